"""What the study measures, as plain functions over arrays."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy import stats

Floats = NDArray[np.float64]


def nearest_distance(
    x: ArrayLike, y: ArrayLike, places: Sequence[tuple[float, float]], size: int
) -> Floats:
    """Distance on a torus from each point to the nearest of some places.

    Args:
        x: (n,) coordinates, in patches.
        y: (n,) coordinates, in patches.
        places: at least one.
        size: patches along a side of the world.

    Returns:
        (n,) distances, in patches; NaN where a coordinate is.

    >>> nearest_distance([16, 3], [0, 4], [(-16, 0), (0, 0)], 33).tolist()
    [1.0, 5.0]
    """
    points = np.stack([np.asarray(x, float), np.asarray(y, float)], axis=-1)
    apart = np.abs(points[:, None, :] - np.asarray(places, float)[None, :, :])
    apart = np.minimum(apart, size - apart)
    return np.sqrt((apart**2).sum(axis=-1)).min(axis=1)


def first_reached(ticks: ArrayLike, values: ArrayLike, level: float) -> Floats:
    """The first recorded tick at which each agent's value reaches a level.

    Args:
        ticks: (T,) recorded ticks, ascending.
        values: (T, n) values; NaN counts as not reached.
        level: what to reach.

    Returns:
        (n,) ticks; infinite for agents that never do.

    >>> first_reached([0, 10, 20], [[0.0, 0.0], [0.9, 0.1], [0.5, 0.2]], 0.8).tolist()
    [10.0, inf]
    """
    reached = np.asarray(values) >= level
    first = np.asarray(ticks, float)[reached.argmax(axis=0)]
    return np.where(reached.any(axis=0), first, np.inf)


def rank_correlation(distance: ArrayLike, tick: ArrayLike) -> float:
    """Spearman's rank correlation of distance and tick; those who never specialise rank last.

    Args:
        distance: (n,) of land to village; agents without land (NaN) are left out.
        tick: (n,) at which each specialised, infinite for never.

    Returns:
        The correlation; NaN where all of either are alike.

    >>> rank_correlation([1.0, 2.0, 3.0, float("nan")], [10.0, 20.0, float("inf"), 0.0])
    1.0
    """
    distance, tick = np.asarray(distance, float), np.asarray(tick, float)
    known = np.isfinite(distance)
    ranks = stats.rankdata(distance[known]), stats.rankdata(tick[known])
    if any(len(set(rank)) < 2 for rank in ranks):
        return float("nan")
    return float(np.round(np.corrcoef(*ranks)[0, 1], 12))


def mean_interval(samples: ArrayLike) -> tuple[Floats, Floats, Floats]:
    """The mean over replicates and its 95 % interval (Student's t).

    Args:
        samples: (replicates, …).

    Returns:
        Mean, lower and upper end, each without the first axis; no width for one replicate.

    >>> [float(part.round(3)) for part in mean_interval([1.0, 2.0, 3.0])]
    [2.0, -0.484, 4.484]
    """
    samples = np.asarray(samples, float)
    count = samples.shape[0]
    mean = samples.mean(axis=0)
    if count < 2:
        return mean, mean, mean
    half = stats.t.ppf(0.975, count - 1) * samples.std(axis=0, ddof=1) / np.sqrt(count)
    return mean, mean - half, mean + half


@dataclass(frozen=True)
class Recovery:
    """How a number comes back after a shock.

    Args:
        before: its mean over the window before the shock.
        after: the number just after it.
        at_end: its mean over the last window of the run.
        share: (at_end − after) / (before − after): 0 none, 1 all; NaN if nothing was lost.
        halfway: ticks from the shock until half of the loss is made good; infinite for never.
        full: ticks from the shock until the whole loss is; infinite for never.
    """

    before: float
    after: float
    at_end: float
    share: float
    halfway: float
    full: float


def recovery(ticks: ArrayLike, number: ArrayLike, shock: int, after: int, window: int) -> Recovery:
    """Measure how a number recovers from a shock.

    Args:
        ticks: (T,) recorded ticks, ascending; the one of the shock holds the number before it.
        number: (T,) the number at those ticks.
        shock: the tick of the shock.
        after: the number just after it.
        window: ticks to average over, before the shock and at the end.

    Returns:
        The measures.

    >>> recovery([0, 10, 20, 30, 40], [6, 6, 4, 5, 6], shock=10, after=3, window=10)
    ... # doctest: +NORMALIZE_WHITESPACE
    Recovery(before=6.0, after=3.0, at_end=5.5, share=0.8333333333333334, halfway=20.0, full=30.0)
    """
    ticks, number = np.asarray(ticks, float), np.asarray(number, float)
    before = float(number[(ticks >= shock - window) & (ticks <= shock)].mean())
    at_end = float(number[ticks >= ticks[-1] - window].mean())
    lost = before - after
    later = ticks > shock

    def since(level: float) -> float:
        return float(first_reached(ticks[later], number[later, None], level)[0]) - shock

    return Recovery(
        before=before,
        after=float(after),
        at_end=at_end,
        share=(at_end - after) / lost if lost else float("nan"),
        halfway=since(after + lost / 2),
        # The mean before may lie between two whole numbers: the lower one is back to normal.
        full=since(np.floor(before)),
    )
