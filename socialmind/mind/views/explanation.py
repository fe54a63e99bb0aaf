"""The account of an evaluation: who influenced whom, and how much that counted in each command.

Influence flows from the master's impulse down to actuators and variables. Of the weight that an
actuator's command rests on (the lower sum of equation 4.3) each skill that commands it holds a
share; a complex skill holds the share that flows along paths through it. What no skill accounts
for is the drive's.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

from socialmind.errors import ModelError
from socialmind.mind.views.explanation_table import table

if TYPE_CHECKING:
    from pandas import DataFrame

    from socialmind.mind.hierarchy import Hierarchy

IMPULSE = "(impulse)"
"""What the master receives, 1.0, in place of the influence of a skill."""
DRIVE = "(drive)"
"""What the drive module adds, in place of a skill."""

_ROUNDING = 1e-12
"""Differences below this come from the order of sums, not from a drive."""


@dataclass(frozen=True)
class Received:
    """A part of the influence that a skill received."""

    source: str
    """The skill it came from, `IMPULSE` or `DRIVE`."""
    influence: float
    """How much, 0 or more."""


@dataclass(frozen=True)
class Influence:
    """The influence that one skill received."""

    skill: str
    total: float
    """The sum, 0 or more."""
    received: tuple[Received, ...]
    """The impulse, the skills above by name, the drive."""


@dataclass(frozen=True)
class Part:
    """What one skill's own command counts in an actuator or a variable."""

    skill: str
    output: float
    """What its function gave by itself, 0 … 1 (V_O of equation 4.1)."""
    weight: float
    """The sum of the influence it received, which the output is weighted by."""
    percent: float
    """The weight's share of the whole weight, 0 … 100; 0 where there is none."""


@dataclass(frozen=True)
class Passage:
    """How much of the weight of a command came through one complex skill, or from the drive."""

    skill: str
    """The complex skill, or `DRIVE`."""
    weight: float
    """What flows along the paths through it, down to skills that command the module."""
    percent: float
    """That weight's share of the whole weight, 0 … 100; 0 where there is none."""


@dataclass(frozen=True)
class Command:
    """What one actuator or variable is commanded, and what that is made of (equation 4.3)."""

    name: str
    command: float | None
    """For an actuator its command, 0 … 1; for a variable the one that it takes in the next
    evaluation, None where nothing commands it."""
    weight: float
    """The sum of the influence of the skills that command it; 0: an actuator is neutral."""
    parts: tuple[Part, ...]
    """Of the skills that command it, by name."""
    passages: tuple[Passage, ...]
    """Of the complex skills above those, from the top down; of the drive where it adds
    influence."""
    driven: bool
    """Whether the drive commanded it too, so that the parts do not account for the command."""

    @property
    def by_skills(self) -> float | None:
        """The command that the skills alone give; None where none of them has influence."""
        return _mean(self.parts, self.weight)


@dataclass(frozen=True)
class Explanation:
    """How the last evaluation of a hierarchy came out; `str` prints it as tables.

    `Hierarchy.explain` gives it.

    >>> from socialmind.mind import Hierarchy, MindDescription, Programmed, Skill
    >>> def halves(): return 0.25, 0.75
    >>> def forward(): return 1.0
    >>> def back(): return 0.0
    >>> skills = [
    ...     Skill("Choose", (), ["SK:Back", "SK:Forward"], Programmed(halves)),
    ...     Skill("Back", (), ["MO:Mot"], Programmed(back)),
    ...     Skill("Forward", (), ["MO:Mot"], Programmed(forward)),
    ... ]
    >>> hierarchy = Hierarchy(MindDescription("m", (), ["Mot"], skills=skills))
    >>> hierarchy.evaluate({})
    {'Mot': 0.75}
    >>> explanation_of(hierarchy).motors[0].parts[1]
    Part(skill='Forward', output=1.0, weight=0.75, percent=75.0)
    """

    mind: str
    master: str
    evaluation: int
    """Which evaluation it is of, counted from 1."""
    influences: tuple[Influence, ...]
    """Of every skill, from the master down."""
    motors: tuple[Command, ...]
    """Of every actuator, in the mind's order."""
    variables: tuple[Command, ...]
    """Of every variable, in the mind's order."""

    def __str__(self) -> str:
        return table(self)

    def to_frames(self) -> dict[str, DataFrame]:
        """Return the explanation as tables of pandas.

        Returns:
            `influences` with a row for each part of each skill's influence; `motors` and
            `variables` with a row for each skill that commands (`way` is "own") and each that
            commands come through ("through").
        """
        from pandas import DataFrame

        influences = [
            (one.skill, one.total, part.source, part.influence)
            for one in self.influences
            for part in one.received
        ]
        columns = ["command", "skill", "way", "output", "weight", "percent"]
        return {
            "influences": DataFrame(influences, columns=["skill", "total", "source", "influence"]),
            "motors": DataFrame(_rows(self.motors), columns=["actuator", *columns]),
            "variables": DataFrame(_rows(self.variables), columns=["variable", *columns]),
        }


