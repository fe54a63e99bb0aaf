"""The torus grid, with NetLogo's geometry.

A world of size s has s × s patches of side 1. Their centres are the whole numbers from
low = −⌊s/2⌋ to low + s − 1 (−16 … 16 for NetLogo's 33 × 33). Agents stand anywhere in
[low − 0.5, low + s − 0.5), and what leaves on one side comes back on the other. Headings are in
degrees, 0 is north, and they grow clockwise.

The commands below are rules themselves: a model calls them as methods of its world,
`model.world.face(human, x, y)`, and they run at both speeds like its own.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Any


def wrapped(value: float, low: int, size: int) -> float:
    """Return a coordinate brought back into the world.

    >>> wrapped(17.0, -16, 33)
    -16.0
    """
    edge = low - 0.5
    if value < edge or value >= edge + size:
        value = value - size * math.floor((value - edge) / size)
        if value < edge or value >= edge + size:  # a hair off, by rounding
            value = edge
    return value


def short_way(difference: float, size: int) -> float:
    """Return a difference of two coordinates, taken the short way round.

    >>> short_way(30.0, 33)
    -3.0
    """
    half = size / 2
    if difference > size or difference < -size:  # to a point outside the world
        difference = difference - size * math.floor(difference / size)
    if difference > half:
        return difference - size
    if difference < -half:
        return difference + size
    return difference


def distance(world: Any, agent: Any, x: float, y: float) -> float:
    """Return the distance from an agent to a point, the short way round."""
    dx = short_way(x - agent.x, world.size)
    dy = short_way(y - agent.y, world.size)
    return math.hypot(dx, dy)


def towards(world: Any, agent: Any, x: float, y: float) -> float:
    """Return the heading from an agent to a point, in degrees; its own heading when it is there."""
    dx = short_way(x - agent.x, world.size)
    dy = short_way(y - agent.y, world.size)
    if dx == 0 and dy == 0:
        return float(agent.heading)
    return compass(dx, dy)


def compass(dx: float, dy: float) -> float:
    """Return the heading of a step, in [0, 360) degrees.

    The arc tangent is Moshier's rational approximation (Cephes, atan.c; error below 2⁻⁵²): written
    out, it gives the same bits on every machine, and costs a third of the C library's.

    >>> compass(0.0, 1.0), compass(1.0, 0.0), compass(-1.0, 0.0), compass(1.0, -1.0)
    (0.0, 90.0, 270.0, 135.0)
    """
    across, along = abs(dx), abs(dy)
    if across == 0 and along == 0:
        return 0.0
    # Within the eighth of the circle next to an axis, then next to its middle.
    near = across if across < along else along
    far = along if across < along else across
    t = near / far
    middle = 0.0
    if t > 0.41421356237309503:
        t = (near - far) / (near + far)
        middle = 45.0
    z = t * t
    top = (
        ((-0.8750608600031904 * z - 16.157537187333652) * z - 75.00855792314705) * z
        - 122.88666844901361
    ) * z - 64.85021904942025
    bottom = (
        (((z + 24.858464901423062) * z + 165.02700983169885) * z + 432.88106049129027) * z
        + 485.3903996359137
    ) * z + 194.5506571482614
    angle = middle + (t * z * (top / bottom) + t) * 57.29577951308232
    if across > along:
        angle = 90.0 - angle
    if dy < 0:
        angle = 180.0 - angle
    if dx < 0:
        angle = 360.0 - angle
        if angle >= 360.0:  # a hair west of north, rounded up
            angle = 0.0
    return angle


def face(world: Any, agent: Any, x: float, y: float) -> None:
    """Turn an agent towards a point, the short way round."""
    agent.heading = towards(world, agent, x, y)


def forward(world: Any, agent: Any, length: float) -> None:
    """Move an agent along its heading."""
    angle = math.radians(agent.heading)
    agent.x = wrapped(agent.x + length * math.sin(angle), world.low, world.size)
    agent.y = wrapped(agent.y + length * math.cos(angle), world.low, world.size)


def right(world: Any, agent: Any, angle: float) -> None:
    """Turn an agent clockwise, by degrees."""
    agent.heading = (agent.heading + angle) % 360


def left(world: Any, agent: Any, angle: float) -> None:
    """Turn an agent counter-clockwise, by degrees."""
    agent.heading = (agent.heading - angle) % 360


def move_to(world: Any, agent: Any, x: float, y: float) -> None:
    """Put an agent at a point, brought back into the world."""
    agent.x = wrapped(x, world.low, world.size)
    agent.y = wrapped(y, world.low, world.size)


def walk_to(world: Any, agent: Any, x: float, y: float, length: float) -> None:
    """Turn an agent to a point and move it there by a length, or onto it when it is nearer."""
    dx = short_way(x - agent.x, world.size)
    dy = short_way(y - agent.y, world.size)
    away = math.hypot(dx, dy)
    if away > 0:
        agent.heading = compass(dx, dy)
    if away == 0 or away < length:
        move_to(world, agent, x, y)
    else:
        agent.x = wrapped(agent.x + length * (dx / away), world.low, world.size)
        agent.y = wrapped(agent.y + length * (dy / away), world.low, world.size)


def is_on(world: Any, agent: Any, x: float, y: float) -> bool:
    """Say whether an agent stands on the patch of a point (NetLogo's `patch-here = patch x y`)."""
    if 1 < abs(x - agent.x) < world.size - 1 or 1 < abs(y - agent.y) < world.size - 1:
        return False  # the usual case, without rounding
    same_x = math.floor(agent.x + 0.5) == math.floor(wrapped(x, world.low, world.size) + 0.5)
    same_y = math.floor(agent.y + 0.5) == math.floor(wrapped(y, world.low, world.size) + 0.5)
    return same_x and same_y


COMMANDS = {
    function.__name__: function
    for function in (distance, towards, face, forward, right, left, move_to, walk_to, is_on)
}
"""What rules call as methods of `model.world`."""


def patch_index(x: float, y: float, low: int, size: int) -> int:
    """Return the place in the array of patches of the patch around a point.

    >>> patch_index(-16.0, -16.0, -16, 33), patch_index(16.9, -16.0, -16, 33)
    (0, 0)
    """
    if not (abs(x) < 1e15 and abs(y) < 1e15):
        raise ValueError("a point that is nowhere")
    column = (math.floor(x + 0.5) - low) % size
    row = (math.floor(y + 0.5) - low) % size
    return column * size + row


def patches_in_radius(x: float, y: float, radius: float, low: int, size: int) -> Iterator[int]:
    """Yield the places of the patches whose centre is at most a radius away, each once.

    NetLogo's `patches in-radius`, in a fixed order: column by column.
    """
    if not (abs(x) < 1e15 and abs(y) < 1e15 and radius < 1e15):
        raise ValueError("a point or a radius that is nowhere")
    half = size / 2
    first_column = math.ceil(x - radius)
    columns = math.floor(x + radius) - first_column + 1
    if columns > size:
        first_column, columns = low, size
    first_row = math.ceil(y - radius)
    rows = math.floor(y + radius) - first_row + 1
    if rows > size:
        first_row, rows = low, size
    for i in range(columns):
        dx = first_column + i - x
        if dx > half:
            dx = dx - size
        elif dx < -half:
            dx = dx + size
        column = (first_column + i - low) % size
        for j in range(rows):
            dy = first_row + j - y
            if dy > half:
                dy = dy - size
            elif dy < -half:
                dy = dy + size
            if dx * dx + dy * dy <= radius * radius:
                yield column * size + (first_row + j - low) % size


def lattice(size: int, n: int) -> list[tuple[int, int]]:
    """Return the patches of n places on a regular lattice over a torus.

    Columns × rows = n, as near to a square as n allows; place i stands in column i % columns.

    Args:
        size: the world's size, in patches.
        n: the number of places, 1 or more.

    >>> lattice(33, 1)
    [(0, 0)]
    >>> lattice(33, 3)
    [(-11, 0), (0, 0), (11, 0)]
    """
    columns = lattice_columns(n)
    rows = n // columns
    low = -(size // 2)

    def centre(place: int, places: int) -> int:
        return math.floor(low - 0.5 + (place + 0.5) * size / places + 0.5)

    return [(centre(i % columns, columns), centre(i // columns, rows)) for i in range(n)]


def lattice_columns(n: int) -> int:
    """Return the columns of the lattice of n places: n's smallest divisor not below its root.

    >>> [lattice_columns(n) for n in (1, 2, 6, 7, 4000)]
    [1, 2, 3, 7, 80]
    """
    columns = math.isqrt(n)
    while columns * columns < n or n % columns:
        columns += 1
    return columns
