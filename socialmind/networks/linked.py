"""Whom an agent is linked with, as interpreted rules go over it, count it or draw from it."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

from coglogo_py.border.errors import shown
from coglogo_py.border.numbers import is_whole
from socialmind.agents import bookkeeping
from socialmind.agents.rows import Row
from socialmind.errors import UnknownNameError, ValueRefusedError
from socialmind.networks import adjacency
from socialmind.society.table import Table

if TYPE_CHECKING:
    from socialmind.networks.table import NetworkTable


class LinkedSet:
    """What the list of an agent holds: for rules, which loop over it, count it or draw from it.

    A loop meets what is there when it begins, but for links that have ended meanwhile.

    Args:
        network: the network.
        heads: the heads of its lists.
        found: the table of what is found, the agents at the other ends or the links.
        slot: that of the agent.
    """

    def __init__(self, network: NetworkTable, heads: Any, found: Table, slot: int) -> None:
        self._network, self._heads, self._found, self._slot = network, heads, found, slot

    def __len__(self) -> int:
        return int(self._heads[self._slot, adjacency.DEGREE])

    def __iter__(self) -> Iterator[Any]:
        halves, alive = self._network._halves, self._network.alive
        listed = []
        half = int(self._heads[self._slot, adjacency.FIRST])
        while half >= 0:
            listed.append(half)
            half = int(halves[half, adjacency.NEXT])
        for half in listed:
            if alive[half >> 1]:
                yield self._row(half)

    def one_of(self, rng: Any) -> Any:
        """Return one of them, drawn at random, or None."""
        if not len(self):
            return None
        place = int(rng.integers(0, len(self)))
        halves = self._network._halves
        return self._row(int(adjacency.nth(self._heads, halves, self._slot, place)))

    def _row(self, half: int) -> Any:
        of_links = self._found is self._network
        slot = half >> 1 if of_links else int(self._network._halves[half ^ 1, adjacency.AGENT])
        return self._found.row_class(self._found, slot)


def slot_in(table: Table, agent: Any) -> int:
    """Return the slot of an agent, as rules give it, or as users do: the agent or its identity."""
    if isinstance(agent, Row):
        if agent._table is not table:
            raise UnknownNameError(
                f"{agent!r}, which is of {agent._table.shape.name!r}; expected an agent of "
                f"{table.shape.name!r}"
            )
        return agent._slot
    if not is_whole(agent) or not table.contains(int(agent)):
        raise ValueRefusedError(
            f"found {shown(agent)}; expected a living agent of {table.shape.name!r}, or an identity"
        )
    return int(bookkeeping.slot_of_agent(table.slot_of, int(agent)))
