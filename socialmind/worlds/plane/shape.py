"""What stands on the plane of a model, and what robots sense, do and are rewarded for there."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from socialmind.errors import ModelError, nearest
from socialmind.fields import Field, class_fields
from socialmind.worlds.contract import Place
from socialmind.worlds.plane.bodies import Body, Disc, Obstacle, Robot
from socialmind.worlds.plane.devices.device import Device, Interruption, Reward, what_lacks
from socialmind.worlds.plane.devices.sensors import RangeFinder

if TYPE_CHECKING:
    from socialmind.worlds.plane.devices.device import Act, Sense


CELL = 6.0
"""Side of the cells in which obstacles are looked up; a matter of speed alone."""


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
    # No two names have the same field.
    letters = [
        letter if letter.isascii() and letter.isalnum() else f"_{ord(letter):x}_" for letter in name
    ]
    return f"_memory_{stage}_{''.join(letters)}"


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
    plane: Any,
    populations: Mapping[str, Any],
    rewards: Mapping[str, Reward],
    interruptions: Mapping[str, Interruption],
    place: Place = lambda name: (None, None),
) -> PlaneShape:
    """Return the shape of a plane with the populations on it.

    Args:
        plane: the declaration.
        populations: of the model, by name.
        rewards: likewise.
        interruptions: likewise.
        place: gives the file and the line of an attribute of the model's class.

    Raises:
        ModelError: a body without a disc, or the other way round; a device that looks for a
            population that there is not; rewards or interruptions without robots.
    """
    bodies = {name: one for name, one in populations.items() if issubclass(one.agent, Body)}
    obstacles = [name for name, one in populations.items() if issubclass(one.agent, Obstacle)]
    robots = [name for name, one in bodies.items() if issubclass(one.agent, Robot)]
    for name, one in populations.items():
        with _said_of(name, place):
            _check_population(name, one, populations)
    if len(obstacles) > 1:
        with _said_of(obstacles[1], place):
            names = ", ".join(obstacles)
            raise ModelError(f"{len(obstacles)} populations of obstacles: {names}", "one at most")
    # Unless they say otherwise, rewards are for the first robots that sense anything.
    sensing = [name for name in robots if populations[name].sensors]
    first = next(iter(sensing or robots), None)
    of_all = {}
    for attribute, devices in (("rewards", rewards), ("interruptions", interruptions)):
        with _said_of(attribute, place):
            of_all[attribute] = _shared_out(devices, robots, first)
    shapes = {}
    for name in robots:
        one = populations[name]
        shapes[name] = RobotShape(
            name,
            list(bodies).index(name),
            dict(one.sensors),
            dict(one.actuators),
            of_all["rewards"][name],
            of_all["interruptions"][name],
            one.hierarchy is not None,
        )
    for name, shape in shapes.items():
        for attribute, stages in (
            (name, (shape.sensors, shape.actuators)),
            ("rewards", (shape.rewards,)),
            ("interruptions", (shape.interruptions,)),
        ):
            with _said_of(attribute, place):
                for stage in stages:
                    for key, device in stage.items():
                        _check_names(key, device, populations, shape)
    discs = {name: one.body for name, one in bodies.items() if one.body is not None}
    return PlaneShape(
        plane.half_width,
        plane.dt,
        discs,
        obstacles[0] if obstacles else None,
        shapes,
        tuple(interruptions),
    )


@contextmanager
def _said_of(attribute: str, place: Place) -> Iterator[None]:
    """Give errors the file and the line of an attribute of the model's class."""
    try:
        yield
    except ModelError as error:
        if error.file is not None:
            raise
        raise ModelError(error.found, error.expected, error.remedy, *place(attribute)) from None


def _shared_out(
    devices: Mapping[str, Any], robots: list[str], first: str | None
) -> dict[str, dict[str, Any]]:
    """Return for each population of robots the rewards or interruptions that are for it."""
    found: dict[str, dict[str, Any]] = {name: {} for name in robots}
    for key, device in devices.items():
        who = device.robots or first
        if who is None:
            raise ModelError(
                f"{key!r} in a model without robots",
                "a population of robots",
                "let a class inherit from Robot, and write Population(…, body=Disc())",
            )
        if who not in robots:
            raise ModelError(
                f"{key!r}, which is for {who!r}", "a population of robots", nearest(who, robots)
            )
        found[who][key] = device
    return found


def _check_names(
    name: str, device: Device | RangeFinder, populations: Mapping[str, Any], shape: RobotShape
) -> None:
    if isinstance(device, Device):
        lacking = what_lacks(device, repr(name), shape.name, populations, shape.sensors)
        if lacking is not None:
            raise ModelError(*lacking)


def _check_population(name: str, one: Any, populations: Mapping[str, Any]) -> None:
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
    if issubclass(one.agent, Robot):
        for field in class_fields(one.agent):
            if field in ("readings", "commands", "before"):
                raise ModelError(
                    f"a field called {field!r} of {one.agent.__name__}",
                    "a name that robots do not use",
                    f"every robot has {field!r}",
                )
    elif one.sensors or one.actuators:
        raise ModelError(
            f"sensors or actuators of {name!r}, whose class is {one.agent.__name__}",
            "a class that inherits from Robot",
            f"write class {one.agent.__name__}(Robot): …",
        )
