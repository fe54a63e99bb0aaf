"""Lists of the agents in each instance of a group, or of those who ask to be in it.

Compiled rules walk through them to find the members of an instance; they are kept while agents join
and leave, are born and die. Nothing of them is state: what is found comes in order of birth,
whatever the lists, which are made anew whenever anything else may have changed what they follow.
The arrays, in what follows:

- heads: for each row of an instance the spot of the first in its list, −1 where it is empty.
- entries: for each agent and type of group, a spot, the spots before and behind it in its list, and
  whose list that is, −1 for none.
- found: two numbers, then a stack of what was found.
- rows, counters, order, alive, slot_of: the population's, as `agents.bookkeeping` has them.
- minds: those of its culture.
- asking: whether these are the lists of those who ask.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numba.extending import register_jitable
from numpy.typing import NDArray

from coglogo_py import kernel
from socialmind.agents.bookkeeping import ENTRIES
from socialmind.worlds.neighbours.birth_order import in_order

BEFORE, NEXT, ROW = 0, 1, 2
"""Columns of the entries."""
TOP, STALE, BOTTOM = 0, 1, 2
"""Where in `found` the end of the stack stands, whether the lists may be wrong, and the stack."""


@register_jitable
def list_of(minds: Any, mind: int, group: int, asking: bool) -> int:
    """Return the row of the instance whose list a mind belongs into, or −1."""
    if asking:
        return kernel.asked_row(minds, mind, group)
    return minds.group_slot[mind, group]


@register_jitable
def put(heads: Any, entries: Any, spot: int, row: int) -> None:
    """Put a spot into the list of a row, as the first."""
    behind = heads[row]
    entries[spot, BEFORE], entries[spot, NEXT], entries[spot, ROW] = -1, behind, row
    if behind >= 0:
        entries[behind, BEFORE] = spot
    heads[row] = spot


@register_jitable
def take_out(heads: Any, entries: Any, spot: int) -> None:
    """Take a spot out of the list that it is in."""
    before, behind = entries[spot, BEFORE], entries[spot, NEXT]
    if before >= 0:
        entries[before, NEXT] = behind
    else:
        heads[entries[spot, ROW]] = behind
    if behind >= 0:
        entries[behind, BEFORE] = before
    entries[spot, ROW] = -1


@register_jitable
def follow(heads: Any, entries: Any, minds: Any, mind: int, slot: int, asking: bool) -> None:
    """Let the lists follow what the agent in a slot has done, or what was done to it."""
    groups = minds.group_slot.shape[1]
    for group in range(groups):
        spot = slot * groups + group
        row = list_of(minds, mind, group, asking)
        if entries[spot, ROW] != row:
            if entries[spot, ROW] >= 0:
                take_out(heads, entries, spot)
            if row >= 0:
                put(heads, entries, spot, row)


@register_jitable
def list_all(
    heads: Any, entries: Any, found: Any, rows: Any, minds: Any, counters: Any, order: Any,
    alive: Any, asking: bool,
) -> None:  # fmt: skip
    """List all the living, the first born first."""
    for row in range(heads.shape[0]):
        heads[row] = -1
    for spot in range(entries.shape[0]):
        entries[spot, ROW] = -1
    for place in range(counters[ENTRIES] - 1, -1, -1):
        slot = order[place]
        if alive[slot]:
            follow(heads, entries, minds, rows[slot]._mind, slot, asking)
    found[TOP] = BOTTOM
    found[STALE] = 0


@register_jitable
def gather(
    heads: Any, entries: Any, found: Any, rows: Any, minds: Any, group: int, row: int, asking: bool
) -> int:  # fmt: skip
    """Push the identities of all in the list of a row; return where they end on the stack.

    Those who asked for an instance that has ended stay in the list of its row until they do
    something else; they are passed over.
    """
    groups = minds.group_slot.shape[1]
    end = found[TOP]
    one = heads[row] if row >= 0 else -1
    while one >= 0:
        agent = rows[one // groups]
        if not asking or minds.asked_id[agent._mind, group] == minds.instance_id[row]:
            found[end] = agent._id
            end += 1
        one = entries[one, NEXT]
    return end


@register_jitable
def keep(found: Any, marks: Any, slot_of: Any, begin: int, end: int, ordered: bool) -> None:
    """Keep what was pushed for a loop to go over, as slots; those who die keep theirs that long."""
    if ordered:
        in_order(found, begin, end, marks, len(slot_of))
    for at in range(begin, end):
        found[at] = slot_of[found[at]]
    found[TOP] = end


def arrays(kind: str, room: tuple[int, int], minds: Any, loops: int) -> dict[str, NDArray[Any]]:
    """Return the arrays of the lists of a population, not yet made.

    Args:
        kind: what their names begin with.
        room: for how many agents, and how many identities.
        minds: its minds.
        loops: how many loops of the rules go over what they found.
    """
    slots, identities = room
    instances, groups = len(minds.instance_id), minds.group_slot.shape[1]
    return {
        f"{kind}_heads": np.full(instances, -1, np.int32),
        f"{kind}_entries": np.full((slots * groups, 3), -1, np.int32),
        f"{kind}_found": np.full(BOTTOM + (loops + 1) * slots, 1, np.int64),
        f"{kind}_marks": np.zeros(identities // 64 + 1, np.int64),
    }
