"""A tutorial: steps in order, each with its words and its goals; and how far somebody has come."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from typing import Any, Protocol

Document = Mapping[str, Any]
"""What is edited, as its editor has it."""
Courses = Mapping[str, Any]
"""What was seen over time: `ticks`, and `courses` with values at these ticks for each `name`."""


class Parts(Protocol):
    """The parts of a document, by their names."""

    def superfluous(self, goals: Iterable[Any]) -> list[str]:
        """Return a sentence for each part that no goal wants."""


class Goal(Protocol):
    """Something that a step wants to see."""

    @property
    def subject(self) -> object:
        """What it is about: a later goal about the same takes its place."""

    def missing(self, parts: Any) -> str | None:
        """Return what to do; None when it is met."""


@dataclass(frozen=True)
class Step:
    """One step.

    Attributes:
        title: a few words.
        says: paragraphs: what is to be done, and why.
        hint: how it is done with the keys and the mouse.
        goals: what is checked; none for a step that is read.
        shows: whether what the minds do is shown at this step.
    """

    title: str
    says: tuple[str, ...]
    hint: str = ""
    goals: tuple[Goal, ...] = ()
    shows: bool = False


@dataclass(frozen=True)
class Tutorial:
    """Steps beside an editor.

    Attributes:
        word: in addresses.
        title: for the reader.
        about: a sentence.
        editor: the room whose editor it is: `mind` (schemes) or `skills`.
        parts: makes the parts of a document of that editor.
        courses: what the mind of a document does.
        measure: what the courses are of.
        steps: in order.
        model: of schemes: the model that runs with it.
        population: of schemes: whose minds it is.
        begins: of schemes: whether it begins with that of the model; with an empty one otherwise.
    """

    word: str
    title: str
    about: str
    editor: str
    parts: Callable[[Document], Parts]
    courses: Callable[[Document], Courses]
    measure: str
    steps: tuple[Step, ...]
    model: str = ""
    population: str = ""
    begins: bool = False

    def to_json(self) -> dict[str, Any]:
        """Return it as the page has it, without what is checked."""
        steps = [
            {"title": one.title, "says": one.says, "hint": one.hint, "shows": one.shows}
            for one in self.steps
        ]
        told = ("word", "title", "about", "editor", "measure", "model", "population", "begins")
        return {**{name: getattr(self, name) for name in told}, "steps": steps}

    def missing(self, document: Document, step: int) -> list[str]:
        """Say what is missing at a step, and what is there that no step wants.

        What steps before wanted has to be there still; a goal of a later step about the same
        thing takes the place of that of an earlier one. Who is ahead is not held back.

        Args:
            document: the mind as it is edited.
            step: the number of the step, from 0 on.

        Returns:
            Sentences; none when the step is done.
        """
        parts = self.parts(document)
        goals = self.goals_of(step)
        lacking = [said for one in goals if (said := one.missing(parts)) is not None]
        return lacking + parts.superfluous(self.goals_of(len(self.steps) - 1))

    def goals_of(self, step: int) -> tuple[Goal, ...]:
        """Return all that is wanted by the end of a step.

        Args:
            step: its number, from 0 on.
        """
        wanted: dict[object, Goal] = {}
        for one in self.steps[: step + 1]:
            wanted |= {goal.subject: goal for goal in one.goals}
        return tuple(wanted.values())
