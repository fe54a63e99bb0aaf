"""Motion: bodies are pushed, damped and moved, and what then overlaps is pushed apart.

Contacts are resolved in rounds. In each, bodies that overlap each other are pushed apart, one pair
after the other; then each body is pushed out of the one obstacle or border that it is deepest in.
Rounds end when nothing overlaps, or after `MOST_ROUNDS`, as bodies may be where there is no room
for them; they are inside the borders even then.

Few ticks have contacts. What every tick does is compiled into `move` itself (`forceinline`), which
saves a third of its time; what resolves contacts is not, as that would only take longer to compile.
"""

from __future__ import annotations

import math
from typing import Any

from numba import carray, types
from numba.extending import register_jitable

from socialmind.language.memory import as_pointer
from socialmind.worlds.plane.kernel.stones import candidates, plane_at, stones_of, table_of
from socialmind.worlds.plane.layout import (
    BODY,
    FASTEST,
    KIND,
    MOST_ROUNDS,
    SETTLING,
    STONE_COLUMNS,
    STONE_COS,
    STONE_HALF_WIDTH,
    STONE_RADIUS,
    STONE_ROUND,
    STONE_SIN,
    STONE_X,
    STONE_Y,
    TOUCHING,
)

AT_REST, MOVED, HELD = 0.0, 1.0, 2.0
"""What `state` says of a body while contacts are resolved: that it overlaps nothing; that it may;
that it cannot give way, as it was pushed out of an obstacle or a border, or of who was."""

TURN = 2.0 * math.pi
DEGREES = 180.0 / math.pi


@register_jitable(error_model="numpy")
def kinds_of(plane: Any) -> Any:
    """Return the records of the kinds of bodies."""
    return carray(as_pointer(plane.kinds), (plane.kind_count,), KIND)


@register_jitable(error_model="numpy")
def alive_of(kind: Any) -> Any:
    """Return which slots of a kind live."""
    return carray(as_pointer(kind.alive), (kind.capacity,), types.uint8)


@register_jitable(error_model="numpy")
def body_at(kind: Any, slot: int) -> Any:
    """Return a body's record, from its column x on."""
    return carray(as_pointer(kind.rows + slot * kind.stride), (1,), BODY)[0]


@register_jitable(error_model="numpy")
def move(address: int) -> int:
    """Move all bodies by one tick.

    Args:
        address: the plane's record.

    Returns:
        0, or 1 + the number of a body, counted over the slots of all kinds, whose motion is not
        finite: it stands where it stood, at rest.
    """
    plane = plane_at(address)
    kinds = kinds_of(plane)
    fault = 0
    carried = False
    first = 0
    for number in range(plane.kind_count):
        kind = kinds[number]
        alive = alive_of(kind)
        for slot in range(kind.capacity):
            if not alive[slot]:
                continue
            body = body_at(kind, slot)
            body.contact = 0
            if body.carrier_kind >= 0:
                if _has_carrier(plane, kinds, body):
                    carried = True
                    continue
                body.carrier_kind = -1  # whose carrier is gone moves freely
                body.carrier = -1
            if not _advance(body, kind, plane.dt) and fault == 0:
                fault = 1 + first + slot
        first += kind.capacity
    if _find_contacts(plane, kinds, first):
        _resolve(plane, kinds, first)
    if carried:
        _carry(plane, kinds)
    return fault


@register_jitable(error_model="numpy")
def _has_carrier(plane: Any, kinds: Any, body: Any) -> bool:
    """Return whether a body's carrier lives."""
    if body.carrier_kind >= plane.kind_count:
        return False
    kind = kinds[body.carrier_kind]
    if body.carrier < 0 or body.carrier >= kind.capacity:
        return False
    return alive_of(kind)[body.carrier] != 0


@register_jitable(error_model="numpy")
def heading_of(angle: float) -> float:
    """Return an angle, -π to π, as degrees clockwise from north, from 0 to below 360.

    >>> heading_of(0.0)
    90.0
    >>> heading_of(-math.pi)
    270.0
    """
    heading = 90.0 - angle * DEGREES
    if heading < 0.0:
        heading += 360.0
    return heading if heading < 360.0 else 0.0


@register_jitable(error_model="numpy")
def turned(angle: float) -> float:
    """Return an angle in [-π, π).

    >>> turned(math.pi) == -math.pi
    True
    """
    if not -math.pi <= angle < math.pi:
        angle -= TURN * math.floor((angle + math.pi) / TURN)
        if not -math.pi <= angle < math.pi:  # a hair off, by rounding
            angle = -math.pi
    return angle


