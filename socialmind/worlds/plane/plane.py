"""The plane of a model: its declaration, and the plane as a world."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import Any

from coglogo_py.border.numbers import is_number
from socialmind.agents.running import Running
from socialmind.compiling.lowering import PLACES
from socialmind.errors import ModelError, nearest
from socialmind.language.shape import PopulationShape, WorldShape, WorldText
from socialmind.worlds.contract import Ground, Place, World
from socialmind.worlds.plane.arena import Arena
from socialmind.worlds.plane.bodies import OWN
from socialmind.worlds.plane.devices.device import Interruption, Reward
from socialmind.worlds.plane.devices.measures import RESERVED, Measure
from socialmind.worlds.plane.shape import PlaneShape, RobotShape, plane_shape
from socialmind.worlds.plane.ticks.lockstep_text import lockstep_text
from socialmind.worlds.plane.ticks.stages import PlaneProgram, planned
from socialmind.worlds.plane.ticks.text import TICK, plane_text

__all__ = ["Plane"]


class Plane(World):
    """The declaration of a square arena with borders, as the attribute `world` of a model.

    Coordinates run from -half_width to half_width, x to the right and y upward.

    Args:
        half_width: above 0: a number, or the name of a parameter; 0 for a plane without borders.
        dt: seconds a tick, above 0.
    """

    devices: Mapping[str, type] = {  # never changed
        "rewards": Reward,
        "interruptions": Interruption,
        "measures": Measure,
    }
    has_episodes = True

    def __init__(self, half_width: float | str = 70.0, dt: float = 1 / 30) -> None:
        self.half_width = half_width
        self.dt = dt

    def check(self) -> None:
        """Refuse sizes and times out of range.

        Raises:
            ModelError: so it is.
        """
        wide, dt = self.half_width, self.dt
        if not isinstance(wide, str) and not (is_number(wide) and 0 <= wide < 1e6):
            raise ModelError(f"half_width={self.half_width!r} of a plane", "a number, 0 or more")
        if not (is_number(dt) and 0 < dt < 1):
            raise ModelError(f"dt={self.dt!r} of a plane", "seconds, above 0 and below 1")

    def shape(self, model: Any, place: Place) -> WorldShape:
        """Return the plane with the bodies on it, and what they sense, do and are rewarded for."""
        for key in model.measures:
            if key in RESERVED:
                raise ModelError(
                    f"a measure called {key!r}",
                    "another name: a score has it",
                    None,
                    *place("measures"),
                )
        wide, numbers = self.half_width, [n for n, p in model.parameters.items() if p.kind is float]
        if isinstance(wide, str) and wide not in numbers:
            raise ModelError(
                f"the half-width {wide!r}",
                "a number or the name of a parameter of numbers",
                nearest(wide, numbers),
                *place("world"),
            )
        shape = plane_shape(self, model.populations, model.rewards, model.interruptions, place)
        return PlaneWorld(shape)

    def ground(self, society: Running, *sizes: int) -> Ground:
        """Return the plane of a running society."""
        return Arena(society)


class PlaneWorld(WorldShape):
    """A plane as a world.

    Args:
        plane: what stands on it.
    """

    extent = ("0.0", "0.0", "0.0", "0.0", "0", "0", "0")  # no ends: that which agents are in
    engines = ("compiled", "pymunk")
    has_episodes = True

    def __init__(self, plane: PlaneShape) -> None:
        self.plane = plane
        self.robots: Mapping[str, RobotShape] = plane.robots
        self.dt: float = plane.dt
        steered = tuple(f"{name}_steered" for name in plane.robots)
        of_robots = ["steered", "eyes", "first", "senses", "senses_0", "motors", "motors_0"]
        self.kept_columns: tuple[str, ...] = ("over", "ignored", *steered)
        self.columns: tuple[str, ...] = (
            *["over", "ignored", "outside", "plane", "build", "move", "look"],
            *["settings", "settings_0"],
            *(f"{name}_{part}" for name in plane.robots for part in of_robots),
        )

    def inhabited(self, population: PopulationShape) -> PopulationShape:
        """Return a population with the readings, commands and memories of its robots."""
        robots = self.robots.get(population.name)
        if robots is None:
            return population
        fields = {**population.fields, **robots.fields}
        return replace(population, fields=fields, own=OWN, evaluated_by_world=True)

    def kept_within(self, population: str, field: str) -> tuple[str, ...]:
        """Return what refuses a place outside the arena."""
        if population not in self.plane.bodies or field not in PLACES:
            return ()
        wide = self.plane.half_width
        return "_within", f"_model.{wide}" if isinstance(wide, str) else repr(float(wide))

    def typed(self, program: Any) -> PlaneProgram:
        """Return the typed devices."""
        return planned(program, self.plane)

    def text(self, program: Any) -> WorldText:
        """Return the stages of a tick, and many worlds in lockstep."""
        deciding = [name for name, one in program.shape.populations.items() if one.minded]
        plane = program.world
        return WorldText(
            "", plane_text(plane, program.sought), TICK, lockstep_text(plane, deciding)
        )
