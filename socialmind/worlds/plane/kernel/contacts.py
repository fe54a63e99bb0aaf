"""Contacts: bodies that overlap each other, an obstacle or a border are pushed apart.

They are resolved in rounds. In each, bodies that overlap each other are pushed apart, one pair
after the other; then each body is pushed out of the one obstacle or border that it is deepest in.
Rounds end when nothing overlaps, or after `MOST_ROUNDS`, as bodies may be where there is no room
for them; they are inside the borders even then.

Few ticks have contacts. What looks for them is compiled into the caller (`forceinline`); what
resolves them is not, as that would only take longer to compile.
"""

from __future__ import annotations

import math
from typing import Any

from numba import carray, types
from numba.extending import register_jitable

from socialmind.compiling.memory import as_pointer
from socialmind.worlds.plane import layout
from socialmind.worlds.plane.kernel.bodies import alive_of, body_at
from socialmind.worlds.plane.kernel.stones import candidates, stones_of, table_of
from socialmind.worlds.plane.layout import MOST_ROUNDS, SETTLING, TOUCHING

AT_REST, MOVED, HELD = 0.0, 1.0, 2.0
"""What `state` says of a body while contacts are resolved: that it overlaps nothing; that it may;
that it cannot give way, as it was pushed out of an obstacle or a border, or of who was."""


@register_jitable(error_model="numpy")
def _depth_in_stone(stones: Any, first: int, dx: float, dy: float, radius: float) -> Any:
    """Return how deep a circle at (dx, dy) from a stone's centre is in it, and the way out.

    The depth is 0 for a circle outside; the way out is a vector of length 1.
    """
    half_width = stones[first + layout.STONE_HALF_WIDTH]
    if stones[first + layout.STONE_ROUND] != 0.0:
        both = half_width + radius
        distance = math.sqrt(dx * dx + dy * dy)
        if distance >= both:
            return 0.0, 0.0, 0.0
        if distance == 0.0:
            return both, 1.0, 0.0
        return both - distance, dx / distance, dy / distance
    cos, sin = stones[first + layout.STONE_COS], stones[first + layout.STONE_SIN]
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
            first = stone * layout.STONE_COLUMNS
            dx, dy = x - stones[first + layout.STONE_X], y - stones[first + layout.STONE_Y]
            both = stones[first + layout.STONE_RADIUS] + radius
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
def find_contacts(plane: Any, kinds: Any, bodies: int) -> bool:
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
def resolve(plane: Any, kinds: Any, bodies: int) -> None:
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
