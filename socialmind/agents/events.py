"""Births and deaths, noted as they happen by both speeds, for those who ask for them.

They stand in an array of rows that is as long as one allows: at both speeds an event is a row, in
the order in which they happen. Where nobody asks, the array is empty, and nothing is noted.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

import numpy as np
from numba.extending import register_jitable
from numpy.typing import NDArray

from socialmind.agents.bookkeeping import COUNT, FREE

TICK = 0
POPULATION = 1
AGENT = 2
PARENT = 3
"""The columns of a row: the tick whose tables are the first to show it, the number of the
population, who was born or died, and of whom one was born."""
CREATED = -1
DIED = -2
"""What stands for the parent of one whom nobody hatched, and of one who died."""
BORN_OR_DIED = ("born", "died")
AT_FIRST = 1 << 10


@register_jitable
def note(rows: Any, tick: int, population: int, agent: int, parent: int) -> None:
    """Note a birth or a death, where there are rows; the first one counts the others."""
    if len(rows) > 0:
        place = rows[0, 0] + 1
        rows[0, 0] = place
        rows[place, TICK] = tick
        rows[place, POPULATION] = population
        rows[place, AGENT] = agent
        rows[place, PARENT] = parent


@register_jitable
def most(counters: Any) -> int:
    """Return how many events there can be in a tick: the living die, and so do the newborn."""
    return counters[COUNT] + 2 * counters[FREE]


@register_jitable
def short_of_rows(rows: Any, events: int) -> bool:
    """Say whether so many events more would find no room."""
    return len(rows) > 0 and rows[0, 0] + events >= len(rows)


class Events:
    """The births and deaths of a society.

    Args:
        populations: whose events count, in the order of their numbers.
    """

    def __init__(self, populations: Iterable[str]) -> None:
        self.populations = tuple(populations)
        self.rows: NDArray[np.int64] = np.zeros((0, 4), np.int64)

    @property
    def kept(self) -> bool:
        """Whether somebody asked for them."""
        return len(self.rows) > 0

    @property
    def count(self) -> int:
        """How many there are."""
        return int(self.rows[0, 0]) if self.kept else 0

    def keep(self) -> None:
        """Note from now on what happens."""
        if not self.kept:
            self.rows = np.zeros((AT_FIRST, 4), np.int64)

    def forget_behind(self, count: int) -> None:
        """Forget all but the first events: a stretch of ticks is done again."""
        if self.kept:
            self.rows[0, 0] = count

    def note(self, tick: int, population: str, agent: int, parent: int) -> None:
        """Note one event, where they are kept."""
        if self.kept:
            self.make_room(1)
            note(self.rows, tick, self.populations.index(population), agent, parent)

    def make_room(self, events: int) -> None:
        """Have room for so many more, where they are kept."""
        if short_of_rows(self.rows, events):
            longer = np.zeros((2 * len(self.rows) + events, 4), np.int64)
            longer[: self.count + 1] = self.rows[: self.count + 1]
            self.rows = longer

    def so_far(self) -> NDArray[np.int64]:
        """Return the events, a row each: a copy."""
        return self.rows[1 : self.count + 1].copy()

    def taken(self) -> NDArray[np.int64]:
        """Return the events, and forget them."""
        found = self.so_far()
        self.forget_behind(0)
        return found


def columns_of_events(rows: NDArray[np.int64], populations: tuple[str, ...]) -> dict[str, Any]:
    """Return events as columns: tick, population, agent, event ("born" or "died") and parent.

    Args:
        rows: the events.
        populations: their names, in the order of their numbers.
    """
    parents = rows[:, PARENT]
    return {
        "tick": rows[:, TICK],
        "population": np.array(populations, str)[rows[:, POPULATION]],
        "agent": rows[:, AGENT],
        "event": np.array(BORN_OR_DIED)[(parents == DIED).astype(int)],
        "parent": np.ma.masked_array(parents, parents < 0),
    }
