"""How a number comes back after a shock: how much of what was lost, and how soon."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from socialmind.errors import SocialmindError


def first_reached(ticks: ArrayLike, values: ArrayLike, level: float) -> NDArray[np.float64]:
    """Return the first recorded tick at which each agent's value reaches a level.

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


@dataclass(frozen=True)
class Recovery:
    """How a number comes back after a shock.

    Attributes:
        before: its mean over the window before the shock.
        after: the number just after it.
        at_end: its mean over the last window of the run, as far as it is after the shock.
        share: (at_end − after) / (before − after): 0 none, 1 all; NaN if it stayed as it was.
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
    """Measure how a number of agents recovers from a shock.

    Args:
        ticks: (T,) recorded ticks, ascending; the one of the shock holds the number before it.
        number: (T,) the number at those ticks.
        shock: the tick of the shock.
        after: the number just after it.
        window: ticks to average over, before the shock and at the end.

    Returns:
        The measures.

    Raises:
        SocialmindError: nothing was recorded in the window before the shock, or after it.

    >>> recovery([0, 10, 20, 30, 40], [6, 6, 4, 5, 6], shock=10, after=3, window=10)
    ... # doctest: +NORMALIZE_WHITESPACE
    Recovery(before=6.0, after=3.0, at_end=5.5, share=0.8333333333333334, halfway=20.0, full=30.0)
    """
    ticks, number = np.asarray(ticks, float), np.asarray(number, float)
    earlier = (ticks >= shock - window) & (ticks <= shock)
    if not earlier.any() or not (ticks > shock).any():
        raise SocialmindError(
            f"a shock at tick {shock}; expected records in the {window} ticks before it, and after"
        )
    before = float(number[earlier].mean())
    later = ticks > shock
    at_end = float(number[later & (ticks >= ticks[-1] - window)].mean())
    lost = before - after

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
