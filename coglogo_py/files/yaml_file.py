"""Cognitive schemes in YAML, a form to read, comment and edit by hand. Reader and writer.

docs/schemes.md describes the form.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Collection, Iterable, Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any

import yaml

from coglogo_py.border.errors import SchemeError
from coglogo_py.conditions.condition import Condition, Conditions
from coglogo_py.decision import DecisionMaker, MaximumWeight, decision_maker_called
from coglogo_py.files.yaml_nodes import NOTHING, Nodes, composed
from coglogo_py.files.yaml_text import (
    list_lines,
    mapping_lines,
    name_text,
    number_text,
    position_text,
)
from coglogo_py.parts import GREY, AScheme, Cogniton, Culturon, Group, Role, Scheme

TOP_FIELDS = (
    "name", "decision_maker", "breeds", "plans", "plan_positions", "cognitons", "groups",
    "group_attributes", "nested_groups", "group_positions", "role_positions",
)  # fmt: skip
LINK_FIELDS = ("influence", "conditional", "reinforcement")
CULTURON_FIELDS = ("start", "colour", "position", *LINK_FIELDS)
CONDITION_FIELDS = ("active_while", "activated_when", "deactivated_when")
COGNITON_FIELDS = (
    "at_birth", *CULTURON_FIELDS, *CONDITION_FIELDS, "type", "chance", "inherited",
)  # fmt: skip


Attributes = tuple[tuple[str, float], ...]
Around = tuple[str, str]
Position = tuple[int, int]


def parse(
    text: str,
    file: str | Path,
    kind: Callable[..., AScheme],
    decision_makers: Iterable[type[DecisionMaker]] = (),
) -> AScheme:
    r"""Return the scheme that a YAML file describes.

    Args:
        text: the file's content.
        file: its path, for messages.
        kind: the class of the scheme.
        decision_makers: decision makers of the modeller's own that the file may name.

    Raises:
        SchemeError: the text is no scheme; says at which line, in which field and why.

    >>> from coglogo_py import CognitiveScheme
    >>> text = "name: cows\ncognitons:\n  hunger: {influence: {eat: 2}, conditional: [eat]}\n"
    >>> parse(text, "cows.yaml", CognitiveScheme).plans
    ('eat',)
    """
    return _scheme(Nodes(file), composed(text, file), kind, decision_makers)


def _decision_maker(
    nodes: Nodes, node: yaml.Node, makers: Iterable[type[DecisionMaker]]
) -> DecisionMaker:
    name, bias, placed = node, 1.0, node
    if isinstance(node, yaml.MappingNode):
        given = nodes.fields(node, "decision_maker", ("name", "bias"))
        if "name" not in given:
            raise nodes.error(node, "decision_maker without a name", "name: and bias:")
        name = placed = given["name"]
        if "bias" in given:
            placed = given["bias"]
            bias = nodes.number(placed, "bias of decision_maker")
    try:
        return decision_maker_called(nodes.name(name, "decision_maker"), bias, makers)
    except SchemeError as error:
        line = (placed if not 0 < bias < math.inf else name).start_mark.line + 1
        raise error.at(nodes.file, line) from None


def _cogniton(nodes: Nodes, name: str, node: yaml.Node) -> Cogniton:
    where = f"cogniton {name!r}"
    given = nodes.fields(node, where, COGNITON_FIELDS)
    birth = given.get("at_birth")
    starting = True if birth is None else nodes.truth(birth, f"at_birth of {where}")
    described = _described(nodes, given, where, Culturon(name))
    for one in CONDITION_FIELDS:
        if one in given:
            described[one] = _conditions(nodes, given[one], f"{one} of {where}")
    for one in ("chance", "inherited"):
        if one in given:
            described[one] = nodes.number(given[one], f"{one} of {where}")
    if "type" in given:
        described["type"] = nodes.name(given["type"], f"type of {where}")
    try:
        return Cogniton(name, starting, **described)
    except SchemeError as error:  # a share beyond 1, an unknown type, or what excludes another
        said = next((one for field, one in given.items() if field in error.found), node)
        raise error.at(nodes.file, said.start_mark.line + 1) from None


def _conditions(nodes: Nodes, node: yaml.Node, where: str) -> Conditions:
    """Return the conditions that a text, or a list of texts, writes."""
    several = nodes.items(node, where) if isinstance(node, yaml.SequenceNode) else [node]
    found = []
    for one in several:
        text = nodes.name(one, where)
        line = one.start_mark.line + 1
        try:
            found.append(Condition.parsed(text, where, line))
        except SchemeError as error:
            raise error.at(nodes.file, line) from None
    return tuple(found)


def _described(
    nodes: Nodes, given: dict[str, yaml.Node], where: str, otherwise: Culturon
) -> dict[str, Any]:
    """Return what the fields say, and where they say nothing what `otherwise` says."""

    def read(field: str, reader: Callable[[yaml.Node, str], Any], unsaid: Any) -> Any:
        return reader(given[field], f"{field} of {where}") if field in given else unsaid

    return {
        "start_value": read("start", nodes.number, otherwise.start_value),
        "colour": read("colour", nodes.colour, otherwise.colour),
        "position": read("position", nodes.position, otherwise.position),
        "influence": read("influence", nodes.weights, {}),
        "conditional": read("conditional", nodes.names, ()),
        "reinforcement": read("reinforcement", nodes.weights, {}),
    }


def _group(nodes: Nodes, name: str, node: yaml.Node) -> Group:
    """Return a group as the field `groups` describes it: its roles and their culturons."""
    where = f"group {name!r}"
    earlier: dict[str, Culturon] = {}
    roles = []
    for role, _, role_node in nodes.entries(node, where):
        culturons = []
        role_where = f"role {role!r} of {where}"
        for culturon, _, culturon_node in nodes.entries(role_node, role_where):
            here = f"culturon {culturon!r} of {role_where}"
            given = nodes.fields(culturon_node, here, CULTURON_FIELDS)
            first = earlier.get(culturon, Culturon(culturon))
            earlier[culturon] = Culturon(culturon, **_described(nodes, given, here, first))
            culturons.append(earlier[culturon])
        roles.append(Role(role, tuple(culturons)))
    return Group(name, tuple(roles))


def _attributes(nodes: Nodes, node: yaml.Node, groups: Collection[str]) -> dict[str, Attributes]:
    """Return the attributes of groups by the groups' names."""
    found = {}
    for group, at, values in nodes.entries(node, "group_attributes"):
        _check_known(nodes, at, f"attributes of a group {group!r}", group, groups)
        found[group] = tuple(nodes.weights(values, f"attributes of group {group!r}").items())
    return found


