"""Devices: one function each, and how it is bound to a body and its world.

Sensors, actuators, rewards and interruptions are plain functions in the language of rules. What a
function wants it names: its parameters are those of `GIVEN`, and numbers from the device's
settings. A modeller's own device is made as ours are:

>>> def nearness(distance, largest):
...     return 1.0 - distance / largest
>>> near = Sense(nearness, of="objects", reach=20.0, settings={"largest": 20.0})
>>> near.takes
('distance', 'largest')
"""

from __future__ import annotations

import inspect
import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, ClassVar

import numpy as np

from coglogo_py.border.errors import shown
from coglogo_py.border.numbers import is_number, is_truth, is_whole
from socialmind.errors import ModelError, called_at, is_ours, nearest
from socialmind.language import types
from socialmind.language.program import Program

__all__ = ["Act", "Interruption", "Reward", "Sense"]

GIVEN: dict[str, str] = {
    "robot": "the robot",
    "model": "the model, as rules know it",
    "rng": "the robot's random stream",
    "kind": "the number of the robot's population among the bodies, for `carrier_kind`",
    "slot": "the robot's place in its population, for `carrier`",
    "members": "the population `of`, for a loop; its carried members too",
    "own": "whether the population `of` is the robot's own",
    "target": "the nearest member of `of`, seen from the device's place; unless found, do not use",
    "found": "whether there is such a member",
    "distance": "to its centre; when none is found the reach, or 0 where that is infinite",
    "bearing": "radians, -pi … pi, from the device's direction, positive to the left; 0 for none",
    "held": "whether the target is carried by this robot",
    "memory": "an array of so many numbers as the device's `memory`, zeros at the start",
    "reading": "what the body's sensor `sensor` reads, 0 … 1",
    "readings": "what the body's sensors `sensors` read, an array",
    "restarted": "of rewards: whether they start anew; the memory is zeros again",
    "command": "of actuators: the command, 0 … 1",
    "before": "of actuators: the command of the tick before; 0.5 at the start",
}
"""What a device's function may ask for, by the names of its parameters. Other names are settings.

The nearest is found among the living members other than the robot, within reach; carried ones are
left out, unless `free` is False: then those that this robot carries count."""

_SOUGHT = ("target", "found", "distance", "bearing", "held")
"""Of these, what tells of the nearest member."""
_NEEDED = {
    **dict.fromkeys(("members", "own", *_SOUGHT), ("of", "a population: of='objects'")),
    "memory": ("memory", "how many numbers it remembers: memory=2"),
    "reading": ("sensor", "the name of a sensor: sensor='SENSOBJ'"),
    "readings": ("sensors", "names of sensors: sensors=('S1', 'S2')"),
}
"""What a device must say for a name: the attribute, and in words."""
_PLAIN: dict[str, types.Type] = {
    "model": types.MODEL,
    "rng": types.RNG,
    **dict.fromkeys(("kind", "slot"), types.INT),
    **dict.fromkeys(("own", "found", "held", "restarted"), types.BOOL),
    **dict.fromkeys(("distance", "bearing", "reading", "command", "before"), types.FLOAT),
}


