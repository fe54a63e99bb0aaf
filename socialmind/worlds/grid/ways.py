"""Ways over patches that cost more or less to enter: A* (Hart, Nilsson and Raphael 1968).

Who looks for a way knows the patches within its sight. Beyond, each step costs the same, so the
search ends where sight does, and is short however far the place lies.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

import numpy as np
from numba.extending import register_jitable
from numpy.typing import NDArray

from socialmind.language.shape import FIELD, WorldCall
from socialmind.language.types import FLOAT, INT
from socialmind.worlds.grid.patches_near import place_on

CALLS: Mapping[str, WorldCall] = {
    "way": WorldCall(
        (FIELD, FLOAT, FLOAT, FLOAT, FLOAT, INT, FLOAT),
        FLOAT,
        'way("cost", x, y, to_x, to_y, sight, beyond)',
        (float,),
    )
}

STEPS = ((0, 1), (1, 1), (1, 0), (1, -1), (0, -1), (-1, -1), (-1, 0), (-1, 1))
"""To the eight neighbours, by headings of 0, 45, … 315 degrees."""
ORDER = (1, 3, 5, 7, 0, 2, 4, 6)
"""In which they are looked at: of equal ways, one that goes straight on comes first."""


@register_jitable
def apart(one: int, other: int, size: int, wraps: int) -> int:
    """Return how many columns lie between two, the short way round."""
    away = abs(one - other)
    return min(away, size - away) if wraps else away


@register_jitable
def _in_sight(place: int, sight: int, size: int, wraps: int) -> tuple[int, int]:
    """Return the first column in sight of one, and how many are."""
    if sight <= 0 or (wraps and 2 * sight + 1 >= size):
        return 0, size
    if wraps:
        return place - sight, 2 * sight + 1
    first = max(place - sight, 0)
    return first, min(place + sight, size - 1) - first + 1


@register_jitable
def way(
    costs: NDArray[np.float64],
    x: float,
    y: float,
    to_x: float,
    to_y: float,
    sight: int,
    beyond: float,
    low_x: int,
    low_y: int,
    width: int,
    height: int,
    wraps_x: int,
    wraps_y: int,
) -> float:
    """Return the heading of the first step of a cheapest way, −1 where there is none, or no need.

    A step leads to one of the eight neighbours.

    Args:
        costs: (patches,) what it costs to enter each; infinite where nobody can.
        x: from where.
        y: from where.
        to_x: to where.
        to_y: to where.
        sight: how many steps far patches are known; 0 or less for all.
        beyond: what a step costs there, above 0.
        low_x: its lowest column.
        low_y: its lowest row.
        width: columns.
        height: rows.
        wraps_x: whether the first column is beside the last.
        wraps_y: whether the first row is beside the last.
    """
    if not beyond > 0.0:
        raise ValueError("a way whose steps cost nothing beyond sight")
    column, row = place_on(x, low_x, width, wraps_x), place_on(y, low_y, height, wraps_y)
    end_column = place_on(to_x, low_x, width, wraps_x)
    end_row = place_on(to_y, low_y, height, wraps_y)
    first_column, columns = _in_sight(column, sight, width, wraps_x)
    first_row, rows = _in_sight(row, sight, height, wraps_y)
    round_x = wraps_x and columns == width
    round_y = wraps_y and rows == height
    known = columns * rows
    least = beyond
    for i in range(columns):
        for j in range(rows):
            cost = costs[(first_column + i) % width * height + (first_row + j) % height]
            if not cost >= 0.0:
                raise ValueError("a way over patches whose cost is below 0")
            least = min(least, cost)
    spent = np.full(known, math.inf)
    first_step = np.full(known, -1)
    # A heap of places, by the cost of the way that leads on from them; of equals the last one
    # found comes first, which is nearest to the end.
    sums, order, places = np.empty(8 * known + 1), np.empty(8 * known + 1), np.empty(8 * known + 1)
    start = (column - first_column) % width * rows + (row - first_row) % height
    spent[start] = 0.0
    sums[0], order[0], places[0] = 0.0, 0.0, start
    size, made = 1, 1
    best, found = math.inf, -1
    while size > 0 and sums[0] < best:
        place = int(places[0])
        sum_here = sums[0]
        size -= 1
        _sift_down(sums, order, places, size)
        i, j = place // rows, place % rows
        at_column, at_row = (first_column + i) % width, (first_row + j) % height
        left = max(
            apart(at_column, end_column, width, wraps_x), apart(at_row, end_row, height, wraps_y)
        )
        if sum_here > spent[place] + least * left:
            continue  # a cheaper way to it was found since
        if left == 0:
            return first_step[place] * 45.0 if place != start else -1.0
        for step in ORDER:
            to_i, to_j = i + STEPS[step][0], j + STEPS[step][1]
            if round_x:
                to_i %= columns
            if round_y:
                to_j %= rows
            if not (0 <= to_i < columns and 0 <= to_j < rows):
                into_x = wraps_x or 0 <= at_column + STEPS[step][0] < width
                into_y = wraps_y or 0 <= at_row + STEPS[step][1] < height
                if into_x and into_y and spent[place] + beyond * left < best:
                    best = spent[place] + beyond * left
                    found = first_step[place] if place != start else step
                continue
            to = to_i * rows + to_j
            to_column, to_row = (first_column + to_i) % width, (first_row + to_j) % height
            cost = spent[place] + costs[to_column * height + to_row]
            if cost < spent[to]:
                spent[to] = cost
                first_step[to] = step if place == start else first_step[place]
                far = max(
                    apart(to_column, end_column, width, wraps_x),
                    apart(to_row, end_row, height, wraps_y),
                )
                sums[size], order[size], places[size] = cost + least * far, -float(made), to
                size += 1
                made += 1
                _sift_up(sums, order, places, size - 1)
    return found * 45.0 if found >= 0 else -1.0


@register_jitable
def _before(sums: Any, order: Any, one: int, other: int) -> bool:
    """Say whether one entry of the heap comes before another."""
    return bool(sums[one] < sums[other] or (sums[one] == sums[other] and order[one] < order[other]))


@register_jitable
def _swap(sums: Any, order: Any, places: Any, one: int, other: int) -> None:
    sums[one], sums[other] = sums[other], sums[one]
    order[one], order[other] = order[other], order[one]
    places[one], places[other] = places[other], places[one]


@register_jitable
def _sift_up(sums: Any, order: Any, places: Any, at: int) -> None:
    """Let the last entry of a heap rise to where it belongs."""
    while at > 0 and _before(sums, order, at, (at - 1) // 2):
        _swap(sums, order, places, at, (at - 1) // 2)
        at = (at - 1) // 2


@register_jitable
def _sift_down(sums: Any, order: Any, places: Any, size: int) -> None:
    """Take the first entry of a heap away; the last one, at `size`, comes in its place."""
    _swap(sums, order, places, 0, size)
    at = 0
    while 2 * at + 1 < size:
        child = 2 * at + 1
        if child + 1 < size and _before(sums, order, child + 1, child):
            child += 1
        if not _before(sums, order, child, at):
            return
        _swap(sums, order, places, child, at)
        at = child


# Compiled -----------------------------------------------------------------------------------------

_BEFORE = """from socialmind.worlds.grid import ways as _ways

_way = _inner(_ways.way)"""

_TEXT = """@_inner
def _world_way_FIELD(_model, x, y, to_x, to_y, sight, beyond):
    return _way(_patches(_model)["FIELD"], x, y, to_x, to_y, sight, beyond, SPACE)"""


def text(calls: list[tuple[str, ...]], space: str) -> str:
    """Return how compiled rules find ways.

    Args:
        calls: what they call, with fields.
        space: how compiled code finds where the world is.
    """
    fields = [call[1] for call in calls if call[0] in CALLS]
    parts = [_TEXT.replace("SPACE", space).replace("FIELD", field) for field in fields]
    return "\n\n\n".join([_BEFORE, *parts] if parts else [])
