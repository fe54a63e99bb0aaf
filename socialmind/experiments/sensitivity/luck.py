"""How much of an output is luck: the variance between replicates, which no parameter explains."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from socialmind.experiments.sensitivity.resampling import with_intervals
from socialmind.experiments.sensitivity.responses import Response


@dataclass(frozen=True)
class Luck:
    """What replicates tell of an output; NaN throughout where no point has two.

    Attributes:
        variance: between runs of one point, with its interval: (3,) value, low, high.
        of_a_run: its share of the variance of single runs over the design, likewise.
        of_means: the share of the variance of the points' means that is luck still, likewise.
    """

    variance: NDArray[np.float64]
    of_a_run: NDArray[np.float64]
    of_means: NDArray[np.float64]

    @property
    def known(self) -> bool:
        """Whether there are replicates to tell it from."""
        return bool(np.isfinite(self.variance[0]))

    def error_of_means(self, variance_of_means: float) -> float:
        """Return the variance of a point's mean that is luck."""
        return float(self.of_means[0] * variance_of_means)


def luck_of(response: Response, size: int, level: float, seed: int) -> Luck:
    """Return how much of an output is luck.

    With common seeds, what a seed does alike at all points moves no mean against another; only the
    rest counts as luck of the means.

    Args:
        response: the output, with a number at every point.
        size: points of a unit of the design, which are drawn together.
        level: of the intervals.
        seed: of the draws.
    """
    values, counts, means = response.values, response.counts, response.means
    free = counts - 1.0
    if not (free > 0).any():
        unknown = np.full(3, np.nan)
        return Luck(unknown, unknown, unknown)
    squares = np.nansum((values - means[:, None]) ** 2, axis=1)
    apart, apart_free = squares, free
    if response.common and np.isfinite(values).all():
        rest = values - means[:, None] - values.mean(axis=0) + values.mean()
        apart = (rest**2).sum(axis=1)
        apart_free = free * (len(values) - 1) / len(values)
    centred = means - means.mean()
    of_points = (squares, free, apart, apart_free, 1.0 / counts, centred, centred**2)
    of_units = np.stack([one.reshape(-1, size).sum(axis=1) for one in of_points])

    def statistic(drawn: NDArray[np.int64]) -> NDArray[np.float64]:
        points = len(drawn) * size
        within, freedom, own, own_freedom, inverse, total, square = (
            one[drawn].sum(axis=0) for one in of_units
        )
        spread = (square - total**2 / points) / (points - 1)
        with np.errstate(divide="ignore", invalid="ignore"):
            variance = within / freedom
            error = own / own_freedom * inverse / points
            of_a_run = variance / (variance + np.maximum(spread - error, 0.0))
            of_means = np.minimum(error / spread, 1.0)
        return np.stack([variance, of_a_run, of_means])

    found = with_intervals(statistic, len(values) // size, level, seed)
    return Luck(*found)
