"""The index by which compiled rules find agents: cells that list who stands in them.

An axis is cut into tiles, on patches each a patch, or a whole number of tiles to a patch where
agents are many; a cell is a whole number of tiles, so that a cell never cuts a patch in two. Cells
are sized for some three agents each, at the begin of each tick. What is found does not depend on
them: they only say where to look, the question is asked exactly, and what is found comes in order
of birth. So nothing of the index is state.

The entries of a cell lie side by side in memory at the begin of a tick. Then agents that move, are
born or die are taken out of lists and put into others. The arrays of an index, in what follows:

- cells: how the world is cut; `low`, `size` and `wraps` of an axis are the world's.
- entries: an agent's place, and the spots of those before and behind it in its cell.
- heads: the spot of the first in each cell, −1 where there is none.
- spots: where in the entries the agent of a slot is, −1 for the dead.
- found: a stack of what was found, as places in the order of birth.
- rows, counters, order, alive: the population's, as `agents.bookkeeping` has them.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numba.extending import register_jitable

from socialmind.agents.bookkeeping import ENTRIES
from socialmind.compiling.memory import lowest_bit

AGENTS_A_CELL = 3.0
FAR = 1e9
FEW = 8
"""So many are brought into order by comparing them, more by marking their places."""
SPARSE = 4
"""Up to so many times as many words of marks are looked through as there are marks."""

ENTRY = np.dtype([("x", "f8"), ("y", "f8"), ("place", "i8"), ("next", "i4"), ("before", "i4")])
"""An agent in its cell: where it stands, its place in the order of birth, and who is beside it."""
_AXIS = [("low", "f8"), ("size", "f8"), ("half", "f8"), ("tiles_a_unit", "f8"), ("begin", "i8"),
         ("tiles", "i8"), ("cells_a_tile", "f8"), ("cells", "i8"), ("wraps", "i8")]  # fmt: skip
CELLS = np.dtype([(f"{name}_{axis}", kind) for axis in "xy" for name, kind in _AXIS]
                 + [("count", "i8"), ("top", "i8")])  # fmt: skip
"""How both axes are cut, how many entries there are, and how much was found that is in use."""


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
    elif tile < 0:
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
) -> None:
    """Cut a rectangle, which most agents are in, into cells for the living.

    There is room for so many cells; a world that is whole has patches, which its ends do not cut.
    """
    area = AGENTS_A_CELL * width * height / max(living, 1)
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
    cells.half_x = width / 2 if wraps_x else math.inf
    cells.half_y = height / 2 if wraps_y else math.inf


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


# Who is where -------------------------------------------------------------------------------------


@register_jitable
def list_all(
    cells: Any, entries: Any, heads: Any, spots: Any, rows: Any, counters: Any, order: Any,
    alive: Any,
) -> None:  # fmt: skip
    """List the living in their cells, in order of birth."""
    number = cells.cells_x * cells.cells_y
    for cell in range(number):
        heads[cell] = 0
    for place in range(counters[ENTRIES]):
        slot = order[place]
        if alive[slot]:
            cell = cell_of(cells, rows[slot].x, rows[slot].y)
            heads[cell] += 1
            spots[slot] = cell
    total = 0
    for cell in range(number):
        count = heads[cell]
        heads[cell] = total
        total += count
    for place in range(counters[ENTRIES]):
        slot = order[place]
        if alive[slot]:
            cell = spots[slot]
            spot = heads[cell]
            heads[cell] += 1
            spots[slot] = spot
            entry = entries[spot]
            entry.x, entry.y = rows[slot].x, rows[slot].y
            entry.place = place
        else:
            spots[slot] = -1
    begin = 0
    for cell in range(number):
        end = heads[cell]
        heads[cell] = begin if end > begin else -1
        for spot in range(begin, end):
            entries[spot].before = spot - 1 if spot > begin else -1
            entries[spot].next = spot + 1 if spot + 1 < end else -1
        begin = end
    cells.count = total
    cells.top = 0


@register_jitable
def put(cells: Any, entries: Any, heads: Any, spot: int) -> None:
    """Put an entry into the cell of its place, as the first."""
    entry = entries[spot]
    cell = cell_of(cells, entry.x, entry.y)
    behind = heads[cell]
    entry.next = behind
    entry.before = -1
    if behind >= 0:
        entries[behind].before = spot
    heads[cell] = spot


@register_jitable
def take_out(cells: Any, entries: Any, heads: Any, spot: int) -> None:
    """Take an entry out of its cell."""
    entry = entries[spot]
    if entry.before >= 0:
        entries[entry.before].next = entry.next
    else:
        heads[cell_of(cells, entry.x, entry.y)] = entry.next
    if entry.next >= 0:
        entries[entry.next].before = entry.before


@register_jitable
def born(
    cells: Any, entries: Any, heads: Any, spots: Any, slot: int, place: int, x: float, y: float
) -> None:
    """List an agent that is born, the last in the order of birth, which is `place`."""
    spot = cells.count
    cells.count += 1
    spots[slot] = spot
    entry = entries[spot]
    entry.x, entry.y = x, y
    entry.place = place
    put(cells, entries, heads, spot)


@register_jitable
def died(cells: Any, entries: Any, heads: Any, spots: Any, slot: int) -> None:
    """Take an agent that dies out of the lists."""
    take_out(cells, entries, heads, spots[slot])
    spots[slot] = -1


@register_jitable
def moved(cells: Any, entries: Any, heads: Any, spots: Any, slot: int, x: float, y: float) -> None:
    """Take note of where an agent stands now; the dead are in no list."""
    spot = spots[slot]
    if spot < 0:
        return
    entry = entries[spot]
    if cell_of(cells, x, y) == cell_of(cells, entry.x, entry.y):
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


# Questions ----------------------------------------------------------------------------------------
# What is found is pushed on a stack, above what the loops around go over.


@register_jitable
def checked(radius: float) -> float:
    """Return a radius, or a number of steps, or refuse it."""
    if not radius >= 0:
        raise ValueError("a radius, or a number of steps, below 0")
    return radius


@register_jitable
def find_near(
    cells: Any, entries: Any, heads: Any, found: Any, x: float, y: float, radius: float, spot: int
) -> int:
    """Push all at most a radius from a place, in no order; return where they end on the stack.

    The agent at `spot` asks, and is not found; it is −1 where no agent of the population asks.
    """
    limit = radius * radius
    column, columns = columns_near(cells, x, radius)
    first_row, rows = rows_near(cells, y, radius)
    cells_x, cells_y = cells.cells_x, cells.cells_y
    half_x, half_y, width, height = cells.half_x, cells.half_y, cells.size_x, cells.size_y
    end = cells.top
    for _ in range(columns):
        line = column * cells_y
        row = first_row
        for _ in range(rows):
            one = heads[line + row]
            while one >= 0:
                entry = entries[one]
                dx = entry.x - x
                dy = entry.y - y
                dx = dx - width if dx > half_x else (dx + width if dx < -half_x else dx)
                dy = dy - height if dy > half_y else (dy + height if dy < -half_y else dy)
                # Without a branch, which processors guess wrong every other time.
                found[end] = entry.place
                end += (dx * dx + dy * dy <= limit) & (one != spot)
                one = entry.next
            row += 1
            if row == cells_y:
                row = 0
        column += 1
        if column == cells_x:
            column = 0
    return end


@register_jitable
def on_axis(value: float, low: int, size: int, wraps: int) -> int:
    """Return the column, or row, of patches of an agent's coordinate."""
    place = math.floor(value + 0.5) - low
    if place >= size:  # a hair before the end, rounded up
        return 0 if wraps else size - 1
    return place


