"""What a step of a tutorial wants to see in a scheme that is edited, and what it says if not.

A goal is data with one method, `missing(parts)`: None when it is met, else a sentence that says
what to do. `Parts.superfluous` finds what no goal wants: a slip of the mouse is told as well as
what lacks.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import Any

Document = Mapping[str, Any]
"""A scheme as `socialmind.studio.schemes.document` has it."""
WEIGHTED = ("influence", "reinforcement")


class Parts:
    """The parts of a document by their names.

    Args:
        document: a scheme as the editor has it.
    """

    def __init__(self, document: Document) -> None:
        self.name: str = document["name"]
        self.maker: str = document["decision_maker"]["name"]
        names = {one["id"]: one["name"] for one in document["plans"]}
        self.plans = tuple(names.values())
        self.cognitons = {one["name"]: one for one in document["cognitons"]}
        self.groups = tuple(one["name"] for one in document["groups"])
        self.links: dict[tuple[str, str, str], float | None] = {}
        """Kind, cogniton, plan: the weight; None of a conditional link."""
        for cogniton in document["cognitons"]:
            for kind in WEIGHTED:
                for plan, weight in cogniton[kind]:
                    self.links[kind, cogniton["name"], names[plan]] = weight
            for plan in cogniton["conditional"]:
                self.links["conditional", cogniton["name"], names[plan]] = None

    def superfluous(self, goals: Iterable[object]) -> list[str]:
        """Return a sentence for each part that no goal wants.

        Args:
            goals: all that is wanted.
        """
        wanted = tuple(goals)
        plans = {one.name for one in wanted if isinstance(one, Plan)}
        cognitons = {one.name for one in wanted if isinstance(one, Cogniton)}
        links = {(one.kind, one.cogniton, one.plan) for one in wanted if isinstance(one, Link)}
        named = [("plan", name) for name in self.plans if name not in plans]
        named += [("cogniton", name) for name in self.cognitons if name not in cognitons]
        named += [("group", name) for name in self.groups]
        said = [
            f"The {kind} {name!r} is not wanted here: delete or rename it." for kind, name in named
        ]
        return said + [
            f"The {kind} link between {cogniton} and {plan} is not wanted here: delete it."
            for kind, cogniton, plan in self.links
            if (kind, cogniton, plan) not in links and cogniton in cognitons and plan in plans
        ]


@dataclass(frozen=True)
class Called:
    """The scheme has a name."""

    name: str

    @property
    def subject(self) -> object:
        """What it is about."""
        return "name"

    def missing(self, parts: Parts) -> str | None:
        """Return what to do; None when it is met."""
        if parts.name == self.name:
            return None
        return f"The scheme is called {parts.name!r}: call it {self.name!r}."


@dataclass(frozen=True)
class Decides:
    """The scheme has a decision maker."""

    maker: str

    @property
    def subject(self) -> object:
        """What it is about."""
        return "decision maker"

    def missing(self, parts: Parts) -> str | None:
        """Return what to do; None when it is met."""
        if parts.maker == self.maker:
            return None
        return f"{parts.maker} decides: choose {self.maker}."


@dataclass(frozen=True)
class Plan:
    """There is a plan."""

    name: str

    @property
    def subject(self) -> object:
        """What it is about."""
        return ("plan", self.name)

    def missing(self, parts: Parts) -> str | None:
        """Return what to do; None when it is met.

        >>> empty = {"name": "s", "decision_maker": {"name": "MaximumWeight"}, "plans": [],
        ...          "cognitons": [], "groups": []}
        >>> Plan("eat").missing(Parts(empty))
        "There is no plan 'eat' yet."
        """
        return None if self.name in parts.plans else f"There is no plan {self.name!r} yet."


@dataclass(frozen=True)
class Cogniton:
    """There is a cogniton with a start value, active at birth."""

    name: str
    start: float = 0.0

    @property
    def subject(self) -> object:
        """What it is about."""
        return ("cogniton", self.name)

    def missing(self, parts: Parts) -> str | None:
        """Return what to do; None when it is met."""
        one = parts.cognitons.get(self.name)
        if one is None:
            return f"There is no cogniton {self.name!r} yet."
        if one["start"] != self.start:
            return f"{self.name} starts at {one['start']:g}: let it start at {self.start:g}."
        if not one["starting"]:
            return f"{self.name} is not there at birth: tick 'at birth'."
        return None


@dataclass(frozen=True)
class Link:
    """There is a link between a cogniton and a plan.

    Attributes:
        kind: influence, conditional or reinforcement.
        cogniton: a cogniton's name.
        plan: a plan's name.
        weight: its weight; None of a conditional link.
    """

    kind: str
    cogniton: str
    plan: str
    weight: float | None = None

    @property
    def subject(self) -> object:
        """What it is about."""
        return (self.kind, self.cogniton, self.plan)

    def missing(self, parts: Parts) -> str | None:
        """Return what to do; None when it is met."""
        key = (self.kind, self.cogniton, self.plan)
        to = f"from {self.plan} to {self.cogniton}"
        if self.kind != "reinforcement":
            to = f"from {self.cogniton} to {self.plan}"
        if key not in parts.links:
            return f"There is no {self.kind} link {to} yet."
        weight = parts.links[key]
        if weight != self.weight:
            return f"The {self.kind} link {to} weighs {weight:g}: let it weigh {self.weight:g}."
        return None
