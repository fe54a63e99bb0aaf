"""Effect sizes and intervals of differences, against values worked out by hand and by scipy."""

import math

import numpy as np
import pandas as pd
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy import stats

from socialmind.errors import SocialmindError
from socialmind.experiments.measures.effects import (
    cliffs_delta,
    compared,
    comparisons,
    hedges_g,
    paired_delta,
    paired_g,
)
from socialmind.experiments.measures.intervals import interval_of, share_difference, share_interval

samples = st.lists(st.integers(-5, 5), min_size=2, max_size=20)


def test_cliffs_delta_by_hand():
    # 10 beats all three, 7 beats 5 and ties with 7, 1 loses to all: (3 + 1 - 1 - 3) / 9.
    assert cliffs_delta([10, 7, 1], [5, 7, 8]) == 0.0
    assert cliffs_delta([10, 7, 1], [0, 7, 8]) == pytest.approx((3 + 1 + 1 - 1 - 2) / 9)


@given(samples, samples)
def test_cliffs_delta_is_that_of_mann_and_whitney(first, second):
    u = stats.mannwhitneyu(first, second).statistic
    assert cliffs_delta(first, second) == pytest.approx(2 * u / (len(first) * len(second)) - 1)
    assert cliffs_delta(second, first) == pytest.approx(-cliffs_delta(first, second))


def test_what_never_came_about_is_later_than_all_else():
    assert cliffs_delta([math.inf, math.inf], [1, 10**9]) == 1.0
    assert paired_delta([math.inf, 1, math.inf], [math.inf, 2, 5]) == 0.0


def test_hedges_g_by_hand():
    # Means 5 and 3, variances 4 and 1, ten numbers: pooled 2.5; J of 8 is 1 - 3/31 nearly.
    first, second = [3, 3, 5, 7, 7], [2, 2, 3, 4, 4]
    assert np.var(first, ddof=1) == 4
    assert np.var(second, ddof=1) == 1
    assert hedges_g(first, second) == pytest.approx(2 / math.sqrt(2.5) * (1 - 3 / 31), rel=2e-3)


def test_pairs_are_measured_in_the_deviation_of_the_numbers():
    # Every difference is 1 but for one of 2: the spread of the differences plays no part.
    first, second = [2.0, 4.0, 6.0, 9.0], [1.0, 3.0, 5.0, 7.0]
    deviation = math.sqrt((np.var(first, ddof=1) + np.var(second, ddof=1)) / 2)
    correction = math.gamma(1.5) / (math.sqrt(1.5) * math.gamma(1.0))
    assert paired_g(first, second) == pytest.approx(1.25 / deviation * correction)


def test_hedges_g_is_without_bias():
    rng = np.random.default_rng(1)
    found = [hedges_g(rng.normal(0.8, 1, 5), rng.normal(0, 1, 5)) for _ in range(4000)]
    assert np.mean(found) == pytest.approx(0.8, abs=0.04)


@given(samples, st.floats(0.1, 10), st.integers(-9, 9))
def test_units_make_no_difference(first, scale, shift):
    second = [one + 1 for one in first[::-1]]
    if len(set(first)) < 2:
        return
    x, y = scale * np.array(first) + shift, scale * np.array(second) + shift
    for effect in (hedges_g, paired_g):
        assert effect(x, y) == pytest.approx(effect(first, second), rel=1e-6, abs=1e-9)
        assert effect(y, x) == pytest.approx(-effect(x, y), rel=1e-6, abs=1e-9)


def test_the_correction_by_hand():
    # J of 1, 2 and 4 degrees of freedom: the limit 0, 1/√π, and 1/(√2 Γ(3/2)) = √(2/π).
    assert paired_g([1.0, 3.0], [2.0, 5.0]) == 0.0
    assert hedges_g([1.0, 3.0], [2.0, 5.0]) == pytest.approx(-1.5 / math.sqrt(3.25 * math.pi))
    assert paired_g([5, 5, 5], [1, 2, 3]) == pytest.approx(3 / math.sqrt(0.5 * math.pi))
    assert hedges_g([2, 4, 6], [1, 2, 3]) == pytest.approx(
        2 / math.sqrt(2.5) * math.sqrt(2 / math.pi)
    )


