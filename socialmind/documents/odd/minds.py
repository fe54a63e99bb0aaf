"""The minds of agents as an ODD document shows them: schemes and hierarchies of skills."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import TYPE_CHECKING

from socialmind.documents.markdown import table
from socialmind.documents.odd import docstrings
from socialmind.mind.functions.programmed import Programmed
from socialmind.mind.links import DERIVATIVE, HISTORY, Input
from socialmind.mind.regulation import Regulated, Regulation

if TYPE_CHECKING:
    from coglogo_py import CognitiveScheme, Cogniton, Culturon, Group
    from socialmind.mind.evaluation.arrays import Assembly


def scheme_tables(scheme: CognitiveScheme, meanings: Mapping[str, str]) -> str:
    """Return a scheme as tables: its decision maker, cognitons, groups and culturons.

    Args:
        scheme: the scheme.
        meanings: what the author says that cognitons stand for, by name.
    """
    maker = scheme.decision_maker
    biased = f", bias {maker.bias:g}" if maker.biased else ""
    parts = [
        f"Plans: {', '.join(scheme.plans)}. The decision maker is {maker.name}{biased}: "
        f"{_lower(docstrings.own(type(maker)))}"
    ]
    if scheme.cognitons:
        header = ("cogniton", "type", "stands for", "at birth", "active while", "influence",
                  "opens", "reinforced by")  # fmt: skip
        parts.append(table(header, [_cogniton(one, meanings) for one in scheme.cognitons]))
    if scheme.groups:
        parts.append("Groups that agents can form, and the culturons of their roles:")
        parts.append(
            table(
                ("group", "role", "culturon", "value", "influence", "opens", "reinforced by"),
                [
                    (f"{group.name}{_within(group)}", role.name, *_culturon(held))
                    for group in scheme.groups
                    for role in group.roles
                    for held in role.culturons or (None,)
                ],
            )
        )
    return "\n\n".join(parts)


def _within(group: Group) -> str:
    return f", in the role {group.within[1]} of {group.within[0]}" if group.within else ""


def _cogniton(one: Cogniton, meanings: Mapping[str, str]) -> tuple[str, ...]:
    born = f"{one.start_value:g}" if one.starting else f"inactive ({one.start_value:g} later)"
    if not one.starting and not one.start_value:
        born = "inactive"
    if one.starting and one.chance < 1:
        born += f", with chance {one.chance:g}"
    conditions = [
        *(str(condition) for condition in one.active_while),
        *(f"from {condition} on" for condition in one.activated_when),
        *(f"not once {condition}" for condition in one.deactivated_when),
    ]
    return (
        one.name, one.type or "", meanings.get(one.name, ""), born.replace("-", "−"),
        " and ".join(conditions), *_links(one),
    )  # fmt: skip


def _culturon(one: Culturon | None) -> tuple[str, ...]:
    if one is None:
        return ("", "", "", "", "")
    return one.name, f"{one.start_value:g}".replace("-", "−"), *_links(one)


def _links(one: Cogniton | Culturon) -> tuple[str, str, str]:
    return _weights(one.influence), ", ".join(one.conditional), _weights(one.reinforcement)


def _weights(weights: Mapping[str, float]) -> str:
    return ", ".join(f"{plan} {_number(weight)}" for plan, weight in weights.items())


def _number(value: float) -> str:
    return f"{value:g}".replace("-", "−") if abs(value) >= 1e-4 or not value else f"{value}"


def _lower(text: str) -> str:
    return text[:1].lower() + text[1:]


def hierarchy_tables(assembly: Assembly) -> str:
    """Return a hierarchy as a table of skills, from the master down, and one of variables."""
    mind = assembly.description
    rows = []
    for name in mind.order:
        skill = mind.skills[name]
        master = " (the master)" if name == assembly.master else ""
        program = isinstance(skill.function, Programmed)
        what = "a program" if program else str(skill.function)
        sent = ", ".join(one.name for one in skill.outputs)
        rows.append((name + master, _read(skill.inputs), sent, what, str(skill.genome_size)))
    header = ("skill", "reads", "commands", "function", "weights")
    parts = [table(header, rows, keep=header)]
    if mind.variables:
        variables = [
            (one.name, f"{one.start:g}", _regulation(one.regulation), one.group or "")
            for one in mind.variables.values()
        ]
        parts += ["Variables of the mind, which skills write and read, 0 … 1:"]
        parts.append(table(("variable", "at the start", "regulation", "shared in"), variables))
    return "\n\n".join(parts)


def _regulation(one: Regulation) -> str:
    """Return what a variable makes of its commands, with the settings that it has."""
    if isinstance(one, Regulated):
        return docstrings.said(one.function)
    settings = ", ".join(f"{name} {value:g}" for name, value in vars(one).items())
    about = docstrings.own(type(one))
    return f"{about} ({settings})" if settings else about


def _read(inputs: Iterable[Input]) -> str:
    """Return what a skill reads, numbered names that follow each other as one span."""
    names = []
    for one in inputs:
        kind = {DERIVATIVE: "change of ", HISTORY: ""}.get(one.reading, "")
        names.append(f"{kind}{one.name}{f' {one.ticks} ticks ago' if one.ticks else ''}")
    return ", ".join(names)
