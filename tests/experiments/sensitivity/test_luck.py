"""Luck by hand: the variance between replicates, with seeds of each point's own and common ones."""

import numpy as np
import pytest

from socialmind.experiments.sensitivity.luck import luck_of
from socialmind.experiments.sensitivity.responses import Response

VALUES = np.array([[0.0, 6.0], [6.0, 8.0]])


@pytest.mark.parametrize(("common", "of_means"), [(False, 0.625), (True, 0.25)])
def test_luck_by_hand(common, of_means):
    """Means of 3 and 7 have a variance of 8.

    Around them runs have 18 + 2 in squares, with 2 degrees of freedom a variance of 10, of which
    half is left in a mean of two. With common seeds, runs of 3 and 7 on the mean of both points,
    each run is 1 from what point and seed add up to: 4 in squares, and with 1 degree of freedom, as
    of the interaction in a table of 2 by 2, a variance of 4.
    """
    found = luck_of(Response("made", VALUES, common), 1, 0.95, seed=1)
    error = 8 * of_means
    assert found.variance[0] == pytest.approx(10)
    assert found.of_means[0] == pytest.approx(of_means)
    assert found.of_a_run[0] == pytest.approx(10 / (10 + 8 - error))


def test_what_a_seed_does_at_all_points_is_no_luck_of_their_means():
    alike = np.array([[0.0, 4.0], [2.0, 6.0], [3.0, 7.0]])
    assert luck_of(Response("made", alike, True), 1, 0.95, seed=1).of_means[0] < 1e-12
    assert luck_of(Response("made", alike, False), 1, 0.95, seed=1).of_means[0] > 0.5
