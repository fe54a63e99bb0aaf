"""Where the most probable plan changes, held to crossings worked out by hand."""

import math

import numpy as np
import pytest

from coglogo_py import (
    BiasedWeightedStochastic,
    DecisionMaker,
    MaximumWeight,
    WeightedStochastic,
)
from coglogo_py.receipts.counterfactual import Line, most_probable, smallest_change

ROOT = math.sqrt(2.0)


def line(value, constants, slopes, name="A", **bounds):
    """The weights `constants` + `slopes` · value."""
    constants, slopes = np.array(constants, float), np.array(slopes, float)
    return Line(name, value, slopes, lambda v: constants + slopes * v, **bounds)


def change_of(maker, *lines):
    """The cogniton, its new value and the plan of the smallest change."""
    plans = tuple("abcd"[: len(lines[0].slopes)])
    change = smallest_change(maker, plans, list(lines))
    return None if change is None else (change.cogniton, change.new_value, change.plan)


# With two plans the stronger leads while its share s has s^(1 / bias) > 1/2, so s > 2^-bias. Where
# the least weight is under 1, s = (d + 1) / (d + 2) for the difference d of the weights; else the
# stronger weight is s / (1 - s) times the other.
SHARE = 2.0**-0.9
RATIO = SHARE / (1.0 - SHARE)
DIFFERENCE = (2.0 * SHARE - 1.0) / (1.0 - SHARE)


@pytest.mark.parametrize(
    ("bias", "value", "constants", "slopes", "new_value", "plan"),
    [
        # b is above a by 1 - v at the shifted weights: (1 - v) / (2 - v) = 1 / √2.
        (0.5, -6.0, [-5, -5], [2, 1], -ROOT, "a"),
        # 1 - (8 + 3v) = d, the least weight being under 1 but above 0.
        (0.9, -3.0, [8, 1], [3, 0], (-7.0 - DIFFERENCE) / 3.0, "a"),
        # The same from where the least weight is under 1 to where both are above it.
        (0.9, 0.0, [-2, 3], [-3, -1], (3.0 + 2.0 * RATIO) / (1.0 - 3.0 * RATIO), "a"),
        (0.9, -6.0, [-1, 6], [3, 1], (6.0 + RATIO) / (3.0 * RATIO - 1.0), "a"),
        # Shifted a: 5 - 6v, b: 7 - v, c: 1. b overtakes a where C2² = 2 C1²: 12 - 7v = √2 (5 - 6v).
        (0.5, -2.0, [1, 3, -3], [-3, 2, 3], (12.0 - 5.0 * ROOT) / (7.0 - 6.0 * ROOT), "a"),
    ],
)
def test_with_a_bias_below_one_by_hand(bias, value, constants, slopes, new_value, plan):
    found = change_of(BiasedWeightedStochastic(bias), line(value, constants, slopes))
    assert found == ("A", pytest.approx(new_value, rel=1e-13), plan)


@pytest.mark.parametrize(
    ("bias", "value", "constants", "slopes"),
    [
        (0.9, 5.0, [-4, 6, 0], [-3, 2, 1]),
        (0.9, 6.0, [-2, -1, 2], [1, 2, -2]),
        (0.5, -6.0, [0, -2, -3], [0, -3, -3]),
        (0.5, -4.0, [3, -2, -5, 7], [-2, 1, 3, 1]),
        (0.9, 4.0, [1, 7, -2, -4], [0, -3, 3, 0]),
    ],
)
def test_with_a_bias_below_one_it_is_the_first_that_a_scan_meets(bias, value, constants, slopes):
    maker, weights = BiasedWeightedStochastic(bias), line(value, constants, slopes)
    change = smallest_change(maker, tuple("abcd"[: len(slopes)]), [weights])
    present = most_probable(maker, weights.weights_at(value))
    assert most_probable(maker, weights.weights_at(change.new_value)) != present
    for part in np.linspace(0.0, 0.999, 1000):
        for way in (1.0, -1.0):
            nearer = value + way * part * change.change
            assert most_probable(maker, weights.weights_at(nearer)) == present


