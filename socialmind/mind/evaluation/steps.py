"""The evaluation of one agent after another, with programs that Python runs.

The arithmetic is the compiled one, step by step (`kernel`); programmed functions, regulations and
the drive are called between the steps as ordinary Python, so that a debugger can stop in them.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from functools import cache
from typing import Any

from coglogo_py import Society
from socialmind.compiling.modules import compiled_module
from socialmind.errors import ModelError
from socialmind.mind.code.drive import AgentHierarchy, tables_of
from socialmind.mind.code.steps_text import steps_text
from socialmind.mind.evaluation.arrays import Assembly
from socialmind.mind.evaluation.state import Record
from socialmind.mind.functions.cogniton_scheme import CognitonScheme
from socialmind.mind.functions.programmed import Programmed
from socialmind.mind.kernel.layout import State
from socialmind.mind.modules import Skill
from socialmind.mind.names import unknown
from socialmind.mind.regulation import Regulated


@cache
def compiled_steps() -> Any:
    """Return the compiled steps of an evaluation, which are the same for all minds."""
    return compiled_module(steps_text(), {})


class Steps:
    """Evaluates agents of one hierarchy, each a block of one lane.

    Args:
        assembly: the hierarchy.
        record: where its arrays are.
        programs: the function of each program, as the assembly numbers them.
        regulations: the function of each of the modeller's regulations.
        drive: the drive, or None.
        tick: gives the tick, by which shared variables know a new one.
    """

    def __init__(
        self,
        assembly: Assembly,
        record: Record,
        programs: Sequence[Callable[..., Any]],
        regulations: Sequence[Callable[..., Any]],
        drive: Callable[..., None] | None,
        tick: Callable[[], int],
    ) -> None:
        self.assembly = assembly
        self.address = record.address
        self.drive = drive
        self.tick = tick
        self.module = compiled_steps()
        self.state: State
        self.societies: tuple[Society, ...] = ()
        self._places = tables_of(assembly)
        variables = list(assembly.description.variables.values())
        self._regulated = [
            (place, one, regulations[assembly.regulations.index(one.regulation)])
            for place, one in enumerate(variables)
            if isinstance(one.regulation, Regulated)
        ]
        skills = [assembly.description.skills[name] for name in assembly.skills]
        self._skills = [(number, skill) for number, skill in enumerate(skills)]
        self._functions = {
            number: programs[assembly.structure.skill_number[number]]
            for number, skill in self._skills
            if isinstance(skill.function, Programmed)
        }

    def connect(self, state: State, societies: tuple[Society, ...]) -> None:
        """Take the arrays of the agents."""
        self.state = state
        self.societies = societies

    def place(self, part: str, name: str) -> int:
        """Return the number of a module.

        Raises:
            ModelError: there is none of this name.
        """
        known = self._places[part]
        if name not in known:
            raise unknown(part, name, known)
        return known[name]

    def evaluate(self, agent: int) -> None:
        """Evaluate an agent once (thesis, figure 5.4).

        Raises:
            ValueError: a sensor is outside [0, 1], or a program gave no number.
        """
        module, address = self.module, self.address
        self.state.now[0] = self.tick()
        module.begin(address, agent)
        for place, variable, function in self._regulated:
            self._regulate(agent, place, variable, function)
        module.show_variables(address, agent)
        if self.drive is not None:
            self.drive(AgentHierarchy(self, agent, driven=True))
        for number, skill in self._skills:
            if not module.receive(address, agent, number):
                continue
            if number in self._functions:
                self._run(skill, self._functions[number])
            elif isinstance(skill.function, CognitonScheme):
                self._decide(agent, skill, skill.function)
            module.transmit(address, agent, number)
        module.end(address, agent)

    def restart(self, agent: int) -> None:
        """Put an agent back to before its first evaluation."""
        self.module.restart(self.address, agent)
        for society in self.societies:
            mind = society.mind_in(agent)
            mind.leave_all_groups()
            society.minds.values[agent] = society.arrays.start

    def _run(self, skill: Skill, function: Callable[..., Any]) -> None:
        nodes = self.state.nodes[0, :, 0]
        inputs = nodes[: len(skill.inputs)].tolist()
        program: Any = skill.function
        results = function(inputs) if program.takes_array else function(*inputs)
        values = list(results) if hasattr(results, "__len__") else [results]
        if len(values) != len(skill.outputs):
            raise skill.refused(
                f"whose function {program.name}() returned {results!r}",
                f"{len(skill.outputs)} numbers, one for each output",
            )
        nodes[len(inputs) : len(inputs) + len(values)] = [
            _held(value, program.name, skill) for value in values
        ]

    def _decide(self, agent: int, skill: Skill, function: CognitonScheme) -> None:
        nodes = self.state.nodes[0, :, 0]
        mind = self.societies[self.assembly.schemes.index(skill.name)].mind_in(agent)
        for cogniton, value in zip(function.cognitons_of(skill), nodes.tolist(), strict=False):
            mind.set_cogniton_value(cogniton, value)
        plan = mind.choose_next_plan()
        for place, output in enumerate(skill.outputs):
            nodes[len(skill.inputs) + place] = float(output.name == plan)

    def _regulate(
        self, agent: int, place: int, variable: Any, function: Callable[..., Any]
    ) -> None:
        state = self.state
        command = self.module.command_of(self.address, agent, place)
        commanded = not math.isnan(command)
        if commanded:
            state.command[agent, place, 0] = command
        latest = state.command.item(agent, place, 0)
        known = {
            "command": 0.0 if math.isnan(latest) else latest,
            "value": state.values.item(agent, place, 0),
            "memory": state.memory.item(agent, place, 0),
            "commanded": commanded,
        }
        found = function(*(known[name] for name in variable.regulation.takes))
        value, memory = found if isinstance(found, tuple) else (found, known["memory"])
        state.values[agent, place, 0] = _held(value, function.__name__, variable)
        state.memory[agent, place, 0] = memory


def _held(value: Any, function: str, owner: Any) -> float:
    """Return what a modeller's function gave, held to [0, 1]."""
    try:
        number = float(value)
    except (TypeError, ValueError):
        number = math.nan
    if math.isnan(number):
        raise ModelError(
            f"{value!r} from {function}() in {owner.name!r}", "a number, 0 … 1",
            file=owner.file, line=owner.line,
        )  # fmt: skip
    return min(max(number, 0.0), 1.0)
