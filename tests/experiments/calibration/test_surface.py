"""The surface through trials: quadratic forms found again, profiles within the cube."""

import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from socialmind.experiments.calibration.surface import Surface

PLACES = np.random.default_rng(4).uniform(size=(80, 3))


@example([0.5, 0.5, 0.875], 1.99609375)  # two that make up for one another: a long valley
@given(st.lists(st.floats(0.1, 0.9), min_size=3, max_size=3), st.floats(0.0, 2.0))
def test_a_quadratic_form_is_found_again(best, tilt):
    away = PLACES - best
    squares = 0.5 + away[:, 0] ** 2 + 3 * away[:, 1] ** 2 + away[:, 2] ** 2
    squares = squares + tilt * away[:, 0] * away[:, 2]
    found = Surface.through(PLACES, np.sqrt(squares), 1.0)
    assert found.at(PLACES) == pytest.approx(squares, abs=1e-6)
    grid, least = found.profile(1)
    assert least == pytest.approx(0.5 + 3 * (grid - best[1]) ** 2, abs=1e-6)


def test_its_ends_are_where_it_crosses_a_limit_or_the_range_ends():
    squares = (PLACES[:, 0] - 0.1) ** 2 + PLACES[:, 1] ** 2 * 4
    found = Surface.through(PLACES, np.sqrt(squares), 0.3)
    assert found.within(0, 0.04) == pytest.approx((0.0, 0.3), abs=0.002)
    assert found.within(1, 0.04) == pytest.approx((0.0, 0.1), abs=0.002)
    assert found.within(2, 0.04) == (0.0, 1.0)
    assert found.within(0, -0.1) is None


def test_of_a_sum_each_part_may_be_anything():
    squares = (PLACES[:, 0] + PLACES[:, 1] - 1.0) ** 2
    found = Surface.through(PLACES, np.sqrt(squares), 0.1)
    low, high = found.within(0, 0.01)
    assert low < 0.02 and high > 0.98


def test_few_trials_make_a_plain_one_or_none():
    few = PLACES[:11]
    assert np.count_nonzero(Surface.through(few, np.abs(few[:, 0] - 0.5), 0.1).curvature) <= 3
    assert Surface.through(PLACES[:6], np.ones(6), 0.1) is None
    assert Surface.through(PLACES[:30], np.full(30, np.inf), 0.1) is None
