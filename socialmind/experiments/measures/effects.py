"""How much two societies differ: effect sizes and the interval of their difference.

Runs of two societies on the same seeds are pairs: what a seed does to both is no difference between
them. Then use the paired forms; and what never came about (an infinite time) is counted by the
rank forms alone, Cliff's delta.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import pandas as pd
from numpy.typing import ArrayLike, NDArray

from socialmind.errors import SocialmindError
from socialmind.experiments.measures.intervals import (
    LEVEL,
    Interval,
    are_shares,
    interval_of,
    share_difference,
    share_interval,
)
from socialmind.experiments.measures.split import checked_columns
from socialmind.names import several

MOST = 100.0
"""The largest g that says anything: beyond it the deviation is nothing beside the difference."""


def cliffs_delta(first: ArrayLike, second: ArrayLike) -> float:
    """Return Cliff's delta: P(x > y) − P(x < y) for one drawn from each sample (Cliff, 1993).

    Args:
        first: (n,) numbers, infinite ones too.
        second: (m,) numbers.

    Returns:
        −1 … 1; 0 where neither tends to be larger.

    >>> cliffs_delta([1, 2, 3], [2, 2])  # of 6 pairs 2 are above, 2 below
    0.0
    >>> cliffs_delta([5, math.inf], [1, 5])
    0.75
    """
    x, y = _sample(first), _sample(second)
    ordered = np.sort(y)
    below = np.searchsorted(ordered, x, side="left")
    above = len(y) - np.searchsorted(ordered, x, side="right")
    return float((below.sum() - above.sum()) / (len(x) * len(y)))


def paired_delta(first: ArrayLike, second: ArrayLike) -> float:
    """Return Cliff's delta within pairs: the share with x > y minus that with x < y.

    Args:
        first: (n,) numbers, infinite ones too.
        second: (n,), in the order of the first.

    Returns:
        −1 … 1.

    >>> paired_delta([3, 5, 1, 4], [1, 2, 1, 9])
    0.25
    """
    x, y = _pairs(first, second)
    return float(((x > y).sum() - (x < y).sum()) / len(x))


def hedges_g(first: ArrayLike, second: ArrayLike) -> float:
    """Return Hedges' g: the difference of means in standard deviations, without bias (1981).

    The standard deviation is pooled over both samples, and multiplied is by the exact correction
    of n + m − 2 degrees of freedom.

    Args:
        first: (n,) finite numbers, at least two.
        second: (m,) finite numbers, at least two.

    Returns:
        The effect; infinite where all numbers of either sample are alike and the samples differ.

    >>> round(hedges_g([2, 4, 6], [1, 2, 3]), 3)  # 2 / √2.5, times 0.798 of 4 degrees of freedom
    1.009
    """
    x, y = _finite(first), _finite(second)
    free = len(x) + len(y) - 2
    squares = float(((x - x.mean()) ** 2).sum() + ((y - y.mean()) ** 2).sum())
    return _standardised(float(x.mean() - y.mean()), math.sqrt(squares / free), free)


def paired_g(first: ArrayLike, second: ArrayLike) -> float:
    """Return Hedges' g of pairs: the mean difference over the mean standard deviation.

    The standard deviation is √((s_x² + s_y²) / 2), that of the numbers and not of their
    differences, so that it compares with that of samples without pairs (d_av: Cumming, 2012,
    chapter 11; Lakens, 2013); the correction is that of n − 1 degrees of freedom.

    Args:
        first: (n,) finite numbers, at least two.
        second: (n,), in the order of the first.

    >>> round(paired_g([2, 4, 6], [1, 2, 3]), 3)  # 2 / √2.5, times 0.564 of 2 degrees of freedom
    0.714
    """
    x, y = _finite(first), _finite(second)
    _pairs(x, y)
    deviation = math.sqrt((x.var(ddof=1) + y.var(ddof=1)) / 2)
    return _standardised(float((x - y).mean()), deviation, len(x) - 1)


@dataclass(frozen=True)
class Comparison:
    """Two samples of a measure, and how they differ.

    Attributes:
        first, second: their means, with intervals; an infinite mean has none.
        difference: first − second, with its interval.
        g: Hedges' g; NaN where a number is infinite, where there are too few for a deviation (one
            of a sample, two pairs), and where the numbers hardly deviate at all (`MOST`): then
            delta says what there is to say.
        delta: Cliff's delta.
        paired: whether the samples are pairs; then both effects are the paired ones.
    """

    first: Interval
    second: Interval
    difference: Interval
    g: float
    delta: float
    paired: bool


def compared(
    first: ArrayLike, second: ArrayLike, paired: bool = True, level: float = LEVEL
) -> Comparison:
    """Compare two samples of a measure.

    The interval of the difference of pairs is that of the mean of their differences, by the
    bias-corrected bootstrap; of samples without pairs it is made of the two intervals (Zou &
    Donner, 2008): each bound is as far from the difference as the distances of the two bounds that
    it depends on, squared, summed, and the root taken. Shares, samples of 0 and 1, have the
    intervals of shares, which have a width also where all of a sample are alike; so have the
    differences of their pairs where these are alike.

    Args:
        first: (n,) numbers; infinite ones for what never came about.
        second: (m,) numbers; for pairs in the order of the first.
        paired: whether they are pairs.
        level: of the intervals.

    Raises:
        SocialmindError: no numbers, one that is NaN, or pairs that are not.

    >>> found = compared([5, 7, 9, 8], [4, 6, 8, 7])
    >>> found.difference
    Interval(mean=1.0, low=1.0, high=1.0)
    >>> found.delta, round(found.g, 2)
    (1.0, 0.42)
    """
    x, y = _pairs(first, second) if paired else (_sample(first), _sample(second))
    finite = bool(np.isfinite(x).all() and np.isfinite(y).all())
    shares = are_shares(x, y)
    of = share_interval if shares else _interval
    one, other = of(x, level), of(y, level)
    if not finite:
        difference = Interval(one.mean - other.mean, math.nan, math.nan)
    elif shares and paired and len(set((x - y).tolist())) == 1:
        difference = share_difference(x, y, level)
    elif paired:
        away = x - y
        least = 1e-12 * max(np.abs(x).max(), np.abs(y).max())  # what rounding may make
        difference = interval_of(np.where(np.abs(away) <= least, 0.0, away), level)
    else:
        mean = one.mean - other.mean
        difference = Interval(
            mean,
            mean - math.hypot(one.mean - one.low, other.high - other.mean),
            mean + math.hypot(one.high - one.mean, other.mean - other.low),
        )
    enough = finite and min(len(x), len(y)) > 1
    enough = enough and len(x) + len(y) > (4 if paired else 3)
    deviates = enough and bool(x.std() > 0 or y.std() > 0)
    g = (paired_g if paired else hedges_g)(x, y) if deviates else math.nan
    g = g if abs(g) <= MOST else math.nan
    delta = (paired_delta if paired else cliffs_delta)(x, y)
    return Comparison(one, other, difference, g, delta, paired)


_COMPARED = (
    "mean", "low", "high", "reference_mean", "difference", "difference_low", "difference_high",
    "g", "delta",
)  # fmt: skip


def comparisons(
    results: pd.DataFrame,
    reference: str,
    by: str = "society",
    seed: str = "seed",
    measures: Sequence[str] | None = None,
) -> pd.DataFrame:
    """Compare societies with one of them, measure by measure, in pairs of equal seeds.

    Args:
        results: a row for each society and seed, with a column for each measure. Where either of
            a pair has no value (NaN), the pair does not count.
        reference: the society that the others are compared with.
        by: the column that names the society.
        seed: the column of the seed.
        measures: the columns to compare; all others by default.

    Returns:
        A row for each society and measure: `pairs`, `mean`, `low`, `high`, of the reference
        `reference_mean`, of the difference `difference`, `difference_low`, `difference_high`; `g`
        and `delta`.

    Raises:
        SocialmindError: no such society, one without a name, a column is missing, or a seed stands
            twice.

    >>> table = pd.DataFrame({"society": ["a", "a", "b", "b"], "seed": [1, 2, 1, 2],
    ...                       "goods": [3.0, 4.0, 1.0, 2.0]})
    >>> comparisons(table, "a")[["society", "measure", "pairs", "difference", "delta"]]
      society measure  pairs  difference  delta
    0       b   goods      2        -2.0   -1.0
    """
    measures = None if measures is None else several(measures, "measures")
    checked_columns(results, (by, seed, *(measures or ())), "results")
    if results[by].isna().any():
        raise SocialmindError(f"results without a {by} in some rows; expected one in each")
    if results.duplicated([by, seed]).any():
        raise SocialmindError("results with a society's seed twice; expected one row for each")
    names = list(measures or results.columns.drop([by, seed]))
    societies = list(dict.fromkeys(results[by]))
    if reference not in societies:
        raise SocialmindError(f"no society {reference!r} in the results; there are {societies}")
    by_seed = {name: part.set_index(seed) for name, part in results.groupby(by, sort=False)}
    rows = []
    for society in societies:
        if society == reference:
            continue
        for name in names:
            pair = pd.concat([by_seed[society][name], by_seed[reference][name]], axis=1).dropna()
            row: dict[str, object] = {"society": society, "measure": name, "pairs": len(pair)}
            if len(pair):
                found = compared(*pair.to_numpy(float).T)
                one, away = found.first, found.difference
                numbers = (one.mean, one.low, one.high, found.second.mean, away.mean, away.low)
                row |= dict(
                    zip(_COMPARED, (*numbers, away.high, found.g, found.delta), strict=True)
                )
            rows.append(row)
    return pd.DataFrame(rows, columns=["society", "measure", "pairs", *_COMPARED])


def _interval(values: NDArray[np.float64], level: float) -> Interval:
    if np.isfinite(values).all():
        return interval_of(values, level)
    # Of infinities of both signs there is no mean.
    signs = set(np.sign(values[np.isinf(values)]).tolist())
    return Interval(math.nan if len(signs) > 1 else signs.pop() * math.inf, math.nan, math.nan)


def _standardised(difference: float, deviation: float, free: int) -> float:
    """Return a difference in standard deviations, times J = Γ(f/2) / (√(f/2) Γ((f − 1)/2)).

    Of one degree of freedom J is 0, the limit: from two pairs nothing is known of the spread.
    """
    if difference == 0:
        return 0.0
    if deviation == 0:
        return math.copysign(math.inf, difference)
    if free < 2:
        return 0.0
    log = math.lgamma(free / 2) - math.lgamma((free - 1) / 2) - math.log(free / 2) / 2
    return difference / deviation * math.exp(log)


def _sample(values: ArrayLike) -> NDArray[np.float64]:
    sample = np.asarray(values, np.float64)
    if sample.ndim != 1 or not len(sample) or np.isnan(sample).any():
        raise SocialmindError(
            f"a sample of the shape {sample.shape}, {np.isnan(sample).sum()} of them NaN; expected "
            "one number or more, none NaN"
        )
    return sample


def _finite(values: ArrayLike) -> NDArray[np.float64]:
    sample = _sample(values)
    if len(sample) < 2 or not np.isfinite(sample).all():
        raise SocialmindError(
            f"{len(sample)} numbers, {np.isinf(sample).sum()} of them infinite; expected two or "
            "more, all finite, or Cliff's delta in place of Hedges' g"
        )
    return sample


def _pairs(first: ArrayLike, second: ArrayLike) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    x, y = _sample(first), _sample(second)
    if len(x) != len(y):
        raise SocialmindError(f"{len(x)} numbers and {len(y)}; expected pairs, as many of each")
    return x, y
