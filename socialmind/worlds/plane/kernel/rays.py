"""What range finders read: how far the nearest border, obstacle or seen body is along their rays.

Rays are worked out together, lane by lane, in the body's frame, where they never change: what
stands around the body is turned into that frame instead. The loops over lanes have no branches, so
that they become vector operations. Whoever stands inside something reads 0.
"""

from __future__ import annotations

import math
from typing import Any

from numba import carray, types
from numba.extending import register_jitable

from socialmind.compiling.memory import as_pointer
from socialmind.worlds.plane import layout
from socialmind.worlds.plane.kernel.bodies import alive_of, body_at, kinds_of
from socialmind.worlds.plane.kernel.stones import (
    candidates,
    plane_at,
    stones_of,
    table_of,
)
from socialmind.worlds.plane.layout import EYES, LANES

FAR = 1e300
"""Farther than any ray reaches."""
TINY = 1e-40
"""Added to what is divided by: it changes nothing but 0."""


@register_jitable(error_model="numpy")
def look(plane_address: int, eyes_address: int) -> int:
    """Write the readings of all range finders of all living bodies of a kind.

    Args:
        plane_address: the plane's record.
        eyes_address: the record of the kind's eyes.

    Returns:
        0.
    """
    plane = plane_at(plane_address)
    eyes = carray(as_pointer(eyes_address), (1,), EYES)[0]
    kind = kinds_of(plane)[eyes.kind]
    alive = alive_of(kind)
    for slot in range(kind.capacity):
        if alive[slot]:
            _look_around(plane, eyes, kind, slot)
    return 0


@register_jitable(error_model="numpy")
def _look_around(plane: Any, eyes: Any, kind: Any, slot: int) -> None:
    """Write the readings of one body."""
    body = body_at(kind, slot)
    x, y = body.x, body.y
    cos, sin = math.cos(body.angle), math.sin(body.angle)
    lanes, count = eyes.lanes, eyes.lane_count
    best = carray(as_pointer(plane.best), (count,), types.float64)
    reach = carray(as_pointer(lanes + 32 * count), (count,), types.float64)
    for lane in range(count):
        best[lane] = reach[lane]
    if plane.stone_count > 0:
        _see_stones(plane, lanes, count, x, y, cos, sin)
    if plane.half_width > 0.0:
        far = plane.reach
        gap = plane.half_width - x
        if gap < far:
            _see_border(lanes, plane.best, count, cos, -sin, gap)
        gap = plane.half_width + x
        if gap < far:
            _see_border(lanes, plane.best, count, -cos, sin, gap)
        gap = plane.half_width - y
        if gap < far:
            _see_border(lanes, plane.best, count, sin, cos, gap)
        gap = plane.half_width + y
        if gap < far:
            _see_border(lanes, plane.best, count, -sin, -cos, gap)
    _see_bodies(plane, eyes, slot, x, y, cos, sin)
    readings = kind.rows + slot * kind.stride + eyes.readings
    _write(eyes, best, reach, readings)


