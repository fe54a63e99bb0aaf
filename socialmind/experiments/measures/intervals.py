"""How far the mean of a few measured numbers can be trusted: its interval by the bootstrap.

Counts and shares over episodes are skewed and bounded: most robots survive to the end, a few do
not. The usual interval, mean ± t · s/√n, then reaches past what there can be. The bias-corrected
and accelerated bootstrap (BCa: Efron, 1987) stays within what was seen. For small samples its
levels are widened as Hesterberg (2015, section 5) does, with Student's t in place of the normal
distribution and √(n / (n − 1)).

A bootstrap never reaches past what was seen, so of a handful of numbers its interval is too narrow:
of three it would hold the mean three times in four. With fewer than `FEW` it is therefore the usual
one, which reaches past bounds such as 100 % where it has to.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from statistics import NormalDist
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from socialmind.errors import SocialmindError

LEVEL = 0.95
"""How often such an interval holds the mean of all that could have been measured."""
RESAMPLES = 10_000
"""How often the sample is drawn from itself."""
SURE = 0.015
"""How much of its width an interval is away from a value at least that is said to lie outside it:
two standard errors of a bound, that is of the 2.5 % quantile of so many draws."""
FEW = 6
"""Numbers from which on the bootstrap is used."""
_AT_ONCE = 4_000_000
_NORMAL = NormalDist()


@dataclass(frozen=True)
class Interval:
    """The mean of a sample and its interval of 95 %.

    Attributes:
        mean: of the sample.
        low, high: the bounds; NaN where there is one number alone.
    """

    mean: float
    low: float
    high: float

    def beyond(self, value: float = 0.0) -> int:
        """Say whether all of the interval lies on one side of a value.

        A bound of a bootstrap is itself known to half a hundredth of the width; where it is nearer
        than `SURE` of the width to the value, another draw might tell otherwise, and nothing is
        said.

        Args:
            value: which.

        Returns:
            1 above it, -1 below it, 0 where that cannot be told.

        >>> Interval(1.0, 0.2, 1.8).beyond(), Interval(1.0, 0.001, 2.0).beyond()
        (1, 0)
        """
        margin = SURE * (self.high - self.low)
        return int(self.low > value + margin) - int(self.high < value - margin)

    def record(self) -> dict[str, float | None]:
        """Return the interval as JSON has it, with null for a bound that nobody knows.

        >>> Interval(2.0, math.nan, math.nan).record()
        {'mean': 2.0, 'low': None, 'high': None}
        """
        found = {"mean": self.mean, "low": self.low, "high": self.high}
        return {name: one if math.isfinite(one) else None for name, one in found.items()}


def interval_of(
    values: ArrayLike, level: float = LEVEL, combine: Callable[..., float] | None = None
) -> Interval:
    """Return the mean of a sample with its interval, or what is made of several means.

    The same sample always gives the same interval. Of a sample of equal numbers it is that number:
    nothing is known of how far others would lie. Of fewer than `FEW` numbers it is mean ± t · s/√n,
    and that of what is made of several means the same with the jackknife's standard error.

    Args:
        values: (n,), finite, at least one; or (n, k), for a function of k means.
        level: above 0 and below 1.
        combine: makes a number of the k means, such as a ratio; NaN where there is none.

    Returns:
        NaN for the bounds where there is one number alone, or of so few the others say nothing.

    Raises:
        SocialmindError: no numbers.

    >>> interval_of([3.0, 3.0, 3.0])
    Interval(mean=3.0, low=3.0, high=3.0)
    >>> found = interval_of([0, 1, 1, 1, 1, 1, 1, 1, 1, 1])
    >>> found.mean, found.low < 0.8, found.high <= 1.0
    (0.9, True, True)
    >>> interval_of([[1, 2], [3, 6], [2, 4]], combine=lambda part, whole: part / whole)
    Interval(mean=0.5, low=0.5, high=0.5)
    """
    sample = np.asarray(values, np.float64)
    if not sample.size:
        raise SocialmindError("no numbers to tell an interval of; expected one at least")
    sample = sample.reshape(len(sample), -1)
    mean = _combined(sample.mean(axis=0)[None], combine).item()
    if len(sample) < 2 or not math.isfinite(mean):
        return Interval(mean, math.nan, math.nan)
    if (sample == sample[0]).all():
        value = _combined(sample[:1], combine).item()
        return Interval(value, value, value)
    if len(sample) < FEW:
        half = student(level, len(sample) - 1) * _standard_error(sample, combine)
        return Interval(mean, mean - half, mean + half)
    means = _combined(_means_of_resamples(sample), combine)
    # Where a draw has none, such as a ratio to nothing, the others speak.
    means = means[np.isfinite(means)]
    # Means of counts are tied with that of the sample; half of those count as below it.
    above = means - mean
    tied = np.abs(above) <= 1e-12 * max(np.abs(sample).max() if combine is None else 0, abs(mean))
    below = float((~tied & (above < 0)).mean() + tied.mean() / 2)
    bias = _NORMAL.inv_cdf(min(max(below, 1 / RESAMPLES), 1 - 1 / RESAMPLES))
    acceleration = _acceleration(sample, combine)
    wide = widened(level, len(sample))
    ends = (bias - wide, bias + wide)
    # At levels near 1 the formula turns over: there the bound is the last of what was drawn.
    turned = [1 - acceleration * z for z in ends]
    bounds = [
        _NORMAL.cdf(bias + z / one) if one > 0 else float(z > 0)
        for z, one in zip(ends, turned, strict=True)
    ]
    low, high = np.quantile(means, bounds).tolist()
    return Interval(mean, low, high)


def are_shares(*samples: ArrayLike) -> bool:
    """Return whether numbers tell of what something holds: each is 0 or 1, and both occur.

    >>> are_shares([1, 1, 1], [0, 1]), are_shares([1, 1, 1]), are_shares([0, 1, 2])
    (True, False, False)
    """
    values = np.unique(np.concatenate([np.asarray(sample, np.float64) for sample in samples]))
    return np.array_equal(values, (0, 1))


def share_interval(values: ArrayLike, level: float = LEVEL) -> Interval:
    """Return the share of a sample for which something holds, with its score interval.

    It has a width also where it holds of all or of none, which a bootstrap has not (Wilson, 1927,
    Journal of the American Statistical Association 22: 209–212).

    Args:
        values: (n,), each 0 or 1, at least one.
        level: above 0 and below 1.

    Raises:
        SocialmindError: no numbers, or others than 0 and 1.

    >>> found = share_interval([1] * 20)
    >>> found.mean, round(found.low, 2), found.high
    (1.0, 0.84, 1.0)
    """
    sample = np.asarray(values, np.float64)
    if not sample.size or not ((sample == 0) | (sample == 1)).all():
        raise SocialmindError("a share of no numbers, or of others than 0 and 1; expected these")
    n, share = sample.size, float(sample.mean())
    z = _NORMAL.inv_cdf((1 + level) / 2)
    middle = (share + z * z / (2 * n)) / (1 + z * z / n)
    half = z * math.sqrt(share * (1 - share) / n + (z / (2 * n)) ** 2) / (1 + z * z / n)
    return Interval(share, max(middle - half, 0.0), min(middle + half, 1.0))


def share_difference(one: ArrayLike, other: ArrayLike, level: float = LEVEL) -> Interval:
    """Return how much greater one share is than another, with an interval from those of both.

    As `share_interval` it has a width also where something holds of all or of none. Samples that
    go together have a narrower one (Newcombe, 1998, Statistics in Medicine 17: 873–890, method 10).

    Args:
        one: (n,), each 0 or 1, at least one.
        other: (m,), likewise.
        level: above 0 and below 1.

    >>> found = share_difference([1] * 56 + [0] * 14, [1] * 48 + [0] * 32)
    >>> round(found.mean, 4), round(found.low, 4), round(found.high, 4)
    (0.2, 0.0524, 0.3339)
    """
    first, second = share_interval(one, level), share_interval(other, level)
    difference = first.mean - second.mean
    below = math.hypot(first.mean - first.low, second.high - second.mean)
    above = math.hypot(first.high - first.mean, second.mean - second.low)
    return Interval(difference, max(difference - below, -1.0), min(difference + above, 1.0))


def _combined(
    means: NDArray[np.float64], combine: Callable[..., float] | None
) -> NDArray[np.float64]:
    """Return a number for each row of means."""
    if combine is None:
        return means[:, 0]
    return np.array([combine(*row) for row in means.tolist()], np.float64)


def _deviations(
    sample: NDArray[np.float64], combine: Callable[..., float] | None
) -> NDArray[np.float64]:
    """Return how much each number moves the mean, or what is made of several, by the jackknife."""
    if combine is None:
        return np.asarray(sample[:, 0] - sample[:, 0].mean())
    without = _combined((sample.sum(axis=0) - sample) / (len(sample) - 1), combine)
    without = without[np.isfinite(without)]
    return np.asarray((len(sample) - 1) * (without.mean() - without))


def _standard_error(sample: NDArray[np.float64], combine: Callable[..., float] | None) -> float:
    """Return the standard error of the mean, or of what is made of several, by the jackknife.

    NaN where nothing can be made of the means without one of the numbers: all hangs on that one.
    """
    deviations = _deviations(sample, combine)
    if len(deviations) < len(sample):
        return math.nan
    squares = float((deviations**2).sum())
    return math.sqrt(squares / (len(sample) * (len(sample) - 1)))


def _acceleration(sample: NDArray[np.float64], combine: Callable[..., float] | None) -> float:
    """Return how fast the standard error changes with the mean, by the jackknife."""
    deviation = _deviations(sample, combine)
    largest = np.abs(deviation).max(initial=0.0)
    if largest == 0.0:
        return 0.0
    deviation = deviation / largest  # tiny ones would vanish when cubed
    squares = float((deviation**2).sum())
    return float((deviation**3).sum()) / (6 * squares**1.5)


def _means_of_resamples(sample: NDArray[Any]) -> NDArray[np.float64]:
    n = len(sample)
    rng = np.random.default_rng(n)
    each = max(1, _AT_ONCE // n)
    parts = []
    for begin in range(0, RESAMPLES, each):
        count = min(each, RESAMPLES - begin)
        drawn = rng.integers(0, n, (count, n))
        # A column at a time, so that a mean is the same alone and beside others.
        columns = [column[drawn].mean(axis=1) for column in sample.T]
        parts.append(np.stack(columns, axis=1))
    return np.concatenate(parts)


def widened(level: float, n: int) -> float:
    """Return how many standard errors a bootstrap of `FEW` numbers or more reaches either way.

    >>> round(widened(0.95, 21), 3)  # t = 2.086 of 20 degrees of freedom, and √(21 / 20)
    2.137
    """
    z, free = _NORMAL.inv_cdf((1 + level) / 2), n - 1
    # Cornish and Fisher's expansion of Student's quantile, good to 1 % from five numbers on.
    t = z + (z**3 + z) / (4 * free) + (5 * z**5 + 16 * z**3 + 3 * z) / (96 * free**2)
    return t * math.sqrt(n / free)


def student(level: float, free: int) -> float:
    """Return how many standard errors Student's t reaches to either side.

    Args:
        level: above 0 and below 1.
        free: degrees of freedom, 1 or more.

    >>> [round(student(0.95, free), 3) for free in (1, 2, 4, 9)]
    [12.706, 4.303, 2.776, 2.262]
    """
    low, high = 0.0, math.pi / 2
    while high - low > 1e-13:
        middle = (low + high) / 2
        low, high = (middle, high) if _within(middle, free) < level else (low, middle)
    return math.sqrt(free) * math.tan(low)


def _within(angle: float, free: int) -> float:
    """Return how probable |t| < √free · tan(angle) is (Abramowitz & Stegun, 26.7.3 and 26.7.4)."""
    sine, cosine = math.sin(angle), math.cos(angle)
    if free % 2:
        term, total = cosine, 0.0
        for power in range(1, free - 1, 2):
            total += term
            term *= cosine * cosine * (power + 1) / (power + 2)
        return 2 / math.pi * (angle + sine * total)
    term, total = 1.0, 0.0
    for power in range(0, free, 2):
        total += term
        term *= cosine * cosine * (power + 1) / (power + 2)
    return sine * total
