"""Who is near: what compiled rules ask of an index.

What is found is pushed on a stack, above what the loops around go over, as places in the order of
birth. Each question looks into strips: the cells of a column, whose entries lie side by side; and,
if there are any, into the lists of those that were born or went far.
"""

from __future__ import annotations

import math
from typing import Any

from numba.extending import register_jitable

from socialmind.compiling.memory import index
from socialmind.worlds.neighbours.cells import columns_near, rows_near
from socialmind.worlds.neighbours.eight import push_near


@register_jitable
def checked(radius: float) -> float:
    """Return a radius, or a number of steps, or refuse it."""
    if not radius >= 0:
        raise ValueError("a radius, or a number of steps, below 0")
    return radius


@register_jitable
def parts(cells: Any, first_row: int, rows: int) -> int:
    """Return in how many strips the rows of a column lie: two where they go round the world."""
    return 2 if first_row + rows > cells.cells_y else 1


@register_jitable
def strip(
    cells: Any, starts: Any, column: int, first_row: int, rows: int, part: int
) -> tuple[int, int]:
    """Return where in the entries a strip of a column begins and ends; columns go round."""
    line = (column - cells.cells_x if column >= cells.cells_x else column) * cells.cells_y
    if part:
        return starts[line], starts[line + first_row + rows - cells.cells_y]
    return starts[line + first_row], starts[line + min(first_row + rows, cells.cells_y)]


@register_jitable
def first_in_list(cells: Any, heads: Any, column: int, row: int) -> int:
    """Return the first entry in the list of a cell, or −1; columns and rows go round."""
    column = column - cells.cells_x if column >= cells.cells_x else column
    row = row - cells.cells_y if row >= cells.cells_y else row
    return heads[column * cells.cells_y + row]


@register_jitable
def square_of_distance(dx: float, dy: float, round_x: float, round_y: float) -> float:
    """Return the square of a way, of which both parts may be gone the other way round the world."""
    # Without a branch, which processors guess wrong every other time.
    dx, dy = abs(dx), abs(dy)
    dx, dy = min(dx, round_x - dx), min(dy, round_y - dy)
    return dx * dx + dy * dy


@register_jitable
def find_near(
    cells: Any, starts: Any, entries: Any, heads: Any, found: Any, x: float, y: float,
    radius: float, spot: int,
) -> int:  # fmt: skip
    """Push all at most a radius from a place, in no order; return where they end on the stack.

    The agent at `spot` asks, and is not found; it is −1 where no agent of the population asks.
    """
    limit = radius * radius
    first_column, columns = columns_near(cells, x, radius + cells.drift)
    first_row, rows = rows_near(cells, y, radius + cells.drift)
    round_x, round_y, cells_x, cells_y = cells.round_x, cells.round_y, cells.cells_x, cells.cells_y
    last_row, round_to = min(first_row + rows, cells_y), first_row + rows - cells_y
    end = cells.top
    for at in range(first_column, first_column + columns if cells.listed else 0):
        line = (at - cells_x if at >= cells_x else at) * cells_y
        begin, last = starts[index(line + first_row)], starts[index(line + last_row)]
        end = push_near(entries, begin, last, spot, found, end, x, y, round_x, round_y, limit)
        if round_to > 0:
            begin, last = starts[index(line)], starts[index(line + round_to)]
            end = push_near(entries, begin, last, spot, found, end, x, y, round_x, round_y, limit)
    if cells.count > cells.listed:
        for column in range(first_column, first_column + columns):
            for row in range(first_row, first_row + rows):
                one = first_in_list(cells, heads, column, row)
                while one >= 0:
                    entry = entries[one]
                    away = square_of_distance(entry.x - x, entry.y - y, round_x, round_y)
                    found[end] = entry.place
                    end += (away <= limit) & (one != spot)
                    one = entry.next
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
def is_on_patch(
    cells: Any, entry: Any, low_x: int, low_y: int, width: int, height: int, own_x: int,
    own_y: int, steps: int, kind: int,
) -> bool:  # fmt: skip
    """Say whether an entry's place is on one of the patches asked for."""
    wraps_x, wraps_y = cells.wraps_x, cells.wraps_y
    dx = steps_between(on_axis(entry.x, low_x, width, wraps_x), own_x, width, wraps_x)
    dy = steps_between(on_axis(entry.y, low_y, height, wraps_y), own_y, height, wraps_y)
    if kind == 4:
        return (dx + dy == 1) & (entry.place >= 0)
    return (dx <= steps) & (dy <= steps) & ((kind == 0) | (dx + dy > 0)) & (entry.place >= 0)


