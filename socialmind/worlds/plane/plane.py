"""The plane of a model: its declaration, and what its bodies sense, do and are rewarded for."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from socialmind.errors import ModelError
from socialmind.fields import Field
from socialmind.language.nodes import nearest
from socialmind.worlds.plane.bodies import Body, Disc, Obstacle, Robot
from socialmind.worlds.plane.devices import Device, Interruption, Reward
from socialmind.worlds.plane.sensors import RangeFinder

if TYPE_CHECKING:
    from socialmind.population import Population
    from socialmind.worlds.plane.devices import Act, Sense

CELL = 6.0
"""Side of the cells in which obstacles are looked up; a matter of speed alone."""


class Plane:
    """The declaration of a square arena with borders, as the attribute `world` of a model.

    Coordinates run from -half_width to half_width, x to the right and y upward.

    Args:
        half_width: above 0: a number, or the name of a parameter; 0 for a plane without borders.
        dt: seconds a tick, above 0.
    """

    def __init__(self, half_width: float | str = 70.0, dt: float = 1 / 30) -> None:
        self.half_width = half_width
        self.dt = dt

    def __get__(self, model: Any, owner: type) -> Any:
        return self if model is None else model.arena

    def check(self) -> None:
        """Refuse sizes and times out of range.

        Raises:
            ModelError: so it is.
        """
        if not isinstance(self.half_width, str) and not 0 <= self.half_width < 1e6:
            raise ModelError(f"half_width={self.half_width!r} of a plane", "a number, 0 or more")
        if not 0 < self.dt < 1:
            raise ModelError(f"dt={self.dt!r} of a plane", "seconds, above 0 and below 1")


@dataclass(frozen=True)
class RobotShape:
    """What a population of robots senses, does and is rewarded for.

    Attributes:
        name: the population's.
        kind: its number among the populations of bodies.
        sensors: the sensors of each body by name, in order.
        actuators: likewise.
        rewards, interruptions: those that are for this population, by name.
        hierarchy: whether its robots have hierarchies of skills.
    """

    name: str
    kind: int
    sensors: Mapping[str, Sense | RangeFinder]
    actuators: Mapping[str, Act]
    rewards: Mapping[str, Reward]
    interruptions: Mapping[str, Interruption]
    hierarchy: bool

    @property
    def fields(self) -> dict[str, Field]:
        """The fields of a robot beside those of its class: readings, commands, memories."""
        fields = [_array("readings", len(self.sensors), 0.0)]
        fields += [_array(name, len(self.actuators), 0.5) for name in ("commands", "before")]
        for name, device in self.remembering.items():
            fields.append(_array(name, device.memory, 0.0))
        return {one.name: one for one in fields}

    @property
    def remembering(self) -> dict[str, Device]:
        """The devices that remember something, by the field that holds it."""
        return {
            memory_field(stage, name): device
            for stage in ("sensors", "actuators", "rewards", "interruptions")
            for name, device in getattr(self, stage).items()
            if isinstance(device, Device) and device.memory
        }


def memory_field(stage: str, name: str) -> str:
    """Return the name of the field in which a device keeps what it remembers."""
    plain = "".join(letter if letter.isalnum() else "_" for letter in name)
    return f"_memory_{stage}_{plain}"


def _array(name: str, size: int, default: float) -> Field:
    # A record has no arrays of length 0.
    return Field(name, float, "f8", (default,) * max(size, 1), max(size, 1))


@dataclass(frozen=True)
class PlaneShape:
    """A plane as the rules of a model know it.

    Attributes:
        half_width: a number, or the name of a parameter.
        dt: seconds a tick.
        bodies: the populations of bodies that move, in order: their numbers are kinds.
        obstacles: the population of obstacles, or None.
        robots: the populations with sensors, actuators, rewards or interruptions.
        interruptions: the names of all interruptions, in order.
    """

    half_width: float | str
    dt: float
    bodies: Mapping[str, Disc]
    obstacles: str | None
    robots: Mapping[str, RobotShape]
    interruptions: tuple[str, ...]


def plane_shape(
    plane: Plane,
    populations: Mapping[str, Population],
    rewards: Mapping[str, Reward],
    interruptions: Mapping[str, Interruption],
) -> PlaneShape:
    """Return the shape of a plane with the populations on it.

    Raises:
        ModelError: a body without a disc, or the other way round; a device that looks for a
            population that there is not; rewards or interruptions without robots.
    """
    bodies = {name: one for name, one in populations.items() if issubclass(one.agent, Body)}
    for name, one in populations.items():
        _check_population(name, one, populations)
    obstacles = [name for name, one in populations.items() if issubclass(one.agent, Obstacle)]
    if len(obstacles) > 1:
        raise ModelError(
            f"{len(obstacles)} populations of obstacles: {', '.join(obstacles)}", "one at most"
        )
    robots = [name for name, one in bodies.items() if issubclass(one.agent, Robot)]
    shapes = {}
    for name in robots:
        one = populations[name]
        shapes[name] = RobotShape(
            name,
            list(bodies).index(name),
            dict(one.sensors),
            dict(one.actuators),
            _those_for(name, rewards, robots),
            _those_for(name, interruptions, robots),
            one.hierarchy is not None,
        )
    stages: list[Mapping[str, Any]] = [rewards, interruptions]
    stages += [stage for one in shapes.values() for stage in (one.sensors, one.actuators)]
    for stage in stages:
        for name, device in stage.items():
            of = getattr(device, "of", None)
            if of is not None and of not in populations:
                raise ModelError(
                    f"{name!r}, which looks for {of!r}",
                    "the name of a population",
                    nearest(of, populations),
                )
    for shape in shapes.values():
        for stage in (shape.sensors, shape.actuators, shape.rewards, shape.interruptions):
            for name, device in stage.items():
                _check_readings(name, device, shape)
    discs = {name: one.body for name, one in bodies.items() if one.body is not None}
    return PlaneShape(
        plane.half_width,
        plane.dt,
        discs,
        obstacles[0] if obstacles else None,
        shapes,
        tuple(interruptions),
    )


def _those_for(name: str, devices: Mapping[str, Any], robots: list[str]) -> dict[str, Any]:
    found = {}
    for key, device in devices.items():
        who = device.robots or robots[0]
        if who not in robots:
            raise ModelError(
                f"{key!r}, which is for {who!r}", "a population of robots", nearest(who, robots)
            )
        if who == name:
            found[key] = device
    return found


def _check_population(name: str, one: Population, populations: Mapping[str, Population]) -> None:
    moves = issubclass(one.agent, Body)
    if moves != (one.body is not None):
        raise ModelError(
            f"the population {name!r} of {one.agent.__name__}"
            + (" without a body" if moves else ", which does not move, with a body"),
            None,
            "write Population(…, body=Disc())" if moves else "let the class inherit from Body",
        )
    if one.body is not None:
        for other in one.body.meets:
            if other not in populations or populations[other].body is None:
                raise ModelError(
                    f"{other!r} among what {name!r} collides with",
                    "the name of a population of bodies",
                    nearest(other, [n for n, p in populations.items() if p.body is not None]),
                )
    if (one.sensors or one.actuators) and not issubclass(one.agent, Robot):
        raise ModelError(
            f"sensors or actuators of {name!r}, whose class is {one.agent.__name__}",
            "a class that inherits from Robot",
            f"write class {one.agent.__name__}(Robot): …",
        )


def _check_readings(name: str, device: Any, shape: RobotShape) -> None:
    sensors = list(shape.sensors)
    wanted = [one for one in (getattr(device, "sensor", None),) if one is not None]
    wanted += list(getattr(device, "sensors", ()))
    for one in wanted:
        if one not in sensors:
            raise ModelError(
                f"{name!r}, which reads the sensor {one!r}",
                f"a sensor of {shape.name!r}",
                nearest(one, sensors),
            )
    several = [sensors.index(one) for one in getattr(device, "sensors", ())]
    if several and several != list(range(several[0], several[0] + len(several))):
        raise ModelError(
            f"{name!r}, which reads {', '.join(device.sensors)}",
            "sensors that stand next to each other in the body, in its order",
        )
