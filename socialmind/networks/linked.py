"""Whom an agent is linked with, as interpreted rules go over it, count it or draw from it."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from coglogo_py.border.errors import shown
from coglogo_py.border.numbers import is_whole
from socialmind.agents import bookkeeping
from socialmind.agents.rows import Row
from socialmind.errors import UnknownNameError, ValueRefusedError
from socialmind.networks import adjacency
from socialmind.society.table import Table


class LinkedSet:
    """What the list of an agent holds: for rules, which loop over it, count it or draw from it.

    A loop meets what is there when it begins, but for links that have ended meanwhile.

    Args:
        network: the network.
        lists: the heads of its lists, and the array that they lie in.
        found: the table of what is found, the agents at the other ends or the links.
        slot: that of the agent.
    """

    def __init__(self, network: Table, lists: Any, found: Table, slot: int) -> None:
        self._network, self._found, self._slot = network, found, slot
        self._heads, self._ties = lists

    def __len__(self) -> int:
        return int(self._heads[self._slot, adjacency.DEGREE])

    def __iter__(self) -> Iterator[Any]:
        begin = int(self._heads[self._slot, adjacency.BEGIN])
        listed = self._ties[begin : begin + len(self)].tolist()
        alive = self._network.alive
        for entry in listed:
            if alive[entry[adjacency.SLOT]]:
                yield self._row(entry)

    def one_of(self, rng: Any) -> Any:
        """Return one of them, drawn at random, or None."""
        if not len(self):
            return None
        place = int(rng.integers(0, len(self)))
        begin = int(self._heads[self._slot, adjacency.BEGIN])
        return self._row(self._ties[begin + place].tolist())

    def _row(self, entry: list[int]) -> Any:
        part = adjacency.SLOT if self._found is self._network else adjacency.AGENT
        return self._found.row_class(self._found, entry[part])


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