@register_jitable
def find_on_patches(
    cells: Any, starts: Any, entries: Any, heads: Any, found: Any, x: float, y: float, steps: int,
    kind: int, spot: int,
) -> int:  # fmt: skip
    """Push all on the patches around a place; return where they end on the stack.

    They are at most so many king's moves away. The kind is 0 with the patch of the place, 8 without
    it, and 4 for the patches that share a side with it. `find_near` says what `spot` is.
    """
    low_x, width = math.floor(cells.low_x + 0.5), int(cells.size_x)
    low_y, height = math.floor(cells.low_y + 0.5), int(cells.size_y)
    own_x = on_axis(x, low_x, width, cells.wraps_x)
    own_y = on_axis(y, low_y, height, cells.wraps_y)
    # Where a tile is a patch, and nobody has moved, its middle tells its cell.
    half = 0.0 if cells.tiles_a_unit_x == 1.0 and cells.furthest == 0 else 0.5
    first_column, columns = columns_near(cells, float(own_x + low_x), steps + half + cells.drift)
    half = 0.0 if cells.tiles_a_unit_y == 1.0 and cells.furthest == 0 else 0.5
    first_row, rows = rows_near(cells, float(own_y + low_y), steps + half + cells.drift)
    end = cells.top
    for column in range(first_column, first_column + columns if cells.listed else 0):
        for part in range(parts(cells, first_row, rows)):
            begin, last = strip(cells, starts, column, first_row, rows, part)
            for one in range(begin, last):
                entry = entries[one]
                found[end] = entry.place
                wanted = is_on_patch(
                    cells, entry, low_x, low_y, width, height, own_x, own_y, steps, kind
                )
                end += wanted & (one != spot)
    if cells.count > cells.listed:
        for column in range(first_column, first_column + columns):
            for row in range(first_row, first_row + rows):
                one = first_in_list(cells, heads, column, row)
                while one >= 0:
                    entry = entries[one]
                    found[end] = entry.place
                    wanted = is_on_patch(
                        cells, entry, low_x, low_y, width, height, own_x, own_y, steps, kind
                    )
                    end += wanted & (one != spot)
                    one = entry.next
    return end


@register_jitable
def nearest(
    cells: Any, starts: Any, entries: Any, heads: Any, x: float, y: float, radius: float, spot: int
) -> int:
    """Return the place of the nearest at most a radius away, of several the first born; or −1."""
    cells_x, cells_y = cells.cells_x, cells.cells_y
    round_x, round_y = cells.round_x, cells.round_y
    reach = min(radius, 0.6 * max(cells.size_x / cells_x, cells.size_y / cells_y))
    while True:
        limit = reach * reach
        best = -1
        first_column, columns = columns_near(cells, x, reach + cells.drift)
        first_row, rows = rows_near(cells, y, reach + cells.drift)
        for column in range(first_column, first_column + columns):
            for part in range(parts(cells, first_row, rows)):
                begin, last = strip(cells, starts, column, first_row, rows, part)
                for one in range(begin, last):
                    entry = entries[one]
                    place = entry.place
                    away = square_of_distance(entry.x - x, entry.y - y, round_x, round_y)
                    nearer = away < limit or (away == limit and (best < 0 or place < best))
                    if nearer and one != spot:
                        best, limit = place, away
        if cells.count > cells.listed:
            for column in range(first_column, first_column + columns):
                for row in range(first_row, first_row + rows):
                    one = first_in_list(cells, heads, column, row)
                    while one >= 0:
                        entry = entries[one]
                        place = entry.place
                        away = square_of_distance(entry.x - x, entry.y - y, round_x, round_y)
                        nearer = away < limit or (away == limit and (best < 0 or place < best))
                        if nearer and one != spot:
                            best, limit = place, away
                        one = entry.next
        if best >= 0 or reach >= radius:
            return best
        # What lies beyond all cells of a plane is in the last of them.
        reach = radius if columns == cells_x and rows == cells_y else min(2 * reach, radius)
