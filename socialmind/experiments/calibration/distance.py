"""How far a trial is from the data.

The data are y[t, c]: of a series, a value for each tick t and column c; of statistics, one row with
a value for each statistic c. A trial's x̄[t, c] is the mean over its runs. Then

    D = √( 1/C · Σ_c  1/T_c · Σ_t ((x̄[t, c] − y[t, c]) / s[c])² )

with C columns and T_c ticks at which column c was observed. s[c] is

- of a statistic, its error ±e: D = 1 says that statistics are missed by one error, typically;
- of a column of a series, its spread, the standard deviation √(1/T_c · Σ_t (y[t, c] − ȳ[c])²) over
  the ticks: D = 1 says as far from the data as their own mean is. Where a column does not vary it
  is |ȳ[c]|, and 1 where that is 0.

A cell of the data that is empty is not compared. A trial of which a run failed, or has no number
where the data have one, is infinitely far.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

Values = NDArray[np.float64]


def spreads(data: Values) -> Values:
    """Return the scale of each column of a series.

    Args:
        data: (ticks, columns), NaN where nothing was observed.

    >>> spreads(np.array([[1.0, 25.0, 0.0], [3.0, 25.0, 0.0]])).tolist()
    [1.0, 25.0, 1.0]
    """
    spread, size = np.nanstd(data, axis=0), np.abs(np.nanmean(data, axis=0))
    varies = spread > 1e-12 * size
    return np.where(varies, spread, np.where(size > 0, size, 1.0))


def distance(found: Values, data: Values, scales: Values) -> float:
    """Return how far a trial is from the data.

    Args:
        found: (ticks, columns), means over a trial's runs.
        data: likewise, NaN where nothing was observed.
        scales: (columns,), above 0.

    >>> data, scales = np.array([[4.0, 10.0]]), np.array([1.0, 5.0])
    >>> distance(np.array([[5.0, 20.0]]), data, scales) == math.sqrt((1 + 4) / 2)
    True
    """
    seen = ~np.isnan(data)
    if not np.isfinite(found[seen]).all():
        return math.inf
    with np.errstate(over="ignore"):
        squares = np.where(seen, (found - data) / scales, 0.0) ** 2
        return math.sqrt(float((squares.sum(axis=0) / seen.sum(axis=0)).mean()))
