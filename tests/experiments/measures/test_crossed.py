"""Intervals over trainings and worlds."""

import math

import numpy as np
import pytest

from socialmind.errors import SocialmindError
from socialmind.experiments.measures.crossed import crossed_interval
from socialmind.experiments.measures.intervals import interval_of


def test_the_worse_of_two_trainings_counts_however_many_worlds_there_are():
    table = np.vstack([np.ones(1000), np.zeros(1000)])
    found = crossed_interval(table)
    assert (found.mean, found.low, found.high) == pytest.approx((0.5, 0.0, 1.0))


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
