"""Intervals of means: where they lie, how wide they are, and how often they are right."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy import stats

from socialmind.errors import SocialmindError
from socialmind.experiments.measures import intervals
from socialmind.experiments.measures.intervals import (
    Interval,
    interval_of,
    share_difference,
    share_interval,
)


def test_of_many_normal_numbers_it_is_the_usual_one():
    sample = np.random.default_rng(1).normal(10.0, 2.0, 400)
    found = interval_of(sample)
    half = 1.966 * sample.std(ddof=1) / math.sqrt(400)
    assert found.mean == sample.mean()
    assert (found.low, found.high) == pytest.approx(
        (found.mean - half, found.mean + half), abs=0.02
    )


def test_of_skewed_numbers_the_longer_side_is_that_of_the_tail():
    found = interval_of([1.0] * 17 + [0.4, 0.2, 0.1])
    assert found.mean - found.low > found.high - found.mean > 0
    assert found.high <= 1.0
    mirrored = interval_of([0.0] * 17 + [0.6, 0.8, 0.9])
    assert (1 - mirrored.high, 1 - mirrored.low) == pytest.approx((found.low, found.high), abs=0.02)


def test_equal_numbers_and_one_alone_have_no_width():
    assert interval_of([7] * 30) == Interval(7.0, 7.0, 7.0)
    alone = interval_of([2.5])
    assert alone.mean == 2.5 and math.isnan(alone.low) and math.isnan(alone.high)
    assert alone.record() == {"mean": 2.5, "low": None, "high": None}


def test_of_several_means_it_is_that_of_what_they_are_combined_to():
    draws = np.random.default_rng(5)
    whole = draws.poisson(8.0, 300) + 1.0
    part = draws.binomial(whole.astype(int), 0.3)
    found = interval_of(np.stack([part, whole], axis=1), combine=lambda a, b: a / b)
    assert found.mean == pytest.approx(part.sum() / whole.sum())
    # A share of independent draws: the normal approximation holds.
    half = 1.966 * math.sqrt(0.3 * 0.7 / whole.sum())
    assert (found.low, found.high) == pytest.approx(
        (found.mean - half, found.mean + half), abs=0.004
    )
    # A plain mean is the same by either way.
    plain = interval_of(whole)
    combined = interval_of(whole[:, None], combine=lambda a: a)
    assert (plain.mean, plain.low, plain.high) == pytest.approx(
        (combined.mean, combined.low, combined.high)
    )


def test_what_both_have_in_common_cancels_out():
    hard = np.random.default_rng(6).normal(10.0, 3.0, 100)
    pairs = np.stack([1.2 * hard, hard], axis=1)
    found = interval_of(pairs, combine=lambda own, other: own / other)
    assert (found.low, found.mean, found.high) == pytest.approx((1.2, 1.2, 1.2))


def test_a_ratio_to_nothing_is_no_number():
    found = interval_of([[0, 0], [0, 0]], combine=lambda a, b: a / b if b else math.nan)
    assert math.isnan(found.mean) and math.isnan(found.low)
    assert found.record() == {"mean": None, "low": None, "high": None}
    # Where all hangs on one of few nobody knows how far others would lie.
    some = interval_of([[1, 2], [0, 0], [0, 0]], combine=lambda a, b: a / b if b else math.nan)
    assert some.mean == 0.5 and math.isnan(some.low)


@pytest.mark.parametrize("call", [lambda: interval_of([]), lambda: share_interval([]),
                                  lambda: share_interval([5, 7])])  # fmt: skip
def test_what_has_no_interval_is_said(call):
    with pytest.raises(SocialmindError, match="expected"):
        call()


def test_a_difference_of_shares_is_as_published():
    # Newcombe (1998), table II, method 10: 9 of 10 against 3 of 10, and 10 of 10 against 0 of 20.
    found = share_difference([1] * 9 + [0], [1] * 3 + [0] * 7)
    assert (found.mean, found.low, found.high) == pytest.approx((0.6, 0.1705, 0.8090), abs=1e-4)
    found = share_difference([1] * 10, [0] * 20)
    assert (found.mean, found.low, found.high) == pytest.approx((1.0, 0.6791, 1.0), abs=1e-4)


@given(st.lists(st.floats(0, 1), min_size=intervals.FEW, max_size=30))
@settings(max_examples=30)
def test_it_stays_within_what_was_seen_and_repeats_itself(values):
    found = interval_of(values)
    assert min(values) - 1e-12 <= found.low <= found.high <= max(values) + 1e-12
    assert found == interval_of(values)


@pytest.mark.parametrize("unit", [1e-110, 1e110])
def test_units_make_no_difference(unit):
    values = np.array([0.0, 0.0, 1.0, 5.0, 7.0])
    found, scaled = interval_of(values), interval_of(values * unit)
    assert (scaled.low / unit, scaled.high / unit) == pytest.approx((found.low, found.high))


@given(st.lists(st.floats(0, 1), min_size=2, max_size=intervals.FEW - 1))
@settings(max_examples=30)
def test_of_a_handful_it_is_that_by_students_t(values):
    found = interval_of(values)
    error = stats.sem(values)
    expected = stats.t.interval(0.95, len(values) - 1, np.mean(values), error) if error else [0, 0]
    if error > 1e-9:
        assert (found.low, found.high) == pytest.approx(expected, rel=1e-6)
    combined = interval_of(np.reshape(values, (-1, 1)), combine=lambda mean: mean)
    assert (combined.low, combined.high) == pytest.approx((found.low, found.high), abs=1e-6)


@pytest.mark.parametrize("size", [3, 5])
def test_of_a_handful_it_holds_the_mean_as_often_as_it_says(size):
    rng = np.random.default_rng(8)
    found = [interval_of(rng.normal(0.0, 1.0, size)) for _ in range(2000)]
    assert np.mean([one.low <= 0.0 <= one.high for one in found]) == pytest.approx(0.95, abs=0.015)


@pytest.mark.parametrize("free", [1, 2, 3, 4, 5, 30, 31])
def test_students_quantile_is_that_of_scipy(free):
    for level in (0.5, 0.95, 0.999):
        assert intervals.student(level, free) == pytest.approx(
            stats.t.ppf((1 + level) / 2, free), rel=1e-8
        )


def test_more_numbers_and_lower_levels_make_it_narrower():
    values = np.random.default_rng(2).random(200)
    widths = [found.high - found.low for found in map(interval_of, (values[:20], values))]
    narrow = interval_of(values, level=0.5)
    assert widths[0] > 2 * widths[1] > 4 * (narrow.high - narrow.low) / 2


@pytest.mark.parametrize(
    ("draw", "mean"),
    [
        (lambda rng, n: np.where(rng.random(n) < 0.3, rng.random(n), 1.0), 0.85),
        (lambda rng, n: rng.poisson(6.0, n), 6.0),
        (lambda rng, n: rng.poisson(0.7, n), 0.7),
    ],
    ids=["shares survived", "objects", "collisions"],
)
def test_of_twenty_episodes_it_holds_the_mean_as_often_as_it_says(monkeypatch, draw, mean):
    monkeypatch.setattr(intervals, "RESAMPLES", 1000)
    rng = np.random.default_rng(3)
    held = [
        found.low <= mean <= found.high
        for found in (interval_of(draw(rng, 20)) for _ in range(400))
    ]
    # 95 % give or take 2.2 for 400 samples, and a little less for so skewed small ones.
    assert 0.915 <= np.mean(held) <= 0.985


@pytest.mark.parametrize("size", [15, 40])
@pytest.mark.parametrize("ratio", [False, True], ids=["mean", "ratio of means"])
def test_it_is_the_bootstrap_of_scipy_at_the_widened_level(size, ratio):
    rng = np.random.default_rng(11)
    whole = 1.0 + rng.exponential(2.0, size)
    part = whole * rng.random(size) ** 3

    def share(a, b, axis=-1):
        return a.mean(axis=axis) / b.mean(axis=axis)

    if ratio:
        own = interval_of(np.stack([part, whole], axis=1), combine=lambda a, b: a / b)
        samples, statistic = (part, whole), share
    else:
        own = interval_of(part)
        samples, statistic = (part,), np.mean
    # Student's quantile of n - 1 and the factor √(n / (n − 1)), from scipy's own distributions.
    wide = stats.t.ppf(0.975, size - 1) * math.sqrt(size / (size - 1))
    theirs = stats.bootstrap(
        samples,
        statistic,
        paired=ratio,
        n_resamples=20_000,
        confidence_level=2 * stats.norm.cdf(wide) - 1,
        method="BCa",
        rng=np.random.default_rng(12),
    ).confidence_interval
    width = theirs.high - theirs.low
    assert own.low == pytest.approx(theirs.low, abs=0.04 * width)
    assert own.high == pytest.approx(theirs.high, abs=0.04 * width)


@pytest.mark.parametrize("n", [10, 15, 40, 200])
@pytest.mark.parametrize("level", [0.5, 0.8, 0.95])
def test_it_is_as_wide_as_students_distribution_and_the_sample_say(n, level):
    right = stats.t.ppf((1 + level) / 2, n - 1) * math.sqrt(n / (n - 1))
    assert intervals.widened(level, n) == pytest.approx(right, rel=0.002)


def product(one, other):
    return one * other


def curved(one, other):
    return 0.3 * one * one + other


def at_most(one, other):
    """A number that some means have none of."""
    return one if one < 2.1 else math.nan


@pytest.mark.parametrize("level", [0.6, 0.95])
@pytest.mark.parametrize("combine", [None, product, curved, at_most])
def test_it_is_efrons_formula_word_by_word(combine, level):
    # Counts, so that many means are tied; and so skewed that bias and acceleration both matter.
    sample = np.array([[0, 4], [0, 1], [0, 1], [1, 2], [1, 1], [2, 3], [9, 9]], float)
    sample = sample if combine else sample[:, :1]

    def made(means):
        return combine(*means) if combine else means[0]

    found = interval_of(sample, level, combine)
    value = made(sample.mean(axis=0))
    draws = np.array([made(one) for one in intervals._means_of_resamples(sample)])
    draws = draws[np.isfinite(draws)]
    draws[np.abs(draws - value) < 1e-9] = value
    bias = stats.norm.ppf((draws < value).mean() + (draws == value).mean() / 2)
    without = np.array([made(np.delete(sample, one, 0).mean(axis=0)) for one in range(7)])
    without = without[np.isfinite(without)]
    apart = without.mean() - without
    speed = (apart**3).sum() / (6 * (apart**2).sum() ** 1.5)
    assert abs(bias) > 0.05 and abs(speed) > 0.05
    wide = intervals.widened(level, 7)
    shares = [bias + z / (1 - speed * z) for z in (bias - wide, bias + wide)]
    low, high = np.quantile(draws, stats.norm.cdf(shares))
    assert (found.mean, found.low, found.high) == pytest.approx((value, low, high), abs=1e-9)


def test_numbers_around_0_are_tied_as_others_are():
    values = np.array([0.1, 0.2, 0.3, -0.6] * 2)
    found, moved = interval_of(values), interval_of(values + 5.0)
    assert (found.low + 5.0, found.high + 5.0) == pytest.approx((moved.low, moved.high), abs=1e-9)


def test_where_nothing_lies_below_there_is_an_interval():
    found = interval_of([1.0, 2.0, 3.5, 1.5, 2.5, 1.5], combine=lambda mean: (mean - 2.0) ** 2)
    assert found.mean == 0.0 and 0.0 <= found.low <= found.high < 1.0


def test_a_sample_too_large_for_one_draw_is_drawn_in_parts(monkeypatch):
    values = np.random.default_rng(4).random(50)
    monkeypatch.setattr(intervals, "RESAMPLES", 1000)
    at_once = interval_of(values)
    monkeypatch.setattr(intervals, "_AT_ONCE", 50 * 300)  # 300, 300, 300 and 100 draws
    drawn = intervals._means_of_resamples(values[:, None])
    assert drawn.shape == (1000, 1)
    assert interval_of(values) == at_once


def test_at_levels_near_one_the_mean_lies_within():
    for sample in ([0, 0, 0, 0, 0, 1], [1, 1, 1, 1, 1, 0]):
        found = interval_of(sample, 0.9999)
        assert found.low <= found.mean <= found.high
