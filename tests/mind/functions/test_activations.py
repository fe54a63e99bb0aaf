"""The formulas of neurons: those of neat-python, finite everywhere, alike compiled."""

import math

import numba
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from socialmind.mind.functions.activations import FINITE, activate, aggregate
from socialmind.mind.functions.network import (
    CLAMP,
    LINEAR,
    NEAT_ACTIVATIONS,
    NEAT_AGGREGATIONS,
    RELU,
    SIGMOID,
    TANH,
)

NUMBERS = st.floats(-1e3, 1e3)
PLAIN = (LINEAR, RELU, SIGMOID, CLAMP, TANH)


@pytest.fixture(scope="module")
def compiled():
    return numba.njit(activate), numba.njit(aggregate)


@pytest.mark.parametrize("name", NEAT_ACTIVATIONS)
def test_the_activations_are_those_of_neat_python(name):
    neat = pytest.importorskip("neat")
    theirs = neat.activations.ActivationFunctionSet().get(name)
    for x in np.concatenate([np.linspace(-30, 30, 1201), np.geomspace(1e-9, 1e9, 40)]):
        ours = activate(NEAT_ACTIVATIONS[name], float(x))
        assert ours == pytest.approx(theirs(float(x)), rel=1e-14, abs=1e-300), x


def test_there_is_a_code_for_everything_in_neat_python():
    neat = pytest.importorskip("neat")
    assert set(neat.activations.ActivationFunctionSet().functions) == set(NEAT_ACTIVATIONS)
    assert set(neat.aggregations.AggregationFunctionSet().functions) == set(NEAT_AGGREGATIONS)


@pytest.mark.parametrize("name", NEAT_AGGREGATIONS)
@given(values=st.lists(NUMBERS, max_size=9))
def test_the_aggregations_are_those_of_neat_python(name, values):
    neat = pytest.importorskip("neat")
    theirs = neat.aggregations.AggregationFunctionSet().get(name)(values)
    assert aggregate(NEAT_AGGREGATIONS[name], values) == pytest.approx(theirs, rel=1e-12, abs=1e-9)


@pytest.mark.parametrize(
    ("code", "x", "expected"),
    [
        (LINEAR, -1.25, -1.25),
        (RELU, -0.5, 0.0),
        (RELU, 2.5, 2.5),
        (SIGMOID, 0.0, 0.5),
        (SIGMOID, math.log(3.0), 0.75),
        (SIGMOID, -math.log(3.0), 0.25),
        (SIGMOID, 1e308, 1.0),
        (SIGMOID, -1e308, 0.0),
        (CLAMP, -1e308, 0.0),
        (CLAMP, 0.3, 0.3),
        (CLAMP, 1.7, 1.0),
        (TANH, 0.5 * math.log(3.0), 0.5),
        (NEAT_ACTIVATIONS["sigmoid"], math.log(3.0) / 5.0, 0.75),
        (NEAT_ACTIVATIONS["inv"], 0.0, 0.0),
        (NEAT_ACTIVATIONS["inv"], 5e-324, FINITE),
        (NEAT_ACTIVATIONS["cube"], 1e300, 1e300),
        (NEAT_ACTIVATIONS["square"], -math.inf, 1e200),
        (NEAT_ACTIVATIONS["identity"], math.nan, 0.0),
    ],
)
def test_values_by_hand(code, x, expected):
    assert activate(code, x) == pytest.approx(expected, rel=1e-15)


@given(x=st.floats(allow_nan=True, allow_infinity=True))
def test_neurons_of_neat_python_stay_finite(x):
    for name, code in NEAT_ACTIVATIONS.items():
        assert math.isfinite(activate(code, x)), name


@given(x=st.floats(allow_nan=True, allow_infinity=True))
def test_compiled_they_are_the_same(compiled, x):
    for code in (*PLAIN, *NEAT_ACTIVATIONS.values()):
        ours, theirs = activate(code, x), compiled[0](code, x)
        assert ours == pytest.approx(theirs, rel=1e-15, nan_ok=True), code


@given(values=st.lists(NUMBERS, max_size=9))
def test_compiled_aggregations_are_the_same(compiled, values):
    for code in NEAT_AGGREGATIONS.values():
        assert aggregate(code, values) == compiled[1](code, np.array(values, dtype=np.float64))
