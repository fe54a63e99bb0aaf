"""What a step of a tutorial wants to see in a hierarchy of skills that is being edited.

Goals are as those of schemes (`goals`); the parts are those of a mind's document.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

from socialmind.studio.tutorials.step import Document

WORDS = {"sensors": "sensor", "actuators": "motor", "variables": "variable", "skills": "skill"}
"""The lists of a document, and what one in it is called on the page."""


class MindParts:
    """The parts of a mind's document by their names.

    Args:
        document: a mind as `socialmind.studio.skills.document` has it.
    """

    def __init__(self, document: Document) -> None:
        self.named = {(what, one["name"]) for what in WORDS for one in document[what]}
        self.skills = {one["name"]: one for one in document["skills"]}
        self.links = [
            (skill, to)
            for skill, one in self.skills.items()
            for to in (*one["inputs"], *one["outputs"])
        ]

    def superfluous(self, goals: Iterable[object]) -> list[str]:
        """Return a sentence for each part that no goal wants.

        Args:
            goals: all that is wanted.
        """
        wanted = tuple(goals)
        named = {(one.what, one.name) for one in wanted if isinstance(one, Module)}
        return [
            f"The {WORDS[what]} {name!r} is not wanted here: delete or rename it."
            for what, name in sorted(self.named - named)
        ]


@dataclass(frozen=True)
class Module:
    """There is a sensor, a motor or a skill.

    Attributes:
        what: the list of the document that it is in.
        name: its name.
    """

    what: str
    name: str

    @property
    def subject(self) -> object:
        """What it is about."""
        return (self.what, self.name)

    def missing(self, parts: MindParts) -> str | None:
        """Return what to do; None when it is met.

        >>> empty = {"sensors": [], "actuators": [], "variables": [], "skills": []}
        >>> Module("actuators", "WHEEL").missing(MindParts(empty))
        "There is no motor 'WHEEL' yet."
        """
        if (self.what, self.name) in parts.named:
            return None
        return f"There is no {WORDS[self.what]} {self.name!r} yet."


@dataclass(frozen=True)
class Wired:
    """A skill reads one sensor and commands one motor, and nothing else.

    Attributes:
        skill: its name.
        sensor: what it reads.
        motor: what it commands.
    """

    skill: str
    sensor: str
    motor: str

    @property
    def subject(self) -> object:
        """What it is about."""
        return ("wired", self.skill)

    def missing(self, parts: MindParts) -> str | None:
        """Return what to do; None when it is met."""
        one = parts.skills.get(self.skill)
        if one is None:
            return None  # said by another goal
        for there, wanted, does in (
            (one["inputs"], f"SE:{self.sensor}", "read"),
            (one["outputs"], f"MO:{self.motor}", "command"),
        ):
            if wanted not in there:
                return f"{self.skill} does not {does} {wanted[3:]} yet: draw a link between them."
            if len(there) > 1:
                other = next(one for one in there if one != wanted)
                return f"{self.skill} is to {does} {wanted[3:]} alone: take {other} out."
        return None


@dataclass(frozen=True)
class Plain:
    """A skill's network has no hidden layer: each output is a weighted sum of the inputs.

    Attributes:
        skill: its name.
    """

    skill: str

    @property
    def subject(self) -> object:
        """What it is about."""
        return ("plain", self.skill)

    def missing(self, parts: MindParts) -> str | None:
        """Return what to do; None when it is met."""
        one = parts.skills.get(self.skill)
        if one is None:
            return None
        lines = dict(line.upper().partition(":")[::2] for line in one["lines"])
        if one["function"] != "neural" or lines.get("TYPE", "BASIC") != "BASIC":
            return f"Inside {self.skill} is to be a perceptron: choose it as the function."
        if lines.get("LAYERS", "2").strip() != "0":
            return f"{self.skill} has hidden layers: let it have 0."
        return None