@dataclass(frozen=True)
class Device:
    """The base of sensors, actuators, rewards and interruptions.

    Attributes:
        function: a plain function; `GIVEN` lists what it may ask for.
        of: the population whose nearest member it sees.
        at: its place on the body, x ahead and y to the left of the centre.
        angle: its direction on the body, radians counterclockwise.
        reach: how far it sees, above 0; or the name of a parameter of the model, 0 or more.
        sensor: the name of the sensor of the body that it reads.
        sensors: the names of sensors that stand next to each other in the body.
        memory: how many numbers it remembers, for each robot.
        free: whether carried members of `of` are left out; with False, those that the robot itself
            carries count.
        settings: the numbers that further parameters of the function take, as numbers with a
            fraction; True and False are 1 and 0; a text is the name of a parameter of the model.
            Those left out take the function's defaults.
        place: the file and line that errors name: of the function, or of the call that made the
            device where the function is the library's.

    Raises:
        ModelError: what the function asks for and what the device says do not fit.
    """

    function: Callable[..., Any]
    of: str | None = None
    at: tuple[float, float] = (0.0, 0.0)
    angle: float = 0.0
    reach: float | str = math.inf
    sensor: str | None = None
    sensors: tuple[str, ...] = ()
    memory: int = 0
    free: bool = True
    settings: Mapping[str, float | str] = field(default_factory=dict, hash=False)
    place: tuple[str | None, int | None] = field(
        default=(None, None), init=False, repr=False, compare=False
    )
    word: ClassVar[str] = "device"
    further: ClassVar[tuple[str, ...]] = ()
    results: ClassVar[tuple[types.AnyType, ...]] = ()
    result: ClassVar[str] = ""

    def __post_init__(self) -> None:
        object.__setattr__(self, "place", self._place())
        parameters = self._parameters()
        # A tuple and a dictionary of one's own: what the caller holds may change.
        object.__setattr__(self, "sensors", (*self._names(self.sensors),))
        self._check_numbers()
        object.__setattr__(self, "at", (float(self.at[0]), float(self.at[1])))
        settings = self._completed(parameters)
        object.__setattr__(self, "settings", settings)
        for name in parameters:
            if name in GIVEN:
                self._check_given(name)
            elif name not in settings:
                known = [*self.given, *settings]
                raise self.error(
                    f"the parameter {name!r} of {self.called}",
                    f"one of {', '.join(self.given)}, or a setting",
                    f"{_hint(name, known)}give it a number: settings={{{name!r}: 1.0}}",
                )
        self._check_used(parameters)

    # What it is made of -----------------------------------------------------------------------

    @property
    def name(self) -> str:
        """The function's name."""
        return str(getattr(self.function, "__name__", self.function))

    @property
    def called(self) -> str:
        """What errors call it."""
        return f"the {self.word} {self.name!r}"

    @property
    def takes(self) -> tuple[str, ...]:
        """The names of its function's parameters, in order."""
        return tuple(inspect.signature(self.function).parameters)

    @property
    def seeks(self) -> bool:
        """Whether its function asks for the nearest member of `of`."""
        return any(name in _SOUGHT for name in self.takes)

    @property
    def given(self) -> tuple[str, ...]:
        """The names of `GIVEN` that this kind of device may ask for."""
        special = ("restarted", "command", "before")
        return tuple(name for name in GIVEN if name not in special or name in self.further)

    def error(self, found: str, expected: str | None, remedy: str | None = None) -> ModelError:
        """Return an error with the device's place."""
        return ModelError(found, expected, remedy, *self.place)

    def _place(self) -> tuple[str | None, int | None]:
        code = getattr(self.function, "__code__", None)
        if code is None or is_ours(code.co_filename):
            return called_at()
        return code.co_filename, code.co_firstlineno

    # Checks -----------------------------------------------------------------------------------

    def _parameters(self) -> dict[str, inspect.Parameter]:
        if not inspect.isfunction(self.function):
            raise self.error(f"{self.function!r} as the function of a {self.word}", "a function")
        return dict(inspect.signature(self.function).parameters)

    def _names(self, names: Sequence[str]) -> Sequence[str]:
        if isinstance(names, str):
            raise self.error(
                f"sensors={names!r} of {self.called}",
                "several names",
                f"write sensors=({names!r},)",
            )
        return names

    def _check_numbers(self) -> None:
        reach, memory = self.reach, self.memory
        sees = isinstance(reach, str) or ((is_number(reach) or reach == math.inf) and reach > 0)
        checks = (
            ("at", "two numbers", is_point(self.at)),
            ("reach", "a number above 0", sees),
            ("angle", "radians", is_number(self.angle)),
            ("memory", "a whole number, 0 or more", is_whole(memory) and memory >= 0),
        )
        for name, expected, fits in checks:
            if not fits:
                raise self.error(f"{name}={shown(getattr(self, name))} of {self.called}", expected)

    def _completed(self, parameters: Mapping[str, inspect.Parameter]) -> dict[str, float | str]:
        """Return the settings with the function's defaults, in the order of its parameters."""
        found = dict(self.settings)
        for name, parameter in parameters.items():
            if parameter.default is parameter.empty or name in found:
                continue
            if name in GIVEN:
                raise self.error(
                    f"a default for {name!r} of {self.called}",
                    None,
                    f"leave it out: {name!r} is {GIVEN[name].split(';')[0]}",
                )
            found[name] = parameter.default
        for name, value in found.items():
            if name not in parameters or name in GIVEN:
                named = [one for one in parameters if one not in GIVEN]
                raise self.error(
                    f"the setting {name!r} of {self.called}",
                    "a parameter of the function that is not given anyway",
                    nearest(name, named) if named else "leave it out: it has no settings",
                )
            if isinstance(value, str) and name in self.settings:
                continue
            infinite = isinstance(value, float) and math.isinf(value)
            if not (is_number(value) or is_truth(value) or infinite):
                raise self.error(
                    f"{name}={shown(value)} of {self.called}",
                    "a number, a truth value or the name of a parameter of the model",
                )
        given = {name: found[name] for name in parameters if name in found}
        return {name: one if isinstance(one, str) else float(one) for name, one in given.items()}

    def _check_given(self, name: str) -> None:
        if name not in self.given:
            raise self.error(
                f"the parameter {name!r} of {self.called}",
                f"one of {', '.join(self.given)}, or a setting",
                f"{name!r} is {GIVEN[name]}",
            )
        attribute, words = _NEEDED.get(name, ("function", ""))
        if not getattr(self, attribute):
            raise self.error(
                f"the parameter {name!r} of {self.called}, which says no `{attribute}`",
                None,
                f"give it {words}",
            )

    def _check_used(self, parameters: Mapping[str, inspect.Parameter]) -> None:
        """Refuse what the device says and its function does not ask for."""
        for attribute in ("of", "memory", "sensor", "sensors"):
            names = [name for name, (needed, _) in _NEEDED.items() if needed == attribute]
            if getattr(self, attribute) and not any(name in parameters for name in names):
                raise self.error(
                    f"{attribute}={getattr(self, attribute)!r} of {self.called}, "
                    f"which does not ask for it",
                    None,
                    f"leave it out, or let the function take {' or '.join(names)}",
                )


