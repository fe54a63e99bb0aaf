"""How the world is cut into cells, by which agents are found.

An axis is cut into tiles, on patches each a patch, or a whole number of tiles to a patch where
agents are many; a cell is a whole number of tiles, so that a cell never cuts a patch in two. Cells
are sized for some three agents each, at the begin of each tick. What is found does not depend on
them: they only say where to look.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numba.extending import register_jitable

from socialmind.agents.bookkeeping import ENTRIES

AGENTS_A_CELL = 3.0
LEASH = 0.5
"""How far an agent may go in a tick and still be looked for where it began, in sides of a cell."""
STEPS = 1 << 30
"""In so many parts of the leash what an agent went is added up, each way rounded up."""
FAR = 1e9
_AXIS = [("low", "f8"), ("size", "f8"), ("round", "f8"), ("tiles_a_unit", "f8"), ("begin", "i8"),
         ("tiles", "i8"), ("cells_a_tile", "f8"), ("cells", "i8"), ("wraps", "i8")]  # fmt: skip
CELLS = np.dtype([(f"{name}_{axis}", kind) for axis in "xy" for name, kind in _AXIS]
                 + [(name, "i8") for name in ("few", "listed", "count", "top", "furthest")]
                 + [("leash", "f8"), ("steps", "f8"), ("drift", "f8")])  # fmt: skip
"""How both axes are cut, or that all are looked at, since they are few; how many entries were
listed and there are, how much was found that is in use; how far agents may go from where they were
listed, and how far one has gone."""


# Cutting an axis ----------------------------------------------------------------------------------


@register_jitable
def tile_size(side: float, whole: int) -> tuple[float, float]:
    """Return tiles a unit and cells a tile for a cell about so long."""
    if not whole:
        return 1.0 / side, 1.0
    if side < 1.0:
        return float(math.floor(1.0 / side + 0.5)), 1.0
    return 1.0, 1.0 / math.floor(side + 0.5)


@register_jitable
def cell_at(
    value: float, tiles_a_unit: float, begin: int, tiles: int, cells_a_tile: float, wraps: int
) -> int:
    """Return the cell of a coordinate along an axis; what lies beyond an end is in the last."""
    tile = math.floor((value + 0.5) * tiles_a_unit) - begin
    if tile >= tiles:
        tile = 0 if wraps else tiles - 1
    elif not tile >= 0:
        tile = 0
    return int((tile + 0.5) * cells_a_tile)


@register_jitable
def span(
    value: float,
    reach: float,
    low: float,
    size: float,
    tiles_a_unit: float,
    begin: int,
    tiles: int,
    cells_a_tile: float,
    cells: int,
    wraps: int,
) -> tuple[int, int]:
    """Return the first cell of those that reach so far to both sides, and how many there are."""
    if not reach < size:
        return 0, cells
    # Room for what differences of coordinates are rounded by.
    reach = reach + 1e-12 * size + 1e-15 * abs(value)
    first, last = value - reach, value + reach
    if not wraps:
        one = cell_at(first, tiles_a_unit, begin, tiles, cells_a_tile, wraps)
        return one, cell_at(last, tiles_a_unit, begin, tiles, cells_a_tile, wraps) - one + 1
    if last - first >= size:
        return 0, cells
    round_it = False
    if first < low:
        first += size
        round_it = True
    if last >= low + size:
        last -= size
        round_it = True
    one = cell_at(first, tiles_a_unit, begin, tiles, cells_a_tile, wraps)
    count = cell_at(last, tiles_a_unit, begin, tiles, cells_a_tile, wraps) - one + 1
    if round_it:
        return (0, cells) if count > 0 else (one, count + cells)
    return one, count


@register_jitable
def cell_of(cells: Any, x: float, y: float) -> int:
    """Return the cell of a place."""
    column = cell_at(
        x, cells.tiles_a_unit_x, cells.begin_x, cells.tiles_x, cells.cells_a_tile_x, cells.wraps_x
    )
    row = cell_at(
        y, cells.tiles_a_unit_y, cells.begin_y, cells.tiles_y, cells.cells_a_tile_y, cells.wraps_y
    )
    return column * cells.cells_y + row


@register_jitable
def columns_near(cells: Any, x: float, reach: float) -> tuple[int, int]:
    """Return the columns of cells that reach so far from x, the first and how many."""
    return span(
        x, reach, cells.low_x, cells.size_x, cells.tiles_a_unit_x, cells.begin_x, cells.tiles_x,
        cells.cells_a_tile_x, cells.cells_x, cells.wraps_x,
    )  # fmt: skip


@register_jitable
def rows_near(cells: Any, y: float, reach: float) -> tuple[int, int]:
    """Return the rows of cells that reach so far from y, the first and how many."""
    return span(
        y, reach, cells.low_y, cells.size_y, cells.tiles_a_unit_y, cells.begin_y, cells.tiles_y,
        cells.cells_a_tile_y, cells.cells_y, cells.wraps_y,
    )  # fmt: skip


@register_jitable
def tiles_between(low: float, size: float, tiles_a_unit: float) -> tuple[int, int]:
    """Return the number of the first tile of an axis, and how many there are."""
    begin = math.floor((low + 0.5) * tiles_a_unit)
    end = math.floor((low + size + 0.5) * tiles_a_unit)
    return begin, end - begin


@register_jitable
def cut(
    cells: Any,
    living: int,
    room: int,
    low_x: float,
    low_y: float,
    width: float,
    height: float,
    wraps_x: int,
    wraps_y: int,
    whole: int,
    patches: bool,
) -> None:
    """Cut a rectangle, which most agents are in, into cells for the living.

    There is room for so many cells; a world that is whole has patches, which its ends do not cut.
    Where agents are looked for by patches alone, a cell is a patch, if there is room.
    """
    area = AGENTS_A_CELL * width * height / max(living, 1)
    if patches:
        area = max(1.0, width * height / room)
    side_y = min(math.sqrt(area), height)
    side_x = min(area / side_y, width)
    side_y = min(area / side_x, height)
    while True:
        cells.tiles_a_unit_x, cells.cells_a_tile_x = tile_size(side_x, whole)
        cells.tiles_a_unit_y, cells.cells_a_tile_y = tile_size(side_y, whole)
        begin_x, tiles_x = tiles_between(low_x, width, cells.tiles_a_unit_x)
        begin_y, tiles_y = tiles_between(low_y, height, cells.tiles_a_unit_y)
        if not whole:  # no tile begins where the world does
            tiles_x += 1
            tiles_y += 1
        cells_x = int((tiles_x - 0.5) * cells.cells_a_tile_x) + 1
        cells_y = int((tiles_y - 0.5) * cells.cells_a_tile_y) + 1
        if cells_x * cells_y <= room:
            break
        side_x *= 1.5
        side_y *= 1.5
    cells.begin_x, cells.tiles_x, cells.cells_x = begin_x, tiles_x, cells_x
    cells.begin_y, cells.tiles_y, cells.cells_y = begin_y, tiles_y, cells_y
    cells.low_x, cells.size_x, cells.wraps_x = low_x, width, wraps_x
    cells.low_y, cells.size_y, cells.wraps_y = low_y, height, wraps_y
    cells.round_x = width if wraps_x else math.inf
    cells.round_y = height if wraps_y else math.inf
    cells.leash = LEASH / max(
        cells.tiles_a_unit_x * cells.cells_a_tile_x, cells.tiles_a_unit_y * cells.cells_a_tile_y
    )
    cells.steps = STEPS / cells.leash


@register_jitable
def bounds(rows: Any, counters: Any, order: Any, alive: Any) -> tuple[float, float, float, float]:
    """Return the rectangle that all the living are in: its low ends, its width and its height.

    Those further out than any world is large are in its last cells.
    """
    low_x = low_y = FAR
    high_x = high_y = -FAR
    for place in range(counters[ENTRIES]):
        slot = order[place]
        if alive[slot]:
            x, y = rows[slot].x, rows[slot].y
            if x > -FAR and x < FAR:
                low_x, high_x = min(low_x, x), max(high_x, x)
            if y > -FAR and y < FAR:
                low_y, high_y = min(low_y, y), max(high_y, y)
    return low_x, low_y, max(high_x - low_x, 1.0 / FAR), max(high_y - low_y, 1.0 / FAR)
