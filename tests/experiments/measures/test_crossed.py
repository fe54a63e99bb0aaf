"""Intervals over trainings and worlds."""

import math

import numpy as np
import pytest

from socialmind.errors import SocialmindError
from socialmind.experiments.measures.crossed import crossed_difference, crossed_interval
from socialmind.experiments.measures.intervals import interval_of


def test_the_worse_of_two_trainings_counts_however_many_worlds_there_are():
    table = np.vstack([np.ones(1000), np.zeros(1000)])
    found = crossed_interval(table)
    assert found.mean == 0.5
    # Two trainings tell next to nothing: t = 12.7 of one degree of freedom.
    assert (found.low, found.high) == pytest.approx((0.5 - 6.35, 0.5 + 6.35), rel=0.02)


def test_of_three_trainings_it_holds_the_mean_of_all_about_as_often_as_it_says():
    rng = np.random.default_rng(4)
    held = 0
    for _ in range(200):
        found = crossed_interval(rng.normal(0, 1, (3, 1)) + rng.normal(0, 0.2, (3, 30)))
        held += found.low <= 0.0 <= found.high
    assert held >= 180


def test_equal_trainings_leave_the_luck_of_worlds():
    worlds = np.random.default_rng(1).random(60)
    found = crossed_interval(np.tile(worlds, (60, 1)))
    alone = interval_of(worlds)
    assert found.mean == pytest.approx(alone.mean)
    assert found.low == pytest.approx(alone.low, abs=0.01)
    assert found.high == pytest.approx(alone.high, abs=0.01)


def test_it_holds_the_mean_of_all_trainings_about_as_often_as_it_says():
    rng = np.random.default_rng(2)
    held = 0
    for _ in range(200):
        skill = rng.normal(0, 1, (10, 1))
        luck = rng.normal(0, 1, (1, 30))
        found = crossed_interval(skill + luck + rng.normal(0, 1, (10, 30)))
        held += found.low <= 0.0 <= found.high
    assert held >= 180


def test_one_training_alone_tells_nothing_of_others():
    found = crossed_interval([[1.0, 0.0]])
    assert found.mean == 0.5 and math.isnan(found.low) and math.isnan(found.high)


@pytest.mark.parametrize("wrong", [[1.0], [[]], [[math.nan]]])
def test_other_tables_are_refused(wrong):
    with pytest.raises(SocialmindError, match="trainings by worlds"):
        crossed_interval(wrong)


def test_what_worlds_have_in_common_is_gone_from_a_difference():
    rng = np.random.default_rng(4)
    worlds = 10 * rng.random(12)
    one, other = (worlds + rng.normal(more, 0.1, (10, 1)) for more in (1.0, 0.0))
    found = crossed_difference(one, other)
    assert found.mean == pytest.approx(1.0, abs=0.1)
    assert 0.8 < found.low < found.high < 1.2
    assert crossed_interval(one).high - crossed_interval(one).low > 3
    turned = crossed_difference(other, one)
    assert turned.mean == pytest.approx(-found.mean)


def test_the_difference_of_two_ways_holds_the_true_one_about_as_often_as_it_says():
    rng = np.random.default_rng(5)
    held = 0
    for _ in range(200):
        worlds = rng.normal(0, 1, 10)
        one, other = (
            worlds + rng.normal(more, 1, (10, 1)) + rng.normal(0, 1, (10, 10)) for more in (1, 0)
        )
        found = crossed_difference(one, other)
        held += found.low <= 1 <= found.high
    assert held >= 188  # it is rather too wide


def test_a_difference_needs_the_same_worlds():
    with pytest.raises(SocialmindError, match="3 and 2 worlds; expected the same ones for both"):
        crossed_difference(np.ones((2, 3)), np.ones((2, 2)))
    assert math.isnan(crossed_difference(np.ones((2, 3)), np.ones((1, 3))).low)


def test_rounding_tells_equal_tables_not_apart():
    one, other = np.full((7, 100), 1.1), np.full((3, 100), 1.1)
    found = crossed_difference(one, other)
    assert (found.mean, found.low, found.high) == (0.0, 0.0, 0.0)
    assert found.beyond() == 0
    assert crossed_interval(np.full((10, 50), 1.1)).low == 1.1


def test_one_world_alone_tells_nothing_and_few_are_widened():
    assert math.isnan(crossed_interval([[1.0], [2.0], [3.0], [4.0], [5.0], [6.0]]).low)
    # In two worlds alike for all trainings the rest is as of two numbers: t is 12.7.
    found = crossed_interval([[0.0, 1.0]] * 8)
    assert found.high - found.low > 5.0