@dataclass(frozen=True)
class Sense(Device):
    """A sensor: its function returns a number, which is held to 0 … 1; truth values are 0 and 1."""

    word: ClassVar[str] = "sensor"
    results: ClassVar[tuple[types.AnyType, ...]] = (types.FLOAT, types.INT, types.BOOL)
    result: ClassVar[str] = "a number"


@dataclass(frozen=True)
class Act(Device):
    """An actuator: its function returns nothing; it adds to `robot.push_x`, `push_y`, `torque`."""

    word: ClassVar[str] = "actuator"
    further: ClassVar[tuple[str, ...]] = ("command", "before")
    results: ClassVar[tuple[types.AnyType, ...]] = (types.NONE,)
    result: ClassVar[str] = "nothing"


@dataclass(frozen=True)
class Reward(Device):
    """A reward of each tick: its function returns a number.

    Attributes:
        robots: the population that it judges; by default the first one with sensors.
        settles: whether it pays what rules have done since the last time, as `paid` does, and takes
            what it pays. It is asked once more when a robot has died, and when an episode ends.
    """

    robots: str | None = None
    settles: bool = False
    word: ClassVar[str] = "reward"
    further: ClassVar[tuple[str, ...]] = ("restarted",)
    results: ClassVar[tuple[types.AnyType, ...]] = (types.FLOAT, types.INT)
    result: ClassVar[str] = "a number"


@dataclass(frozen=True)
class Interruption(Device):
    """What ends an episode: its function returns a truth value.

    Attributes:
        robots: the population that it watches; by default the first one with sensors.
    """

    robots: str | None = None
    word: ClassVar[str] = "interruption"
    results: ClassVar[tuple[types.AnyType, ...]] = (types.BOOL,)
    result: ClassVar[str] = "True or False"


def makers(names: Mapping[str, Any], made: type[Device]) -> dict[str, Callable[..., Any]]:
    """Return those functions of a file, given by its names, that make devices of a kind."""
    functions = {name: one for name, one in names.items() if inspect.isfunction(one)}
    return {n: f for n, f in functions.items() if f.__annotations__.get("return") == made.__name__}


