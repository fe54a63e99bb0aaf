"""How far indices can be trusted: the design's units drawn anew, with an explicit seed."""

from __future__ import annotations

from collections.abc import Callable
from importlib import import_module
from typing import Any

import numpy as np
from numpy.typing import NDArray

from socialmind.experiments.designs import MissingLibraryError

RESAMPLES = 1_000
"""How often a design's units are drawn from themselves, unless there are very many."""
FEWEST, _ALL = 200, 10_000_000
FEW = 16
"""Fewer units give rough intervals."""
_AT_ONCE = 250_000

Statistic = Callable[[NDArray[np.int64]], NDArray[np.float64]]
"""Of units by number, (units, draws), some numbers of each draw: (numbers, draws)."""


def with_intervals(
    statistic: Statistic, units: int, level: float, seed: int
) -> NDArray[np.float64]:
    """Return numbers with their intervals, by the percentiles of a bootstrap.

    Args:
        statistic: what is known of a design.
        units: how many independent units the design has: points, or blocks of them.
        level: of the intervals, above 0 and below 1.
        seed: of the draws.

    Returns:
        (numbers, 3): value, low, high; bounds are NaN where fewer than half of the draws have one.

    >>> x = np.array([1.0, 2.0, 3.0, 4.0, 5.0] * 20)
    >>> found = with_intervals(lambda drawn: x[drawn].mean(axis=0)[None], 100, 0.95, 0)
    >>> found.round(1).tolist()
    [[3.0, 2.7, 3.3]]
    """
    value = statistic(np.arange(units)[:, None])[:, 0]
    if units < 2:
        return np.column_stack([value, np.full((len(value), 2), np.nan)])
    rng = np.random.default_rng(seed)
    count = max(FEWEST, min(RESAMPLES, _ALL // units))
    batch = max(1, min(count, _AT_ONCE // units))
    parts = []
    for begin in range(0, count, batch):
        drawn = rng.integers(0, units, (units, min(batch, count - begin)))
        parts.append(statistic(drawn))
    draws = np.concatenate(parts, axis=1)
    bounds = np.full((len(value), 2), np.nan)
    for place, several in enumerate(draws):
        known = several[np.isfinite(several)]
        if 2 * len(known) > len(several):
            bounds[place] = np.quantile(known, [(1 - level) / 2, (1 + level) / 2])
    return np.column_stack([value, bounds])


def library(module: str) -> Any:
    """Return a module of SALib or scipy.

    Raises:
        MissingLibraryError: it is not installed.
    """
    try:
        return import_module(module)
    except ImportError:
        raise MissingLibraryError(
            f"sensitivity needs {module.partition('.')[0]}: pip install 'socialmind[sensitivity]'"
        ) from None
