"""What recovery says: which parameters such data tell, and how far intervals can be trusted.

For each parameter, in shares of its range,

    error = √(mean of (found − true)²)          of the recoveries
    guess = √(mean of (½ − true)²)              what naming the middle of the range would miss
    gain  = 1 − error / guess

A gain of 1 is perfect, at 0 one may as well not look at the data. The words are ours: *told* from
a gain of 0.5, *roughly* from 0.35, *not told* below: who knows the sum of two parameters alone can
gain 1 − √½ = 0.29 on each. *Not apart* are parameters whose errors go together, so that the data
tell a combination of them, such as their sum or product, whatever the gain on each. Of 41 published
models, half of those that are agent-based could not be identified in full, by any of nine methods
(Carrella, 2021, JASSS 24(2) 7).
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from socialmind.experiments.measures.intervals import share_interval

if TYPE_CHECKING:
    import pandas as pd

TOLD, ROUGHLY = 0.5, 0.35
TOGETHER, FEWEST_TOGETHER = 0.8, 6
"""Errors of two parameters that correlate by so much, in so many recoveries, go together."""
SURE = 0.8
"""A parameter of this gain is told, with whatever others its small errors go."""
FEWEST = 4
"""Recoveries below which nothing is said of a parameter."""


def summary(recovery: pd.DataFrame) -> pd.DataFrame:
    """Return a row a parameter, with what recovery says of it.

    Columns: `error`, `guess` (shares of the range) and `gain`, the `coverage` of its intervals with
    that share's own interval, the `recoveries`, and a `verdict`.

    Args:
        recovery: as `recovery_table` gives it.
    """
    import pandas as pd

    together = {name for pair in combinations(recovery) for name in pair[:2]}
    rows = []
    for name, every in recovery.groupby("parameter", sort=False):
        some = every[every["found_place"].notna()]
        away = (some["found_place"] - some["true_place"]).to_numpy(float)
        blind = (0.5 - some["true_place"]).to_numpy(float)
        error, guess = _size(away), _size(blind)
        gain = _gain(some)
        covers = share_interval(every["covers"].to_numpy(float))
        rows.append(
            {
                "parameter": name, "error": error, "guess": guess, "gain": gain,
                "coverage": covers.mean, "coverage_low": covers.low, "coverage_high": covers.high,
                "recoveries": len(some), "verdict": verdict(gain, len(some), name in together),
            }
        )  # fmt: skip
    return pd.DataFrame(rows)


def verdict(gain: float, recoveries: int, together: bool = False) -> str:
    """Return what is said of a parameter.

    Args:
        gain: of its recoveries.
        recoveries: how many had a result.
        together: whether its errors go with those of another.

    >>> verdict(0.8, 10), verdict(0.4, 10), verdict(-0.2, 10), verdict(0.9, 2)
    ('told', 'roughly', 'not told', 'too few recoveries')
    """
    if recoveries < FEWEST:
        return "too few recoveries"
    if together:
        return "not apart"
    return "told" if gain >= TOLD else "roughly" if gain >= ROUGHLY else "not told"


def combinations(recovery: pd.DataFrame) -> list[tuple[str, str, float]]:
    """Return pairs of parameters that are mistaken for each other, with how their errors correlate.

    Where one is found too high whenever the other is found too low (or too high), the data tell a
    combination of both, and not each.
    """
    away = recovery.assign(away=recovery["found_place"] - recovery["true_place"])
    wide = away.pivot_table("away", "recovery", "parameter", observed=True).dropna()
    if len(wide) < FEWEST_TOGETHER:
        return []
    unsure = [
        str(name)
        for name, some in recovery.groupby("parameter", sort=False)
        if _gain(some[some["found_place"].notna()]) < SURE and wide[name].std() > 0
    ]
    found = []
    for n, one in enumerate(unsure):
        for other in unsure[n + 1 :]:
            both = float(np.corrcoef(wide[one], wide[other])[0, 1])
            if abs(both) >= TOGETHER:
                found.append((one, other, both))
    return found


def _gain(some: pd.DataFrame) -> float:
    guess = _size((0.5 - some["true_place"]).to_numpy(float))
    error = _size((some["found_place"] - some["true_place"]).to_numpy(float))
    return 1 - error / guess if guess else math.nan


def _size(away: NDArray[np.float64]) -> float:
    return math.sqrt(float((away**2).mean())) if len(away) else math.nan