@register_jitable(error_model="numpy", forceinline=True)
def _advance(body: Any, kind: Any, dt: float) -> bool:
    """Push, damp and move a body; return whether its motion is finite."""
    vx = body.vx + dt * body.push_x / kind.mass
    vy = body.vy + dt * body.push_y / kind.mass
    spin = body.spin + dt * body.torque / kind.moment
    damping = 1.0 + dt * kind.linear_damping
    vx /= damping
    vy /= damping
    spin /= 1.0 + dt * kind.angular_damping
    if not vx * vx + vy * vy <= FASTEST * FASTEST:
        excess = FASTEST / math.hypot(vx, vy)
        vx *= excess
        vy *= excess
    x, y, angle = body.x + dt * vx, body.y + dt * vy, body.angle + dt * spin
    # One sum for all three: what is not finite in one of them is not in the sum.
    if not abs(x) + abs(y) + abs(angle) < math.inf:
        body.vx = 0.0
        body.vy = 0.0
        body.spin = 0.0
        return False
    angle = turned(angle)
    body.x = x
    body.y = y
    body.vx = vx
    body.vy = vy
    body.spin = spin
    body.angle = angle
    body.heading = heading_of(angle)
    return True


@register_jitable(error_model="numpy")
def _depth_in_stone(stones: Any, first: int, dx: float, dy: float, radius: float) -> Any:
    """Return how deep a circle at (dx, dy) from a stone's centre is in it, and the way out.

    The depth is 0 for a circle outside; the way out is a vector of length 1.
    """
    half_width = stones[first + STONE_HALF_WIDTH]
    if stones[first + STONE_ROUND] != 0.0:
        both = half_width + radius
        distance = math.sqrt(dx * dx + dy * dy)
        if distance >= both:
            return 0.0, 0.0, 0.0
        if distance == 0.0:
            return both, 1.0, 0.0
        return both - distance, dx / distance, dy / distance
    cos, sin = stones[first + STONE_COS], stones[first + STONE_SIN]
    ahead, left = cos * dx + sin * dy, cos * dy - sin * dx
    out_ahead, out_left = abs(ahead) - half_width, abs(left) - half_width
    if out_ahead <= 0.0 and out_left <= 0.0:  # the centre is inside: out by the nearest side
        if out_ahead >= out_left:
            depth, normal_ahead, normal_left = radius - out_ahead, 1.0, 0.0
        else:
            depth, normal_ahead, normal_left = radius - out_left, 0.0, 1.0
    else:
        out_ahead, out_left = max(out_ahead, 0.0), max(out_left, 0.0)
        span = out_ahead * out_ahead + out_left * out_left
        if span >= radius * radius:
            return 0.0, 0.0, 0.0
        distance = math.sqrt(span)
        if distance == 0.0:  # so near the side that the square is nothing
            return radius, cos * math.copysign(1.0, dx), sin * math.copysign(1.0, dx)
        depth, normal_ahead, normal_left = (
            radius - distance,
            out_ahead / distance,
            out_left / distance,
        )
    normal_ahead = math.copysign(normal_ahead, ahead)
    normal_left = math.copysign(normal_left, left)
    return (
        depth,
        cos * normal_ahead - sin * normal_left,
        sin * normal_ahead + cos * normal_left,
    )


@register_jitable(error_model="numpy")
def _deepest(plane: Any, stones: Any, begin: Any, entries: Any, body: Any, radius: float) -> Any:
    """Return how deep a body is in the obstacle or border that it is deepest in, and the normal.

    The depth is 0 when it is nowhere in deeper than `TOUCHING`.
    """
    x, y = body.x, body.y
    deepest, normal_x, normal_y = TOUCHING, 0.0, 0.0
    if plane.stone_count > 0:
        place, end = candidates(plane, begin, x, y)
        while place < end:
            stone = entries[place] if plane.cell > 0.0 else place
            place += 1
            first = stone * STONE_COLUMNS
            dx, dy = x - stones[first + STONE_X], y - stones[first + STONE_Y]
            both = stones[first + STONE_RADIUS] + radius
            if dx * dx + dy * dy >= both * both:
                continue
            depth, nx, ny = _depth_in_stone(stones, first, dx, dy, radius)
            if depth > deepest:
                deepest, normal_x, normal_y = depth, nx, ny
    if plane.half_width > 0.0:
        room = max(plane.half_width - radius, 0.0)
        depth = abs(x) - room
        if depth > deepest:
            deepest, normal_x, normal_y = depth, -math.copysign(1.0, x), 0.0
        depth = abs(y) - room
        if depth > deepest:
            deepest, normal_x, normal_y = depth, 0.0, -math.copysign(1.0, y)
    return (deepest if deepest > TOUCHING else 0.0), normal_x, normal_y


