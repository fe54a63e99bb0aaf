"""What views ask of a hierarchy that was evaluated."""

from __future__ import annotations

from typing import Protocol

from socialmind.mind.description import MindDescription


class Evaluated(Protocol):
    """What can be looked at: a `Hierarchy`, or an agent's in a model; methods as of `Hierarchy`."""

    @property
    def skills(self) -> tuple[str, ...]:
        """The names of the evaluated skills, from the master down."""

    @property
    def tick(self) -> int:
        """How many evaluations there were."""

    description: MindDescription

    def influences(self) -> dict[str, float]:
        """Return the influence that each skill received."""

    def links(self) -> dict[tuple[str, str], float]:
        """Return what each output transmitted."""

    def outputs(self) -> dict[tuple[str, str], float]:
        """Return what each output's function gave."""

    def sensors(self) -> dict[str, float]:
        """Return the sensors' values."""

    def variables(self) -> dict[str, float]:
        """Return the variables' values."""

    def actuators(self) -> dict[str, float]:
        """Return the actuators' commands."""


class Explained(Evaluated, Protocol):
    """What can be explained as well: a `Hierarchy`."""

    master: str

    def drive_commands(self) -> dict[str, tuple[float, float]]:
        """Return what the drive adds to each variable: weighted commands, and their weight."""
