"""Who is in which cell: the entries of an index, and how they are kept in a tick.

At the begin of a tick the entries of a cell lie side by side, and a column's cells one after
another. An agent that moves a little keeps its entry: where it stands is written there, and
who looks for agents looks as far again as any has gone. One that moves further, or is born, gets an
entry behind the others, in a list of its cell. Nothing of this is state.

The arrays of an index, in what follows:

- cells: how the world is cut.
- starts: where in the entries each cell begins, and after the last where it ends.
- entries: where an agent stands and its place in the order of birth; how far it went (`kept`), or,
  in a list, its cell and who is beside it.
- heads: the first in the list of each cell, −1 where there is none.
- spots: where in the entries the agent of a slot is, −1 for the dead.
- rows, counters, order, alive: the population's, as `agents.bookkeeping` has them.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numba.extending import register_jitable

from socialmind.agents.bookkeeping import ENTRIES
from socialmind.worlds.neighbours.cells import STEPS, cell_of

ENTRY = np.dtype([("x", "f8"), ("y", "f8"), ("place", "i4"), ("kept", "i4"), ("next", "i4"),
                  ("before", "i4")])  # fmt: skip
NOBODY = -1
"""The place of an entry whose agent is dead or has another entry; it stands nowhere."""


@register_jitable
def list_all(
    cells: Any, starts: Any, entries: Any, heads: Any, spots: Any, rows: Any, counters: Any,
    order: Any, alive: Any,
) -> None:  # fmt: skip
    """List the living in their cells, in order of birth."""
    number = cells.cells_x * cells.cells_y
    for cell in range(number):
        heads[cell] = -1
        starts[cell] = 0
    for place in range(counters[ENTRIES]):
        slot = order[place]
        if alive[slot]:
            cell = cell_of(cells, rows[slot].x, rows[slot].y)
            starts[cell] += 1
            spots[slot] = cell
    total = 0
    for cell in range(number):
        total += starts[cell]
        starts[cell] = total
    starts[number] = total
    # From behind, so that each cell's start is where its entries begin when all are listed.
    for place in range(counters[ENTRIES] - 1, -1, -1):
        slot = order[place]
        if alive[slot]:
            cell = spots[slot]
            spot = starts[cell] - 1
            starts[cell] = spot
            spots[slot] = spot
            entry = entries[spot]
            entry.x, entry.y = rows[slot].x, rows[slot].y
            entry.place = place
            entry.kept = 0
        else:
            spots[slot] = -1
    cells.listed = cells.count = total
    cells.top = 0
    cells.furthest = 0
    cells.drift = 0.0


@register_jitable
def list_apart(
    cells: Any, starts: Any, entries: Any, heads: Any, spots: Any, rows: Any, counters: Any,
    order: Any, alive: Any,
) -> None:  # fmt: skip
    """Give each of the living an entry in the list of its cell, where most cells are empty."""
    for cell in range(cells.cells_x * cells.cells_y):
        heads[cell] = -1
    cells.listed = cells.count = cells.top = cells.furthest = 0
    cells.drift = 0.0
    for place in range(counters[ENTRIES]):
        slot = order[place]
        if alive[slot]:
            born(cells, entries, heads, spots, slot, place, rows[slot].x, rows[slot].y)
        else:
            spots[slot] = -1


@register_jitable
def put(cells: Any, entries: Any, heads: Any, spot: int) -> None:
    """Put an entry into the list of its cell, as the first."""
    entry = entries[spot]
    cell = cell_of(cells, entry.x, entry.y)
    entry.kept = cell
    behind = heads[cell]
    entry.next = behind
    entry.before = -1
    if behind >= 0:
        entries[behind].before = spot
    heads[cell] = spot


@register_jitable
def take_out(cells: Any, entries: Any, heads: Any, spot: int) -> None:
    """Take an entry out of the list of its cell."""
    entry = entries[spot]
    if entry.before >= 0:
        entries[entry.before].next = entry.next
    else:
        heads[entry.kept] = entry.next
    if entry.next >= 0:
        entries[entry.next].before = entry.before


@register_jitable
def born(
    cells: Any, entries: Any, heads: Any, spots: Any, slot: int, place: int, x: float, y: float
) -> None:
    """Give an agent an entry in a list; `place` is its own in the order of birth."""
    spot = cells.count
    cells.count += 1
    spots[slot] = spot
    entry = entries[spot]
    entry.x, entry.y = x, y
    entry.place = place
    put(cells, entries, heads, spot)


@register_jitable
def died(cells: Any, entries: Any, heads: Any, spots: Any, slot: int) -> None:
    """Let an agent have no entry any more."""
    spot = spots[slot]
    spots[slot] = -1
    if spot >= cells.listed:
        take_out(cells, entries, heads, spot)
        return
    entry = entries[spot]
    entry.x = entry.y = math.nan
    entry.place = NOBODY


@register_jitable
def moved(cells: Any, entries: Any, heads: Any, spots: Any, slot: int, x: float, y: float) -> None:
    """Take note of where an agent stands now; the dead are in no list."""
    spot = spots[slot]
    if spot < 0:
        return
    entry = entries[spot]
    if spot < cells.listed:
        dx, dy = abs(x - entry.x), abs(y - entry.y)
        way = max(min(dx, abs(cells.round_x - dx)), min(dy, abs(cells.round_y - dy)))
        if way <= cells.leash:
            went = entry.kept + math.ceil(way * cells.steps)
            if went <= STEPS:
                entry.x, entry.y = x, y
                entry.kept = went
                if went > cells.furthest:
                    cells.furthest = went
                    cells.drift = went / cells.steps
                return
        place = entry.place
        died(cells, entries, heads, spots, slot)
        born(cells, entries, heads, spots, slot, place, x, y)
    elif cell_of(cells, x, y) == entry.kept:
        entry.x, entry.y = x, y
    else:
        take_out(cells, entries, heads, spot)
        entry.x, entry.y = x, y
        put(cells, entries, heads, spot)


@register_jitable
def cells_around(cells: Any, x: float, y: float, turn: int) -> int:
    """Return one of three cells from west to east around a place, −1 where there is none."""
    cell = cell_of(cells, x, y) + (turn - 1) * cells.cells_y
    return cell if 0 <= cell < cells.cells_x * cells.cells_y else -1
