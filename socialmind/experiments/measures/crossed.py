"""How far a mean over trainings and worlds can be trusted, where all trainings met the same worlds.

What one training came to says little of what the next will: an interval over worlds alone is about
the minds at hand, one over trainings and worlds about the way to learn. Rows and columns are drawn
anew each on their own, which is the bootstrap for crossed designs (Owen, 2007, Annals of Applied
Statistics 1: 386–411); it is rather too wide than too narrow.
"""

from __future__ import annotations

import math
from statistics import NormalDist

import numpy as np
from numpy.typing import ArrayLike

from socialmind.errors import SocialmindError
from socialmind.experiments.measures.intervals import LEVEL, RESAMPLES, Interval, widened

_NORMAL = NormalDist()


def crossed_interval(values: ArrayLike, level: float = LEVEL) -> Interval:
    """Return the mean over trainings and worlds, and its interval over both.

    With few trainings the level is widened as that of `intervals` is, by Student's t. The same
    table always gives the same interval.

    Args:
        values: (trainings, worlds), finite: what each training came to in each world, the same
            worlds for all.
        level: above 0 and below 1.

    Returns:
        NaN for the bounds where there is one training or world alone.

    Raises:
        SocialmindError: a table of another shape, or numbers that are not finite.

    >>> crossed_interval([[1, 1, 1], [1, 1, 1]])
    Interval(mean=1.0, low=1.0, high=1.0)
    >>> found = crossed_interval([[0.9, 1.0, 0.8], [0.1, 0.2, 0.0], [0.9, 0.8, 1.0]])
    >>> round(found.mean, 3), found.low < 0.2, found.high > 0.9
    (0.633, True, True)
    """
    table = np.asarray(values, np.float64)
    if table.ndim != 2 or 0 in table.shape or not np.isfinite(table).all():
        raise SocialmindError(
            f"numbers of the shape {table.shape}; expected finite ones, trainings by worlds"
        )
    trainings, worlds = table.shape
    mean = float(table.mean())
    if min(trainings, worlds) < 2:
        return Interval(mean, math.nan, math.nan)
    rng = np.random.default_rng([trainings, worlds])
    rows = rng.multinomial(trainings, np.full(trainings, 1 / trainings), RESAMPLES) / trainings
    columns = rng.multinomial(worlds, np.full(worlds, 1 / worlds), RESAMPLES) / worlds
    means = ((rows @ table) * columns).sum(axis=1)
    wide = widened(level, min(trainings, worlds))
    low, high = np.quantile(means, [_NORMAL.cdf(-wide), _NORMAL.cdf(wide)]).tolist()
    return Interval(mean, low, high)
