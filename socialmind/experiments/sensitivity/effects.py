"""Elementary effects (Morris, 1991): how far an output moves when one parameter takes a step.

An effect is the change of the output over the step, the step as a share of the parameter's range:
so effects of parameters of all units can be compared, in the unit of the output. Steps are measured
where the design has them. SALib takes all for equal, which those of whole numbers are not.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from socialmind.experiments.sensitivity.resampling import with_intervals
from socialmind.experiments.sensitivity.variance import Rows

MU, MU_STAR, SIGMA = "mu", "mu_star", "sigma"


def steps_of(
    points: NDArray[np.float64], ranges: Sequence[tuple[float, float]]
) -> NDArray[np.float64] | None:
    """Return the steps of a design's trajectories, (trajectories, steps, columns), 0 for none.

    Args:
        points: in the order of the design.
        ranges: of its columns.

    Returns:
        Shares of the ranges; None where points are no trajectories in which each column steps once.
    """
    count, columns = points.shape
    if count % (columns + 1):
        return None
    low, high = np.array(ranges, np.float64).T
    steps = np.diff(points.reshape(-1, columns + 1, columns), axis=1) / (high - low)
    moved = steps != 0
    once = (moved.sum(axis=1) == 1).all() and (moved.sum(axis=2) == 1).all()
    return steps if once else None


def morris_indices(
    means: NDArray[np.float64],
    steps: NDArray[np.float64],
    names: Sequence[str],
    level: float,
    seed: int,
) -> Rows:
    """Return mu, mu* and sigma: the mean of the effects, of their sizes, and their deviation.

    Args:
        means: of each point, in the order of the design.
        steps: of the trajectories.
        names: of the columns.
        level: of the intervals.
        seed: of the draws.
    """
    units, columns = len(steps), len(names)
    change = np.diff(means.reshape(units, columns + 1), axis=1)
    which = (steps != 0).argmax(axis=2)
    effects = np.empty((units, columns))
    taken = np.take_along_axis(steps, which[:, :, None], axis=2)[:, :, 0]
    np.put_along_axis(effects, which, change / taken, axis=1)

    def statistic(drawn: NDArray[np.int64]) -> NDArray[np.float64]:
        some = effects[drawn]
        parts = [some.mean(axis=0), np.abs(some).mean(axis=0), some.std(axis=0, ddof=1)]
        return np.concatenate([part.T for part in parts])

    found = np.split(with_intervals(statistic, units, level, seed), 3)
    return [
        (index, name, "", one)
        for index, several in zip((MU, MU_STAR, SIGMA), found, strict=True)
        for name, one in zip(names, several, strict=True)
    ]


def effect_of_luck(error: float, steps: NDArray[np.float64]) -> float:
    """Return the mu* that a parameter without any effect has by luck.

    Args:
        error: variance of a point's mean.
        steps: of the trajectories.

    >>> round(effect_of_luck(1.0, np.array([[[0.5]]])), 3)  # E|N(0, 2)| / 0.5
    2.257
    """
    taken = np.abs(steps[steps != 0])
    return math.sqrt(4 * error / math.pi) * float((1 / taken).mean())