@register_jitable(error_model="numpy")
def _write(eyes: Any, best: Any, reach: Any, readings: int) -> None:
    """Write the nearest of each sensor's rays over its reach."""
    count = eyes.sensor_count
    sensors = carray(as_pointer(eyes.sensors), (count,), types.int64)
    for ray in range(1, eyes.depth):
        for sensor in range(count):
            other = best[ray * count + sensor]
            best[sensor] = other if other < best[sensor] else best[sensor]
    for sensor in range((count + LANES - 1) // LANES * LANES):
        best[sensor] /= reach[sensor]
    for sensor in range(count):
        place = as_pointer(readings + 8 * sensors[sensor])
        carray(place, (1,), types.float64)[0] = best[sensor]


@register_jitable(error_model="numpy")
def _see_stones(
    plane: Any, lanes: int, count: int, x: float, y: float, cos: float, sin: float
) -> None:
    stones = stones_of(plane)
    begin, entries = table_of(plane)
    place, end = candidates(plane, begin, x, y)
    while place < end:
        stone = entries[place] if plane.cell > 0.0 else place
        place += 1
        first = stone * layout.STONE_COLUMNS
        dx, dy = x - stones[first + layout.STONE_X], y - stones[first + layout.STONE_Y]
        far = plane.reach + stones[first + layout.STONE_RADIUS]
        if dx * dx + dy * dy > far * far:
            continue
        half_width = stones[first + layout.STONE_HALF_WIDTH]
        if stones[first + layout.STONE_ROUND] != 0.0:
            ahead, left = -(cos * dx + sin * dy), sin * dx - cos * dy
            _see_circle(lanes, plane.best, count, ahead, left, half_width)
        else:
            stone_cos = stones[first + layout.STONE_COS]
            stone_sin = stones[first + layout.STONE_SIN]
            ahead, left = stone_cos * dx + stone_sin * dy, stone_cos * dy - stone_sin * dx
            turn_cos = stone_cos * cos + stone_sin * sin
            turn_sin = stone_cos * sin - stone_sin * cos
            _see_square(lanes, plane.best, count, ahead, left, turn_cos, turn_sin, half_width)


@register_jitable(error_model="numpy")
def _see_bodies(
    plane: Any, eyes: Any, own: int, x: float, y: float, cos: float, sin: float
) -> None:
    kinds = kinds_of(plane)
    for number in range(plane.kind_count):
        kind = kinds[number]
        if kind.seen == 0:
            continue
        alive = alive_of(kind)
        far = plane.reach + kind.radius
        for slot in range(kind.capacity):
            if not alive[slot] or (number == eyes.kind and slot == own):
                continue
            other = body_at(kind, slot)
            if other.carrier_kind >= 0:
                continue
            dx, dy = other.x - x, other.y - y
            if dx * dx + dy * dy < far * far:
                ahead, left = cos * dx + sin * dy, cos * dy - sin * dx
                _see_circle(eyes.lanes, plane.best, eyes.lane_count, ahead, left, kind.radius)


@register_jitable(error_model="numpy")
def _see_square(
    lanes: int, nearest: int, count: int,
    ahead: float, left: float, turn_cos: float, turn_sin: float, half_width: float,
) -> None:  # fmt: skip
    """Meet rays with a square: the body stands at (ahead, left) in its frame, and is turned."""
    x = carray(as_pointer(lanes), (count,), types.float64)
    y = carray(as_pointer(lanes + 8 * count), (count,), types.float64)
    cos = carray(as_pointer(lanes + 16 * count), (count,), types.float64)
    sin = carray(as_pointer(lanes + 24 * count), (count,), types.float64)
    best = carray(as_pointer(nearest), (count,), types.float64)
    for lane in range(count):
        along = turn_cos * cos[lane] - turn_sin * sin[lane] + TINY
        across = turn_sin * cos[lane] + turn_cos * sin[lane] + TINY
        from_along = ahead + (turn_cos * x[lane] - turn_sin * y[lane])
        from_across = left + (turn_sin * x[lane] + turn_cos * y[lane])
        # One division for both directions.
        inverse = 1.0 / (along * across)
        per_along, per_across = inverse * across, inverse * along
        a = (-half_width - from_along) * per_along
        b = (half_width - from_along) * per_along
        c = (-half_width - from_across) * per_across
        d = (half_width - from_across) * per_across
        enter_one = a if a < b else b
        leave_one = b if a < b else a
        enter_two = c if c < d else d
        leave_two = d if c < d else c
        enter = enter_one if enter_one > enter_two else enter_two
        leave = leave_one if leave_one < leave_two else leave_two
        enter = enter if enter > 0.0 else 0.0
        met = enter if enter <= leave else FAR
        best[lane] = met if met < best[lane] else best[lane]


@register_jitable(error_model="numpy")
def _see_circle(
    lanes: int, nearest: int, count: int, ahead: float, left: float, radius: float
) -> None:
    """Meet rays with a circle at (ahead, left) in the body's frame."""
    x = carray(as_pointer(lanes), (count,), types.float64)
    y = carray(as_pointer(lanes + 8 * count), (count,), types.float64)
    cos = carray(as_pointer(lanes + 16 * count), (count,), types.float64)
    sin = carray(as_pointer(lanes + 24 * count), (count,), types.float64)
    best = carray(as_pointer(nearest), (count,), types.float64)
    square = radius * radius
    for lane in range(count):
        to_x, to_y = ahead - x[lane], left - y[lane]
        middle = to_x * cos[lane] + to_y * sin[lane]
        beside = to_x * sin[lane] - to_y * cos[lane]
        half_square = square - beside * beside
        half = math.sqrt(half_square if half_square > 0.0 else 0.0)
        enter = middle - half
        enter = enter if enter > 0.0 else 0.0
        met = enter if half_square >= 0.0 else FAR
        met = met if middle + half >= 0.0 else FAR
        best[lane] = met if met < best[lane] else best[lane]


@register_jitable(error_model="numpy")
def _see_border(
    lanes: int, nearest: int, count: int, ahead: float, left: float, gap: float
) -> None:
    """Meet rays with a border whose direction is (ahead, left) in the body's frame."""
    x = carray(as_pointer(lanes), (count,), types.float64)
    y = carray(as_pointer(lanes + 8 * count), (count,), types.float64)
    cos = carray(as_pointer(lanes + 16 * count), (count,), types.float64)
    sin = carray(as_pointer(lanes + 24 * count), (count,), types.float64)
    best = carray(as_pointer(nearest), (count,), types.float64)
    for lane in range(count):
        room = gap - (ahead * x[lane] + left * y[lane])
        speed = ahead * cos[lane] + left * sin[lane]
        met = room / (speed + TINY)
        met = met if speed > 0.0 else FAR
        met = met if room > 0.0 else 0.0
        best[lane] = met if met < best[lane] else best[lane]