@register_jitable
def steps_between(one: int, other: int, size: int, wraps: int) -> int:
    """Return how many columns, or rows, lie between two, the short way."""
    steps = abs(one - other)
    return min(steps, size - steps) if wraps else steps


@register_jitable
def find_on_patches(
    cells: Any, entries: Any, heads: Any, found: Any, x: float, y: float, steps: int, kind: int,
    spot: int,
) -> int:  # fmt: skip
    """Push all on the patches around a place; return where they end on the stack.

    They are at most so many king's moves away. The kind is 0 with the patch of the place, 8 without
    it, and 4 for the patches that share a side with it. `find_near` says what `spot` is.
    """
    low_x, width = math.floor(cells.low_x + 0.5), int(cells.size_x)
    low_y, height = math.floor(cells.low_y + 0.5), int(cells.size_y)
    wraps_x, wraps_y = cells.wraps_x, cells.wraps_y
    own_x, own_y = on_axis(x, low_x, width, wraps_x), on_axis(y, low_y, height, wraps_y)
    # Where a tile is a patch, its middle tells its cell.
    reach_x = steps if cells.tiles_a_unit_x == 1.0 else steps + 0.5
    reach_y = steps if cells.tiles_a_unit_y == 1.0 else steps + 0.5
    column, columns = columns_near(cells, float(own_x + low_x), float(reach_x))
    first_row, rows = rows_near(cells, float(own_y + low_y), float(reach_y))
    cells_x, cells_y = cells.cells_x, cells.cells_y
    end = cells.top
    for _ in range(columns):
        line = column * cells_y
        row = first_row
        for _ in range(rows):
            one = heads[line + row]
            while one >= 0:
                entry = entries[one]
                dx = steps_between(on_axis(entry.x, low_x, width, wraps_x), own_x, width, wraps_x)
                dy = steps_between(on_axis(entry.y, low_y, height, wraps_y), own_y, height, wraps_y)
                if kind == 4:
                    wanted = dx + dy == 1
                else:
                    wanted = (dx <= steps) & (dy <= steps) & ((kind == 0) | (dx + dy > 0))
                found[end] = entry.place
                end += wanted & (one != spot)
                one = entry.next
            row += 1
            if row == cells_y:
                row = 0
        column += 1
        if column == cells_x:
            column = 0
    return end


