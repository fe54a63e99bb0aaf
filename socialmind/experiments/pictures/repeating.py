"""A run that is repeated tick by tick, for whoever wants to see all of a moment."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from typing import TYPE_CHECKING

import numpy as np

from socialmind.errors import SocialmindError
from socialmind.interventions.following import advanced
from socialmind.mind.evaluation.agent_state import AgentState, observe
from socialmind.runs.branching.kept import interventions_of
from socialmind.runs.sources import model_of
from socialmind.worlds.plane.bodies import Robot
from socialmind.worlds.plane.layout import FASTEST
from socialmind.worlds.plane.scene import Scene, scene_of

if TYPE_CHECKING:
    from socialmind.drawing.plane import Floats, Paths
    from socialmind.model import Model
    from socialmind.runs.capsule import Capsule

Progress = Callable[[int, int], None]
Name = tuple[str | None, int]
"""A robot: its population, or None for any, and its identity."""
TOLD = 500
"""Ticks after which progress is told on the way from moment to moment."""


class Repeated:
    """A run on a plane that is repeated, at some moment of it.

    Args:
        capsule: the run.
        robot: who is looked at; the first robot by default.
        mind: whether the robot's hierarchy is wanted.
        trust: run programs that this user has neither named nor run before.
        kept: take the copies of the model's source that the run keeps.

    Attributes:
        scene: what stands where.
        robot: the population and identity of who is looked at; None where there are no robots.
        mind: its hierarchy, or None where it is not wanted.

    Raises:
        SocialmindError: the run cannot be repeated, its world is no plane, or there is no such
            robot at its start.
    """

    def __init__(
        self,
        capsule: Capsule,
        robot: Name | None = None,
        mind: bool = False,
        trust: bool = False,
        kept: bool = False,
    ) -> None:
        self._model: Model = model_of(capsule, kept=kept, trust=trust)
        self._interventions = interventions_of(capsule, trust)
        self.scene: Scene = scene_of(self._model)
        self.robot = self._robot_to_follow(robot, mind)
        self.mind: AgentState | None = None
        self._with_mind = mind
        if mind and self.robot is not None:
            observe(self._model.assemblies[self.robot[0]])
        self._see_mind()
        self._jump = 2.0 * FASTEST * self._model.shape.world.dt
        self._teams = [
            name for name, one in self._model.populations.items() if issubclass(one.agent, Robot)
        ]
        self._paths: dict[tuple[str, int], _Path] = {}
        self._note()

    def _robot_to_follow(self, robot: Name | None, mind: bool) -> tuple[str, int] | None:
        team, identity = robot or (None, None)
        minded = self._model.assemblies if mind else self._model.populations
        for one in self.scene.robots:
            if identity in (None, one.identity) and team in (None, one.team) and one.team in minded:
                return one.team, one.identity
        if robot is not None:
            known = ", ".join(f"{one.team}={one.identity}" for one in self.scene.robots[:10])
            raise SocialmindError(
                f"agent {identity if team is None else f'{team}={identity}'}; expected a robot"
                f"{' with a hierarchy' if mind else ''} at the start of {self._model.name}, "
                f"which has {known or 'none'}"
            )
        if mind:
            raise SocialmindError(
                f"the robots of {self._model.name} have no hierarchies; draw the plane alone"
            )
        return None

    def at(self, ticks: Sequence[int], on_progress: Progress | None = None) -> Iterator[int]:
        """Go from moment to moment.

        Args:
            ticks: ascending.
            on_progress: called with the ticks done and the last one.
        """
        for tick in ticks:
            while self._model.tick < tick:
                self._model = advanced(self._model, 1, self._interventions)
                self._note()
                if on_progress is not None and self._model.tick % TOLD == 0:
                    on_progress(self._model.tick, ticks[-1])
            self.scene = scene_of(self._model)
            self._see_mind()
            if on_progress is not None:
                on_progress(tick, ticks[-1])
            yield tick

    def paths(self, ticks: int | None = None) -> Paths:
        """Return where robots have been.

        Args:
            ticks: in how many last ticks; all by default.
        """
        return {key: path.last(ticks) for key, path in self._paths.items()}

    def _note(self) -> None:
        for name in self._teams:
            table = self._model.tables[name]
            slots = table.slots
            identities, x, y = (table.columns[one][slots].tolist() for one in ("_id", "x", "y"))
            for place, identity in enumerate(identities):
                path = self._paths.setdefault((name, identity), _Path(self._jump))
                path.add(x[place], y[place])

    def _see_mind(self) -> None:
        """Find the robot's hierarchy; one that is no more stays as it was."""
        if self.robot is None or not self._with_mind:
            return
        name, identity = self.robot
        table = self._model.tables[name]
        if table.minds is not None and table.contains(identity):
            self.mind = AgentState(table.minds, table[identity]._slot)


class _Path:
    """Where a robot has been, tick by tick; it is broken where the robot was moved at once."""

    def __init__(self, jump: float) -> None:
        self._jump = jump
        self._places = np.zeros((256, 2))
        self._count = 0

    def add(self, x: float, y: float) -> None:
        if self._count == len(self._places):
            self._places = np.concatenate([self._places, np.zeros_like(self._places)])
        self._places[self._count] = x, y
        self._count += 1

    def last(self, ticks: int | None) -> Floats:
        first = 0 if ticks is None else max(self._count - ticks - 1, 0)
        places = self._places[first : self._count]
        steps = np.hypot(*np.diff(places, axis=0).T)
        jumps = np.flatnonzero(steps > self._jump) + 1
        return np.insert(places, jumps, math.nan, axis=0) if len(jumps) else places.copy()
