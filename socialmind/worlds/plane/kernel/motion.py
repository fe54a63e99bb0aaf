"""Motion: bodies are pushed, damped and moved, carried ones along with their carriers.

What every tick does is compiled into `move` itself (`forceinline`), which saves a third of its
time.
"""

from __future__ import annotations

import math
from typing import Any

from numba.extending import register_jitable

from socialmind.worlds.plane.kernel.bodies import alive_of, body_at, kinds_of
from socialmind.worlds.plane.kernel.contacts import find_contacts, resolve
from socialmind.worlds.plane.kernel.stones import plane_at
from socialmind.worlds.plane.layout import FARTHEST, FASTEST

TURN = 2.0 * math.pi
DEGREES = 180.0 / math.pi


@register_jitable(error_model="numpy")
def move(address: int) -> int:
    """Move all bodies by one tick.

    Args:
        address: the plane's record.

    Returns:
        0, or 1 + the number of a body, counted over the slots of all kinds, whose motion is not
        finite, or who is farther away than `FARTHEST`: it stands where it stood, at rest.
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
    if find_contacts(plane, kinds, first):
        resolve(plane, kinds, first)
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
    if not abs(x) + abs(y) + abs(angle) < FARTHEST:
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
