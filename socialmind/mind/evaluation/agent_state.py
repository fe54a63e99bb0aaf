"""The state of one agent's hierarchy in a running model, as drawings read it."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Iterable
from typing import TYPE_CHECKING, TypeVar

from socialmind.mind.kernel.layout import OBSERVED

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from socialmind.mind.contract import SkillMinds
    from socialmind.mind.description import MindDescription
    from socialmind.mind.evaluation.arrays import Assembly
    from socialmind.mind.evaluation.state import State

Name = TypeVar("Name")


def observe(assembly: Assembly) -> None:
    """Have the outputs of skills without influence worked out too, for who looks at them.

    Nothing else changes: commands, variables and what skills remember stay the same.

    Args:
        assembly: of a model that has not begun to run.
    """
    sizes = assembly.structure.sizes
    # It is read where it lies; nothing else may change in a structure once minds refer to it.
    sizes.setflags(write=True)
    sizes[OBSERVED] = 1
    sizes.setflags(write=False)


class Readings(ABC):
    """What the last evaluation of one agent's hierarchy came to."""

    assembly: Assembly
    description: MindDescription
    _slot = 0

    @property
    @abstractmethod
    def _read(self) -> State:
        """The arrays that hold it, in the agent's slot."""

    @property
    @abstractmethod
    def tick(self) -> int:
        """How many evaluations there were; 0 before the first."""

    @property
    def skills(self) -> tuple[str, ...]:
        """The names of the skills that are evaluated, from the master down."""
        return self.assembly.skills

    def influences(self) -> dict[str, float]:
        """Return the sum of the influence that each skill received in the last evaluation."""
        return self._named(self.skills, self._read.totals)

    def links(self) -> dict[tuple[str, str], float]:
        """Return what each output of a skill transmitted: its value times the influence (eq. 4.2).

        Returns:
            By the skill and the output's text, as in `("Collect", "SK:Avoid")`.
        """
        return self._named(self._entries(), self._read.sent)

    def outputs(self) -> dict[tuple[str, str], float]:
        """Return what each skill's function gave by itself, V_O of equation 4.1."""
        return self._named(self._entries(), self._read.output)

    def inputs(self, skill: str) -> dict[str, float]:
        """Return what a skill read in the last evaluation, by its inputs' texts.

        Args:
            skill: one that is evaluated (`skills`).
        """
        structure, number = self.assembly.structure, self.skills.index(skill)
        begin, end = structure.input_begin[number : number + 2]
        read = self._read.signals[self._slot, structure.input_signal[begin:end], 0]
        texts = [str(one) for one in self.description.skills[skill].inputs]
        return dict(zip(texts, read.tolist(), strict=True))

    def sensors(self) -> dict[str, float]:
        """Return the sensors' values of the last evaluation."""
        return self._named(self.description.sensors, self._read.sensors)

    def variables(self) -> dict[str, float]:
        """Return the variables' values."""
        return self._named(self.description.variables, self._read.values)

    def actuators(self) -> dict[str, float]:
        """Return the actuators' commands of the last evaluation."""
        return self._named(self.description.actuators, self._read.actuators)

    def drive_commands(self) -> dict[str, tuple[float, float]]:
        """Return what the drive adds to each variable: weighted commands, and their weight."""
        # Its commands to actuators stand after those to variables.
        commands, weights = (
            array[self._slot, :, 0].tolist()
            for array in (self._read.drive_command, self._read.drive_weight)
        )
        return dict(
            zip(self.description.variables, zip(commands, weights, strict=True), strict=False)
        )

    def _named(self, names: Iterable[Name], array: NDArray) -> dict[Name, float]:
        return dict(zip(names, array[self._slot, :, 0].tolist(), strict=True))

    def _entries(self) -> list[tuple[str, str]]:
        skills = self.description.skills
        return [(name, str(output)) for name in self.skills for output in skills[name].outputs]


class AgentState(Readings):
    """What the hierarchy of an agent of a population is in.

    Args:
        minds: the population's.
        slot: the agent's place in the population's arrays.
    """

    def __init__(self, minds: SkillMinds, slot: int) -> None:
        self._minds = minds
        self._slot = slot
        self.assembly = minds.assembly
        self.description = minds.assembly.description

    @property
    def _read(self) -> State:
        return self._minds.state

    @property
    def tick(self) -> int:
        """How many evaluations there were; 0 for an agent before its first."""
        state = self._read
        return 0 if state.fresh[self._slot, 0] else max(int(state.clock[self._slot]), 1)
