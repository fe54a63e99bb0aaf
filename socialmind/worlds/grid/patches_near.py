"""Which patch a point is on, and which patches are within a radius of it, or around its own.

Patches are numbers here, their places in the array of patches: column by column, each from the
lowest row up. Where the world is comes in six numbers: its lowest column and row, how many there
are of both, and whether it wraps across and up.
"""

from __future__ import annotations

import math
from collections.abc import Iterator

from numba.extending import register_jitable


@register_jitable
def place_on(value: float, low: int, size: int, wraps: int) -> int:
    """Return the column, or row, of a coordinate, counted from 0."""
    if wraps:
        place = math.floor(value + 0.5) - low
        return place if 0 <= place < size else place % size
    if not low - 0.5 <= value < low - 0.5 + size:
        raise ValueError("a point outside the world; ask world.is_inside(x, y) before")
    return min(math.floor(value + 0.5) - low, size - 1)  # a hair before the wall, rounded up


def patch_index(
    x: float, y: float, low_x: int, low_y: int, width: int, height: int, wraps_x: int, wraps_y: int
) -> int:
    """Return the place in the array of patches of the patch around a point.

    >>> patch_index(-16.0, -16.0, -16, -16, 33, 33, 1, 1)
    0
    >>> patch_index(16.9, -16.0, -16, -16, 33, 33, 1, 1)
    0
    """
    if not (abs(x) < 1e15 and abs(y) < 1e15):
        raise ValueError("a point that is nowhere")
    column = place_on(x, low_x, width, wraps_x)
    return column * height + place_on(y, low_y, height, wraps_y)


@register_jitable
def first_and_count(
    value: float, radius: float, low: int, size: int, wraps: int
) -> tuple[int, int]:
    """Return the first column within a radius, and how many there are; each at most once."""
    first = math.ceil(value - radius)
    last = math.floor(value + radius)
    if wraps:
        return (low, size) if last - first + 1 > size else (first, last - first + 1)
    first, last = max(first, low), min(last, low + size - 1)
    return first, last - first + 1


def patches_in_radius(
    x: float,
    y: float,
    radius: float,
    low_x: int,
    low_y: int,
    width: int,
    height: int,
    wraps_x: int,
    wraps_y: int,
) -> Iterator[int]:
    """Yield the places of the patches whose centre is at most a radius away, each once.

    NetLogo's `patches in-radius`, in a fixed order: column by column.
    """
    if not (abs(x) < 1e15 and abs(y) < 1e15 and radius < 1e15):
        raise ValueError("a point or a radius that is nowhere")
    # Between walls no difference is too large to be the way.
    half_x = width / 2 if wraps_x else math.inf
    half_y = height / 2 if wraps_y else math.inf
    first_column, columns = first_and_count(x, radius, low_x, width, wraps_x)
    first_row, rows = first_and_count(y, radius, low_y, height, wraps_y)
    for i in range(columns):
        dx = first_column + i - x
        if dx > half_x:
            dx = dx - width
        elif dx < -half_x:
            dx = dx + width
        column = (first_column + i - low_x) % width
        for j in range(rows):
            dy = first_row + j - y
            if dy > half_y:
                dy = dy - height
            elif dy < -half_y:
                dy = dy + height
            if dx * dx + dy * dy <= radius * radius:
                yield column * height + (first_row + j - low_y) % height


@register_jitable
def axis_around(place: int, steps: int, size: int, wraps: int) -> tuple[int, int, int]:
    """Return the first column around one, how many there are, and which of them is its own."""
    if wraps:
        if 2 * steps + 1 > size:
            return 0, size, place
        return place - steps, 2 * steps + 1, steps
    first = max(place - steps, 0)
    return first, min(place + steps, size - 1) - first + 1, place - first


@register_jitable
def count_around(
    x: float,
    y: float,
    steps: int,
    four: int,
    low_x: int,
    low_y: int,
    width: int,
    height: int,
    wraps_x: int,
    wraps_y: int,
) -> int:
    """Return how many patches there are around that of a point, which is not among them.

    They are at most so many king's moves away; or, if `four`, share a side with it.
    """
    if steps < 0:
        raise ValueError("a radius, or a number of steps, below 0")
    column, row = place_on(x, low_x, width, wraps_x), place_on(y, low_y, height, wraps_y)
    _, columns, _ = axis_around(column, min(steps, width), width, wraps_x)
    _, rows, _ = axis_around(row, min(steps, height), height, wraps_y)
    return columns + rows - 2 if four else columns * rows - 1


@register_jitable
def once_round(place: int, size: int) -> int:
    """Return a column, or row, that lies at most once round the world, as one in it."""
    return place + size if place < 0 else (place - size if place >= size else place)


@register_jitable
def nth_around(
    number: int,
    x: float,
    y: float,
    steps: int,
    four: int,
    low_x: int,
    low_y: int,
    width: int,
    height: int,
    wraps_x: int,
    wraps_y: int,
) -> int:
    """Return one of the patches that `count_around` counts, by its number, column by column."""
    column, row = place_on(x, low_x, width, wraps_x), place_on(y, low_y, height, wraps_y)
    first_x, _, own_x = axis_around(column, min(steps, width), width, wraps_x)
    first_y, rows, own_y = axis_around(row, min(steps, height), height, wraps_y)
    if not four:
        if number >= own_x * rows + own_y:
            number += 1
        across = number // rows
        up = number - across * rows
    elif number < own_x:
        across, up = number, own_y
    elif number < own_x + rows - 1:
        across, up = own_x, number - own_x
        if up >= own_y:
            up += 1
    else:
        across, up = number - rows + 2, own_y
    return once_round(first_x + across, width) * height + once_round(first_y + up, height)
