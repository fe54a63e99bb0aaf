"""Shares of an output's variance: Sobol indices of Saltelli's design, and FAST.

The estimators are SALib's. Intervals of Sobol indices draw the blocks of the design anew: each has
its own runs, so luck is in them. FAST has one curve through the space for each column, which cannot
be drawn anew; its intervals are SALib's, which look at halves of the curve.
"""

from __future__ import annotations

import itertools
import warnings
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from socialmind.errors import SocialmindError
from socialmind.experiments.designs import HARMONICS, MissingLibraryError, fast, reseeding
from socialmind.experiments.sensitivity.resampling import RESAMPLES, library, with_intervals

FIRST, TOTAL, SECOND = "first", "total", "second"

Rows = list[tuple[str, str, str, NDArray[np.float64]]]
"""Index, parameter, other parameter of a pair, and value, low, high."""


def sobol_indices(
    means: NDArray[np.float64], names: Sequence[str], level: float, seed: int
) -> Rows:
    """Return the indices of first, total and second order of Saltelli's design.

    Args:
        means: of each point, in the order of the design.
        names: of the columns.
        level: of the intervals.
        seed: of the draws.
    """
    sobol = library("SALib.analyze.sobol")
    columns = len(names)
    units = len(means) // (2 * columns + 2)
    # SALib takes differences below 2e-16 for none, whatever the unit of the output.
    scaled = (means - means.mean()) / means.std()
    a, b, ab, ba = sobol.separate_output_values(scaled, columns, units, True)
    pairs = list(itertools.combinations(range(columns), 2))

    def statistic(drawn: NDArray[np.int64]) -> NDArray[np.float64]:
        first = [sobol.first_order(a[drawn], ab[drawn, j], b[drawn]) for j in range(columns)]
        total = [sobol.total_order(a[drawn], ab[drawn, j], b[drawn]) for j in range(columns)]
        second = [
            sobol.second_order(a[drawn], ab[drawn, j], ab[drawn, k], ba[drawn, j], b[drawn])
            for j, k in pairs
        ]
        return np.stack([*first, *total, *second])

    with warnings.catch_warnings():  # a draw may hold one block alone, which is constant
        warnings.simplefilter("ignore")
        found = with_intervals(statistic, units, level, seed)
    first, total, second = np.split(found, [columns, 2 * columns])
    return [
        *((FIRST, name, "", one) for name, one in zip(names, first, strict=True)),
        *((TOTAL, name, "", one) for name, one in zip(names, total, strict=True)),
        *((SECOND, names[j], names[k], one) for (j, k), one in zip(pairs, second, strict=True)),
    ]


def fast_indices(means: NDArray[np.float64], names: Sequence[str], level: float, seed: int) -> Rows:
    """Return the indices of first and total order of FAST; arguments as above."""
    analyze = library("SALib.analyze.fast").analyze
    problem = {"num_vars": len(names), "names": list(names)}
    scaled = (means - means.mean()) / means.std()
    with warnings.catch_warnings():  # that its intervals are rough, which we say in our words
        warnings.simplefilter("ignore")
        # It seeds NumPy's own generator, and takes 0 for no seed.
        found = reseeding(
            analyze, problem, scaled, HARMONICS, RESAMPLES, level, seed=_not_zero(seed)
        )
    rows: Rows = []
    for index, key in ((FIRST, "S1"), (TOTAL, "ST")):
        for place, name in enumerate(names):
            value, half = float(found[key][place]), float(found[f"{key}_conf"][place])
            rows.append((index, name, "", np.array([value, value - half, value + half])))
    return rows


def is_saltelli(points: NDArray[np.float64]) -> bool:
    """Return whether points are blocks of Saltelli's design: A, its k crossings with B, B's, B.

    >>> a, b = [1.0, 2.0], [5.0, 6.0]
    >>> is_saltelli(np.array([a, [5.0, 2.0], [1.0, 6.0], [1.0, 6.0], [5.0, 2.0], b]))
    True
    """
    count, columns = points.shape
    size = 2 * columns + 2
    if count % size:
        return False
    blocks = points.reshape(-1, size, columns)
    a, b = blocks[:, :1], blocks[:, -1:]
    own = np.eye(columns, dtype=bool)
    return bool(
        (blocks[:, 1 : columns + 1] == np.where(own, b, a)).all()
        and (blocks[:, columns + 1 : -1] == np.where(own, a, b)).all()
    )


def is_fast(points: NDArray[np.float64], made: Mapping[str, Any]) -> bool:
    """Return whether points are those that FAST's design has, as it was made."""
    try:
        again = fast(made["ranges"], made["size"], made["seed"], made["whole"]).to_numpy(np.float64)
    except MissingLibraryError:
        raise
    except (KeyError, SocialmindError):
        return False
    return again.shape == points.shape and bool(np.allclose(again, points))


def _not_zero(seed: int) -> int:
    return seed % (2**32 - 1) + 1
