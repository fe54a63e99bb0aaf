"""What a population asks of the minds of its agents, in the arrays that hold all of them.

There are three kinds: cognitons alone (`CognitonMinds`), a hierarchy of skills alone
(`SkillMinds`), and both, where the hierarchy weighs the plans of the cognitons or stands beside
them. Either side has room to be made, births, copies of a parent, and a state to keep; who lives
is told to it, and what the agent does is asked of it, agent by agent.

`coglogo_py.Society` and `PopulationMinds` meet these; another kind of mind has to as well.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any, Protocol, runtime_checkable

from numpy.typing import NDArray

from coglogo_py.arrays import MindArrays, SchemeArrays
from coglogo_py.mind import Mind
from coglogo_py.names import Names
from coglogo_py.scheme import CognitiveScheme
from socialmind.mind.code.drive import AgentHierarchy
from socialmind.mind.evaluation.arrays import Assembly
from socialmind.mind.evaluation.state import Record, State
from socialmind.mind.evaluation.steps import Steps

if TYPE_CHECKING:
    from coglogo_py import Society
    from socialmind.mind.population_minds import PopulationMinds

Arrays = Mapping[str, NDArray[Any]]


@runtime_checkable
class CognitonMinds(Protocol):
    """Cogniton minds, which have slots of their own: populations with one scheme share them."""

    scheme: CognitiveScheme
    names: Names
    arrays: SchemeArrays
    """The scheme's, for compiled rules."""
    minds: MindArrays
    """All minds', for compiled rules; others once there was made room."""

    def new_minds(self, count: int) -> NDArray[Any]:
        """Make the minds of founders, and return their slots."""

    def new_mind(self) -> Mind:
        """Make the mind of one who is born; one that is its parent's copy, `Mind.hatch` makes."""

    def mind_in(self, slot: int) -> Mind:
        """Return the living mind in a slot; `Mind.die` takes it out."""

    def reserve(self, count: int) -> None:
        """Make room for so many more."""

    def state(self) -> dict[str, NDArray[Any]]:
        """Return copies of all that changes."""

    def restore(self, state: Arrays) -> None:
        """Go back to what `state` returned."""


@runtime_checkable
class SkillMinds(Protocol):
    """Hierarchies of skills, each in its agent's own slot."""

    assembly: Assembly
    state: State
    """All agents', for drawings and observation."""
    record: Record
    """Where the arrays are, for compiled rules."""

    @property
    def bytes(self) -> int:
        """How much memory the arrays take."""

    @property
    def stepping(self) -> Steps:
        """The evaluation of one agent after another, for interpreted rules."""

    def compile(self) -> None:
        """Make ready for compiled runs."""

    def begin(self, slot: int) -> None:
        """Begin the life of who is born in a slot, whoever was there before."""

    def copy(self, parent: int, child: int) -> None:
        """Make who is born in a slot its parent's copy."""

    def grow(self, capacity: int) -> None:
        """Make room for so many slots."""

    def of(self, slot: int) -> AgentHierarchy:
        """Return the hierarchy of the agent in a slot, as rules see it."""

    def set_genome(self, skill: str, genome: Any, slots: NDArray[Any] | None = None) -> None:
        """Set a skill's weights, for all or for some slots."""

    def snapshot(self) -> dict[str, NDArray[Any]]:
        """Return copies of all that changes."""

    def restore(self, arrays: Arrays) -> None:
        """Go back to what `snapshot` returned."""


if TYPE_CHECKING:

    def _met(society: Society, minds: PopulationMinds) -> tuple[CognitonMinds, SkillMinds]:
        return society, minds
