"""Who is on the patches around, where a patch has room for one: it says who stands on it."""

from __future__ import annotations

from typing import Any

from numba.extending import register_jitable

from socialmind.worlds.grid.patches_near import axis_around, place_on


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
