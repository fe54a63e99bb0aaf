"""The reference engine of a plane: one world whose bodies are moved and kept apart by pymunk.

Pymunk's own step moves with the velocities of the step before, damps a whole space, multiplies
elasticities and pushes overlapping bodies apart over several steps. A plane wants none of it, so
pymunk does here what it is best at, finding contacts and solving all of them together, and the
rest is done around its step:

- velocities are worked out from forces and damping before the step, and pymunk moves with them;
- each contact is given its restitution as it is found;
- overlaps are taken out at once, by the corrections that pymunk would have spread over steps.

The rows are all that a world remembers. Every step writes them into pymunk and puts all moving
shapes in anew, in order, which empties pymunk's cache of contacts and gives its tree of shapes the
same form again: what a step does follows from the rows alone, so that a world that was restored
goes on exactly as if it had never stopped.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Protocol

import numpy as np
import pymunk
from numpy.typing import NDArray
from pymunk.contact_point_set import ContactPoint, ContactPointSet

from socialmind.errors import ModelError
from socialmind.worlds.plane.bodies import Disc
from socialmind.worlds.plane.kernel.arrays import STANDING, meetings
from socialmind.worlds.plane.kernel.motion import heading_of, turned
from socialmind.worlds.plane.layout import FARTHEST, FASTEST, SETTLING, TOUCHING

if TYPE_CHECKING:
    from socialmind.worlds.plane.arena import Arena

MOST_KINDS = 31
"""Kinds of bodies in a world: pymunk tells 32 categories apart, and one is what never moves."""
ITERATIONS = 20
"""How often pymunk goes over all contacts of a step."""

_STILL = 1 << MOST_KINDS


class Slots(Protocol):
    """Records and which of them live, such as the table of a population of a running model.

    Attributes:
        rows: (slots,) records with the columns of `Body` or `Obstacle`, found by their names.
        alive: (slots,) truth values.
    """

    rows: NDArray[Any]
    alive: NDArray[np.bool_]


@dataclass(frozen=True, eq=False)
class Kind:
    """A population of bodies.

    Attributes:
        name: what the `meets` of other kinds call it.
        disc: what its bodies are made of. Two kinds collide if either meets the other.
        table: its bodies. Each tick looks up its arrays anew: they may have been replaced.
    """

    name: str
    disc: Disc
    table: Slots


Placed = tuple[pymunk.Body, pymunk.Shape]
"""A body of a plane in pymunk."""


class PymunkMotion:
    """Moves the bodies of one world by pymunk.

    Args:
        half_width: of the arena with borders at ±half_width, 0 for one without borders.
        dt: seconds a tick. Up to 0.1 what a step does follows from the rows alone; with longer
            ones the order in which pymunk finds contacts does not.
        kinds: the populations of bodies; a body's `carrier_kind` is a place in this sequence.
        obstacles: what never moves, or None.

    Call `build` once the world is set up, and again after obstacles changed. Anything else may be
    written into the rows between ticks; bodies that are born, die, are picked up or put down are
    followed.

    Raises:
        ModelError: more than `MOST_KINDS` kinds, or a body that meets a kind that is not there.

    >>> from types import SimpleNamespace
    >>> from socialmind.worlds.plane.layout import BODY
    >>> rows = np.zeros(1, BODY)
    >>> rows["x"], rows["carrier_kind"], rows["push_x"] = 8.0, -1, 160.0
    >>> table = SimpleNamespace(rows=rows, alive=np.ones(1, bool))
    >>> motion = PymunkMotion(10.0, 1 / 30, [Kind("robots", Disc(), table)])
    >>> motion.build()
    >>> for _ in range(30):
    ...     motion.move()
    >>> rows["x"].round(6).item(), rows["contact"].item()
    (9.0, 1)
    """

    def __init__(
        self,
        half_width: float,
        dt: float,
        kinds: Sequence[Kind],
        obstacles: Slots | None = None,
    ) -> None:
        self.half_width = half_width
        self.dt = dt
        self.kinds = list(kinds)
        self.obstacles = obstacles
        self._filters = _filters(self.kinds)
        self._space = pymunk.Space()
        self._placed: list[dict[int, Placed]] = []
        self._owner: dict[pymunk.Shape, tuple[pymunk.Body, float, tuple[int, int]]] = {}
        self._squares: dict[pymunk.Shape, tuple[float, float, float, float, float]] = {}
        self._touching: dict[pymunk.Shape, int] = {}

    def build(self) -> None:
        """Make the space anew from the rows of obstacles and bodies.

        Raises:
            ModelError: an obstacle's place, angle or half-width is not finite.
        """
        space = self._space = pymunk.Space()
        space.iterations = ITERATIONS
        space.collision_slop = 0.0
        space.collision_bias = 0.0  # the whole of an overlap is taken out in its step
        space.on_collision(pre_solve=self._meet)
        self._placed = [{} for _ in self.kinds]
        self._owner = {}
        self._squares = {}
        for shape in self._borders() + self._stones():
            shape.filter = pymunk.ShapeFilter(categories=_STILL)
            space.add(shape)

    def move(self) -> None:
        """Move all bodies by one tick: their x, y, heading, angle, vx, vy, spin and contact.

        A body whose carrier is dead is put down (`carrier_kind` and `carrier` are -1).

        Raises:
            ModelError: a body's place or motion is not finite.
        """
        moving = self._moving()
        space, shapes = self._space, [shape for _, _, _, shape in moving]
        space.add(*shapes)
        self._touching.clear()
        space.step(self.dt)
        for kind, slot, body, shape in moving:
            rows = kind.table.rows
            if touched := self._touching.get(shape, 0):
                vx, vy = body.velocity
                rows["vx"][slot], rows["vy"][slot] = vx, vy
                # What is left of the motion in pymunk is the correction of overlaps alone.
                body.velocity = (0.0, 0.0)
                pymunk.Body.update_position(body, self.dt)
            x, y = body.position
            if touched and self.half_width > 0:
                # Where a crowd finds no room, pymunk leaves overlaps: not at borders.
                room = max(self.half_width - kind.disc.radius, 0.0)
                x, y = min(max(x, -room), room), min(max(y, -room), room)
            rows["x"][slot], rows["y"][slot] = x, y
            rows["contact"][slot] = touched
        space.remove(*shapes)
        self._carry()

    def _moving(self) -> list[tuple[Kind, int, pymunk.Body, pymunk.Shape]]:
        """The living bodies that nobody carries, with their velocities of this tick."""
        moving = []
        for number, kind in enumerate(self.kinds):
            rows, placed = kind.table.rows, self._placed[number]
            for slot in np.flatnonzero(kind.table.alive).tolist():
                if rows["carrier_kind"].item(slot) >= 0:
                    if self._has_carrier(rows, slot):
                        continue
                    rows["carrier_kind"][slot] = rows["carrier"][slot] = -1
                if slot not in placed:
                    placed[slot] = self._place(number, slot)
                body, shape = placed[slot]
                x, y, vx, vy = _accelerate(kind, slot, self.dt)
                if self.half_width > 0:
                    # The walls are not endless: what is far outside is brought to them.
                    far = self.half_width + FASTEST
                    x, y = min(max(x, -far), far), min(max(y, -far), far)
                body.position = (x, y)
                body.velocity = (vx, vy)
                moving.append((kind, slot, body, shape))
        return moving

    def _has_carrier(self, rows: NDArray[Any], slot: int) -> bool:
        """Whether the one that carries a body lives."""
        number, carrier = rows["carrier_kind"].item(slot), rows["carrier"].item(slot)
        if number >= len(self.kinds):
            return False
        alive = self.kinds[number].table.alive
        return 0 <= carrier < len(alive) and bool(alive[carrier])

    def _place(self, number: int, slot: int) -> Placed:
        """A body of a kind in pymunk. It does not turn there: without friction nothing turns it."""
        disc = self.kinds[number].disc
        body = pymunk.Body(disc.mass, math.inf)
        shape = pymunk.Circle(body, disc.radius)
        shape.filter = self._filters[number]
        self._space.add(body)
        self._owner[shape] = body, disc.restitution, (number, slot)
        return body, shape

    def _meet(self, arbiter: pymunk.Arbiter, space: pymunk.Space, data: object) -> None:
        """Note who touches, and say how much of this impact bounces."""
        self._settle_tie(arbiter)
        if arbiter.contact_point_set.points[0].distance > -TOUCHING:
            arbiter.process_collision = False
            return
        normal, approach, share, most = arbiter.normal, 0.0, 0.0, math.inf
        contact = 2 if all(shape in self._owner for shape in arbiter.shapes) else 1
        for shape, toward in zip(arbiter.shapes, (1.0, -1.0), strict=True):
            if shape in self._owner:
                body, restitution, _ = self._owner[shape]
                self._touching[shape] = min(contact, self._touching.get(shape, contact))
                approach += toward * normal.dot(body.velocity)
                share = max(share, restitution)
            else:
                most = 1.0
        arbiter.restitution = min(share, most) if approach > SETTLING else 0.0

    def _settle_tie(self, arbiter: pymunk.Arbiter) -> None:
        """Say which way is out where pymunk knows none, or two: the one that the kernel takes.

        So it is in the middle of a square, on its diagonals, and where two bodies stand at one
        place.
        """
        one: Any
        other: Any
        one, other = arbiter.shapes
        moves = one in self._owner
        if moves and other in self._owner:
            away = other.body.position - one.body.position
            if away.dot(away) > 0.0:
                return
            # Who comes first is pushed to the left.
            normal = pymunk.Vec2d(1.0 if self._owner[one][2] < self._owner[other][2] else -1.0, 0.0)
            depth = one.radius + other.radius
        else:
            circle, stone = (one, other) if moves else (other, one)
            square = self._squares.get(stone)
            out = None if square is None else _tied(square, *circle.body.position)
            if out is None:
                return
            normal = pymunk.Vec2d(*out[1:]) * (-1.0 if moves else 1.0)
            depth = circle.radius - out[0]
        # Where the first one's rim is, and that of the other.
        rim = one.radius if moves else depth - other.radius
        begin = (one if moves else other).body.position + normal * rim
        point = ContactPoint(begin, begin - normal * depth, -depth)
        arbiter.contact_point_set = ContactPointSet(normal, (point,))

    def _borders(self) -> list[pymunk.Shape]:
        """Thick walls around the arena, so that what ran far into one is pushed back inside."""
        half = self.half_width
        if half <= 0:
            return []
        thick = 4.0 * half + FASTEST
        line, end = half + thick, half + 2.0 * thick
        ends = [
            ((line, -end), (line, end)),
            ((-line, -end), (-line, end)),
            ((-end, line), (end, line)),
            ((-end, -line), (end, -line)),
        ]
        ground = self._space.static_body
        return [pymunk.Segment(ground, start, stop, thick) for start, stop in ends]

    def _stones(self) -> list[pymunk.Shape]:
        """The living obstacles."""
        if self.obstacles is None:
            return []
        rows = self.obstacles.rows
        ground = self._space.static_body
        stones: list[pymunk.Shape] = []
        for slot in np.flatnonzero(self.obstacles.alive).tolist():
            row = rows[slot]
            x, y, angle, half = (float(row[name]) for name in ("x", "y", "angle", "half_width"))
            if not (abs(x) + abs(y) + abs(angle) + half < FARTHEST and half >= 0.0):
                raise ModelError(
                    f"obstacle {slot} at ({x:g}, {y:g}), angle {angle:g}, half-width {half:g}",
                    STANDING,
                )
            if half == 0.0:
                continue  # there is nothing
            if row["round"]:
                stones.append(pymunk.Circle(ground, half, (x, y)))
                continue
            a, b = half * math.cos(angle), half * math.sin(angle)
            corners = [(a - b, b + a), (-a - b, -b + a), (-a + b, -b - a), (a + b, b - a)]
            stones.append(pymunk.Poly(ground, [(x + dx, y + dy) for dx, dy in corners]))
            self._squares[stones[-1]] = x, y, math.cos(angle), math.sin(angle), half
        return stones

    def _carry(self) -> None:
        """Put what is carried ahead of its carrier."""
        for kind in self.kinds:
            rows = kind.table.rows
            held = kind.table.alive & (rows["carrier_kind"] >= 0)
            for slot in np.flatnonzero(held).tolist():
                carrier_kind = self.kinds[rows["carrier_kind"][slot]]
                carrier = carrier_kind.table.rows[rows["carrier"][slot]]
                ahead = carrier_kind.disc.radius + kind.disc.radius
                rows["x"][slot] = carrier["x"] + ahead * math.cos(carrier["angle"])
                rows["y"][slot] = carrier["y"] + ahead * math.sin(carrier["angle"])
                for name in ("heading", "angle", "vx", "vy"):
                    rows[name][slot] = carrier[name]
                rows["spin"][slot] = 0.0
                rows["contact"][slot] = 0


def motion_of(arena: Arena) -> PymunkMotion:
    """Return what moves the bodies of a plane, to be built once it is set up."""
    shape, tables = arena.shape, arena.society.tables
    kinds = [Kind(name, disc, tables[name]) for name, disc in shape.bodies.items()]
    obstacles = None if shape.obstacles is None else tables[shape.obstacles]
    return PymunkMotion(arena.half_width, shape.dt, kinds, obstacles)


def _filters(kinds: Sequence[Kind]) -> list[pymunk.ShapeFilter]:
    """Whom the bodies of each kind collide with."""
    if len(kinds) > MOST_KINDS:
        raise ModelError(f"{len(kinds)} populations of bodies", f"up to {MOST_KINDS} with pymunk")
    return [
        pymunk.ShapeFilter(categories=1 << number, mask=mask | _STILL)
        for number, mask in enumerate(meetings(kinds))
    ]


def _tied(
    square: tuple[float, float, float, float, float], x: float, y: float
) -> tuple[float, float, float] | None:
    """Return the way out of a square from where pymunk may take another; None from elsewhere.

    So it is inside, where two sides are equally near, and outside on the line of a side.

    Returns:
        How far it is to the square, negative inside, and the direction.
    """
    at_x, at_y, cos, sin, half = square
    dx, dy = x - at_x, y - at_y
    ahead, left = cos * dx + sin * dy, cos * dy - sin * dx
    out_ahead, out_left = abs(ahead) - half, abs(left) - half
    if max(out_ahead, out_left) > 0.0:
        if abs(min(out_ahead, out_left)) > TOUCHING:
            return None
        over_ahead, over_left = max(out_ahead, 0.0), max(out_left, 0.0)
        far = math.hypot(over_ahead, over_left)
        to_ahead, to_left = (
            math.copysign(over_ahead, ahead) / far,
            math.copysign(over_left, left) / far,
        )
        return far, to_ahead * cos - to_left * sin, to_ahead * sin + to_left * cos
    if abs(out_ahead - out_left) > TOUCHING:
        return None
    if out_ahead >= out_left:
        way = math.copysign(1.0, ahead)
        return out_ahead, way * cos, way * sin
    way = math.copysign(1.0, left)
    return out_left, -way * sin, way * cos


def _accelerate(kind: Kind, slot: int, dt: float) -> tuple[float, float, float, float]:
    """Turn a body, and work out the velocity with which it moves.

    Returns:
        x, y, vx, vy.
    """
    rows, disc = kind.table.rows, kind.disc
    x, y, angle = rows["x"].item(slot), rows["y"].item(slot), rows["angle"].item(slot)
    vx, vy, spin = rows["vx"].item(slot), rows["vy"].item(slot), rows["spin"].item(slot)
    slowing = 1.0 + dt * disc.linear_damping
    vx = (vx + dt * rows["push_x"].item(slot) / disc.mass) / slowing
    vy = (vy + dt * rows["push_y"].item(slot) / disc.mass) / slowing
    spin += dt * rows["torque"].item(slot) / disc.moment
    spin /= 1.0 + dt * disc.angular_damping
    if (speed := math.sqrt(vx * vx + vy * vy)) > FASTEST:
        if speed == math.inf:  # a square is beyond all numbers before its root is
            vx, vy = vx * 1e-160, vy * 1e-160
            speed = math.hypot(vx, vy)
        vx, vy = vx * FASTEST / speed, vy * FASTEST / speed
    angle += dt * spin
    if not abs(x + dt * vx) + abs(y + dt * vy) + abs(angle) < FARTHEST:
        # Pymunk ends the whole process at a number that is none.
        who = rows["_id"].item(slot) if "_id" in (rows.dtype.names or ()) else slot
        raise ModelError(
            f"agent {who} of {kind.name!r}, whose motion is not finite: x={x}, y={y}, "
            f"angle={angle}, vx={vx}, vy={vy}",
            "numbers up to a thousand million",
        )
    angle = turned(angle)
    rows["vx"][slot], rows["vy"][slot], rows["spin"][slot] = vx, vy, spin
    rows["angle"][slot] = angle
    rows["heading"][slot] = heading_of(angle)
    return x, y, vx, vy
