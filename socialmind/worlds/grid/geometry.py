"""Geometry on a grid of patches, with NetLogo's meaning: a torus, walls, or a cylinder between.

Patches are squares of side 1, whose centres are whole numbers: low_x … low_x + width − 1 across and
low_y … low_y + height − 1 up (−16 … 16 for NetLogo's 33 × 33). Agents stand anywhere in
[low_x − 0.5, low_x + width − 0.5), and likewise up. Where an axis wraps, what leaves on one side
comes back on the other, and distances are those of the short way round; where it does not, nothing
leaves. Headings are in degrees, 0 is north, and they grow clockwise.

The commands below are rules themselves: a model calls them as methods of its world,
`model.world.face(human, x, y)`, and they run at both speeds like its own. What of a world is the
same in all runs of a model, as whether it wraps, is a constant to them.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Any

from numba.extending import register_jitable


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


def apart(difference: float, size: int, wraps: int) -> float:
    """Return a difference of two coordinates as the way between them goes."""
    return short_way(difference, size) if wraps else difference


def distance(world: Any, agent: Any, x: float, y: float) -> float:
    """Return the distance from an agent to a point, the short way round where the world wraps."""
    dx = apart(x - agent.x, world.width, world.wraps_x)
    dy = apart(y - agent.y, world.height, world.wraps_y)
    return math.hypot(dx, dy)


def towards(world: Any, agent: Any, x: float, y: float) -> float:
    """Return the heading from an agent to a point, in degrees; its own heading when it is there."""
    dx = apart(x - agent.x, world.width, world.wraps_x)
    dy = apart(y - agent.y, world.height, world.wraps_y)
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
    """Turn an agent towards a point, the short way round where the world wraps."""
    agent.heading = towards(world, agent, x, y)


def right(world: Any, agent: Any, angle: float) -> None:
    """Turn an agent clockwise, by degrees."""
    agent.heading = (agent.heading + angle) % 360


def left(world: Any, agent: Any, angle: float) -> None:
    """Turn an agent counter-clockwise, by degrees."""
    agent.heading = (agent.heading - angle) % 360


# Where an agent may stand ----------------------------------------------------------------------


def between(value: float, low: int, size: int) -> bool:
    """Say whether a coordinate lies between two walls.

    >>> between(16.4, -16, 33), between(16.5, -16, 33), between(-16.5, -16, 33)
    (True, False, True)
    """
    return low - 0.5 <= value < low - 0.5 + size


def is_inside(world: Any, x: float, y: float) -> bool:
    """Say whether the world has a patch at a point; where it wraps there is always one."""
    across = world.wraps_x != 0 or between(x, world.low_x, world.width)
    return across and (world.wraps_y != 0 or between(y, world.low_y, world.height))


def kept(value: float, low: int, size: int, wraps: int) -> float:
    """Return a coordinate brought back over a border; beyond a wall it stays, and is refused."""
    return wrapped(value, low, size) if wraps else value


def unrounded(share: float) -> float:
    """Return a sine or cosine; what is 0 but for rounding is 0, as in NetLogo.

    Or an agent that goes along a wall would run into it.
    """
    return 0.0 if abs(share) < 3.2e-15 else share


def steps_to_wall(place: float, step: float, low: int, size: int, wanted: int) -> int:
    """Return how many steps, at most so many, do not leave the space between two walls."""
    if step == 0:
        return wanted
    edge = low - 0.5
    room = (edge + size - place) / step if step > 0 else (edge - place) / step
    if room >= wanted + 1:
        return wanted
    steps = min(math.floor(room) + 1, wanted)  # one more, as the quotient is rounded
    while steps > 0 and not between(place + steps * step, low, size):
        steps -= 1
    return steps


def ahead(world: Any, agent: Any, length: float) -> tuple[float, float]:
    """Return where an agent comes to that goes on: in steps of one, as far as walls let it."""
    angle = math.radians(agent.heading)
    if world.wraps_x and world.wraps_y:
        x = wrapped(agent.x + length * math.sin(angle), world.low_x, world.width)
        return x, wrapped(agent.y + length * math.cos(angle), world.low_y, world.height)
    way = abs(length)
    dx, dy = unrounded(math.sin(angle)), unrounded(math.cos(angle))
    if length < 0:
        dx, dy = -dx, -dy
    if not is_inside(world, agent.x + way * dx, agent.y + way * dy):
        steps = math.floor(way)
        if not world.wraps_x:
            steps = steps_to_wall(agent.x, dx, world.low_x, world.width, steps)
        if not world.wraps_y:
            steps = steps_to_wall(agent.y, dy, world.low_y, world.height, steps)
        way = float(steps)
    x = kept(agent.x + way * dx, world.low_x, world.width, world.wraps_x)
    return x, kept(agent.y + way * dy, world.low_y, world.height, world.wraps_y)


def can_move(world: Any, agent: Any, length: float) -> bool:
    """Say whether the world goes on so far ahead of an agent (NetLogo's `can-move?`)."""
    angle = math.radians(agent.heading)
    dx, dy = unrounded(math.sin(angle)), unrounded(math.cos(angle))
    return is_inside(world, agent.x + length * dx, agent.y + length * dy)


def nearer(world: Any, agent: Any, x: float, y: float, length: float) -> tuple[float, float, float]:
    """Return where an agent comes to that walks to a point, and its heading there."""
    dx = apart(x - agent.x, world.width, world.wraps_x)
    dy = apart(y - agent.y, world.height, world.wraps_y)
    away = math.hypot(dx, dy)
    heading = compass(dx, dy) if away > 0 else float(agent.heading)
    if away == 0 or away < length:
        new_x, new_y = float(x), float(y)
    else:
        new_x = agent.x + length * (dx / away)
        new_y = agent.y + length * (dy / away)
    new_x = kept(new_x, world.low_x, world.width, world.wraps_x)
    return new_x, kept(new_y, world.low_y, world.height, world.wraps_y), heading


def is_on(world: Any, agent: Any, x: float, y: float) -> bool:
    """Say whether an agent stands on the patch of a point (NetLogo's `patch-here = patch x y`)."""
    if 1 < abs(x - agent.x) < world.width - 1 or 1 < abs(y - agent.y) < world.height - 1:
        return False  # the usual case, without rounding
    x = kept(x, world.low_x, world.width, world.wraps_x)
    y = kept(y, world.low_y, world.height, world.wraps_y)
    same_x = math.floor(agent.x + 0.5) == math.floor(x + 0.5)
    return same_x and math.floor(agent.y + 0.5) == math.floor(y + 0.5)


def offset(world: Any, agent: Any, other: Any) -> tuple[float, float]:
    """Return how far another agent or patch lies to the right of an agent, and how far up.

    It is the short way round where the world wraps: within (−width / 2, width / 2).
    """
    dx = between_inside(other.x - agent.x, world.width, world.wraps_x)
    dy = between_inside(other.y - agent.y, world.height, world.wraps_y)
    return dx, dy


def between_inside(difference: float, size: int, wraps: int) -> float:
    """Return `apart` of two coordinates that both lie in the world."""
    if wraps:
        # Choices of numbers, not of ways on, which processors would have to guess.
        half = size / 2
        over = size if difference > half else 0
        under = size if difference < -half else 0
        return difference - over + under
    return difference


# Moving ----------------------------------------------------------------------------------------


def forward(world: Any, agent: Any, length: float) -> None:
    """Move an agent along its heading, in steps of one; it stops before a wall."""
    x, y = ahead(world, agent, length)
    agent.x = x
    agent.y = y


def move_to(world: Any, agent: Any, x: float, y: float) -> None:
    """Put an agent at a point, brought back into the world where that wraps."""
    new_x = kept(x, world.low_x, world.width, world.wraps_x)
    new_y = kept(y, world.low_y, world.height, world.wraps_y)
    agent.x = new_x
    agent.y = new_y


def walk_to(world: Any, agent: Any, x: float, y: float, length: float) -> None:
    """Turn an agent to a point and move it there by a length, or onto it when it is nearer."""
    new_x, new_y, heading = nearer(world, agent, x, y, length)
    agent.heading = heading
    agent.x = new_x
    agent.y = new_y


LOOKING = {
    function.__name__: function
    for function in (distance, offset, towards, face, right, left, is_on, is_inside, can_move)
}
MOVING = {function.__name__: function for function in (forward, move_to, walk_to)}
COMMANDS = LOOKING | MOVING
"""What rules call as methods of `model.world`."""


@register_jitable
def place_on(value: float, low: int, size: int, wraps: int) -> int:
    """Return the column, or row, of a coordinate, counted from 0."""
    if wraps:
        return (math.floor(value + 0.5) - low) % size
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
        across, up = number // rows, number % rows
    elif number < own_x:
        across, up = number, own_y
    elif number < own_x + rows - 1:
        across, up = own_x, number - own_x
        if up >= own_y:
            up += 1
    else:
        across, up = number - rows + 2, own_y
    return (first_x + across) % width * height + (first_y + up) % height


def lattice(size: int | tuple[int, int], n: int) -> list[tuple[int, int]]:
    """Return the patches of n places on a regular lattice over a world.

    Columns × rows = n, as near to a square as n allows; place i stands in column i % columns.

    Args:
        size: the world's size, in patches: along a side, or width and height.
        n: the number of places, 1 or more.

    >>> lattice(33, 1)
    [(0, 0)]
    >>> lattice(33, 3)
    [(-11, 0), (0, 0), (11, 0)]
    >>> lattice((9, 3), 3)
    [(-3, 0), (0, 0), (3, 0)]
    """
    width, height = size if isinstance(size, tuple) else (size, size)
    columns = lattice_columns(n)
    rows = n // columns

    def centre(place: int, places: int, side: int) -> int:
        return math.floor(-(side // 2) - 0.5 + (place + 0.5) * side / places + 0.5)

    return [
        (centre(i % columns, columns, width), centre(i // columns, rows, height)) for i in range(n)
    ]


def lattice_columns(n: int) -> int:
    """Return the columns of the lattice of n places: n's smallest divisor not below its root.

    >>> [lattice_columns(n) for n in (1, 2, 6, 7, 4000)]
    [1, 2, 3, 7, 80]
    """
    columns = math.isqrt(n)
    while columns * columns < n or n % columns:
        columns += 1
    return columns
