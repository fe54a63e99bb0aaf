"""When a society has settled, how long it takes after a shock, and how often roles change then.

A society is settled from a tick on when its split stays within so many agents of the wanted one
for so long: one agent and 5,000 ticks unless said otherwise. All is known at recorded ticks alone;
what happens between two records and is undone by the second does not count.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
import pandas as pd

from socialmind.errors import SocialmindError
from socialmind.experiments.measures.split import checked_columns

WITHIN = 1.0
"""How many agents the split of a settled society may be away from the wanted one."""
HOLD = 5_000
"""Ticks that it must stay there."""
PER = 10_000
"""Ticks that role changes are counted over."""
_ROUNDING = 1e-9


def settled_from(
    distance: pd.Series,
    begin: float = -math.inf,
    end: float = math.inf,
    within: float = WITHIN,
    hold: int = HOLD,
) -> float:
    """Return the first recorded tick from which a society is settled.

    It is the first record from which on all records of the next `hold` ticks, those at both ends
    included, are within `within` agents of the wanted split. A record with less than `hold` ticks
    to the last one counts for nothing, since nobody knows how it went on.

    Args:
        distance: numbers of agents by tick, ascending, as `distance_to` gives them.
        begin: the first tick to consider.
        end: the tick before which records count: that of the next shock.
        within: agents.
        hold: ticks.

    Returns:
        The tick; infinite for never.

    Raises:
        SocialmindError: ticks that do not rise.

    >>> away = pd.Series([3.0, 1.0, 2.0, 1.0, 0.0, 1.0], index=[0, 100, 200, 300, 400, 500])
    >>> settled_from(away, hold=200)
    300.0
    >>> settled_from(away, hold=201)
    inf
    """
    ticks = distance.index.to_numpy(float)
    if (np.diff(ticks) <= 0).any():
        raise SocialmindError("distances whose ticks do not rise; expected one for each tick")
    considered = (ticks >= begin) & (ticks < end)
    ticks = ticks[considered]
    if not len(ticks):
        return math.inf
    # What is unknown is not known to be within.
    away = ~(distance.to_numpy(float)[considered] <= within + _ROUNDING)
    # The first record from each on that is too far away; behind the last one if none is.
    places = np.where(away, np.arange(len(ticks)), len(ticks))
    left = np.minimum.accumulate(places[::-1])[::-1]
    leaves = np.append(ticks, math.inf)[left]
    settled = (leaves > ticks + hold) & (ticks + hold <= ticks[-1])
    return float(ticks[settled.argmax()]) if settled.any() else math.inf


def settlings(
    distance: pd.Series, shocks: Sequence[float] = (), within: float = WITHIN, hold: int = HOLD
) -> pd.DataFrame:
    """Return when a society settles at first, and again after each shock.

    Args:
        distance: numbers of agents by tick, as `distance_to` gives them.
        shocks: their ticks, ascending; a shock's own record belongs to what follows it.
        within: agents.
        hold: ticks; a society that is not settled for so long before the next shock never was.

    Returns:
        A row for the start and one for each shock: `begin`, its tick, and `end`, that of the next
        shock or infinite; `settled`, the tick from which it is settled; `ticks`, how long that
        took. Both are infinite for never.

    >>> away = pd.Series([2.0, 0.0, 0.0, 0.0, 3.0, 3.0, 0.0, 0.0, 0.0], index=range(0, 90, 10))
    >>> settlings(away, shocks=[40], hold=20)
       begin   end  settled  ticks
    0    0.0  40.0     10.0   10.0
    1   40.0   inf     60.0   20.0
    """
    starts = [float(distance.index[0]), *map(float, shocks)] if len(distance) else []
    if sorted(set(starts)) != starts or (starts and starts[-1] > distance.index[-1]):
        raise SocialmindError(
            f"shocks at {list(shocks)}; expected ticks that rise, after the first that is recorded "
            "and not behind the last"
        )
    ends = [*starts[1:], math.inf][: len(starts)]
    settled = [settled_from(distance, *one, within, hold) for one in zip(starts, ends, strict=True)]
    return pd.DataFrame(
        {
            "begin": starts,
            "end": ends,
            "settled": settled,
            "ticks": [at - begin for at, begin in zip(settled, starts, strict=True)],
        }
    )


def role_changes(
    roles: pd.DataFrame,
    windows: Sequence[tuple[float, float]] = ((-math.inf, math.inf),),
    per: float = PER,
) -> float:
    """Return how often an agent changes roles.

    Counted are two records of one agent, the second following the first, with different roles. They
    are divided by the ticks between such pairs of records, so agents that come or go count for
    the time that they are there.

    Args:
        roles: `tick`, `agent`, `role`.
        windows: from which tick on, and before which; records of a pair are in one of them. After
            settling it is `zip(found.settled, found.end)` of what `settlings` found.
        per: ticks.

    Returns:
        Changes for each agent and `per` ticks; NaN where no agent was seen twice.

    >>> table = pd.DataFrame({"tick": [0, 0, 5000, 5000, 10000, 10000], "agent": [0, 1] * 3,
    ...                       "role": ["A", "B", "B", "B", "A", "B"]})
    >>> role_changes(table)
    1.0
    >>> role_changes(table, [(5000, 20000)])
    1.0
    """
    checked_columns(roles, ("tick", "agent", "role"), "roles")
    ordered = roles.sort_values(["agent", "tick"], kind="stable")
    tick = ordered["tick"].to_numpy(float)
    agent, role = (pd.factorize(ordered[name])[0] for name in ("agent", "role"))
    before, after = tick[:-1], tick[1:]
    same = agent[1:] == agent[:-1]
    changed = role[1:] != role[:-1]
    changes, ticks = 0, 0.0
    for since, until in windows:
        inside = same & (before >= since) & (after < until)
        changes += int((inside & changed).sum())
        ticks += float((after - before)[inside].sum())
    return changes / ticks * per if ticks else math.nan
