"""The contract that every decision maker keeps, a modeller's own included, and the formulas."""

import math

import numba
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from coglogo_py import (
    BiasedWeightedStochastic,
    DecisionMaker,
    MaximumWeight,
    PositiveStochastic,
    SchemeError,
    WeightedStochastic,
)
from coglogo_py.decision import BUILT_IN, decision_maker_called

ALMOST_ONE = math.nextafter(1.0, 0.0)


class Exploring(DecisionMaker):
    """The best plan, but with probability bias / (1 + bias) any one: a modeller's own."""

    name = "Exploring"

    @staticmethod
    def choose(weights, bias, u):
        exploring = bias / (1.0 + bias)
        if u < exploring:
            return min(int(u / exploring * len(weights)), len(weights) - 1)
        return int(np.argmax(weights))

    @staticmethod
    def probabilities(weights, bias):
        shares = np.full(len(weights), bias / (1.0 + bias) / len(weights))
        shares[np.argmax(weights)] += 1.0 / (1.0 + bias)
        return shares


MAKERS = [
    *(
        kind(bias)
        for kind in BUILT_IN
        for bias in ((0.5, 1.0, 2.6, 30.0) if kind.biased else (1.0,))
    ),
    Exploring(0.25),
]
COMPILED = {
    type(maker): (numba.njit(maker.choose), numba.njit(maker.probabilities)) for maker in MAKERS
}
WEIGHTS = [
    [3.0],
    [12.0, 9.0],
    [0.0, 0.0, 0.0],
    [5.0, -2.0, 5.0, 1.0],
    [0.5, 0.25, 7.0, 0.5, 0.5],
    [-1e17, 0.0, 1e17],
    [1e-300, -1e-300],
    [1.7e308, -1.7e308, 1.7e308],
    [1.7e308] * 9,
    [-1.7e308, 0.0, 0.0],
    [7e15, 1e15, 5e15, 4e15, 5e15, 9e15, 0.0],  # by rank the shares before the last exceed 1
    [-1.7e308, -1.7e308],
    list(np.linspace(-3.0, 40.0, 60)),
]

every_maker = pytest.mark.parametrize("maker", MAKERS, ids=repr)
all_weights = st.lists(
    st.floats(allow_nan=False, allow_infinity=False) | st.sampled_from([0.0, 1.0, -1.0]),
    min_size=1,
    max_size=8,
)


@every_maker
@pytest.mark.parametrize("weights", WEIGHTS, ids=lambda w: f"{len(w)} from {w[0]}")
def test_choices_over_all_draws_come_as_often_as_their_probabilities_say(maker, weights):
    weights = np.array(weights)
    chances = maker.probabilities(weights, maker.bias)
    assert chances.shape == weights.shape
    assert (chances >= 0).all()
    assert chances.sum() == pytest.approx(1.0, abs=1e-12)
    count = 4000
    draws = (np.arange(count) + 0.5) / count
    choose, _ = COMPILED[type(maker)]
    chosen = np.bincount([choose(weights, maker.bias, u) for u in draws], minlength=len(weights))
    # Between two neighbouring draws each plan's interval may begin and end.
    assert np.abs(chosen / count - chances).max() <= 2 / count


@every_maker
@given(weights=all_weights, u=st.floats(0, ALMOST_ONE))
def test_compiled_and_interpreted_are_the_same_bit_for_bit(maker, weights, u):
    weights = np.array(weights)
    choose, probabilities = COMPILED[type(maker)]
    position = maker.choose(weights, maker.bias, u)
    assert position == choose(weights, maker.bias, u)
    assert type(position) is int
    assert 0 <= position < len(weights)
    chances = maker.probabilities(weights, maker.bias)
    assert not np.isnan(chances).any()
    assert chances.tobytes() == probabilities(weights, maker.bias).tobytes()


