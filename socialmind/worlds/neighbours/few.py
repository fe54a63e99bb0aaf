"""Who is near where there are few: all are looked at, eight in one step, in the order of birth.

That is quicker than to look up cells, and nothing found need be brought into order. Coordinates
stand in one array, all x and behind them all y, by the place in the order of birth, which is also
an agent's spot.
"""

from __future__ import annotations

import math
from typing import Any

from numba.extending import register_jitable

from socialmind.agents.bookkeeping import ENTRIES
from socialmind.worlds.neighbours.eight import EIGHT, near_bits_apart, patch_bits, push_bits
from socialmind.worlds.neighbours.questions import on_axis

FEW = 512
FEW_ON_PATCHES = 256
"""Up to so many agents, when a tick begins, are all looked at; where they are looked for by patches
alone, up to so many."""


@register_jitable
def list_few(
    cells: Any, places: Any, spots: Any, rows: Any, counters: Any, order: Any, alive: Any,
    low_x: float, low_y: float, width: float, height: float, wraps_x: int, wraps_y: int,
) -> None:  # fmt: skip
    """Note where the living stand, in a world that begins there and is so large."""
    cells.low_x, cells.size_x, cells.wraps_x = low_x, width, wraps_x
    cells.low_y, cells.size_y, cells.wraps_y = low_y, height, wraps_y
    cells.round_x = width if wraps_x else math.inf
    cells.round_y = height if wraps_y else math.inf
    cells.top = cells.count = 0
    for place in range(counters[ENTRIES]):
        slot = order[place]
        if alive[slot]:
            born(cells, places, spots, slot, place, rows[slot].x, rows[slot].y)
        else:
            places[place] = math.nan
            spots[slot] = -1


@register_jitable
def born(cells: Any, places: Any, spots: Any, slot: int, place: int, x: float, y: float) -> None:
    """Note where an agent stands that has this place, the last one, in the order of birth."""
    places[place] = x
    places[len(places) // 2 + place] = y
    spots[slot] = place
    cells.count = place + 1
    for behind in range(EIGHT):  # nobody is near there
        places[place + 1 + behind] = math.nan


@register_jitable
def died(places: Any, spots: Any, slot: int) -> None:
    """Let an agent stand nowhere any more."""
    places[spots[slot]] = math.nan
    spots[slot] = -1


@register_jitable
def moved(places: Any, spots: Any, slot: int, x: float, y: float) -> None:
    """Note where an agent stands now; the dead stand nowhere."""
    place = spots[slot]
    if place >= 0:
        places[place] = x
        places[len(places) // 2 + place] = y


@register_jitable
def find_near(
    cells: Any, places: Any, found: Any, x: float, y: float, radius: float, spot: int
) -> int:
    """Push all at most a radius from a place; return where they end on the stack.

    The agent at `spot` asks, and is not found; it is −1 where no agent of the population asks.
    """
    limit = radius * radius
    half = len(places) // 2
    round_x, round_y = cells.round_x, cells.round_y
    end = cells.top
    for first in range(0, cells.count, EIGHT):
        bits = near_bits_apart(places, first, half + first, x, y, round_x, round_y, limit)
        bits &= ~((1 if first == spot & -EIGHT else 0) << (spot & (EIGHT - 1)))
        end = push_bits(found, end, first, bits)
    return end


@register_jitable
def find_on_patches(
    cells: Any, places: Any, found: Any, x: float, y: float, steps: int, kind: int, spot: int
) -> int:
    """Push all on the patches around a place; return where they end on the stack.

    `questions.find_on_patches` says which patches they are.
    """
    low_x, width = cells.low_x + 0.5, cells.size_x
    low_y, height = cells.low_y + 0.5, cells.size_y
    own_x = on_axis(x, int(low_x), int(width), cells.wraps_x)
    own_y = on_axis(y, int(low_y), int(height), cells.wraps_y)
    last_x = 0.0 if cells.wraps_x else width - 1.0
    last_y = 0.0 if cells.wraps_y else height - 1.0
    least = 0.0 if kind == 0 else 1.0
    most = 1.0 if kind == 4 else math.inf
    half = len(places) // 2
    end = cells.top
    for first in range(0, cells.count, EIGHT):
        bits = patch_bits(
            places, first, half + first, float(own_x), float(own_y), cells.round_x, cells.round_y,
            low_x, low_y, width, height, last_x, last_y, float(steps), least, most,
        )  # fmt: skip
        bits &= ~((1 if first == spot & -EIGHT else 0) << (spot & (EIGHT - 1)))
        end = push_bits(found, end, first, bits)
    return end
