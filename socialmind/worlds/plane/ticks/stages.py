"""The stages of a tick on a plane, planned once for both speeds.

A tick: motion, rewards, interruptions, actuators, sensors, minds, schedule. For each stage and
population of robots a `Stage` says which functions are called with what; `text` writes it for the
compiled module, `interpreted` walks through it in Python.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from socialmind.errors import ModelError, nearest
from socialmind.streams import phase_tags
from socialmind.worlds.plane.devices.device import Device, typed
from socialmind.worlds.plane.shape import PlaneShape, RobotShape, memory_field

if TYPE_CHECKING:
    from socialmind.language.program import Program

STAGES = ("rewards", "interruptions", "actuators", "sensors")
DEVICE_TAG = 0x0000
"""First tag of the streams that devices draw from."""
PLACED = 4
"""Numbers that every device has before its settings: its place, its angle and its reach."""


@dataclass(frozen=True)
class Call:
    """The call of a device's function.

    Attributes:
        name: the device's.
        number: its place among the sensors, actuators or interruptions.
        device: what it is.
        symbol: the typed function.
        seek: the number of the stage's look-up of its target, or None.
        settings: where its numbers begin in the settings: place (2), angle, reach, then the others.
        memory: the field of what it remembers, or None.
        tag: of the stream that it draws from.
    """

    name: str
    number: int
    device: Device
    symbol: str
    seek: int | None
    settings: int
    memory: str | None
    tag: int


@dataclass(frozen=True)
class Seek:
    """A look-up of the nearest target, shared by the devices that look from one place.

    Attributes:
        of: the population.
        free: whether those that are carried are left out.
        settings: where the place begins in the settings.
        same: whether the population is the robot's own.
        carried: whether its members can be carried.
    """

    of: str
    free: bool
    settings: int
    same: bool
    carried: bool


@dataclass(frozen=True)
class Stage:
    """What the robots of a population go through in a stage."""

    robots: RobotShape
    name: str
    seeks: tuple[Seek, ...]
    calls: tuple[Call, ...]


@dataclass(frozen=True)
class PlaneProgram:
    """The typed devices of a plane.

    Attributes:
        shape: the plane.
        stages: by the robots' population, then the stage's name.
        settling: by the robots' population, the rewards that are asked once more when a robot has
            died or an episode ends.
        settings: the numbers of all devices; NaN where a parameter of the model gives it.
        named: of those, the places, and the devices and parameters that they belong to.
        shifting: whether obstacles may change in a tick, so that they are looked at anew.
    """

    shape: PlaneShape
    stages: Mapping[str, Mapping[str, Stage]]
    settling: Mapping[str, Stage]
    settings: NDArray[np.float64]
    named: Mapping[int, tuple[str, str]]
    shifting: bool

    def settings_of(self, parameters: Mapping[str, float]) -> NDArray[np.float64]:
        """Return the numbers of all devices in a model.

        Args:
            parameters: the values of the model's parameters, by name.

        Raises:
            ModelError: a reach below 0.
        """
        if not self.named:
            return self.settings
        found = self.settings.copy()
        for place, (what, name) in self.named.items():
            found[place] = parameters[name]
            if what and not found[place] >= 0:
                raise ModelError(f"{name}={parameters[name]:g} as the reach of {what}", "0 or more")
        return found


def planned(program: Program, shape: PlaneShape) -> PlaneProgram:
    """Type the devices of a plane as parts of a program.

    Raises:
        ModelError: a function outside the language, or that returns other than it should.
    """
    settings: list[float] = []
    named: dict[int, tuple[str, str]] = {}
    tags: list[tuple[str, str, str]] = [
        (robots, stage, name)
        for robots, one in shape.robots.items()
        for stage in STAGES
        for name in getattr(one, stage)
    ]
    tag_of = dict(zip(tags, phase_tags(DEVICE_TAG, ["/".join(t) for t in tags]), strict=True))
    stages: dict[str, dict[str, Stage]] = {}
    for robots, one in shape.robots.items():
        stages[robots] = {}
        for stage in STAGES:
            seeks: dict[Any, Seek] = {}
            calls = []
            for number, (name, device) in enumerate(getattr(one, stage).items()):
                if not isinstance(device, Device):
                    continue  # a range finder
                what = f"the {device.word} {name!r} of {robots!r}"
                first = len(settings)
                settings += [*device.at, device.angle]
                for key, value in (("reach", device.reach), *device.settings.items()):
                    if isinstance(value, str):
                        _check_parameter(program, device, f"{key}={value!r} of {what}", value)
                        named[len(settings)] = what if key == "reach" else "", value
                    settings.append(math.nan if isinstance(value, str) else float(value))
                place = None
                if device.of is not None and device.seeks:
                    sought = (device.of, device.free, device.at, device.reach)
                    if sought not in seeks:
                        carried = device.of in shape.bodies
                        same = device.of == robots
                        seeks[sought] = Seek(device.of, device.free, first, same, carried)
                    place = list(seeks).index(sought)
                symbol = typed(program, device, robots, list(one.sensors), what)
                if stage == "interruptions":
                    number = shape.interruptions.index(name)
                memory = memory_field(stage, name) if device.memory else None
                tag = tag_of[robots, stage, name]
                calls.append(Call(name, number, device, symbol, place, first, memory, tag))
            stages[robots][stage] = Stage(one, stage, tuple(seeks.values()), tuple(calls))
    symbols = [phase.symbol for phase in program.schedule]
    symbols += [call.symbol for plans in program.plans.values() for call in plans.calls]
    symbols += [c.symbol for one in stages.values() for s in one.values() for c in s.calls]
    obstacles = shape.obstacles
    shifting = obstacles is not None and any(
        program.effects.changed_by(symbol, obstacles) for symbol in symbols
    )
    settling = {}
    for robots, of_robots in stages.items():
        rewards = of_robots["rewards"]
        due = tuple(call for call in rewards.calls if getattr(call.device, "settles", False))
        settling[robots] = Stage(rewards.robots, "settling", rewards.seeks if due else (), due)
    return PlaneProgram(shape, stages, settling, np.array([*settings, 0.0]), named, shifting)


def _check_parameter(program: Program, device: Device, found: str, name: str) -> None:
    """Refuse the name of a parameter that the model has not.

    Raises:
        ModelError: so it is.
    """
    known = list(program.shape.parameters)
    if name not in known:
        remedy = nearest(name, known) if known else "it has none; write a number"
        raise device.error(found, "a number or the name of a parameter of the model", remedy)
