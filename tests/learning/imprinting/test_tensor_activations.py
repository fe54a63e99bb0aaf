"""Activations over tensors are those of minds, and so are their gradients."""

import numpy as np
import pytest

from socialmind.mind.functions.activations import activate, aggregate
from socialmind.mind.functions.network import (
    CLAMP,
    LINEAR,
    NEAT_ACTIVATIONS,
    NEAT_AGGREGATIONS,
    RELU,
    SIGMOID,
    TANH,
)

torch = pytest.importorskip("torch")

from socialmind.learning.imprinting import tensor_activations  # noqa: E402

PLAIN = {"linear": LINEAR, "relu": RELU, "sigmoid": SIGMOID, "clamp": CLAMP, "tanh": TANH}
ACTIVATIONS = PLAIN | {f"neat {name}": code for name, code in NEAT_ACTIVATIONS.items()}
WILD = [0.0, -0.0, 1e300, -1e300, 1e-300, 5e-324, 700.0, -700.0]


@pytest.mark.parametrize("name", ACTIVATIONS)
def test_values_are_the_same(name):
    code = ACTIVATIONS[name]
    x = np.concatenate([np.linspace(-9, 9, 721), WILD])
    ours = tensor_activations.activate(code, torch.tensor(x)).numpy()
    assert ours == pytest.approx([activate(code, float(one)) for one in x], rel=1e-13, abs=1e-14)


@pytest.mark.parametrize("name", ACTIVATIONS)
def test_gradients_are_those_of_finite_differences(name):
    code = ACTIVATIONS[name]
    # None of these lies at a kink.
    x = torch.tensor([-2.31, -0.83, -0.27, 0.19, 0.61, 1.37], dtype=torch.float64)
    x.requires_grad_()
    assert torch.autograd.gradcheck(lambda x: tensor_activations.activate(code, x), [x])


@pytest.mark.parametrize("name", ACTIVATIONS)
def test_gradients_are_numbers_everywhere(name):
    x = torch.tensor(WILD, dtype=torch.float64, requires_grad=True)
    tensor_activations.activate(ACTIVATIONS[name], x).sum().backward()
    assert not torch.isnan(x.grad).any()


@pytest.mark.parametrize("name", NEAT_AGGREGATIONS)
@pytest.mark.parametrize("count", range(7))
def test_aggregations_are_the_same(name, count):
    code = NEAT_AGGREGATIONS[name]
    values = np.random.default_rng(count).normal(size=(20, 3, count))
    ours = tensor_activations.aggregate(code, torch.tensor(values)).numpy()
    expected = [[aggregate(code, list(one)) for one in row] for row in values]
    assert ours == pytest.approx(np.array(expected), rel=1e-12, abs=1e-13)


@pytest.mark.parametrize("name", NEAT_AGGREGATIONS)
def test_gradients_of_aggregations(name):
    code = NEAT_AGGREGATIONS[name]
    values = torch.tensor(np.random.default_rng(3).normal(size=(4, 5)), requires_grad=True)
    assert torch.autograd.gradcheck(lambda v: tensor_activations.aggregate(code, v), [values])