def _positions(
    nodes: Nodes, node: yaml.Node, field: str, part: str, known: Collection[str]
) -> dict[str, Position]:
    """Return the places of groups, or of the roles of a group, by their names."""
    found = {}
    for name, at, place in nodes.entries(node, field):
        _check_known(nodes, at, f"the position of a {part} {name!r}", name, known, part)
        found[name] = nodes.position(place, f"position of {part} {name!r}")
    return found


def _placed(
    nodes: Nodes, given: dict[str, yaml.Node], groups: Iterable[Group]
) -> tuple[Group, ...]:
    """Return groups, and their roles, with the places in the drawing that the fields say."""
    named = {one.name: one for one in groups}
    places = _positions(
        nodes, given.get("group_positions", NOTHING), "group_positions", "group", named
    )
    for name, place in places.items():
        named[name] = replace(named[name], position=place)
    for name, at, inner in nodes.entries(given.get("role_positions", NOTHING), "role_positions"):
        _check_known(nodes, at, f"positions of the roles of a group {name!r}", name, named)
        roles = {role.name: role for role in named[name].roles}
        field = f"the positions of the roles of group {name!r}"
        for role, place in _positions(nodes, inner, field, "role", roles).items():
            roles[role] = replace(roles[role], position=place)
        named[name] = replace(named[name], roles=tuple(roles.values()))
    return tuple(named.values())