def test_without_spread_an_effect_has_no_bounds():
    assert hedges_g([2, 2], [1, 1]) == math.inf
    assert paired_g([1, 1, 1], [2, 2, 2]) == -math.inf
    assert hedges_g([1, 1], [1, 1]) == 0.0


# Comparisons ------------------------------------------------------------------------------------


def test_pairs_take_the_luck_of_the_seeds_out():
    rng = np.random.default_rng(2)
    luck = rng.normal(0, 10, 30)
    first, second = luck + 1 + rng.normal(0, 0.5, 30), luck
    paired, alone = compared(first, second), compared(first, second, paired=False)
    assert paired.difference.low > 0 > alone.difference.low
    assert paired.difference.mean == pytest.approx(alone.difference.mean)
    assert paired.delta > 0.9 > 0.3 > alone.delta
    assert paired.g == pytest.approx(alone.g, rel=0.05)


def test_the_interval_without_pairs_is_nearly_students():
    rng = np.random.default_rng(3)
    first, second = rng.normal(5, 2, 60), rng.normal(3, 1, 40)
    found = compared(first, second, paired=False).difference
    student = stats.ttest_ind(first, second, equal_var=False).confidence_interval()
    assert (found.low, found.high) == pytest.approx((student.low, student.high), abs=0.06)


@settings(max_examples=20)
@given(st.lists(st.floats(-9, 9), min_size=3, max_size=12))
def test_turned_round_the_difference_changes_its_sign(first):
    second = [0.5 * one + 1 for one in first]
    one, other = compared(first, second, False), compared(second, first, False)
    assert one.difference.low == pytest.approx(-other.difference.high, abs=1e-9)


def test_the_interval_without_pairs_by_hand():
    # Bounds as far off as those of both, squared and summed: here all four distances differ.
    first, second = [0.0] * 8 + [1.0, 4.0, 6.0], [5.0] * 6 + [1.0, 0.0]
    one, other = interval_of(first), interval_of(second)
    found = compared(first, second, paired=False)
    assert (found.first, found.second) == (one, other)
    away = one.mean - other.mean
    assert away == pytest.approx(1.0 - 31 / 8)
    below = math.sqrt((one.mean - one.low) ** 2 + (other.high - other.mean) ** 2)
    above = math.sqrt((one.high - one.mean) ** 2 + (other.mean - other.low) ** 2)
    bounds = (found.difference.mean, found.difference.low, found.difference.high)
    assert bounds == pytest.approx((away, away - below, away + above))


def test_shares_have_their_own_intervals():
    all_of, none_of = [1.0, 1.0], [0.0, 0.0]
    for paired in (True, False):
        found = compared(all_of, none_of, paired)
        assert (found.first, found.second) == (share_interval(all_of), share_interval(none_of))
        # Twice two that are alike make nothing sure.
        assert found.difference == share_difference(all_of, none_of)
        assert found.difference.low < 1
    # Those of both, squared and summed, are Newcombe's.
    one, other = [1, 1, 0, 1, 1, 1], [0, 0, 1, 0]
    bounds = compared(one, other, paired=False).difference
    assert bounds.low == pytest.approx(share_difference(one, other).low)
    assert bounds.high == pytest.approx(share_difference(one, other).high)
    # Where one is never met it is an amount that happens to be nought.
    assert compared(none_of, none_of).difference == interval_of(none_of)


def test_all_intervals_are_of_the_level_asked_for():
    first, second = np.array([1.0, 4.0, 2.0, 8.0, 5.0]), np.array([1.0, 1.0, 3.0, 2.0, 6.0])
    found = compared(first, second, level=0.6)
    assert found.first == interval_of(first, 0.6) != interval_of(first)
    assert found.second == interval_of(second, 0.6)
    assert found.difference == interval_of(first - second, 0.6)


def test_where_g_says_something():
    assert math.isnan(compared([1.0, 3.0], [2.0, 5.0]).g)  # two pairs
    assert compared([1.0, 3.0, 2.0], [2.0, 5.0, 2.0]).g < 0
    alone = compared([1.0, 3.0], [2.0, 5.0], paired=False)
    assert alone.g == hedges_g([1.0, 3.0], [2.0, 5.0])
    assert math.isnan(compared([1.0], [2.0, 5.0, 6.0], paired=False).g)
    assert math.isnan(compared([2.0, 5.0, 6.0], [1.0], paired=False).g)
    # One sample without spread still leaves that of the other; none of either, none at all.
    assert compared([5, 5, 5], [1, 2, 3]).g == pytest.approx(3 / math.sqrt(0.5 * math.pi))
    assert math.isnan(compared([5, 5, 5], [4, 4, 4]).g)
    # A hundred deviations are the most: 80 / √π is less, 200 / √π is more.
    assert compared([80, 81, 82], [0, 1, 2]).g == pytest.approx(80 / math.sqrt(math.pi))
    assert math.isnan(compared([200, 201, 202], [0, 1, 2]).g)
    assert math.isnan(compared([0, 1, 2], [200, 201, 202]).g)


