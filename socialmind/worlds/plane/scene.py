"""What stands where on a plane at one moment, and what robots perceive: plain data for pictures."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from socialmind.errors import SocialmindError
from socialmind.worlds.plane.arena import Arena
from socialmind.worlds.plane.bodies import Body, Obstacle, Robot, Zone
from socialmind.worlds.plane.devices.actuators import emit
from socialmind.worlds.plane.devices.device import Act, Sense
from socialmind.worlds.plane.devices.sensors import RangeFinder

if TYPE_CHECKING:
    from socialmind.agents.running import Running

Floats = NDArray[np.float64]
Point = tuple[float, float]

_NO_SEGMENTS = np.zeros((0, 2, 2))


@dataclass(frozen=True)
class RobotSeen:
    """A robot at one moment.

    Attributes:
        team: the name of its population.
        identity: which of them.
        x, y: its centre.
        angle: radians, counterclockwise from the x axis.
        radius: of its body.
        rays: (range finders, 2, 2); from each the segment to what it detects, or to its reach.
        lines: (targets, 2, 2); the segments to what its orientation sensors point at.
        emits: whether it emits a signal, on any channel.
    """

    team: str
    identity: int
    x: float
    y: float
    angle: float
    radius: float
    rays: Floats = field(default_factory=_NO_SEGMENTS.copy)
    lines: Floats = field(default_factory=_NO_SEGMENTS.copy)
    emits: bool = False


@dataclass(frozen=True)
class Scene:
    """A plane at one moment.

    Attributes:
        tick: how many ticks have run.
        half_width: of the arena; 0 for a plane without borders.
        robots: in the order of their populations and births.
        objects: by population, (objects, 3): x, y and radius.
        zones: by population, (zones, 4): x, y, angle and half-width of squares.
        obstacles: (obstacles, 5): x, y, angle, half-width, and 1 for round ones.
        over: the name of the interruption that has ended the episode, or None.
    """

    tick: int
    half_width: float
    robots: Sequence[RobotSeen] = ()
    objects: Mapping[str, Floats] = field(default_factory=dict)
    zones: Mapping[str, Floats] = field(default_factory=dict)
    obstacles: Floats = field(default_factory=lambda: np.zeros((0, 5)))
    over: str | None = None

    def robot(self, identity: int | None = None, team: str | None = None) -> RobotSeen | None:
        """Return a robot, the first that fits; None where there is none.

        Args:
            identity: which of its population; any unless given.
            team: the name of its population; any unless given.
        """
        for one in self.robots:
            if identity in (None, one.identity) and team in (None, one.team):
                return one
        return None


def scene_of(model: Running) -> Scene:
    """Return what stands where in a model at this moment.

    Args:
        model: one whose world is a plane.

    Raises:
        SocialmindError: its world is none.
    """
    arena = model.ground
    if not isinstance(arena, Arena):
        raise SocialmindError(
            f"the model {model.name} has no plane to draw; expected one that declares "
            "world = Plane(…)"
        )
    robots: list[RobotSeen] = []
    objects, zones = {}, {}
    obstacles = [np.zeros((0, 5))]
    for name, population in model.populations.items():
        table, agent = model.tables[name], population.agent
        if issubclass(agent, Robot):
            robots += _robots(model, arena, name)
        elif issubclass(agent, Body):
            x, y = _columns(table, "x", "y")
            radius = arena.shape.bodies[name].radius
            objects[name] = np.stack([x, y, np.full(len(x), radius)], axis=1)
        elif issubclass(agent, Zone):
            zones[name] = np.stack(_columns(table, "x", "y", "angle", "half_width"), axis=1)
        elif issubclass(agent, Obstacle):
            names = ("x", "y", "angle", "half_width", "round")
            obstacles.append(np.stack(_columns(table, *names), axis=1))
    return Scene(
        tick=model.tick,
        half_width=arena.half_width,
        robots=tuple(robots),
        objects=objects,
        zones=zones,
        obstacles=np.concatenate(obstacles),
        over=model.over,
    )


def _columns(table: Any, *names: str) -> list[Floats]:
    slots = table.slots
    return [table.columns[name][slots].astype(np.float64) for name in names]


def _robots(model: Running, arena: Arena, name: str) -> Iterator[RobotSeen]:
    table, radius = model.tables[name], arena.shape.bodies[name].radius
    for slot in table.slots.tolist():
        x, y, angle = (table.columns[column].item(slot) for column in ("x", "y", "angle"))
        yield RobotSeen(
            team=name,
            identity=table.columns["_id"].item(slot),
            x=x,
            y=y,
            angle=angle,
            radius=radius,
            # Nothing is read before the first tick.
            rays=_rays(arena, table, slot) if model.tick else _NO_SEGMENTS,
            lines=_lines(model, arena, table, slot),
            emits=any(
                isinstance(one, Act)
                and one.function is emit
                and table.columns["signal"][slot][int(one.settings["channel"])] > 0.5
                for one in arena.shape.robots[name].actuators.values()
            ),
        )


def _rays(arena: Arena, table: Any, slot: int) -> Floats:
    """Return the segments of a robot's range finders, each along its middle."""
    name = table.shape.name
    readings, direction = table.columns["readings"][slot], table.columns["angle"].item(slot)
    segments = []
    for reading, sensor in zip(readings, arena.shape.robots[name].sensors.values(), strict=False):
        if isinstance(sensor, RangeFinder):
            begin = _outside(table, slot, sensor.place(arena.shape.bodies[name].radius))
            length, along = float(reading) * sensor.reach, direction + sensor.angle
            segments.append(
                (begin, (begin[0] + length * math.cos(along), begin[1] + length * math.sin(along)))
            )
    return np.array(segments) if segments else _NO_SEGMENTS


