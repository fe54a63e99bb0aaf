"""Means and differences with their intervals, as a table tells them."""

from __future__ import annotations

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from socialmind.errors import SocialmindError
from socialmind.experiments.measures.crossed import crossed_difference, crossed_interval
from socialmind.experiments.measures.intervals import Interval, interval_of, share_interval


def in_brackets(part: pd.DataFrame, name: str, form: str) -> str:
    """Return a mean with its interval of 95 %: over trainings and worlds, or worlds alone.

    A single number has none.
    """
    square = part.pivot_table(index="attempt", columns="world", values=name).dropna(axis="columns")
    if square.empty:
        raise SocialmindError(
            f"no world in which all attempts at {part['way'].iloc[0]} were judged"
        )
    values = square.to_numpy(float)
    if len(values) > 1:
        found = crossed_interval(values)
    elif np.isin(values, (0, 1)).all():  # where all are alike a bootstrap has no width
        found = share_interval(values[0])
    else:
        found = interval_of(values[0])
    if not np.isfinite(found.low):
        return f"{found.mean:{form}}"
    low, high = found.low, found.high
    if form.endswith("%"):  # Student's t of few attempts reaches past what a share can be
        low, high = max(low, 0.0), min(high, 1.0)
    return f"{found.mean:{form}} ({low:{form}} to {high:{form}})"


def paired_interval(more: NDArray[np.float64]) -> Interval:
    """Return a mean difference of the same minds in the same worlds, (attempts, worlds), paired.

    Its bounds are over attempts and worlds, or worlds alone where there is one attempt; NaN where
    all worlds of a single attempt are alike, which has no width.
    """
    if len(more) > 1:
        return crossed_interval(more)
    if (more == more[0, 0]).all():
        return Interval(float(more[0, 0]), float("nan"), float("nan"))
    return interval_of(more[0])


def held_against(one: NDArray[np.float64], other: NDArray[np.float64]) -> Interval:
    """Return how much more a way that was learned comes to than another, in the same worlds.

    Args:
        one: (attempts, worlds), of several attempts.
        other: (attempts, worlds); one row where nobody learned.
    """
    return crossed_interval(one - other) if len(other) == 1 else crossed_difference(one, other)


def signed(found: Interval, form: str = "+.2f") -> str:
    """Return a difference with its interval, if it has one.

    >>> signed(Interval(-0.2, -0.6, 0.0)), signed(Interval(0.0, float("nan"), float("nan")))
    ('-0.20 (-0.60 to +0.00)', '+0.00')
    """
    bounds = f" ({found.low:{form}} to {found.high:{form}})" if np.isfinite(found.low) else ""
    return f"{found.mean:{form}}{bounds}"
