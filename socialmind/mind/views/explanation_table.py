"""The account of an evaluation as plain text, up to 100 columns wide."""

from __future__ import annotations

import textwrap
from collections.abc import Sequence
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from socialmind.mind.views.explanation import Command, Explanation, Influence

WIDTH = 100
_GAP = "  "


def table(explanation: Explanation) -> str:
    """Return an explanation as text: influences, then actuators, then variables.

    Args:
        explanation: the account of an evaluation.
    """
    heading = (
        f"Evaluation {explanation.evaluation} of the mind {explanation.mind!r}, "
        f"master {explanation.master!r}"
    )
    lines = [*textwrap.wrap(heading, WIDTH), "", *_influences(explanation.influences)]
    if explanation.motors:
        lines += ["", *_commands("actuator", explanation.motors, "neutral: no influence")]
    if explanation.variables:
        heading = "variable (next command)"
        lines += ["", *_commands(heading, explanation.variables, "none: it keeps its last")]
    return "\n".join(lines)


def _influences(influences: Sequence[Influence]) -> list[str]:
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


def _commands(kind: str, commands: Sequence[Command], absent: str) -> list[str]:
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
    widths = [max(len(row[column]) for row in rows) for column in range(6)]
    return [
        _GAP.join(
            text.ljust(width) if column in (0, 2) else text.rjust(width)
            for column, (text, width) in enumerate(zip(row, widths, strict=True))
        ).rstrip()
        for row in rows
    ]


def _number(value: float) -> str:
    return f"{value:.3f}"


def _percent(value: float) -> str:
    return f"{value:.1f} %"