def _lines(model: Running, arena: Arena, table: Any, slot: int) -> Floats:
    """Return the segments from a robot to the targets that its sensors tell the bearing of."""
    segments: dict[tuple[Point, Point], None] = {}
    for sensor in arena.shape.robots[table.shape.name].sensors.values():
        if isinstance(sensor, Sense) and "bearing" in sensor.takes:
            begin = _outside(table, slot, sensor.at)
            end = _target(model, arena, table, slot, sensor, begin)
            if end is not None:
                segments[begin, end] = None
    return np.array(list(segments)) if segments else _NO_SEGMENTS


def _outside(table: Any, slot: int, at: Point) -> Point:
    """Return where a place in a body's frame (ahead, left) is on the plane."""
    x, y, angle = (table.columns[name].item(slot) for name in ("x", "y", "angle"))
    cos, sin = math.cos(angle), math.sin(angle)
    return x + at[0] * cos - at[1] * sin, y + at[0] * sin + at[1] * cos


def _target(
    model: Running, arena: Arena, table: Any, slot: int, sensor: Sense, begin: Point
) -> Point | None:
    """Return the centre of a sensor's target, as devices find it; None where there is none."""
    name = table.shape.name
    others = model.tables[str(sensor.of)]
    slots = others.slots
    if others is table:
        slots = slots[slots != slot]
    if sensor.of in arena.shape.bodies:
        kind, carrier = others.columns["carrier_kind"][slots], others.columns["carrier"][slots]
        counts = kind < 0
        if not sensor.free:
            counts |= (kind == arena.shape.robots[name].kind) & (carrier == slot)
        slots = slots[counts]
    if not len(slots):
        return None
    x, y = others.columns["x"][slots], others.columns["y"][slots]
    distance = np.hypot(x - begin[0], y - begin[1])
    nearest = int(np.argmin(distance))
    if distance[nearest] > arena.reach_of(sensor):
        return None
    return float(x[nearest]), float(y[nearest])