def test_infinities_of_both_signs_have_no_mean():
    found = compared([math.inf, -math.inf], [1.0, math.inf])
    assert math.isnan(found.first.mean) and found.second.mean == math.inf
    assert math.isnan(found.difference.mean)
    both = compared([math.inf, 1.0], [math.inf, 2.0])
    assert math.isnan(both.difference.mean) and both.delta == -0.5
    assert compared([-math.inf, 1.0], [1.0, 2.0]).difference.mean == -math.inf


def test_infinite_times_leave_the_ranks_alone():
    found = compared([100.0, math.inf], [50.0, 60.0])
    assert found.first.mean == math.inf
    assert math.isnan(found.difference.low)
    assert math.isnan(found.g)
    assert found.delta == 1.0


def test_societies_are_compared_with_one_of_them_seed_by_seed():
    results = pd.DataFrame(
        {
            "society": ["fixed", "fixed", "fixed", "learned", "learned", "learned"],
            "seed": [1, 2, 3, 3, 1, 2],
            "goods": [10.0, 20.0, 30.0, 33.0, 12.0, 21.0],
            "settling_ticks": [1.0, 2.0, math.nan, 5.0, math.inf, 1.0],
        }
    )
    found = comparisons(results, "fixed").set_index("measure")
    goods = found.loc["goods"]
    assert (goods["pairs"], goods["difference"], goods["delta"]) == (3, 2.0, 1.0)
    learned, fixed = [12.0, 21.0, 33.0], [10.0, 20.0, 30.0]
    own, away = interval_of(learned), interval_of([2.0, 1.0, 3.0])
    assert goods[["mean", "low", "high"]].tolist() == [22.0, own.low, own.high]
    assert goods["reference_mean"] == 20.0
    assert goods[["difference_low", "difference_high"]].tolist() == [away.low, away.high]
    assert goods["g"] == paired_g(learned, fixed)
    times = found.loc["settling_ticks"]
    assert (times["pairs"], times["mean"], times["delta"]) == (2, math.inf, 0.0)


def test_only_the_measures_asked_for_are_compared():
    results = pd.DataFrame(
        {"seed": [1, 1], "society": ["a", "b"], "x": [1.0, 2.0], "y": [1.0, 2.0], "z": [0.0, 0.0]}
    )
    assert comparisons(results, "a", measures=["z", "x"])["measure"].tolist() == ["z", "x"]
    assert comparisons(results, "a")["measure"].tolist() == ["x", "y", "z"]
    # Without a pair there is nothing to tell, in the same columns.
    apart = comparisons(results.assign(seed=[1, 2]), "a")
    assert (apart["pairs"] == 0).all() and apart["difference"].isna().all()


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda: compared([1], [1, 2]), "expected pairs"),
        (lambda: cliffs_delta([], [1]), "one number or more"),
        (lambda: cliffs_delta([math.nan], [1]), "none NaN"),
        (lambda: hedges_g([1, math.inf], [1, 2]), "Cliff's delta in place"),
        (lambda: paired_g([1], [2]), "two or more"),
        (
            lambda: comparisons(pd.DataFrame({"society": ["a"], "seed": [1], "x": [1.0]}), "b"),
            "no society 'b'",
        ),
        (
            lambda: comparisons(pd.DataFrame({"society": ["a"] * 2, "seed": [1] * 2}), "a"),
            "seed twice",
        ),
        (lambda: comparisons(pd.DataFrame({"society": ["a"]}), "a"), "column 'seed'"),
        (
            lambda: comparisons(pd.DataFrame({"society": ["a", None], "seed": [1, 1]}), "a"),
            "without a society",
        ),
    ],
)
def test_what_cannot_be_compared_is_refused(call, message):
    with pytest.raises(SocialmindError, match=message):
        call()