@register_jitable(error_model="numpy", forceinline=True)
def _find_contacts(plane: Any, kinds: Any, bodies: int) -> bool:
    """Mark who overlaps what; return whether anyone does. Nothing moves."""
    state = carray(as_pointer(plane.state), (bodies,), types.float64)
    stones = stones_of(plane)
    begin, entries = table_of(plane)
    found = False
    first = 0
    for number in range(plane.kind_count):
        kind = kinds[number]
        alive = alive_of(kind)
        for slot in range(kind.capacity):
            state[first + slot] = AT_REST
            if not alive[slot]:
                continue
            body = body_at(kind, slot)
            if body.carrier_kind >= 0:
                continue
            depth, _, _ = _deepest(plane, stones, begin, entries, body, kind.radius)
            if depth > 0.0:
                state[first + slot] = MOVED
                body.contact = 1
                found = True
        first += kind.capacity
    return _touch_pairs(plane, kinds, state) or found


@register_jitable(error_model="numpy", forceinline=True)
def _overlap(one: Any, two: Any, both: float) -> Any:
    """Return how deep circles are in each other, and the normal from the first to the second."""
    dx, dy = two.x - one.x, two.y - one.y
    span = dx * dx + dy * dy
    if span >= both * both:
        return 0.0, 0.0, 0.0
    distance = math.sqrt(span)
    if both - distance <= TOUCHING:
        return 0.0, 0.0, 0.0
    if distance == 0.0:
        return both, 1.0, 0.0
    return both - distance, dx / distance, dy / distance


@register_jitable(error_model="numpy", forceinline=True)
def _touch_pairs(plane: Any, kinds: Any, state: Any) -> bool:
    """Mark the bodies that overlap each other; return whether any do."""
    found = False
    first = 0
    for number in range(plane.kind_count):
        kind = kinds[number]
        second = first
        for other_number in range(number, plane.kind_count):
            other = kinds[other_number]
            if (kind.meets >> other_number) & 1:
                for slot in range(kind.capacity):
                    found |= _touch_others(
                        kind, slot, other, slot + 1 if number == other_number else 0,
                        state, first, second,
                    )  # fmt: skip
            second += other.capacity
        first += kind.capacity
    return found


@register_jitable(error_model="numpy", forceinline=True)
def _touch_others(
    kind: Any, slot: int, other: Any, begin: int, state: Any, first: int, second: int
) -> bool:
    """Mark a body and those of a kind, from slot `begin` on, that it overlaps."""
    body = body_at(kind, slot)
    if not alive_of(kind)[slot] or body.carrier_kind >= 0:
        return False
    alive = alive_of(other)
    found = False
    both = kind.radius + other.radius
    for place in range(begin, other.capacity):
        if not alive[place]:
            continue
        met = body_at(other, place)
        if met.carrier_kind >= 0:
            continue
        depth, _, _ = _overlap(body, met, both)
        if depth > 0.0:
            _touch(body)
            _touch(met)
            state[first + slot] = MOVED
            state[second + place] = MOVED
            found = True
    return found


@register_jitable(error_model="numpy")
def _touch(body: Any) -> None:
    """Note that a body touches another one, unless it touches what never moves."""
    if body.contact == 0:
        body.contact = 2


@register_jitable(error_model="numpy")
def _resolve(plane: Any, kinds: Any, bodies: int) -> None:
    """Push apart what overlaps, round by round."""
    state = carray(as_pointer(plane.state), (bodies,), types.float64)
    for turn in range(MOST_ROUNDS):
        pairs = _part_pairs(plane, kinds, state, turn == 0)
        if not _push_out(plane, kinds, state) and not pairs:
            break
    _keep_inside(plane, kinds)


@register_jitable(error_model="numpy")
def _push_out(plane: Any, kinds: Any, state: Any) -> bool:
    """Push each body out of the obstacle or border that it is deepest in."""
    stones = stones_of(plane)
    begin, entries = table_of(plane)
    found = False
    first = 0
    for number in range(plane.kind_count):
        kind = kinds[number]
        alive = alive_of(kind)
        bounce = min(kind.restitution, 1.0)
        for slot in range(kind.capacity):
            if state[first + slot] == AT_REST or not alive[slot]:
                continue
            body = body_at(kind, slot)
            if body.carrier_kind >= 0:
                continue
            depth, nx, ny = _deepest(plane, stones, begin, entries, body, kind.radius)
            if depth <= 0.0:
                continue
            found = True
            state[first + slot] = HELD
            body.x += depth * nx
            body.y += depth * ny
            speed = body.vx * nx + body.vy * ny
            if speed < 0.0:
                change = -speed * (1.0 + (bounce if -speed > SETTLING else 0.0))
                body.vx += change * nx
                body.vy += change * ny
        first += kind.capacity
    return found


