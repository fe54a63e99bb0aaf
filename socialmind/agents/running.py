"""What the rooms below ask of a running society: the part of `socialmind.Model` that they know."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, Protocol

from numpy.typing import NDArray

from socialmind.agents.events import Events
from socialmind.language.program import Program
from socialmind.language.shape import ModelShape


class Running(Protocol):
    """A society that runs.

    Attributes:
        seed: the key of its draws.
        physics: what moves bodies in its world.
        contexts: its record, an array of one: parameters, variables, and where its arrays are.
        context: the record itself.
        tables: its populations and networks, by name.
        schemes: the schemes of those with cogniton minds.
        conditioned: the populations whose schemes have conditions.
        assemblies: the hierarchies of those with skills, laid out.
        names: where in them the names stand that rules write, by population.
        program: its typed rules.
        ground: its world.
        engine: what runs it.
        stream: the state of its compiled draws.
        connected: the arrays, or tuples of them, whose addresses the record holds.
        watch: the population and identity of an agent whose decision is to be explained.
        watched: the receipt of that decision.
        event_log: births and deaths, where somebody asked for them.
    """

    seed: int
    physics: str
    record: Any
    contexts: NDArray[Any]
    context: Any
    tables: dict[str, Any]
    schemes: dict[str, Any]
    conditioned: tuple[str, ...]
    assemblies: dict[str, Any]
    names: dict[str, NDArray[Any]]
    program: Program
    ground: Any
    engine: Any
    stream: NDArray[Any]
    connected: list[Any]
    watch: tuple[str, int] | None
    watched: Any
    event_log: Events

    @property
    def name(self) -> str:
        """The model's name."""

    @property
    def shape(self) -> ModelShape:
        """What its rules may read and write."""

    @property
    def populations(self) -> Mapping[str, Any]:
        """What was declared of its populations."""

    @property
    def networks(self) -> Mapping[str, Any]:
        """What was declared of its networks."""

    @property
    def interruptions(self) -> Mapping[str, Any]:
        """What ends an episode, by name."""

    @property
    def tick(self) -> int:
        """How many ticks have run."""

    @property
    def over(self) -> str | None:
        """What ended it; None while it goes on."""

    @property
    def minded(self) -> bool:
        """Whether robots have minds."""

    def plans(self, table: Any) -> list[str | None]:
        """Return the names of the plans of a population's living."""

    def state(self) -> dict[str, NDArray[Any]]:
        """Return copies of all arrays that change in a run."""

    def restore(self, state: Mapping[str, NDArray[Any]]) -> None:
        """Take back the arrays of a state."""

    def fresh(self) -> Any:
        """Return the same society before its first tick."""
