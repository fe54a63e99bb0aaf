"""The criterion by which the thesis's results count as reproduced."""

import pytest

from socialmind.experiments.judging import are_alike, between_shares, covers, too_short
from socialmind.experiments.measures.intervals import Interval


def test_two_shares_differ_by_their_score_intervals():
    """Newcombe (1998), table II, row a of method 10: 56 of 70 and 48 of 80."""
    found = between_shares(56, 70, 48, 80)
    assert (found.mean, found.low, found.high) == pytest.approx((0.2, 0.0524, 0.3339), abs=1e-4)


def test_nine_of_ten_are_not_told_from_ten_of_ten_but_two_of_ten_are():
    assert covers(between_shares(9, 10, 10, 10), 0.0)
    assert not covers(between_shares(2, 10, 10, 10), 0.0)


@pytest.mark.parametrize(("ours", "thesis", "told"), [(500, 1000, False), (499, 1000, True)])
def test_the_course_of_learning_is_compared_from_half_the_generations_on(ours, thesis, told):
    assert bool(too_short(ours, thesis)) is told


@pytest.mark.parametrize(("high", "alike"), [(0.99, True), (1.01, None)])
def test_alike_is_a_quarter_of_the_larger_at_most(high, alike):
    assert are_alike(Interval(0.2, -0.6, high), 4.0) is alike