@register_jitable
def nearest(
    cells: Any, entries: Any, heads: Any, x: float, y: float, radius: float, spot: int
) -> int:
    """Return the place of the nearest at most a radius away, of several the first born; or −1."""
    cells_x, cells_y = cells.cells_x, cells.cells_y
    half_x, half_y, width, height = cells.half_x, cells.half_y, cells.size_x, cells.size_y
    reach = min(radius, 0.6 * max(width / cells_x, height / cells_y))
    while True:
        limit = reach * reach
        best = -1
        column, columns = columns_near(cells, x, reach)
        first_row, rows = rows_near(cells, y, reach)
        for _ in range(columns):
            line = column * cells_y
            row = first_row
            for _ in range(rows):
                one = heads[line + row]
                while one >= 0:
                    entry = entries[one]
                    dx = entry.x - x
                    dy = entry.y - y
                    dx = dx - width if dx > half_x else (dx + width if dx < -half_x else dx)
                    dy = dy - height if dy > half_y else (dy + height if dy < -half_y else dy)
                    away = dx * dx + dy * dy
                    nearer = away < limit or (away == limit and (best < 0 or entry.place < best))
                    if nearer and one != spot:
                        best = entry.place
                        limit = away
                    one = entry.next
                row += 1
                if row == cells_y:
                    row = 0
            column += 1
            if column == cells_x:
                column = 0
        if best >= 0 or reach >= radius:
            return best
        # What lies beyond all cells of a plane is in the last of them.
        reach = radius if columns == cells_x and rows == cells_y else min(2 * reach, radius)


@register_jitable
def in_order(found: Any, begin: int, end: int, marks: Any) -> None:
    """Bring what was pushed, from begin to end, into the order of birth.

    The marks are a bit for each place in that order, all 0, and so they are left.
    """
    if end - begin > FEW:
        first = last = found[begin] >> 6
        for at in range(begin + 1, end):
            word = found[at] >> 6
            first = min(first, word)
            last = max(last, word)
        if last - first < SPARSE * (end - begin):
            for at in range(begin, end):
                marks[found[at] >> 6] |= 1 << (found[at] & 63)
            at = begin
            for word in range(first, last + 1):
                bits = marks[word]
                marks[word] = 0
                while bits != 0:
                    found[at] = (word << 6) | lowest_bit(bits)
                    at += 1
                    bits &= bits - 1
            return
    gap = 1
    if end - begin > 3 * FEW:
        while gap < end - begin:
            gap = 3 * gap + 1
    while gap > 0:
        for at in range(begin + gap, end):
            place = found[at]
            other = at
            while other - gap >= begin and found[other - gap] > place:
                found[other] = found[other - gap]
                other -= gap
            found[other] = place
        gap //= 3
