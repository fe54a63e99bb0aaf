"""The drive module, and how rules reach the hierarchy of an agent (thesis, 5.1.3 and A.5.4).

A drive is a plain function of one parameter that runs in every evaluation after sensors and
variables are updated and before the skills are evaluated:

    def go_to_target(mind):
        mind.set_variable("VAR_TARGET", mind.sensor("RADOBJ"))
        mind.add_influence("GoToTarget", 1.0)
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from socialmind.errors import ModelError
from socialmind.language.program import Program
from socialmind.language.types import NONE, HierarchyType
from socialmind.mind.code.text import MIND_NAME
from socialmind.mind.evaluation.arrays import Assembly, groups_of

if TYPE_CHECKING:
    from socialmind.mind.description import MindDescription


def typed_drive(program: Program, drive: Callable[..., None], population: str = MIND_NAME) -> str:
    """Type a drive as part of a program and return its symbol.

    Raises:
        ModelError: it is outside the language of rules, takes other than one parameter, or
            returns something.
    """
    source = program.source(drive)
    if len(source.parameters) != 1:
        raise ModelError(
            f"the drive {source.name!r} with {len(source.parameters)} parameters",
            "one, the mind",
            f"write def {source.name}(mind)",
            source.file,
            source.line,
        )
    kinds = (HierarchyType(population, driven=True),)
    symbol, result = program.specialised(source, kinds, None, source.tree)
    if result != NONE:
        raise ModelError(
            f"the drive {source.name!r}, which returns {result}",
            "nothing",
            "call mind.set_variable(), mind.command() or mind.add_influence()",
            source.file,
            source.line,
        )
    return symbol


def tables_of(assembly: Assembly) -> dict[str, dict[str, int]]:
    """Return the numbers of the modules that rules and drives may name, by part and name."""
    description: MindDescription = assembly.description
    named = {
        "sensor": description.sensors,
        "actuator": description.actuators,
        "variable": description.variables,
        "skill": assembly.skills,
        "group of variables": groups_of(description),
    }
    return {part: {name: n for n, name in enumerate(names)} for part, names in named.items()}


def names_of(
    program: Program, assembly: Assembly, population: str = MIND_NAME
) -> NDArray[np.int64]:
    """Return the numbers of the modules that a program names.

    Raises:
        ModelError: it names one that the mind does not have.
    """
    tables = tables_of(assembly)
    owners = dict.fromkeys(tables, f"the mind {assembly.description.name!r}")
    return np.array(program.placed(population, tables, owners), np.int64)


class AgentHierarchy:
    """The hierarchy of one agent, as rules and drives hold it in interpreted runs.

    Args:
        minds: the `Steps` of the minds that it is one of.
        agent: its number among them.
        driven: whether a drive holds it, in the middle of an evaluation.
    """

    __slots__ = ("_agent", "_driven", "_steps")

    def __init__(self, steps: Any, agent: int, driven: bool = False) -> None:
        self._steps = steps
        self._agent = agent
        self._driven = driven

    def sensor(self, name: str) -> float:
        """Return a sensor's value, 0 … 1."""
        return float(self._steps.state.sensors[self._agent, self._place("sensor", name), 0])

    def set_sensor(self, name: str, value: float) -> None:
        """Set a sensor, 0 … 1."""
        self._refuse_drive("set_sensor")
        place = self._place("sensor", name)
        self._steps.module.set_sensor(self._steps.address, self._agent, place, float(value))

    def evaluate(self) -> None:
        """Evaluate the hierarchy once (thesis, figure 5.4)."""
        self._refuse_drive("evaluate")
        self._steps.evaluate(self._agent)

    def actuator(self, name: str) -> float:
        """Return an actuator's command of the last evaluation, 0 … 1."""
        return float(self._steps.state.actuators[self._agent, self._place("actuator", name), 0])

    def variable(self, name: str) -> float:
        """Return a variable's value, 0 … 1."""
        return float(self._steps.state.values[self._agent, self._place("variable", name), 0])

    def set_variable(self, name: str, value: float) -> None:
        """Set a variable, 0 … 1; by a drive, so that the skills see it in this evaluation."""
        place = self._place("variable", name)
        module, address = self._steps.module, self._steps.address
        module.set_variable(address, self._agent, place, float(value))
        if self._driven:
            module.override(address, self._agent, place, float(value))

    def influence(self, skill: str) -> float:
        """Return the sum of the influence that a skill received in the last evaluation."""
        return float(self._steps.state.totals[self._agent, self._place("skill", skill), 0])

    def add_influence(self, skill: str, value: float) -> None:
        """Add to the influence that a skill receives, 0 or more."""
        place = self._place("skill", skill)
        self._steps.module.add_influence(self._steps.address, self._agent, place, float(value))

    def command(self, actuator: str, value: float, weight: float = 1.0) -> None:
        """Command an actuator as a base skill of that influence does."""
        place = self._place("actuator", actuator)
        self._command(True, place, value, weight)

    def command_variable(self, variable: str, value: float, weight: float = 1.0) -> None:
        """Command a variable as a skill of that influence does; it hears it in the next tick."""
        self._command(False, self._place("variable", variable), value, weight)

    def _command(self, actuator: bool, place: int, value: float, weight: float) -> None:
        self._steps.module.command(
            self._steps.address, self._agent, actuator, place, float(value), float(weight)
        )

    def join_group(self, group: str, instance: int, participation: float = 1.0) -> None:
        """Join an instance of a group, whose shared variables this agent then sees and writes."""
        self._refuse_drive("join_group")
        place = self._place("group of variables", group)
        self._steps.module.join(
            self._steps.address, self._agent, place, instance, float(participation)
        )

    def leave_group(self, group: str) -> None:
        """Leave a group; its shared variables are then the agent's own."""
        self.join_group(group, -1)

    def restart(self) -> None:
        """Put the hierarchy back to before its first evaluation."""
        self._refuse_drive("restart")
        self._steps.restart(self._agent)

    def _refuse_drive(self, method: str) -> None:
        if self._driven:
            raise ModelError(
                f"{method}() in a drive, which runs in the middle of an evaluation",
                "what a drive may do",
                "see docs/minds.md",
            )

    def _place(self, part: str, name: str) -> int:
        place: int = self._steps.place(part, name)
        return place