@register_jitable(error_model="numpy")
def _keep_inside(plane: Any, kinds: Any) -> None:
    """Put bodies inside the borders that found no room."""
    if plane.half_width <= 0.0:
        return
    for number in range(plane.kind_count):
        kind = kinds[number]
        alive = alive_of(kind)
        room = max(plane.half_width - kind.radius, 0.0)
        for slot in range(kind.capacity):
            if not alive[slot]:
                continue
            body = body_at(kind, slot)
            if body.carrier_kind < 0:
                body.x = min(max(body.x, -room), room)
                body.y = min(max(body.y, -room), room)


@register_jitable(error_model="numpy")
def _part_pairs(plane: Any, kinds: Any, state: Any, bouncing: bool) -> bool:
    """Push apart the bodies that overlap each other; return whether any did."""
    found = False
    first = 0
    for number in range(plane.kind_count):
        kind = kinds[number]
        second = first
        for other_number in range(number, plane.kind_count):
            other = kinds[other_number]
            if (kind.meets >> other_number) & 1:
                for slot in range(kind.capacity):
                    found |= _part_others(
                        kind, slot, other, slot + 1 if number == other_number else 0,
                        state, first, second, bouncing,
                    )  # fmt: skip
            second += other.capacity
        first += kind.capacity
    return found


@register_jitable(error_model="numpy")
def _part_others(
    kind: Any, slot: int, other: Any, begin: int,
    state: Any, first: int, second: int, bouncing: bool,
) -> bool:  # fmt: skip
    """Push apart a body and those of a kind, from slot `begin` on, that it overlaps."""
    body = body_at(kind, slot)
    if not alive_of(kind)[slot] or body.carrier_kind >= 0:
        return False
    alive = alive_of(other)
    found = False
    both = kind.radius + other.radius
    restitution = max(kind.restitution, other.restitution) if bouncing else 0.0
    for place in range(begin, other.capacity):
        if not alive[place]:
            continue
        own, others = state[first + slot], state[second + place]
        if own == AT_REST and others == AT_REST:
            continue
        met = body_at(other, place)
        if met.carrier_kind >= 0:
            continue
        depth, nx, ny = _overlap(body, met, both)
        if depth <= 0.0:
            continue
        found = True
        _part(body, kind, met, other, depth, nx, ny, own, others, restitution)
        # Who is pushed by somebody that cannot give way cannot either.
        marked = HELD if own == HELD or others == HELD else MOVED
        state[first + slot] = marked
        state[second + place] = marked
    return found


@register_jitable(error_model="numpy")
def _part(
    body: Any, kind: Any, met: Any, other: Any, depth: float, nx: float, ny: float,
    own: float, others: float, restitution: float,
) -> None:  # fmt: skip
    """Push two bodies apart by their masses, and exchange the impulse of their impact."""
    whole = kind.mass + other.mass
    share = other.mass / whole  # of the way, for the first
    if own == HELD and others != HELD:
        share = 0.0
    elif others == HELD and own != HELD:
        share = 1.0
    body.x -= depth * share * nx
    body.y -= depth * share * ny
    met.x += depth * (1.0 - share) * nx
    met.y += depth * (1.0 - share) * ny
    speed = (met.vx - body.vx) * nx + (met.vy - body.vy) * ny
    if speed < 0.0:
        bounce = restitution if -speed > SETTLING else 0.0
        impulse = -speed * (1.0 + bounce) * kind.mass * (other.mass / whole)
        body.vx -= impulse / kind.mass * nx
        body.vy -= impulse / kind.mass * ny
        met.vx += impulse / other.mass * nx
        met.vy += impulse / other.mass * ny


@register_jitable(error_model="numpy")
def _carry(plane: Any, kinds: Any) -> None:
    """Put carried bodies ahead of their carriers."""
    for number in range(plane.kind_count):
        kind = kinds[number]
        alive = alive_of(kind)
        for slot in range(kind.capacity):
            if not alive[slot]:
                continue
            body = body_at(kind, slot)
            if body.carrier_kind < 0:
                continue
            carrier = kinds[body.carrier_kind]
            holder = body_at(carrier, body.carrier)
            ahead = carrier.radius + kind.radius
            body.x = holder.x + ahead * math.cos(holder.angle)
            body.y = holder.y + ahead * math.sin(holder.angle)
            body.vx = holder.vx
            body.vy = holder.vy
            body.spin = 0.0
            body.angle = holder.angle
            body.heading = holder.heading
