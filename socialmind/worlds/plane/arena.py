"""The plane of a running model: where its bodies are moved, and what its minds are told."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from functools import partial
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from socialmind.agents.bookkeeping import GONE, GONE_SCORE
from socialmind.agents.running import Running
from socialmind.compiling.lowering import PLACES
from socialmind.compiling.memory import address
from socialmind.errors import ModelError, SocialmindError, ValueRefusedError, nearest
from socialmind.fields import place_of_field
from socialmind.worlds.contract import Extent, Functions, Ground
from socialmind.worlds.plane.devices.sensors import RangeFinder
from socialmind.worlds.plane.kernel.arrays import Bodies, Eyes, Obstacles, PlaneArrays
from socialmind.worlds.plane.kernel.code import kernel
from socialmind.worlds.plane.shape import CELL, PlaneShape, RobotShape
from socialmind.worlds.plane.steering import MINDS, OUTSIDE, in_hand
from socialmind.worlds.plane.trajectories import trajectories

if TYPE_CHECKING:
    from socialmind.mind.evaluation.arrays import Assembly
    from socialmind.worlds.plane.devices.device import Device

_MOTION = ("x", "y", "angle", "push_x", "push_y", "torque")


class Arena(Ground):
    """The plane of a running model.

    Args:
        model: the model; its tables are made later.

    Attributes:
        half_width: from the middle to a border, 0 without borders.
        plane_arrays: what the compiled engine works on.

    Raises:
        SocialmindError: an engine that there is not.
        ModelError: a mind that wants sensors or actuators that the body lacks.
    """

    def __init__(self, model: Running) -> None:
        super().__init__(model)
        self.world = self
        world: Any = model.shape.world
        self.shape: PlaneShape = world.plane
        wide = self.shape.half_width
        self.half_width = float(model.context[wide]) if isinstance(wide, str) else float(wide)
        program: Any = model.program.world
        given = {name: float(model.context[name]) for name in model.shape.parameters}
        self.settings: NDArray[np.float64] = program.settings_of(given)
        self.shifting: bool = program.shifting
        self._motion: Any = None

    def settle_in(self) -> None:
        """Find the bodies in the society's tables, and what their minds read and command."""
        model = self.society
        self.senses: dict[str, NDArray[np.int64]] = {}
        self.motors: dict[str, NDArray[np.int64]] = {}
        for name, robots in self.shape.robots.items():
            if robots.hierarchy:
                places = places_of(robots, model.assemblies[name])
                self.senses[name], self.motors[name] = places
        self._eyes = self._seeing()
        try:
            self.plane_arrays: PlaneArrays = self._arrays()
        except ModelError as error:
            place = place_of_field(type(model), "world")
            raise ModelError(error.found, error.expected, error.remedy, *place) from None
        self._known = {kind: table.rows for kind, table in self._attached()}
        for name in () if model.minded else self.shape.robots:
            model.context[f"_{name}_steered"] = OUTSIDE

    def _arrays(self) -> PlaneArrays:
        tables = self.society.tables
        bodies = []
        for name, disc in self.shape.bodies.items():
            table = tables[name]
            bodies.append(Bodies(name, disc, table.rows, table.alive, _offset(table.dtype)))
        obstacles = None
        if self.shape.obstacles is not None:
            table = tables[self.shape.obstacles]
            obstacles = Obstacles(table.rows, table.alive, _offset(table.dtype))
        eyes = tuple(self._eyes.values())
        return PlaneArrays(self.half_width, self.shape.dt, CELL, bodies, obstacles, eyes)

    def _seeing(self) -> dict[str, Eyes]:
        """Return the range finders of the populations that have some."""
        eyes = {}
        for name, robots in self.shape.robots.items():
            rays = self._rays(name)
            if len(rays):
                fields: Any = self.society.tables[name].dtype.fields
                readings = fields["readings"][1] - fields["x"][1]
                eyes[name] = Eyes(robots.kind, rays, readings)
        return eyes

    def _rays(self, name: str) -> NDArray[Any]:
        """Return the rays of a population's range finders, which are the same in all societies."""
        made = self.society.program.made
        if ("rays", name) not in made:
            radius = self.shape.bodies[name].radius
            rays = [
                one.lines(radius, number)
                for number, one in enumerate(self.shape.robots[name].sensors.values())
                if isinstance(one, RangeFinder)
            ]
            made["rays", name] = np.concatenate(rays) if rays else np.zeros(0)
        found: NDArray[Any] = made["rays", name]
        return found

    def _attached(self) -> list[tuple[int | None, Any]]:
        """Return the numbers and tables of the bodies, and of the obstacles."""
        found: list[tuple[int | None, Any]] = [
            (kind, self.society.tables[name]) for kind, name in enumerate(self.shape.bodies)
        ]
        if self.shape.obstacles is not None:
            found.append((None, self.society.tables[self.shape.obstacles]))
        return found

    def reach_of(self, device: Device) -> float:
        """Return how far a device of this model sees."""
        reach = device.reach
        return float(self.society.context[reach]) if isinstance(reach, str) else reach

    def eyes_of(self, name: str) -> int:
        """Return the address of the range finders of a population, 0 where it has none."""
        return self._eyes[name].address if name in self._eyes else 0

    def connect(self, context: Any) -> None:
        """Write into the model's record where the plane's arrays are."""
        for kind, table in self._attached():
            if self._known.get(kind) is not table.rows:
                self._known[kind] = table.rows
                self.plane_arrays.attach(kind, table.rows, table.alive, _offset(table.dtype))
                if kind is None:
                    self.plane_arrays.build()
        module = kernel()
        context["_plane"] = self.plane_arrays.address
        for name in ("build", "move", "look"):
            context[f"_{name}"] = getattr(module, name).address
        context["_outside"] = self.society.physics != "compiled"
        context["_settings"], context["_settings_0"] = address(self.settings), len(self.settings)
        for name in self.shape.robots:
            context[f"_{name}_eyes"] = self.eyes_of(name)
            for part in ("senses", "motors"):
                array = getattr(self, part).get(name)
                if array is not None:
                    context[f"_{name}_{part}"] = address(array)
                    context[f"_{name}_{part}_0"] = len(array)

    def build(self) -> None:
        """Look at where the obstacles are, after the setup or a restored state."""
        self.society.engine.connect()
        self.plane_arrays.build()
        if self.society.physics == "pymunk":
            self.motion.build()

    def move(self) -> None:
        """Move the bodies by one tick."""
        if self.society.physics == "pymunk":
            self.motion.move()
            return
        self.society.engine.connect()
        fault = kernel().move.ctypes(self.plane_arrays.address, 0, 0)
        if fault:
            raise self._not_finite(fault - 1)

    def check_state(self, state: Mapping[str, Any], context: Any) -> str | None:
        """Say whether the record tells of an interruption that the model lacks."""
        if not 0 <= context["_over"] <= len(self.society.interruptions):
            return "context holds an interruption that the model lacks"
        return None

    @property
    def extent(self) -> Extent:
        """A plane without ends that matter to who is near whom."""
        return Extent(0.0, 0.0, math.inf, math.inf, False, False, False)

    def keeper(self, population: str, field: str) -> Callable[[float, str], float] | None:
        """Return what refuses a place outside the arena."""
        if population not in self.shape.bodies or field not in PLACES or self.half_width <= 0:
            return None
        return partial(_inside, field, self.half_width)

    def run_tick(self, functions: Functions, schedule: Callable[[], None]) -> None:
        """Run a tick on the plane, interpreted."""
        from socialmind.worlds.plane.ticks.interpreted import run_tick

        run_tick(self, functions, schedule)

    def before_compiled_tick(self) -> None:
        """Move the bodies, unless the episode is over."""
        if self.society.over is None:
            self.move()

    def after_compiled_tick(self) -> None:
        """Look at the obstacles anew, where they may have changed."""
        if self.shifting:
            self.build()

    @property
    def over(self) -> str | None:
        """The interruption that ended the episode."""
        number = int(self.society.context["_over"])
        return list(self.society.interruptions)[number - 1] if number else None

    def settle(self) -> None:
        """Pay robots what is still due to them: an episode ends here.

        The engine does so itself where an interruption ends it, not at a limit of ticks, which it
        does not know.
        """
        from socialmind.worlds.plane.ticks.interpreted import settle_rewards

        settle_rewards(self, self.society.engine.functions, ended=True)

    def series(self) -> dict[str, Any]:
        """Return the mean score of the robots, the dead included."""
        if not self.shape.robots:
            return {}
        tables = [self.society.tables[name] for name in self.shape.robots]
        scores = [one for table in tables for one in table.score.tolist()]
        count = len(scores) + sum(int(table.counters[GONE]) for table in tables)
        # The dead count with what they had.
        scores += [float(table.counters.view(np.float64)[GONE_SCORE]) for table in tables]
        return {"score": sum(scores) / count if count else None}

    def agents(self) -> dict[str, Any] | None:
        """Return where the robots are and how they fare."""
        return trajectories(self.society) if self.shape.robots else None

    def _not_finite(self, place: int) -> SocialmindError:
        """Return the error for a body, by its place among the slots of all bodies."""
        for name in self.shape.bodies:
            table = self.society.tables[name]
            if place < len(table.rows):
                row = table.rows[place]
                values = ", ".join(f"{field}={row[field].item()}" for field in _MOTION)
                return ModelError(
                    f"agent {row['_id']} of {name!r}, whose motion is not finite in tick "
                    f"{self.society.tick}: {values}",
                    "numbers up to a thousand million",
                )
            place -= len(table.rows)
        return SocialmindError("the motion of a body is not finite")

    def steer(self, population: str, commands: ArrayLike | None, agent: int | None = None) -> None:
        """Steer robots from outside, in place of their minds; see `Model.steer`."""
        robots = self.shape.robots
        if population not in robots:
            raise SocialmindError(
                f"no robots called {population!r} in {self.society.name}; "
                f"{nearest(population, robots)}"
            )
        steered = f"_{population}_steered"
        table = self.society.tables[population]
        if agent is not None and not table.contains(agent):
            raise SocialmindError(
                f"no robot {agent} of {population!r} lives at tick {self.society.tick}"
            )
        if commands is None:
            if not self.society.minded:
                raise SocialmindError(
                    f"robots of {self.society.name} without minds, which was made with "
                    "hierarchy=False; steer them with commands"
                )
            self.society.context[steered] = MINDS
            return
        count, names = len(robots[population].actuators), robots[population].actuators
        given, slots = np.asarray(commands, np.float64), table.slots
        several = () if agent is not None else ((len(slots), count),)
        if given.shape not in ((count,), *several):
            whose, shape = f"for a robot of {population!r}, which has", str((count,))
            if several:
                whose, shape = f"a row for each robot of {population!r} with", str(several[0])
            raise SocialmindError(
                f"commands of shape {given.shape}; expected {shape}, {whose} "
                f"{', '.join(names) or 'none'}"
            )
        if not ((given >= 0.0) & (given <= 1.0)).all():
            raise SocialmindError(f"commands {given.tolist()}; expected numbers, 0 … 1")
        if agent is not None:
            table.rows["commands"][slots[table.rows["_id"][slots] == agent], :count] = given
            if self.society.minded:
                self.society.context[steered] = in_hand(agent)
            return
        table.rows["commands"][slots, :count] = given
        self.society.context[steered] = OUTSIDE

    def steered(self, population: str) -> int | None:
        """Return the identity of the robot that is steered alone; None where none is."""
        code = int(self.society.context[f"_{population}_steered"])
        return in_hand(code) if code < 0 else None

    @property
    def motion(self) -> Any:
        """The reference engine."""
        if self._motion is None:
            from socialmind.worlds.plane.pymunk_motion import motion_of

            self._motion = motion_of(self)
        return self._motion


