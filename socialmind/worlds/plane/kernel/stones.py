"""Obstacles made ready: their cosines and sines, and a table of who can meet which."""

from __future__ import annotations

import math
from typing import Any

from numba import carray, types
from numba.extending import register_jitable

from socialmind.compiling.memory import as_pointer
from socialmind.worlds.plane import layout
from socialmind.worlds.plane.layout import FARTHEST, OBSTACLE, PLANE

SQRT_2 = math.sqrt(2.0)


@register_jitable(error_model="numpy")
def plane_at(address: int) -> Any:
    """Return the record of the plane at an address."""
    return carray(as_pointer(address), (1,), PLANE)[0]


@register_jitable(error_model="numpy")
def stones_of(plane: Any) -> Any:
    """Return the stones of a plane, one after the other."""
    return carray(
        as_pointer(plane.stones), (plane.obstacle_capacity * layout.STONE_COLUMNS,), types.float64
    )


@register_jitable(error_model="numpy")
def table_of(plane: Any) -> Any:
    """Return where the lists of the cells begin, and the lists."""
    begin = carray(as_pointer(plane.cell_begin), (plane.cells * plane.cells + 1,), types.int32)
    return begin, carray(as_pointer(plane.cell_stones), (plane.cell_room,), types.int32)


@register_jitable(error_model="numpy", forceinline=True)
def candidates(plane: Any, begin: Any, x: float, y: float) -> Any:
    """Return the first and the last + 1 place of the list of the cell at (x, y).

    Places are those of `cell_stones`; without a table they are the stones themselves.
    """
    if plane.cell <= 0.0:
        return 0, plane.stone_count
    across, up = (x - plane.left) / plane.cell, (y - plane.bottom) / plane.cell
    if not (0.0 <= across < plane.cells and 0.0 <= up < plane.cells):
        return 0, 0
    cell = int(up) * plane.cells + int(across)
    return begin[cell], begin[cell + 1]


@register_jitable(error_model="numpy")
def build(address: int) -> int:
    """Work out the stones of a plane and the table of its cells.

    Args:
        address: the plane's record.

    Returns:
        0; or how many entries the table needs when they are more than `cell_room`: the plane can be
        used all the same, but slowly; or −1 − slot of an obstacle that stands nowhere, as one of
        its numbers is not finite, or is enormous, or its half-width is below 0.
    """
    plane = plane_at(address)
    fault = _take_stones(plane)
    plane.cell = -1.0
    if fault < 0:
        plane.stone_count = 0
        return fault
    if plane.stone_count == 0 or plane.cells < 1:
        return 0
    _place_table(plane)
    begin, entries = table_of(plane)
    cells = plane.cells * plane.cells
    for cell in range(cells + 1):
        begin[cell] = 0
    needed = 0
    for stone in range(plane.stone_count):
        needed += _enter(plane, begin, entries, stone, True)
    if needed > plane.cell_room:
        plane.cell = -1.0
        return needed
    # Entry c + 1 counts cell c's stones. Made the begin of cell c, it moves on as they are entered,
    # until it is the end, the begin of cell c + 1.
    total = 0
    for cell in range(cells):
        count = begin[cell + 1]
        begin[cell + 1] = total
        total += count
    for stone in range(plane.stone_count):
        _enter(plane, begin, entries, stone, False)
    return 0


@register_jitable(error_model="numpy")
def _take_stones(plane: Any) -> int:
    """Fill the stones from the living obstacles; return 0 or what is wrong."""
    stones = stones_of(plane)
    alive = carray(as_pointer(plane.obstacle_alive), (plane.obstacle_capacity,), types.uint8)
    count = 0
    for slot in range(plane.obstacle_capacity):
        if not alive[slot]:
            continue
        place = plane.obstacles + slot * plane.obstacle_stride
        obstacle = carray(as_pointer(place), (1,), OBSTACLE)[0]
        x, y, angle, half_width = obstacle.x, obstacle.y, obstacle.angle, obstacle.half_width
        if not (abs(x) + abs(y) + abs(angle) + half_width < FARTHEST and half_width >= 0.0):
            return -1 - slot
        if half_width == 0.0:
            continue  # there is nothing
        first = count * layout.STONE_COLUMNS
        stones[first + layout.STONE_X] = x
        stones[first + layout.STONE_Y] = y
        stones[first + layout.STONE_COS] = math.cos(angle)
        stones[first + layout.STONE_SIN] = math.sin(angle)
        stones[first + layout.STONE_HALF_WIDTH] = half_width
        stones[first + layout.STONE_ROUND] = 1.0 if obstacle.round != 0 else 0.0
        stones[first + layout.STONE_RADIUS] = half_width * (1.0 if obstacle.round != 0 else SQRT_2)
        count += 1
    plane.stone_count = count
    return 0


@register_jitable(error_model="numpy")
def _place_table(plane: Any) -> None:
    """Lay the table over all places from which a stone can be met."""
    stones = stones_of(plane)
    left, right, bottom, top = math.inf, -math.inf, math.inf, -math.inf
    for stone in range(plane.stone_count):
        first = stone * layout.STONE_COLUMNS
        x, y = stones[first + layout.STONE_X], stones[first + layout.STONE_Y]
        # A hair more, as distances are rounded.
        margin = (stones[first + layout.STONE_RADIUS] + plane.reach) * (1.0 + 1e-9)
        left, right = min(left, x - margin), max(right, x + margin)
        bottom, top = min(bottom, y - margin), max(top, y + margin)
    plane.left, plane.bottom = left, bottom
    plane.cell = max(right - left, top - bottom) * (1.0 + 1e-9) / plane.cells


@register_jitable(error_model="numpy")
def _enter(plane: Any, begin: Any, entries: Any, stone: int, count_only: bool) -> int:
    """Enter a stone into the lists of the cells near it; return how many they are."""
    stones = stones_of(plane)
    first = stone * layout.STONE_COLUMNS
    x, y = stones[first + layout.STONE_X], stones[first + layout.STONE_Y]
    margin = (stones[first + layout.STONE_RADIUS] + plane.reach) * (1.0 + 1e-9)
    side, cells = plane.cell, plane.cells
    low = max(int((x - margin - plane.left) / side), 0)
    high = min(int((x + margin - plane.left) / side) + 1, cells)
    below = max(int((y - margin - plane.bottom) / side), 0)
    above = min(int((y + margin - plane.bottom) / side) + 1, cells)
    entered = 0
    slack = side * 1e-9
    for up in range(below, above):
        bottom = plane.bottom + up * side
        dy = max(max(bottom - y, y - bottom - side), 0.0)
        for across in range(low, high):
            left = plane.left + across * side
            dx = max(max(left - x, x - left - side), 0.0)
            if dx * dx + dy * dy > (margin + slack) * (margin + slack):
                continue
            cell = up * cells + across
            entered += 1
            if not count_only:
                entries[begin[cell + 1]] = stone
            begin[cell + 1] += 1
    return entered