@every_maker
@pytest.mark.parametrize("u", [0.0, 5e-324, 0.5, ALMOST_ONE])
@pytest.mark.parametrize("weights", WEIGHTS, ids=lambda w: f"{len(w)} from {w[0]}")
def test_no_draw_loses_the_plan(maker, weights, u):
    assert 0 <= maker.choose(np.array(weights), maker.bias, u) < len(weights)


@every_maker
def test_weights_are_left_as_they_were(maker):
    weights = np.array([0.5, -3.0, 7.0])
    maker.choose(weights, maker.bias, 0.4)
    maker.probabilities(weights, maker.bias)
    assert weights.tolist() == [0.5, -3.0, 7.0]


@pytest.mark.parametrize(
    ("weights", "expected"),
    [
        ([1.5, 1.5], [1 / 2, 1 / 2]),  # MetaCiv's own cuts them to 2/3 and 1/3
        ([-4.0, 1.0, 0.0, 3.0], [0, 1 / 4, 0, 3 / 4]),
        ([-2.0, -1.0, -1.0], [0, 1, 0]),
    ],
)
def test_positive_stochastic_draws_among_the_weights_above_0(weights, expected):
    found = PositiveStochastic.probabilities(np.array(weights), 1.0)
    assert found == pytest.approx(expected)
    assert PositiveStochastic.choose(np.array([1.0, 3.0]), 1.0, 0.25) == 1  # the border is above


def test_maximum_weight_takes_the_first_of_equals():
    assert MaximumWeight.choose(np.array([1.0, 4.0, 4.0]), 1.0, 0.99) == 1
    assert MaximumWeight.probabilities(np.array([1.0, 4.0, 4.0]), 1.0).tolist() == [0, 1, 0]


@pytest.mark.parametrize(
    ("weights", "expected"),
    [
        ([1.0, 3.0], [1 / 4, 3 / 4]),  # least is 1: no offset
        ([2.0, 6.0], [1 / 4, 3 / 4]),  # least above 1: no offset
        ([0.0, 2.0], [1 / 4, 3 / 4]),  # offset 1
        ([0.5, 1.5], [1 / 3, 2 / 3]),  # offset 0.5: 1 and 2
        ([-2.0, 0.0, 3.0], [1 / 10, 3 / 10, 6 / 10]),  # offset 3: 1, 3, 6
    ],
)
def test_weighted_stochastic_by_hand(weights, expected):
    assert WeightedStochastic.probabilities(np.array(weights), 1.0) == pytest.approx(expected)


@pytest.mark.parametrize(
    ("weights", "expected"),
    [
        ([0.0, 1e301], [1e-301, 1.0]),  # offset 1
        ([-1.7e308, 0.0, 0.0], [1 / 1.7e308 / 2, 0.5, 0.5]),
        ([3e299, 7e299, 1e300], [0.15, 0.35, 0.5]),
        ([1e308, 1e308, 1.5e308, 1.5e308], [0.2, 0.2, 0.3, 0.3]),
    ],
)
def test_shares_near_the_end_of_the_number_range(weights, expected):
    found = WeightedStochastic.probabilities(np.array(weights), 1.0)
    assert found == pytest.approx(expected, rel=1e-13, abs=0)


def test_shares_to_the_last_bit():
    # The least weight is 1: no weight is moved. 2⁵³ + 2 less 1 and more 1 would be 2⁵³.
    found = WeightedStochastic.probabilities(np.array([1.0, 2.0**53 + 2, 2.0**53]), 1.0)
    assert found.tolist() == [2.0**-54 * (1 - 2.0**-52), 0.5, 0.5 - 2.0**-53]
    # Scaled down by 10⁻¹⁰ / 3: some sums are then another last bit than unscaled.
    found = WeightedStochastic.probabilities(np.array(NEAR_THE_END), 1.0)
    assert [one.hex() for one in found.tolist()] == SHARES_NEAR_THE_END


NEAR_THE_END = [4.3e299, 2.6e299, 7.4e299]
SHARES_NEAR_THE_END = ["0x1.33ea8479bbf8dp-2", "0x1.745d1745d1746p-3", "0x1.08f377f1ada68p-1"]


