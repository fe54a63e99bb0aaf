"""A skill of a running hierarchy: what it is, and its genome to read and set."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from coglogo_py.border.closed import Closed
from socialmind.errors import ModelError
from socialmind.mind.modules import Skill

if TYPE_CHECKING:  # a circle for types alone: a hierarchy gives its skills, to be set in it
    from coglogo_py import Mind
    from socialmind.mind.functions.contract import InternalFunction
    from socialmind.mind.hierarchy import Hierarchy


class RunningSkill(Closed):
    """A skill of a running hierarchy."""

    def __init__(self, hierarchy: Hierarchy, name: str) -> None:
        self._hierarchy = hierarchy
        self.name = name
        self._closed = True

    @property
    def description(self) -> Skill:
        """The skill as it is described, with its genome as it is set."""
        return self._hierarchy.description.skills[self.name].changed(genome=self.genome)

    @property
    def inputs(self) -> tuple[str, ...]:
        """What it reads, as texts."""
        return tuple(str(one) for one in self._hierarchy.description.skills[self.name].inputs)

    @property
    def outputs(self) -> tuple[str, ...]:
        """Where its function's results go, as texts."""
        return tuple(str(one) for one in self._hierarchy.description.skills[self.name].outputs)

    @property
    def function(self) -> InternalFunction:
        """Its internal function."""
        return self._hierarchy.description.skills[self.name].function

    @property
    def genome(self) -> NDArray[np.float64] | None:
        """Its weights, read-only; None where they are not set or it has none."""
        return self._hierarchy.genome(self.name)

    @genome.setter
    def genome(self, weights: Any) -> None:
        self._hierarchy.set_genome(self.name, weights)

    @property
    def mind(self) -> Mind:
        """The cogniton mind of a skill whose function is a cogniton scheme.

        Raises:
            ModelError: it is none.
        """
        hierarchy = self._hierarchy
        if self.name not in hierarchy.assembly.schemes:
            raise ModelError(
                f"the mind of the skill {self.name!r}, which is {self.function}",
                "a skill with a cogniton scheme",
            )
        return hierarchy._societies[hierarchy.assembly.schemes.index(self.name)].mind_in(0)

    def __repr__(self) -> str:
        return f"<skill {self.name!r}: {self.function}>"
