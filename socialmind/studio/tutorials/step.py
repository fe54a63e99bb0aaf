"""A tutorial: steps in order, each with its words and its goals; and how far somebody has come."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from socialmind.studio.tutorials.goals import Document, Goal, Parts, superfluous


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
    """Steps beside the editor of schemes.

    Attributes:
        word: in addresses.
        title: for the reader.
        about: a sentence.
        model: the model that runs with the scheme.
        population: whose minds it is.
        steps: in order.
        begins: whether it begins with the scheme of the model; with an empty one otherwise.
        measure: the column of the series that is shown.
        ticks: how many ticks are shown.
    """

    word: str
    title: str
    about: str
    model: str
    population: str
    steps: tuple[Step, ...]
    begins: bool = False
    measure: str = ""
    ticks: int = 1000

    def to_json(self) -> dict[str, Any]:
        """Return it as the page has it, without what is checked."""
        steps = [
            {"title": one.title, "says": one.says, "hint": one.hint, "shows": one.shows}
            for one in self.steps
        ]
        told = ("word", "title", "about", "model", "population", "begins", "measure", "ticks")
        return {**{name: getattr(self, name) for name in told}, "steps": steps}

    def missing(self, document: Document, step: int) -> list[str]:
        """Say what is missing at a step, and what is there that no step wants.

        What steps before wanted has to be there still; a goal of a later step about the same
        thing takes the place of that of an earlier one. Who is ahead is not held back.

        Args:
            document: the scheme as it is edited.
            step: the number of the step, from 0 on.

        Returns:
            Sentences; none when the step is done.
        """
        parts = Parts(document)
        goals = self.goals_of(step)
        lacking = [said for one in goals if (said := one.missing(parts)) is not None]
        return lacking + superfluous(parts, self.goals_of(len(self.steps) - 1))

    def goals_of(self, step: int) -> tuple[Goal, ...]:
        """Return all that is wanted by the end of a step.

        Args:
            step: its number, from 0 on.
        """
        wanted: dict[object, Goal] = {}
        for one in self.steps[: step + 1]:
            wanted |= {_subject(goal): goal for goal in one.goals}
        return tuple(wanted.values())


def _subject(goal: Any) -> object:
    """What a goal is about, without its number."""
    told = (getattr(goal, name, None) for name in ("kind", "cogniton", "plan"))
    name = getattr(goal, "name", None)
    return (type(goal).__name__, name if type(goal).__name__ != "Called" else "", *told)
