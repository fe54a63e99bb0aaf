"""Schemes of a model as one: its agents meet in one random order, so they are one population.

What two schemes say alike is one part of the scheme that is written; what they say otherwise under
one name bears the name of its scheme, as "Work (Farmers)".
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any

from socialmind.metaciv.description import (
    Action,
    Argument,
    Attribute,
    Civilisation,
    Cogniton,
    Constant,
    Group,
    Model,
    Plan,
    Role,
    Scheme,
    Settlement,
)


@dataclass
class People:
    """What the agents of a model are made of.

    Attributes:
        schemes: those of the civilisations that are on the map.
        civilisations: these, each once, in the order of their first places.
        settlements: their places.
        plans, cognitons, groups, constants, attributes: of all schemes, by the names they have now.
        names: of each scheme (kind, name there) -> the name now.
        starts: attributes that begin otherwise in some schemes, by scheme and name.
    """

    schemes: list[Scheme]
    civilisations: list[Civilisation]
    settlements: list[Settlement]
    plans: dict[str, Plan] = field(default_factory=dict)
    cognitons: dict[str, Cogniton] = field(default_factory=dict)
    groups: dict[str, Group] = field(default_factory=dict)
    constants: dict[str, Constant] = field(default_factory=dict)
    attributes: dict[str, Attribute] = field(default_factory=dict)
    names: dict[str, dict[tuple[str, str], str]] = field(default_factory=dict)
    starts: dict[str, dict[str, float]] = field(default_factory=dict)

    @property
    def several(self) -> bool:
        """Whether there is more than one scheme."""
        return len(self.schemes) > 1

    def of_scheme(self, scheme: Scheme) -> list[Civilisation]:
        """Return the civilisations of a scheme."""
        return [one for one in self.civilisations if one.scheme == scheme.name]

    def joining(self, group: str) -> list[Civilisation]:
        """Return the civilisations whose agents join a group at birth, by its name now."""
        schemes = {
            scheme.name
            for scheme in self.schemes
            for one in scheme.groups
            if one.auto_join and self.names[scheme.name]["group", one.name] == group
        }
        return [one for one in self.civilisations if one.scheme in schemes]

    def is_shared(self, kind: str, name: str) -> bool:
        """Say whether all schemes have a part of a kind under its name now."""
        return all(name in (now for (of, _), now in self.names[one.name].items() if of == kind)
                   for one in self.schemes)  # fmt: skip

    def initial(self, scheme: Scheme) -> list[str]:
        """Return the cognitons that agents of a scheme have at birth, by their names now."""
        names = self.names[scheme.name]
        return [names["cogniton", one.name] for one in scheme.cognitons if one.initial]

    def plans_of_kind(self, kind: str, scheme: Scheme) -> list[Plan]:
        """Return the plans of a kind of a scheme, with the names that are now in them."""
        names = self.names[scheme.name]
        return [self.plans[names["plan", one.name]] for one in scheme.plans if one.kind == kind]


def people_of(model: Model) -> People:
    """Return the agents of a model, of all the schemes of civilisations that are on its map."""
    by_name = {one.name: one for one in model.civilisations}
    places = [one for one in model.environment.settlements if one.civilisation in by_name]
    civilisations = [by_name[name] for name in dict.fromkeys(one.civilisation for one in places)]
    used = dict.fromkeys(one.scheme for one in civilisations)
    schemes = [one for one in model.schemes if one.name in used]
    people = People(schemes, civilisations, places)
    for scheme in schemes:
        _take_in(people, scheme)
    for scheme in schemes:
        own = {one.name for one in scheme.attributes}
        for name, attribute in people.attributes.items():
            if name not in own and attribute.start != 0:
                people.starts[scheme.name][name] = 0.0  # it has none
    return people


def _take_in(people: People, scheme: Scheme) -> None:
    names: dict[tuple[str, str], str] = {}
    people.names[scheme.name] = names
    starts = people.starts.setdefault(scheme.name, {})
    for attribute in scheme.attributes:
        known = people.attributes.setdefault(attribute.name, attribute)
        if known.start != attribute.start:
            starts[attribute.name] = attribute.start
    for constant in scheme.constants:
        name = constant.name
        if name in people.constants and people.constants[name].value != constant.value:
            name = f"{name} ({scheme.name})"
        people.constants.setdefault(name, constant)
        names["constant", constant.name] = name
    # Plans call cognitons and groups, which name plans: first all keep their names, and those
    # that differ from another scheme's are renamed until nothing changes.
    renamed: set[tuple[str, str]] = set()
    while True:
        kept = [("plan", one.name) for one in scheme.plans]
        kept += [("cogniton", one.name) for one in scheme.cognitons]
        kept += [("group", one.name) for one in scheme.groups]
        for kind, name in kept:
            names[kind, name] = f"{name} ({scheme.name})" if (kind, name) in renamed else name
        plans = [_plan(one, names) for one in scheme.plans]
        cognitons = [_cogniton(one, names) for one in scheme.cognitons]
        groups = [_group(one, names) for one in scheme.groups]
        differing = {
            *(("plan", old) for old in _differing(people.plans, scheme.plans, plans)),
            *(
                ("cogniton", old)
                for old in _differing(people.cognitons, scheme.cognitons, cognitons)
            ),
            *(("group", old) for old in _differing(people.groups, scheme.groups, groups)),
        } - renamed
        if not differing:
            break
        renamed |= differing
    people.plans |= {one.name: one for one in plans if one.name not in people.plans}
    people.cognitons |= {one.name: one for one in cognitons if one.name not in people.cognitons}
    people.groups |= {one.name: one for one in groups if one.name not in people.groups}


def _differing(
    known: Mapping[str, Any], parts: Sequence[Any], made: Sequence[Any]
) -> Iterator[str]:
    """Yield the names of the parts that another scheme has under a name, and has otherwise."""
    for before, after in zip(parts, made, strict=True):
        if after.name in known and not _alike(known[after.name], after):
            yield before.name


def _alike(one: object, other: object) -> bool:
    return _bare(one) == _bare(other)


def _bare(part: object) -> object:
    """Return what a part says, without where it stands."""
    if hasattr(part, "__dataclass_fields__"):
        skipped = ("place", "description", "colour", "initial", "start_chance", "written", "label")
        kept = [one for one in part.__dataclass_fields__ if one not in skipped]
        return type(part).__name__, tuple(_bare(getattr(part, one)) for one in kept)
    if isinstance(part, tuple):
        return tuple(_bare(one) for one in part)
    return part


def _plan(plan: Plan, names: dict[tuple[str, str], str]) -> Plan:
    return replace(
        plan, name=names["plan", plan.name], actions=tuple(_action(a, names) for a in plan.actions)
    )


def _action(action: Action, names: dict[tuple[str, str], str]) -> Action:
    return replace(
        action,
        arguments=tuple(_argument(one, names) for one in action.arguments),
        children=tuple(_action(one, names) for one in action.children),
    )


def _argument(argument: Argument, names: dict[tuple[str, str], str]) -> Argument:
    kinds = {"Cogniton": "cogniton", "Group": "group", "GroupAndRole": "group"}
    if argument.type in kinds:
        key = (kinds[argument.type], str(argument.value))
        argument = replace(argument, value=names.get(key, argument.value))
    if argument.constant is not None:
        key = ("constant", argument.constant)
        argument = replace(argument, constant=names.get(key))
    return argument


def _cogniton(cogniton: Cogniton, names: dict[tuple[str, str], str]) -> Cogniton:
    return replace(
        cogniton,
        name=names["cogniton", cogniton.name],
        permits=tuple(replace(one, plan=names["plan", one.plan]) for one in cogniton.permits),
        influences=tuple(replace(one, plan=names["plan", one.plan]) for one in cogniton.influences),
        triggers=tuple(
            replace(one, constant=names.get(("constant", one.constant or "")))
            for one in cogniton.triggers
        ),
    )


def _group(group: Group, names: dict[tuple[str, str], str]) -> Group:
    roles = tuple(_role(one, names) for one in group.roles)
    return replace(group, name=names["group", group.name], roles=roles)


def _role(role: Role, names: dict[tuple[str, str], str]) -> Role:
    culturons = tuple(names["cogniton", one] for one in role.culturons)
    return replace(role, culturons=culturons)