def typed(
    program: Program,
    device: Device,
    population: str,
    body_sensors: Sequence[str],
    what: str = "",
) -> str:
    """Type the function of a device for the robots of a population.

    Args:
        program: the program of the model.
        device: the device.
        population: the population that has it, or that it judges.
        body_sensors: the names of the sensors of that population, in order.
        what: what errors call the device, as "the sensor 'RADOBJ' of 'robots'".

    Returns:
        The function's symbol in the program; it takes `device.takes`, in order.

    Raises:
        ModelError: the function is outside the language of rules or returns what it should not, or
            the device names a population or a sensor that there is not.
    """
    what = what or f"the {device.word} {device.name!r} of {population!r}"
    lacking = what_lacks(device, what, population, program.shape.populations, body_sensors)
    if lacking is not None:
        raise device.error(*lacking)
    _check_signal(program, device, population, what)
    source = program.source(device.function)
    kinds = tuple(_kind(device, name, population) for name in device.takes)
    try:
        symbol, result = program.specialised(source, kinds, None, source.tree)
    except ModelError as error:
        found = f"{error.found} in {what}"
        place = error.file, error.line
        if error.file is None or is_ours(error.file):
            place = device.place
        raise ModelError(found, error.expected, error.remedy, *place) from None
    if result not in device.results:
        raise ModelError(
            f"the function {source.name!r}, which returns {result}, in {what}",
            device.result,
            "write `return x > 0.5`"
            if device.results == (types.BOOL,) and result in (types.FLOAT, types.INT)
            else None,
            source.file,
            source.line,
        )
    return symbol


def what_lacks(
    device: Device,
    what: str,
    population: str,
    populations: Iterable[str],
    body_sensors: Iterable[str],
) -> tuple[str, str, str] | None:
    """Return what a device names and a model lacks, what is expected and a remedy; None if nothing.

    Args:
        device: the device.
        what: what errors call it.
        population: the one that has it, or that it judges.
        populations: the names of the model's populations, which it may look for.
        body_sensors: the names of the body's sensors in order, which it may read.
    """
    names = tuple(body_sensors)
    if device.of is not None and device.of not in populations:
        found = f"{what}, which looks for {device.of!r}"
        return found, "the name of a population", nearest(device.of, populations)
    for name in (*device.sensors, *(() if device.sensor is None else (device.sensor,))):
        if name not in names:
            found = f"{what}, which reads the sensor {name!r}"
            return found, f"a sensor of {population!r}", nearest(name, names)
    first = names.index(device.sensors[0]) if device.sensors else 0
    if names[first : first + len(device.sensors)] != device.sensors:
        found = f"{what}, which reads {', '.join(device.sensors)}"
        expected = "sensors that stand next to each other in the body, in its order"
        return found, expected, f"the body has {', '.join(names)}"
    return None


def _check_signal(program: Program, device: Device, population: str, what: str) -> None:
    """Refuse what emits or hears signals of robots that have no field, or no channel, for them."""
    channel = device.settings.get("channel")
    if channel is None or not is_ours(device.function.__code__.co_filename):
        return
    whose = device.of or population
    signal = program.shape.populations[whose].fields.get("signal")
    if signal is None or signal.size is None:
        raise device.error(
            f"{what} without a field for signals in the class of {whose!r}",
            "signal: list[float] = [0.0], a number for each channel",
        )
    if not isinstance(channel, str) and channel >= signal.size:
        raise device.error(
            f"channel {int(channel)} of {what}", f"0 … {signal.size - 1}: signal has {signal.size}"
        )


def is_point(at: Any) -> bool:
    """Return whether something is a place on a body: two numbers."""
    return isinstance(at, Sequence | np.ndarray) and len(at) == 2 and all(map(is_number, at))


def _kind(device: Device, name: str, population: str) -> types.AnyType:
    """Return the type of a parameter of a device's function."""
    if name in _PLAIN:
        return _PLAIN[name]
    if name == "robot":
        return types.RowType(population)
    if name == "target":
        return types.RowType(str(device.of))
    if name == "members":
        return types.PopulationType(str(device.of))
    if name == "memory":
        return types.ArrayType(types.FLOAT, device.memory)
    if name == "readings":
        return types.ArrayType(types.FLOAT, len(device.sensors))
    return types.FLOAT


def _hint(name: str, known: Sequence[str]) -> str:
    """Return "did you mean …? or " for a misspelt name, or nothing."""
    hint = nearest(name, known)
    return f"{hint} or " if hint.startswith("did you mean") else ""
