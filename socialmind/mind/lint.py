"""The linter of minds: what is allowed and yet hardly meant.

What it reports, by kind:

- *unused sensor*, *unused variable*, *unused actuator*: no skill reads or commands it.
- *never written*: a simple variable or counter that skills read and none writes; it keeps its
  default unless a drive module sets it. Variables that a group shares may be written by others.
- *never read*: a variable that skills write and none reads.
- *skill out of reach*: no master influences it, directly or through others.
- *output nobody can influence*: an actuator or variable that only skills out of reach command.
- *input listed twice*: in the same skill.
- *no weights*: a network whose genome is not set.
- *outside the rule language*: a program that cannot be compiled.

Masters are the complex skills that no other influences, unless one is named; where there is no
complex one, the base skills that no other influences.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable

from coglogo_py import Finding
from socialmind.errors import ModelError
from socialmind.mind.description import MindDescription
from socialmind.mind.functions.programmed import Programmed
from socialmind.mind.modules import Skill
from socialmind.mind.regulation import Counter, Simple

__all__ = ["Finding", "findings", "genome_sizes"]

Typing = Callable[[Skill], None]
"""Types the program of a skill; raises a ModelError where it is outside the rule language."""


def findings(
    description: MindDescription,
    master: str | Iterable[str] | None = None,
    typing: Typing | None = None,
) -> list[Finding]:
    r"""Return what is odd about a mind, kind by kind, each in the mind's order.

    Args:
        description: the mind.
        master: the skill that steers the agent, or several that do in turn.
        typing: types a programmed skill; None to leave programs alone.

    Raises:
        ModelError: there is no such master.

    >>> from socialmind.mind import Programmed
    >>> still = Skill("Still", (), ["MO:MotL"], Programmed(lambda: 0.5))
    >>> mind = MindDescription("m", ["Eye"], ["MotL", "MotR"], skills=[still])
    >>> print(*findings(mind), sep="\n")
    unused sensor: sensor 'Eye': no skill reads it
    unused actuator: actuator 'MotR': no skill commands it
    """
    reached = set(description.below(*_masters(description, master)))
    found = _unused(description)
    found += _half_used(description)
    found += _out_of_reach(description, reached)
    for name in description.order:
        found += _about(description.skills[name], typing)
    return found


def genome_sizes(description: MindDescription) -> dict[str, int]:
    """Return how many weights each skill has, from the top down; 0 for those without a network.

    >>> from socialmind.mind import Programmed
    >>> still = Skill("Still", (), ["MO:MotL"], Programmed(lambda: 0.5))
    >>> genome_sizes(MindDescription("m", (), ["MotL"], skills=[still]))
    {'Still': 0}
    """
    return {name: description.skills[name].genome_size for name in description.order}


def _masters(description: MindDescription, master: str | Iterable[str] | None) -> tuple[str, ...]:
    if master is not None:
        named = (master,) if isinstance(master, str) else tuple(master)
        return tuple(description.skill(name).name for name in named)
    alone = description.masters
    complex_ones = tuple(name for name in alone if description.skills[name].is_complex)
    return complex_ones or alone


def _users(description: MindDescription, module: str, written: bool) -> dict[str, list[str]]:
    """Return the skills that read or write each module of a kind."""
    users: dict[str, list[str]] = {}
    for name in description.order:
        skill = description.skills[name]
        for link in skill.outputs if written else skill.inputs:
            if link.module == module:
                users.setdefault(link.name, []).append(name)
    return users


def _unused(description: MindDescription) -> list[Finding]:
    used = {(one.module, one.name) for skill in description.skills.values() for one in skill.links}
    kinds = (
        ("sensor", description.sensors, "reads"),
        ("variable", description.variables, "reads or writes"),
        ("actuator", description.actuators, "commands"),
    )
    return [
        Finding(f"unused {kind}", f"{kind} {name!r}", f"no skill {uses} it")
        for kind, modules, uses in kinds
        for name in modules
        if (kind, name) not in used
    ]


def _half_used(description: MindDescription) -> list[Finding]:
    read = _users(description, "variable", written=False)
    written = _users(description, "variable", written=True)
    found = []
    for name, variable in description.variables.items():
        waits = isinstance(variable.regulation, Simple | Counter) and variable.group is None
        if name in read and name not in written and waits:
            message = f"no skill writes it: it stays {variable.start:g} unless a drive module acts"
            found.append(Finding("never written", f"variable {name!r}", message))
        if name in written and name not in read and variable.group is None:
            by = " and ".join(written[name])
            message = (
                f"{by} {'write' if len(written[name]) > 1 else 'writes'} it, no skill reads it"
            )
            found.append(Finding("never read", f"variable {name!r}", message))
    return found


def _out_of_reach(description: MindDescription, reached: set[str]) -> list[Finding]:
    found = [
        Finding(
            "skill out of reach",
            f"skill {name!r}",
            "no master influences it; link it from a skill above, or leave it out",
        )
        for name in description.order
        if name not in reached
    ]
    modules = {"actuator": description.actuators, "variable": description.variables}
    for module, names in modules.items():
        users = _users(description, module, written=True)
        for name in names:
            if name in users and not reached.intersection(users[name]):
                message = f"only {' and '.join(users[name])} would, out of a master's reach"
                where = f"{module} {name!r}"
                found.append(Finding("output nobody can influence", where, message))
    return found


def _about(skill: Skill, typing: Typing | None) -> list[Finding]:
    where = f"skill {skill.name!r}"
    found = []
    texts = [str(one) for one in skill.inputs]
    for text in dict.fromkeys(texts):
        if texts.count(text) > 1:
            message = f"{text} stands {texts.count(text)} times among its inputs"
            found.append(Finding("input listed twice", where, message))
    if skill.genome is None and skill.genome_size:
        message = f"its {skill.genome_size} weights are not set; train it, or draw them at random"
        found.append(Finding("no weights", where, message))
    if typing is not None and isinstance(skill.function, Programmed):
        try:
            typing(skill)
        except ModelError as error:
            found.append(Finding("outside the rule language", where, str(error)))
    return found