def explanation_of(hierarchy: Hierarchy) -> Explanation:
    """Return the account of a hierarchy's last evaluation.

    Args:
        hierarchy: evaluated at least once.

    Raises:
        ModelError: it was not evaluated yet, or was reset since.
    """
    if hierarchy.tick == 0:
        raise ModelError(
            f"the mind {hierarchy.description.name!r} before its first evaluation",
            "one that was evaluated",
            "call evaluate() first",
        )
    influences = _influences(hierarchy)
    description = hierarchy.description
    commands = hierarchy.actuators()
    return Explanation(
        mind=description.name,
        master=hierarchy.master,
        evaluation=hierarchy.tick,
        influences=influences,
        motors=tuple(
            _motor(hierarchy, influences, name, commands[name]) for name in description.actuators
        ),
        variables=tuple(_variable(hierarchy, influences, name) for name in description.variables),
    )


def _influences(hierarchy: Hierarchy) -> tuple[Influence, ...]:
    links, totals = hierarchy.links(), hierarchy.influences()
    found = []
    for skill in hierarchy.skills:
        received = [Received(IMPULSE, 1.0)] if skill == hierarchy.master else []
        received += [
            Received(parent, links[parent, f"SK:{skill}"])
            for parent in hierarchy.description.parents[skill]
            if parent in totals
        ]
        rest = totals[skill] - sum(part.influence for part in received)
        if rest > _ROUNDING * max(1.0, totals[skill]):
            received.append(Received(DRIVE, rest))
        found.append(Influence(skill, totals[skill], tuple(received)))
    return tuple(found)


def _motor(
    hierarchy: Hierarchy, influences: Sequence[Influence], name: str, command: float
) -> Command:
    parts, passages, weight = _flow(hierarchy, influences, f"MO:{name}")
    alone = _mean(parts, weight)
    if alone is None:
        alone = hierarchy.description.actuators[name].neutral
    return Command(name, command, weight, parts, passages, abs(command - alone) > _ROUNDING)


def _variable(hierarchy: Hierarchy, influences: Sequence[Influence], name: str) -> Command:
    parts, passages, weight = _flow(hierarchy, influences, f"VA:{name}")
    # Until the next evaluation the drive's commands to variables lie beside those of the skills.
    place = list(hierarchy.description.variables).index(name)
    state = hierarchy._state
    added, by = state.drive_command.item(0, place, 0), state.drive_weight.item(0, place, 0)
    if not by > 0.0:
        return Command(name, _mean(parts, weight), weight, parts, passages, False)
    total = sum(part.output * part.weight for part in parts) + added
    return Command(name, total / (weight + by), weight, parts, passages, True)


def _flow(
    hierarchy: Hierarchy, influences: Sequence[Influence], target: str
) -> tuple[tuple[Part, ...], tuple[Passage, ...], float]:
    """Return the parts and passages of a module's command, and its whole weight."""
    outputs = hierarchy.outputs()
    totals = {one.skill: one.total for one in influences}
    commanding = sorted(name for name in totals if (name, target) in outputs)
    weight = sum(totals[name] for name in commanding)
    percent = 100.0 / weight if weight > 0.0 else 0.0
    parts = tuple(
        Part(name, outputs[name, target], totals[name], totals[name] * percent)
        for name in commanding
    )
    # How much weight a skill passes down to the target for each unit of influence it receives.
    passed: dict[str, float] = {}
    above = set()
    for name in reversed(hierarchy.skills):
        passed[name] = 0.0
        for child in hierarchy.description.skills[name].subskills:
            if child in commanding or child in above:
                above.add(name)
                passed[name] += outputs[name, f"SK:{child}"] * (
                    passed[child] + (child in commanding)
                )
    passages = [
        Passage(name, totals[name] * passed[name], totals[name] * passed[name] * percent)
        for name in hierarchy.skills
        if name in above
    ]
    driven = sum(
        part.influence * (passed[one.skill] + (one.skill in commanding))
        for one in influences
        for part in one.received
        if part.source == DRIVE
    )
    if driven > 0.0:
        passages.append(Passage(DRIVE, driven, driven * percent))
    return parts, tuple(passages), weight


def _mean(parts: Sequence[Part], weight: float) -> float | None:
    """Return the weighted mean of equation 4.3; None without weight."""
    if not weight > 0.0:
        return None
    return sum(part.output * part.weight for part in parts) / weight


def _rows(
    commands: Sequence[Command],
) -> Iterator[tuple[str, float | None, str, str, float, float, float]]:
    for one in commands:
        for part in one.parts:
            yield one.name, one.command, part.skill, "own", part.output, part.weight, part.percent
        for way in one.passages:
            yield one.name, one.command, way.skill, "through", math.nan, way.weight, way.percent
