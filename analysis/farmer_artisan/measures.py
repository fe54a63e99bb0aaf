"""What this study alone measures, as plain functions over arrays.

What it shares with others stands in `socialmind.experiments`.
"""

from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy import stats

from socialmind.experiments.measures.intervals import interval_of

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


def band(samples: ArrayLike) -> tuple[Floats, Floats, Floats]:
    """Return the mean over replicates at each tick, and its interval of 95 %.

    Args:
        samples: (replicates, ticks).

    Returns:
        Mean, lower and upper end, (ticks,); NaN for the ends of one replicate.

    >>> [part.round(3).tolist() for part in band([[1.0], [2.0], [3.0]])]
    [[2.0], [-0.484], [4.484]]
    """
    found = [interval_of(column) for column in np.asarray(samples, float).T]
    mean, low, high = np.array([(one.mean, one.low, one.high) for one in found]).T
    return mean, low, high
