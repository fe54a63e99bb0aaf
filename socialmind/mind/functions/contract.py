"""The contract of internal functions: inputs in, outputs in [0, 1], a flat genome or none.

An internal function is a description: it is told how many inputs and outputs its skill has and
says what it computes. The weights are not part of it, they are the skill's genome.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, ClassVar

if TYPE_CHECKING:  # a circle for types alone: a skill has a function, which checks the skill
    from socialmind.mind.functions.network import Network
    from socialmind.mind.modules import Skill


class InternalFunction:
    """The base of all internal functions.

    Attributes:
        keyword: its name in `.ades` files and in YAML.
    """

    keyword: ClassVar[str]

    def check(self, skill: Skill) -> None:
        """Refuse a skill that the function does not fit.

        Raises:
            ModelError: so it is; the error names the skill, its file and line.
        """

    def genome_size(self, inputs: int, outputs: int) -> int:
        """Return how many weights it has, 0 for none."""
        network = self.network(inputs, outputs)
        return 0 if network is None else network.genome_size

    def network(self, inputs: int, outputs: int) -> Network | None:
        """Return what it computes as steps of arithmetic; None for programs and schemes."""
        return None
