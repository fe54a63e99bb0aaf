"""Who is on the patches around, where a patch has room for one: it says who stands on it."""

from __future__ import annotations

from typing import Any

from numba.extending import register_jitable

from socialmind.compiling.memory import index
from socialmind.worlds.grid.patches_near import axis_around, once_round, place_on


@register_jitable
def find_on_taken(
    taken: Any,
    entries: Any,
    spots: Any,
    found: Any,
    end: int,
    x: float,
    y: float,
    steps: int,
    kind: int,
    own: int,
    as_places: bool,
    populations: int,
    number: int,
    low_x: int,
    low_y: int,
    width: int,
    height: int,
    wraps_x: int,
    wraps_y: int,
) -> int:
    """Push all on the patches around a place; return where they end on the stack.

    Args:
        taken: who stands on each patch, as the slot times the populations plus which of them.
        entries: the index's, which knows places in the order of birth.
        spots: likewise, by slot.
        found: the stack.
        end: where it ends so far.
        x: of the place.
        y: likewise.
        steps: at most so many king's moves away.
        kind: 0 with the patch of the place, 8 without it, 4 for those that share a side with it.
        own: the slot of the agent that asks, or −1.
        as_places: push places in the order of birth, or else slots.
        populations: how many there are.
        number: of the one that is looked for.
        low_x: the first column of the world.
        low_y: its first row.
        width: how many columns there are.
        height: how many rows.
        wraps_x: whether it wraps from west to east.
        wraps_y: whether it wraps from south to north.
    """
    column, row = place_on(x, low_x, width, wraps_x), place_on(y, low_y, height, wraps_y)
    first_x, columns, own_x = axis_around(column, min(steps, width), width, wraps_x)
    first_y, rows, own_y = axis_around(row, min(steps, height), height, wraps_y)
    for i in range(columns):
        at_x = first_x + i
        at_x = at_x + width if at_x < 0 else (at_x - width if at_x >= width else at_x)
        line = at_x * height
        for j in range(rows):
            at_y = first_y + j
            at_y = at_y + height if at_y < 0 else (at_y - height if at_y >= height else at_y)
            who = taken[line + at_y]
            middle = (i == own_x) + (j == own_y)
            asked = middle == 1 if kind == 4 else (kind == 0) | (middle < 2)
            slot = who // populations
            wanted = asked & (who >= 0) & (who % populations == number) & (slot != own)
            if as_places:
                if wanted:
                    found[end] = entries[spots[slot]].place
                    end += 1
            else:  # without a branch, which processors guess wrong every fifth time
                found[end] = slot
                end += wanted
    return end


@register_jitable
def area(
    x: float,
    y: float,
    steps: int,
    low_x: int,
    low_y: int,
    width: int,
    height: int,
    wraps_x: int,
    wraps_y: int,
) -> tuple[int, int, int, int, int, int]:
    """Return the patches at most so many king's moves from a place.

    Returns:
        The first column, how many there are and which of them is the place's own; the same of rows.
    """
    column, row = place_on(x, low_x, width, wraps_x), place_on(y, low_y, height, wraps_y)
    columns = axis_around(column, min(steps, width), width, wraps_x)
    return *columns, *axis_around(row, min(steps, height), height, wraps_y)


@register_jitable
def standing(
    taken: Any,
    area: Any,
    column: int,
    row: int,
    kind: int,
    own: int,
    populations: int,
    number: int,
    low_x: int,
    low_y: int,
    width: int,
    height: int,
    wraps_x: int,
    wraps_y: int,
) -> tuple[int, bool]:
    """Return the slot of who stands on a patch of an area, and whether it is asked for.

    The column and row are counted within the area; `find_on_taken` says what the others are. Where
    no agent of the population stands the slot is 0.
    """
    first_x, _, own_x, first_y, _, own_y = area
    at_x = once_round(first_x + column, width) if wraps_x else first_x + column
    at_y = once_round(first_y + row, height) if wraps_y else first_y + row
    who = taken[index(at_x * height + at_y)]
    theirs = (who >= 0) & (who % populations == number)
    slot = max(who, 0) // populations if populations == 1 or theirs else 0
    if kind == 0:
        return slot, theirs & (slot != own)
    middle = (column == own_x) + (row == own_y)  # on its own patch there is but the agent itself
    return slot, theirs & (middle == 1 if kind == 4 else middle < 2)
