"""The state of one agent's hierarchy in a running model, as drawings read it."""

from __future__ import annotations

from typing import TYPE_CHECKING

from socialmind.mind.kernel.layout import OBSERVED

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from socialmind.mind.evaluation.arrays import Assembly
    from socialmind.mind.population_minds import PopulationMinds


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


class AgentState:
    """What the hierarchy of an agent of a population is in; methods as of `Hierarchy`.

    Args:
        minds: the population's.
        slot: the agent's place in the population's arrays.
    """

    def __init__(self, minds: PopulationMinds, slot: int) -> None:
        self._minds = minds
        self._slot = slot
        self.description = minds.assembly.description

    @property
    def skills(self) -> tuple[str, ...]:
        """The names of the evaluated skills, from the master down."""
        return self._minds.assembly.skills

    @property
    def tick(self) -> int:
        """How many evaluations there were; 0 for an agent before its first."""
        state = self._minds.state
        return 0 if state.fresh[self._slot, 0] else max(int(state.clock[self._slot]), 1)

    def influences(self) -> dict[str, float]:
        """Return the sum of the influence that each skill received in the last evaluation."""
        return self._named(self.skills, self._minds.state.totals)

    def links(self) -> dict[tuple[str, str], float]:
        """Return what each output of a skill transmitted, by the skill and the output's text."""
        return dict(zip(self._entries(), self._values(self._minds.state.sent), strict=True))

    def outputs(self) -> dict[tuple[str, str], float]:
        """Return what each skill's function gave by itself."""
        return dict(zip(self._entries(), self._values(self._minds.state.output), strict=True))

    def sensors(self) -> dict[str, float]:
        """Return the sensors' values of the last evaluation."""
        return self._named(tuple(self.description.sensors), self._minds.state.sensors)

    def variables(self) -> dict[str, float]:
        """Return the variables' values."""
        return self._named(tuple(self.description.variables), self._minds.state.values)

    def actuators(self) -> dict[str, float]:
        """Return the actuators' commands of the last evaluation."""
        return self._named(tuple(self.description.actuators), self._minds.state.actuators)

    def _values(self, array: NDArray) -> list[float]:
        values: list[float] = array[self._slot, :, 0].tolist()
        return values

    def _named(self, names: tuple[str, ...], array: NDArray) -> dict[str, float]:
        return dict(zip(names, self._values(array), strict=True))

    def _entries(self) -> list[tuple[str, str]]:
        skills = self.description.skills
        return [(name, str(output)) for name in self.skills for output in skills[name].outputs]
