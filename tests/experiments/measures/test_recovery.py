"""How a number comes back after a shock, against values worked out by hand."""

import math

import numpy as np
import pytest

from socialmind.errors import SocialmindError
from socialmind.experiments.measures.recovery import first_reached, recovery


def test_unknown_values_have_not_reached_the_level():
    values = [[np.nan, np.nan], [np.nan, 0.8]]
    assert first_reached([0, 5], values, 0.8).tolist() == [math.inf, 5.0]


def test_no_recovery():
    found = recovery([0, 10, 20, 30], [6, 6, 3, 3], shock=10, after=3, window=10)
    assert found.share == 0.0
    assert found.halfway == math.inf
    assert found.full == math.inf


def test_recovery_in_two_steps():
    ticks = [0, 10, 20, 30, 40, 50]
    found = recovery(ticks, [8, 8, 4, 6, 7, 8], shock=10, after=4, window=10)
    assert found.before == 8.0
    assert found.at_end == 7.5
    assert found.share == pytest.approx(3.5 / 4)
    assert found.halfway == 20.0  # 6 at tick 30
    assert found.full == 40.0


def test_the_window_before_holds_both_its_ends():
    # From tick 10 to the shock at 30: 6, 9 and 3, of a mean of 6; at the end 4 and 8.
    ticks, number = [0, 10, 20, 30, 40, 50, 60], [90, 6, 9, 3, 2, 4, 8]
    found = recovery(ticks, number, shock=30, after=1, window=20)
    assert found.before == 6.0
    assert found.after == 1.0
    assert found.at_end == pytest.approx((2 + 4 + 8) / 3)
    assert found.share == pytest.approx((14 / 3 - 1) / 5)
    assert found.halfway == 20.0  # 3.5 or more at tick 50
    assert found.full == 30.0  # 6 or more at tick 60


def test_a_mean_between_two_numbers_is_made_good_by_the_lower_one():
    found = recovery([0, 10, 20, 30, 40], [5, 6, 3, 5, 6], shock=10, after=2, window=10)
    assert found.before == 5.5
    assert found.full == 20.0
    assert found.halfway == 20.0


def test_what_rose_with_the_shock_has_a_share_as_well():
    found = recovery([0, 10, 20, 30], [4, 4, 8, 6], shock=10, after=8, window=10)
    assert found.share == pytest.approx((7 - 8) / (4 - 8))


def test_the_end_is_after_the_shock_however_wide_the_window():
    found = recovery([0, 10, 20, 30, 40], [6, 6, 6, 6, 3], shock=30, after=3, window=20)
    assert (found.at_end, found.share) == (3.0, 0.0)


def test_where_nothing_was_lost_there_is_no_share():
    assert math.isnan(recovery([0, 1, 2], [5, 5, 5], shock=1, after=5, window=1).share)


@pytest.mark.parametrize(("shock", "window"), [(30, 10), (15, 4)])
def test_a_shock_without_records_before_or_after_it_is_refused(shock, window):
    with pytest.raises(SocialmindError, match="expected records in the"):
        recovery([0, 10, 20, 30], [4, 4, 8, 6], shock=shock, after=8, window=window)
