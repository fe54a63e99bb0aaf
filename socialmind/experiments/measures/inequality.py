"""How unequally something is shared out among agents."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike


def gini(values: ArrayLike) -> float:
    """Return the Gini coefficient: half the mean difference of two values, over their mean.

    G = Σ (2 i − n − 1) x_i / (n Σ x), with the values sorted and i = 1 … n.

    Args:
        values: (n,), what each has, 0 or more.

    Returns:
        0 where all have the same, up to 1 − 1/n where one has all; NaN of no values, of a sum of
        0, or where somebody has less than nothing.

    >>> gini([1, 1, 1, 1]), gini([0, 0, 0, 1])
    (0.0, 0.75)
    """
    sorted_up = np.sort(np.asarray(values, np.float64).ravel())
    n, total = len(sorted_up), float(sorted_up.sum())
    if n == 0 or not total > 0.0 or sorted_up[0] < 0.0:
        return float("nan")
    ranks = 2.0 * np.arange(1, n + 1) - n - 1
    return float((ranks * sorted_up).sum() / (n * total))