def _check_known(
    nodes: Nodes, at: yaml.Node, found: str, name: str, known: Collection[str], part: str = "group"
) -> None:
    """Refuse the name of a group, or of a role of one, that there is not."""
    if name not in known:
        whole = "scheme" if part == "group" else "group"
        expected = f"a {part} of the {whole}: {', '.join(known) or 'there are none'}"
        raise nodes.error(at, found, expected)


def _nesting(nodes: Nodes, node: yaml.Node, groups: Collection[str]) -> dict[str, Around]:
    """Return the group and role that groups are within, by the groups' names."""
    found = {}
    for group, at, around in nodes.entries(node, "nested_groups"):
        _check_known(nodes, at, f"a nested group {group!r}", group, groups)
        pairs = list(nodes.entries(around, f"what group {group!r} is within"))
        if len(pairs) != 1:
            raise nodes.error(at, f"{len(pairs)} groups around {group!r}", "one, {clan: member}")
        ((name, place, role),) = pairs
        if name not in groups:
            raise nodes.error(place, f"group {group!r} within {name!r}", "a group of the scheme")
        found[group] = name, nodes.name(role, f"the role that group {group!r} plays")
    return found


def _scheme(
    nodes: Nodes,
    root: yaml.Node,
    kind: Callable[..., AScheme],
    decision_makers: Iterable[type[DecisionMaker]],
) -> AScheme:
    given = nodes.fields(root, "the scheme", TOP_FIELDS)
    if "name" not in given:
        raise nodes.error(root, "a scheme without a name", "name:", "begin with name:")
    maker, plans = given.get("decision_maker"), given.get("plans", NOTHING)

    def entries(field: str) -> Iterator[tuple[str, yaml.Node, yaml.Node]]:
        return nodes.entries(given.get(field, NOTHING), field)

    groups = {name: _group(nodes, name, node) for name, _, node in entries("groups")}
    attributes = _attributes(nodes, given.get("group_attributes", NOTHING), groups)
    nesting = _nesting(nodes, given.get("nested_groups", NOTHING), groups)
    described = (
        replace(one, attributes=attributes.get(name, ()), within=nesting.get(name))
        for name, one in groups.items()
    )
    return kind(
        nodes.name(given["name"], "name of the scheme"),
        tuple(_cogniton(nodes, name, node) for name, _, node in entries("cognitons")),
        _placed(nodes, given, described),
        MaximumWeight() if maker is None else _decision_maker(nodes, maker, decision_makers),
        nodes.names(given.get("breeds", NOTHING), "breeds"),
        {
            plan: nodes.position(node, f"position of plan {plan!r}")
            for plan, _, node in entries("plan_positions")
        },
        None if nodes.is_nothing(plans) else nodes.names(plans, "plans"),
    )


HEADER = """\
# A cognitive scheme for coglogo_py. docs/schemes.md describes the form.
# The order of the plans decides between plans of equal weight.
"""