def test_weighted_stochastic_walks_in_the_order_of_the_scheme():
    weights = np.array([1.0, 3.0])
    assert WeightedStochastic.choose(weights, 1.0, 0.25) == 0  # a draw on the border counts
    assert WeightedStochastic.choose(weights, 1.0, 0.2500001) == 1


def test_biased_weighted_stochastic_by_hand():
    # Shares 0.25, 0.75; by rank C = 0.75, 1; with bias 2 the roots are 0.866 and 1.
    chances = BiasedWeightedStochastic.probabilities(np.array([1.0, 3.0]), 2.0)
    assert chances == pytest.approx([1 - math.sqrt(0.75), math.sqrt(0.75)])
    # Of equals the earlier gets more: sqrt(1/2) against the rest.
    chances = BiasedWeightedStochastic.probabilities(np.array([4.0, 4.0]), 2.0)
    assert chances == pytest.approx([math.sqrt(0.5), 1 - math.sqrt(0.5)])
    assert BiasedWeightedStochastic.choose(np.array([1.0, 3.0]), 2.0, 0.866) == 1
    assert BiasedWeightedStochastic.choose(np.array([1.0, 3.0]), 2.0, 0.8661) == 0


@pytest.mark.parametrize(
    ("bias", "u", "weights"),
    [
        (1.0, 0.5, [3.0, 3.0]),
        (2.0, 0.5, [1.0] * 4),
        (0.5, 0.25, [7.0, 7.0]),
        (0.5, 0.0625, [1.0] * 4),
    ],
)
def test_a_biased_draw_on_the_border_counts(bias, u, weights):
    weights = np.array(weights)
    assert BiasedWeightedStochastic.choose(weights, bias, u) == 0
    assert BiasedWeightedStochastic.choose(weights, bias, math.nextafter(u, 1.0)) == 1


def test_a_bias_of_one_changes_nothing_but_the_walk():
    weights = np.array([0.0, 2.0, -1.0])
    plain = WeightedStochastic.probabilities(weights, 1.0)
    assert BiasedWeightedStochastic.probabilities(weights, 1.0) == pytest.approx(plain)


@pytest.mark.parametrize("bias", [0, -2.0, math.nan, math.inf, True, "2", None])
def test_a_bias_must_be_a_finite_number_above_0(bias):
    with pytest.raises(SchemeError, match="a finite number above 0"):
        BiasedWeightedStochastic(bias)


def test_makers_are_equal_by_kind_and_bias():
    assert BiasedWeightedStochastic(2) == BiasedWeightedStochastic(2.0)
    assert BiasedWeightedStochastic(2) != BiasedWeightedStochastic(3)
    assert MaximumWeight() != WeightedStochastic()


def test_makers_are_found_by_their_exact_name():
    assert decision_maker_called("Exploring", 2.0, [Exploring]) == Exploring(2.0)
    with pytest.raises(SchemeError) as failure:
        decision_maker_called("maximumWeight", 1.0, [Exploring])
    message = str(failure.value)
    assert "'maximumWeight'" in message
    assert "did you mean 'MaximumWeight'" in message
    assert f"{BUILT_IN[-1].name}, Exploring" in message


def test_an_incomplete_maker_is_refused_where_it_is_written():
    with pytest.raises(SchemeError, match="one word"):
        type("Nameless", (DecisionMaker,), {})
    with pytest.raises(SchemeError, match="one word"):
        type("Spaced", (DecisionMaker,), {"name": "two words"})
    with pytest.raises(SchemeError, match="without a static function 'choose'"):
        type("Idle", (DecisionMaker,), {"name": "Idle"})
    functions = {"choose": lambda weights, bias, u: 0, "probabilities": staticmethod(len)}
    with pytest.raises(SchemeError, match="@staticmethod"):
        type("Method", (DecisionMaker,), {"name": "Method", **functions})
    with pytest.raises(SchemeError, match="decides nothing"):
        DecisionMaker()
