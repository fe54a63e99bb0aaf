"""The account of an evaluation: who influenced whom, and how much that counted in each command.

Influence flows from the master's impulse down to actuators and variables. Of the weight that an
actuator's command rests on (the lower sum of equation 4.3) each skill that commands it holds a
share; a complex skill holds the share that flows along paths through it. What no skill accounts
for is the drive's.
"""

from __future__ import annotations

import textwrap
from collections.abc import Sequence
from dataclasses import dataclass

from socialmind.errors import ModelError
from socialmind.mind.evaluation.agent_state import Readings
from socialmind.text_table import aligned

WIDTH = 100
"""Columns of text, at most."""
_GAP = "  "

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
        return _table(self)


def explanation_of(hierarchy: Readings) -> Explanation:
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
        master=hierarchy.assembly.master,
        evaluation=hierarchy.tick,
        influences=influences,
        motors=tuple(
            _motor(hierarchy, influences, name, commands[name]) for name in description.actuators
        ),
        variables=tuple(_variable(hierarchy, influences, name) for name in description.variables),
    )


def _influences(hierarchy: Readings) -> tuple[Influence, ...]:
    links, totals = hierarchy.links(), hierarchy.influences()
    found = []
    for skill in hierarchy.skills:
        received = [Received(IMPULSE, 1.0)] if skill == hierarchy.assembly.master else []
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
    hierarchy: Readings, influences: Sequence[Influence], name: str, command: float
) -> Command:
    parts, passages, weight = _flow(hierarchy, influences, f"MO:{name}")
    alone = _mean(parts, weight)
    if alone is None:
        alone = hierarchy.description.actuators[name].neutral
    return Command(name, command, weight, parts, passages, abs(command - alone) > _ROUNDING)


def _variable(hierarchy: Readings, influences: Sequence[Influence], name: str) -> Command:
    parts, passages, weight = _flow(hierarchy, influences, f"VA:{name}")
    # Until the next evaluation the drive's commands to variables lie beside those of the skills.
    added, by = hierarchy.drive_commands()[name]
    if not by > 0.0:
        return Command(name, _mean(parts, weight), weight, parts, passages, False)
    total = sum(part.output * part.weight for part in parts) + added
    return Command(name, total / (weight + by), weight, parts, passages, True)


def _flow(
    hierarchy: Readings, influences: Sequence[Influence], target: str
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


# As plain text ----------------------------------------------------------------------------


def _table(explanation: Explanation) -> str:
    """Return an explanation as text: influences, then actuators, then variables.

    Args:
        explanation: the account of an evaluation.
    """
    heading = (
        f"Evaluation {explanation.evaluation} of the mind {explanation.mind!r}, "
        f"master {explanation.master!r}"
    )
    lines = [*textwrap.wrap(heading, WIDTH), "", *_influence_lines(explanation.influences)]
    if explanation.motors:
        lines += ["", *_command_lines("actuator", explanation.motors, "neutral: no influence")]
    if explanation.variables:
        heading = "variable (next command)"
        lines += ["", *_command_lines(heading, explanation.variables, "none: it keeps its last")]
    return "\n".join(lines)


def _influence_lines(influences: Sequence[Influence]) -> list[str]:
    width = max(len("skill"), *(len(one.skill) for one in influences))
    lines = [f"{'skill':{width}}{_GAP}influence{_GAP}from"]
    for one in influences:
        start = f"{one.skill:{width}}{_GAP}{_number(one.total):>9}{_GAP}"
        # A no-break space keeps a name and its number on one line.
        parts = [f"{part.source} {_number(part.influence)}" for part in one.received]
        joined = ", ".join(part.replace(" ", "\xa0") for part in parts)
        wrapped = textwrap.wrap(
            joined,
            max(WIDTH, len(start) + 20),
            initial_indent=start.replace(" ", "\xa0"),
            subsequent_indent="\xa0" * len(start),
            break_long_words=False,
            break_on_hyphens=False,
        )
        lines += [line.replace("\xa0", " ").rstrip() for line in wrapped or [start]]
    return lines


def _command_lines(kind: str, commands: Sequence[Command], absent: str) -> list[str]:
    rows = [(kind, "command", "by", "output", "weight", "share")]
    for one in commands:
        name, command = one.name, "-" if one.command is None else _number(one.command)
        if not one.weight > 0.0 and not one.driven:
            rows.append((name, command, f"({absent})", "", "", ""))
            continue
        for part in one.parts:
            numbers = (_number(part.output), _number(part.weight), _percent(part.percent))
            rows.append((name, command, part.skill, *numbers))
            name = command = ""
        for way in one.passages:
            numbers = ("", _number(way.weight), _percent(way.percent))
            rows.append(("", "", f"through {way.skill}", *numbers))
        if one.driven:
            alone = one.by_skills
            said = "nothing" if alone is None else _number(alone)
            rows.append((name, command, f"(drive: the skills alone give {said})", "", "", ""))
    return aligned(rows, right=(1, 3, 4, 5))


def _number(value: float) -> str:
    return f"{value:.3f}"


def _percent(value: float) -> str:
    return f"{value:.1f} %"