def test_a_bias_of_one_is_decided_by_the_largest_weight():
    # a = 1 and c = 2v - 2 are equal at 1.5, and a ranks first; as shares they differ by rounding.
    for maker in (BiasedWeightedStochastic(1.0), WeightedStochastic(), MaximumWeight()):
        found = change_of(maker, line(4.0, [1, 4, -2], [0, -3, 2]))
        assert found == ("A", 1.5, "a")


def test_the_nearest_of_several_crossings():
    # b reaches a's 5 at 5, c at 2.5 already.
    found = change_of(MaximumWeight(), line(0.0, [5, 0, 0], [0, 1, 2]))
    assert found == ("A", math.nextafter(2.5, 3), "c")


def test_of_equal_changes_it_is_that_of_the_first_cogniton_upwards():
    up_and_down = line(0.0, [5, 0, 0], [0, 1, -1])
    found = change_of(MaximumWeight(), up_and_down)
    assert found == ("A", math.nextafter(5.0, 6), "b")
    second = line(0.0, [5, 0, 0], [0, -1, 1], name="B")
    assert change_of(MaximumWeight(), second, up_and_down) == ("B", math.nextafter(5.0, 6), "c")
    assert change_of(MaximumWeight(), up_and_down, second) == ("A", math.nextafter(5.0, 6), "b")


def test_bounds_are_values_that_may_be_proposed():
    # a takes over where b is no more than its 2: at 2 exactly.
    constants, slopes = [2, 0], [0, 1]
    for bounds in ({"low": 2.0}, {"high": 9.0}, {}):
        assert change_of(MaximumWeight(), line(9.0, constants, slopes, **bounds)) == ("A", 2.0, "a")
    assert change_of(MaximumWeight(), line(9.0, constants, slopes, low=2.1)) is None
    found = change_of(MaximumWeight(), line(1.0, [0, 2], [1, 0], high=2.0))
    assert found == ("A", 2.0, "a")
    assert change_of(MaximumWeight(), line(1.0, [0, 2], [1, 0], high=1.9)) is None
    above = math.nextafter(2.0, 3)
    found = change_of(MaximumWeight(), line(1.0, [2, 0], [0, 1], high=above))
    assert found == ("A", above, "b")


class Narrow(DecisionMaker):
    """The first plan, but the second while its weight is between 1.8 and 2."""

    name = "Narrow"

    @staticmethod
    def choose(weights, bias, u):
        return int(1.8 <= weights[1] <= 2.0)

    @staticmethod
    def probabilities(weights, bias):
        chances = np.zeros(len(weights))
        chances[int(1.8 <= weights[1] <= 2.0)] = 1.0
        return chances


@pytest.mark.parametrize("scale", [1e-6, 1.0, 1e6])
def test_for_a_modeller_s_own_maker_steps_grow_by_a_tenth(scale):
    # From 0 on a step is a tenth of what it has come to, so what lasts a tenth is not passed over.
    found = change_of(Narrow(), line(0.0, [0, 0], [0, scale]))
    assert found == ("A", pytest.approx(1.8 / scale, rel=1e-15), "b")


def test_the_most_probable_plan_is_the_first_of_equals():
    for maker in (MaximumWeight(), WeightedStochastic(), BiasedWeightedStochastic(1.0),
                  BiasedWeightedStochastic(2.6)):  # fmt: skip
        assert most_probable(maker, np.array([6.0, 6.0, -2.0, 6.0])) == 0
    # As shares, moved up by 10¹⁷, 0 and 1 are equal.
    assert most_probable(WeightedStochastic(), np.array([-1e17, 0.0, 1.0])) == 1
    assert most_probable(MaximumWeight(), np.array([-1e17, 0.0, 1.0])) == 2
    # Shares 0.5, 0.3, 0.2 and bias 0.5: 0.25, 0.39, 0.36.
    assert most_probable(BiasedWeightedStochastic(0.5), np.array([5.0, 3.0, 2.0])) == 1


def test_the_smallest_change_says_whether_a_smaller_one_may_have_been_missed():
    plans = ("a", "b")
    lines = [line(0.0, [0, 0], [0, 1])]
    assert not smallest_change(Narrow(), plans, lines).exact
    for maker in (MaximumWeight(), WeightedStochastic(), BiasedWeightedStochastic(0.5)):
        change = smallest_change(maker, plans, [line(0.0, [5, 0], [0, 1])])
        assert change.exact
        assert change.change == change.new_value > 0
