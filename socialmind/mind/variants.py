"""Variants of a mind: a skill replaced, a master encapsulated, a subskill grafted (6.2, 6.3).

They return descriptions, or the skills of one; what they are made from stays as it is.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import replace
from typing import Any, Protocol

from socialmind.errors import ModelError
from socialmind.mind.description import MindDescription
from socialmind.mind.links import Input, Output
from socialmind.mind.modules import Actuator, Sensor, Skill, Variable


class Trained(Protocol):
    """What is asked of a hierarchy; `Hierarchy` has it."""

    master: str

    def trained(self) -> MindDescription:
        """Return its description, with its genomes as they are set."""


def replaced(
    description: MindDescription,
    master: str,
    name: str,
    other: Skill | Trained,
    sensors: Iterable[Sensor | str] = (),
    actuators: Iterable[Actuator | str] = (),
    variables: Iterable[Variable | str] = (),
) -> tuple[MindDescription, str]:
    """Return a mind with another skill or hierarchy in a skill's place, and its master.

    Raises:
        ModelError: there is no such skill, or the modules do not fit together.
    """
    description.skill(name)
    head, skills, modules = _parts(other)
    joined = description.with_modules(**modules).with_modules(sensors, actuators, variables)
    for one in skills:
        known = joined.skills.get(one.name)
        if known is not None and one.name != name and not _same(known, one):
            raise _taken(one)
    redirected = [
        one.redirected(name, head) for one in joined.skills.values() if name in one.subskills
    ]
    added = {one.name: one for one in (*redirected, *skills)}
    without = () if head == name else (name,)
    result = joined.with_modules(skills=added.values(), without=without)
    return result, head if master == name else master


def encapsulated(
    description: MindDescription,
    master: str,
    new_master: Skill,
    skills: Iterable[Skill] = (),
    sensors: Iterable[Sensor | str] = (),
    actuators: Iterable[Actuator | str] = (),
    variables: Iterable[Variable | str] = (),
) -> tuple[MindDescription, str]:
    """Return a mind under a further master, and that master's name.

    Raises:
        ModelError: the new master does not influence the old one, or the modules do not fit.
    """
    if not isinstance(new_master, Skill):
        raise ModelError(f"{new_master!r} as a master", "a Skill")
    if master not in new_master.subskills:
        raise new_master.refused(
            f"as the master above {master!r}, which it does not influence",
            f"an output SK:{master}",
        )
    added = (new_master, *skills)
    for one in added:
        if one.name in description.skills:
            raise _taken(one)
    return description.with_modules(sensors, actuators, variables, added), new_master.name


def grafted(
    description: MindDescription,
    skill: Skill | Trained,
    under: str,
    inputs: Iterable[Input | str] = (),
    skills: Iterable[Skill] = (),
    sensors: Iterable[Sensor | str] = (),
    actuators: Iterable[Actuator | str] = (),
    variables: Iterable[Variable | str] = (),
) -> MindDescription:
    """Return a mind in which the skill `under` has a further subskill and further inputs.

    Raises:
        ModelError: there is no such skill, or the modules do not fit together.
    """
    parent = description.skill(under)
    head, own, modules = _parts(skill)
    added = (*own, *skills)
    for one in added:
        known = description.skills.get(one.name)
        if known is not None and not _same(known, one):
            raise _taken(one)
    if head in parent.subskills:
        raise parent.refused(f"which influences {head!r} already", "a further subskill")
    read = [one if isinstance(one, Input) else Input.parse(one) for one in inputs]
    changed = parent.changed(
        inputs=(*parent.inputs, *read), outputs=(*parent.outputs, Output("SK", head)), genome=None
    )
    joined = description.with_modules(**modules).with_modules(sensors, actuators, variables)
    return joined.with_modules(skills=(*added, changed))


def duplicates(
    description: MindDescription,
    name: str,
    modules: Mapping[str, str],
    renamed: Callable[[str], str],
) -> list[Skill]:
    """Return a duplicate of a skill and of those below it, for other sensors and actuators (8.2.2).

    Skills that neither read nor command what is exchanged, nor lead to one that does, are returned
    as they are: several duplicates share them. Weights are kept.

    Args:
        description: the mind.
        name: the skill.
        modules: sensors, variables and actuators by their names, and what stands for each.
        renamed: the name of a skill's duplicate.

    Raises:
        ModelError: there is no such skill, or nothing below it has to do with a module.

    >>> from socialmind.mind import Perceptron
    >>> go = Skill("Go", ["SE:RED"], ["MO:Legs"], Perceptron())
    >>> rest = Skill("Rest", [], ["MO:Legs"], Perceptron())
    >>> fetch = Skill("Fetch", ["SE:RED"], ["SK:Go", "SK:Rest"], Perceptron())
    >>> mind = MindDescription("robot", ["RED"], ["Legs"], [], [fetch, go, rest])
    >>> [one.name for one in duplicates(mind, "Fetch", {"RED": "BLUE"}, "{}Blue".format)]
    ['FetchBlue', 'GoBlue', 'Rest']
    """
    description.skill(name)
    below = description.below(name)
    other: dict[str, str] = {}
    met: set[str] = set()
    for one in reversed(below):
        skill = description.skills[one]
        links: list[Any] = [*skill.inputs, *skill.outputs]
        own = {link.name for link in links if link.module != "skill"} & set(modules)
        if own or any(child in other for child in skill.subskills):
            met |= own
            other[one] = renamed(one)
    unmet = [module for module in modules if module not in met]
    if unmet or not modules:
        what = repr(unmet[0]) if unmet else "nothing"
        raise ModelError(f"{what} to be exchanged in {name!r}", "what its skills read or command")

    def exchanged(link: Any) -> Any:
        names = other if link.module == "skill" else modules
        return replace(link, name=names.get(link.name, link.name))

    found = []
    for one in below:
        skill = description.skills[one]
        if one in other:
            skill = skill.changed(
                name=other[one],
                inputs=tuple(exchanged(link) for link in skill.inputs),
                outputs=tuple(exchanged(link) for link in skill.outputs),
            )
        found.append(skill)
    return found


def _parts(other: Skill | Trained) -> tuple[str, list[Skill], dict[str, Any]]:
    """Return the name of a skill or of a hierarchy's master, its skills and its other modules."""
    if isinstance(other, Skill):
        return other.name, [other], {}
    if not hasattr(other, "trained"):
        raise ModelError(f"{other!r} as a skill", "a Skill or a Hierarchy")
    description = other.trained()
    skills = [description.skills[name] for name in description.below(other.master)]
    links: list[Any] = [link for one in skills for link in (*one.inputs, *one.outputs)]
    read = {(link.module, link.name) for link in links}
    modules = {
        f"{what}s": [one for name, one in some.items() if (what, name) in read]
        for what, some in (
            ("sensor", description.sensors),
            ("actuator", description.actuators),
            ("variable", description.variables),
        )
    }
    return other.master, skills, modules


def _same(one: Skill, other: Skill) -> bool:
    """Say whether two skills are equal, weights and all."""
    fields = [(skill.inputs, skill.outputs, skill.function) for skill in (one, other)]
    if one.genome is None or other.genome is None:
        return fields[0] == fields[1] and one.genome is other.genome
    return fields[0] == fields[1] and bool((one.genome == other.genome).all())


def _taken(skill: Skill) -> ModelError:
    return skill.refused("for a mind that has another of this name", "a name of its own")