def places_of(
    robots: RobotShape, assembly: Assembly
) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """Return which reading each sensor of a mind is, and which actuator each of a body's is.

    Args:
        robots: the body.
        assembly: the mind.

    Returns:
        For each sensor of the mind the number of the body's; for each actuator of the body the
        number of the mind's, -1 for one that the mind does not have.

    Raises:
        ModelError: the mind reads a sensor, or commands an actuator, that the body lacks.
    """
    description = assembly.description
    commanded = {
        one.name
        for skill in assembly.skills
        for one in description.skills[skill].outputs
        if one.module == "actuator"
    }
    used: list[tuple[str, Any, Any]] = [
        ("sensor", assembly.required, robots.sensors),
        ("actuator", sorted(commanded), robots.actuators),
    ]
    for part, needed, own in used:
        for name in needed:
            if name not in own:
                raise ModelError(
                    f"the {part} {name!r} of the mind {description.name!r}, "
                    f"which the bodies of {robots.name!r} do not have",
                    f"one of {', '.join(own) or 'none'}",
                    nearest(name, own),
                )
    sensors = list(robots.sensors)
    senses = [sensors.index(one) if one in sensors else 0 for one in description.sensors]
    commands = list(description.actuators)
    motors = [commands.index(one) if one in commands else -1 for one in robots.actuators]
    return np.array(senses, np.int64), np.array(motors, np.int64)


def _offset(dtype: np.dtype[Any]) -> int:
    """Return the bytes from the begin of a row to its column x."""
    fields: Any = dtype.fields
    return int(fields["x"][1])


def _inside(name: str, edge: float, value: float, whose: str) -> float:
    """Return a coordinate of a body.

    Raises:
        ValueRefusedError: it is outside the arena.
    """
    if not abs(value) <= edge:
        raise ValueRefusedError(
            f"{name} = {value:g} of {whose}, which is outside the arena; "
            f"expected -{edge:g} … {edge:g}"
        )
    return value