def written(scheme: Scheme) -> str:
    """Return the YAML file of a scheme, which reads back as an equal scheme.

    Args:
        scheme: the scheme to write.

    >>> from coglogo_py import CognitiveScheme
    >>> print(written(CognitiveScheme("cows", (Cogniton("hunger", influence={"eat": 2}),))))
    # A cognitive scheme for coglogo_py. docs/schemes.md describes the form.
    # The order of the plans decides between plans of equal weight.
    name: cows
    decision_maker: {name: MaximumWeight, bias: 1}
    plans: [eat]
    cognitons:
      hunger:
        at_birth: true
        start: 0
        influence: {eat: 2}
    <BLANKLINE>
    """
    maker = scheme.decision_maker
    lines = [
        f"name: {name_text(scheme.name)}",
        f"decision_maker: {{name: {name_text(maker.name)}, bias: {number_text(maker.bias)}}}",
    ]
    if scheme.breeds:
        lines += list_lines("breeds", scheme.breeds, "")
    order = scheme.linked_plans if scheme.plan_order is None else scheme.plan_order
    lines += list_lines("plans", order, "")
    positions = {plan: position_text(place) for plan, place in scheme.plan_positions.items()}
    lines += mapping_lines("plan_positions", positions, "")
    if scheme.cognitons:
        lines.append("cognitons:")
    for cogniton in scheme.cognitons:
        lines.append(f"  {name_text(cogniton.name)}:")
        lines.append(f"    at_birth: {'true' if cogniton.starting else 'false'}")
        lines += _rest(cogniton, "    ") + _becoming(cogniton, "    ")
    if scheme.groups:
        lines.append("groups:")
    for group in scheme.groups:
        lines.append(f"  {name_text(group.name)}:")
        seen: list[str] = []
        for role in group.roles:
            lines.append(f"    {name_text(role.name)}:")
            for culturon in role.culturons:
                if culturon.name in seen:
                    lines.append(f"      {name_text(culturon.name)}: # as described above")
                    continue
                seen.append(culturon.name)
                lines.append(f"      {name_text(culturon.name)}:")
                lines += _rest(culturon, "        ")
    if any(group.attributes for group in scheme.groups):
        lines.append("group_attributes:")
    for group in scheme.groups:
        values = {name: number_text(value) for name, value in group.attributes}
        lines += mapping_lines(name_text(group.name), values, "  ")
    if any(group.within for group in scheme.groups):
        lines.append("nested_groups:")
    for group in scheme.groups:
        if group.within is not None:
            around, part = group.within
            lines += mapping_lines(name_text(group.name), {around: name_text(part)}, "  ")
    lines += mapping_lines("group_positions", _places(scheme.groups), "")
    if any(role.position for group in scheme.groups for role in group.roles):
        lines.append("role_positions:")
    for group in scheme.groups:
        lines += mapping_lines(name_text(group.name), _places(group.roles), "  ")
    return HEADER + "\n".join(lines) + "\n"


def _rest(holder: Cogniton | Culturon, indent: str) -> list[str]:
    """Return the lines of a cogniton or culturon from its start value on."""
    lines = [f"{indent}start: {number_text(holder.start_value)}"]
    if holder.colour != GREY:
        lines.append(indent + "colour: '#{:02x}{:02x}{:02x}'".format(*holder.colour))
    if holder.position is not None:
        lines.append(f"{indent}position: {position_text(holder.position)}")
    influence = {plan: number_text(weight) for plan, weight in holder.influence.items()}
    reinforcement = {plan: number_text(weight) for plan, weight in holder.reinforcement.items()}
    lines += mapping_lines("influence", influence, indent)
    if holder.conditional:
        lines += list_lines("conditional", holder.conditional, indent)
    return lines + mapping_lines("reinforcement", reinforcement, indent)


def _becoming(cogniton: Cogniton, indent: str) -> list[str]:
    """Return the lines that say when a cogniton is active, what it is and how it is passed on."""
    lines = []
    for name in CONDITION_FIELDS:
        texts = [f'"{one}"' for one in getattr(cogniton, name)]
        if texts:
            lines.append(f"{indent}{name}: {texts[0] if len(texts) == 1 else _flow(texts)}")
    if cogniton.type is not None:
        lines.append(f"{indent}type: {cogniton.type}")
    shares = {"chance": cogniton.chance, "inherited": cogniton.inherited}
    lines += [f"{indent}{name}: {number_text(one)}" for name, one in shares.items() if one != 1.0]
    return lines


def _places(parts: Iterable[Group | Role]) -> dict[str, str]:
    """Return the places of those that have one, by their names."""
    return {one.name: position_text(one.position) for one in parts if one.position is not None}


def _flow(texts: list[str]) -> str:
    return f"[{', '.join(texts)}]"
