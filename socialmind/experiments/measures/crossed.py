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
from numpy.typing import ArrayLike, NDArray

from socialmind.errors import SocialmindError
from socialmind.experiments.measures.intervals import (
    FEW,
    LEVEL,
    RESAMPLES,
    Interval,
    student,
    widened,
)

_NORMAL = NormalDist()


def crossed_interval(values: ArrayLike, level: float = LEVEL) -> Interval:
    """Return the mean over trainings and worlds, and its interval over both.

    With few trainings the level is widened as that of `intervals` is, by Student's t; with fewer
    than `intervals.FEW` it is so many standard errors of the bootstrap. The same table always gives
    the same interval.

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
    return _crossed([_checked(values)], level)


def crossed_difference(one: ArrayLike, other: ArrayLike, level: float = LEVEL) -> Interval:
    """Return how much more one way to learn comes to than another, and its interval.

    The trainings of each are drawn on their own, the worlds, which are the same for both, once.

    Args:
        one: (trainings, worlds), finite.
        other: (trainings, worlds): of as many trainings as it has, in the same worlds.
        level: above 0 and below 1.

    Returns:
        NaN for the bounds where one of them has one training, or there is one world.

    Raises:
        SocialmindError: tables of other shapes, or numbers that are not finite.

    >>> one = [[0.9, 1.0, 0.8], [0.9, 0.8, 1.0], [1.0, 0.9, 0.8]]
    >>> found = crossed_difference(one, [[0.4, 0.5, 0.3]] * 3)
    >>> round(found.mean, 3), found.low > 0.2
    (0.5, True)
    """
    tables = [_checked(one), _checked(other)]
    if tables[0].shape[1] != tables[1].shape[1]:
        raise SocialmindError(
            f"{tables[0].shape[1]} and {tables[1].shape[1]} worlds; expected the same ones for both"
        )
    return _crossed(tables, level)


def _checked(values: ArrayLike) -> NDArray[np.float64]:
    table = np.asarray(values, np.float64)
    if table.ndim != 2 or 0 in table.shape or not np.isfinite(table).all():
        raise SocialmindError(
            f"numbers of the shape {table.shape}; expected finite ones, trainings by worlds"
        )
    return table


def _crossed(tables: list[NDArray[np.float64]], level: float) -> Interval:
    """Return the mean of a table, or how much more the first comes to than the second."""
    alike = all((one == one[0, 0]).all() for one in tables)
    # The mean of equal numbers is that number, which rounding must not move.
    first, *others = (float(one[0, 0] if alike else one.mean()) for one in tables)
    mean = first - sum(others)
    least = min(min(one.shape) for one in tables)
    if least < 2:
        return Interval(mean, math.nan, math.nan)
    if alike:
        return Interval(mean, mean, mean)
    worlds = tables[0].shape[1]
    rng = np.random.default_rng([*(len(one) for one in tables), worlds])
    each = [_drawn(rng, len(one)) @ one for one in tables]
    columns = _drawn(rng, worlds)
    means = ((each[0] - sum(each[1:])) * columns).sum(axis=1)
    if least < FEW:
        # A standard error of the bootstrap falls short by √(n / (n − 1)).
        wide = student(level, least - 1) * math.sqrt(least / (least - 1))
        half = wide * float(means.std())
        return Interval(mean, mean - half, mean + half)
    wide = widened(level, least)
    low, high = np.quantile(means, [_NORMAL.cdf(-wide), _NORMAL.cdf(wide)]).tolist()
    return Interval(mean, low, high)


def _drawn(rng: np.random.Generator, count: int) -> NDArray[np.float64]:
    """Return how much each of some counts in each resample."""
    return rng.multinomial(count, np.full(count, 1 / count), RESAMPLES) / count
