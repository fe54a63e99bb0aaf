"""Plans: lines `Action : …` as trees of actions with their arguments."""

from __future__ import annotations

import re
from collections.abc import Collection
from dataclasses import replace
from typing import Literal

from coglogo_py.border.errors import shown
from socialmind.metaciv.actions import (
    ACTIONS,
    COMPARATORS,
    DIRECTIONS,
    OLD_NAMES,
    Kind,
    Parameter,
    kind_called,
)
from socialmind.metaciv.description import Action, Argument, Place, Plan
from socialmind.metaciv.reading.files import Line
from socialmind.metaciv.reading.names import SchemeNames, WorldNames
from socialmind.metaciv.reading.record import Record, as_number, as_whole, matching

DEEPEST = 50
"""Actions within actions."""
MOST_ACTIONS = 5_000
"""Actions of a plan."""

BIRTH = "A_BirthGroupAndRole"
NO_CONSTANT = "__NoConstant"
CONSTANT = " Constant "
NUMBERS = ("Integer", "Double")
WORLD = {
    "Objet": ("objects", "an object"),
    "Amenagement": ("facilities", "a facility"),
    "Terrain": ("terrains", "a terrain"),
    "Pheromone": ("pheromones", "a pheromone"),
}
SCHEME = {
    "Attribute": ("attributes", "an attribute"),
    "Cogniton": ("cognitons", "a cogniton"),
    "Group": ("groups", "a group"),
}
"""What the names of arguments are names of: the folder's part, and one in words."""
TYPES = (*WORLD, *SCHEME, "GroupAndRole", *NUMBERS, "String", "Comparator")


def read_plan(
    record: Record,
    kind: Literal["plan", "birth", "self"],
    scheme: SchemeNames,
    world: WorldNames,
) -> Plan:
    """Return the plan that a file says."""
    plan = Plan(record.name, kind, _Actions(record, scheme, world).tree(), record.place)
    births = [one for action in plan.actions for one in action.all() if one.name == BIRTH]
    for one in births if kind == "birth" else []:
        found, remedy = f"{BIRTH} in the plan of birth", "each child would have a child at once"
        record.findings.error(one.place, found, "no birth at birth", remedy)
    return plan


_TYPED = re.compile(rf"\((?=(?:{'|'.join(TYPES)}) )")
"""Where the content of an argument begins; a label may hold brackets too."""


def written_arguments(rest: str) -> list[tuple[str, str | None]] | None:
    """Return label and content of each argument behind an action's name; None if malformed.

    >>> written_arguments("EAST")
    [('EAST', None)]
    >>> written_arguments("Modified object(Objet Bread, brown),n(Integer 1 Constant meal)")
    [('Modified object', 'Objet Bread, brown'), ('n', 'Integer 1 Constant meal')]
    >>> written_arguments("n (ticks)(Integer 3)")
    [('n (ticks)', 'Integer 3')]
    >>> written_arguments("n(Integer 1") is None
    True
    """
    found: list[tuple[str, str | None]] = []
    at = 0
    while at < len(rest):
        comma, opened = rest.find(",", at), rest.find("(", at)
        if opened >= 0 and (comma < 0 or opened < comma):
            typed = _TYPED.search(rest, at, len(rest) if comma < 0 else comma)
            opened = opened if typed is None else typed.start()
            closed = rest.find("),", opened)
            if closed < 0:
                if not rest.rstrip().endswith(")"):
                    return None
                closed = rest.rindex(")")
            found.append((rest[at:opened], rest[opened + 1 : closed].split(";")[0]))
            at = closed + 2
        else:
            end = len(rest) if comma < 0 else comma
            found.append((rest[at:end], None))
            at = end + 1
    return found


class _Actions:
    """Reads the actions of one plan."""

    def __init__(self, record: Record, scheme: SchemeNames, world: WorldNames) -> None:
        self.record, self.scheme, self.world = record, scheme, world
        self.findings = record.findings

    def tree(self) -> tuple[Action, ...]:
        """Return the actions at the top, each with its children."""
        nodes: list[tuple[int, Line]] = []
        deepest = 0
        for line in self.record.document.lines:
            if line.key != "Action":
                if line.key.strip() == "Action":
                    place = self.record.document.place(line)
                    found, expected = "blanks before `Action`", "a tab for each step inwards"
                    self.findings.error(place, found, expected)
                continue
            if line.tabs > min(deepest, DEEPEST):
                expected = f"at most {min(deepest, DEEPEST)}"
                self.findings.error(
                    self.record.document.place(line), f"{line.tabs} tabs before `Action`", expected
                )
                continue
            if len(nodes) == MOST_ACTIONS:
                found = f"more than {MOST_ACTIONS} actions"
                self.findings.error(self.record.document.place(line), found, "a smaller plan")
                break
            nodes.append((line.tabs, line))
            deepest = line.tabs + 1
        return self._siblings(nodes, 0, len(nodes))

    def _siblings(self, nodes: list[tuple[int, Line]], begin: int, end: int) -> tuple[Action, ...]:
        """Return the actions of a stretch of lines that begins with one of the outermost."""
        found = []
        while begin < end:
            after = begin + 1
            while after < end and nodes[after][0] > nodes[begin][0]:
                after += 1
            children = self._siblings(nodes, begin + 1, after)
            action = self._action(nodes[begin][1], children)
            found += [] if action is None else [action]
            begin = after
        return tuple(found)

    def _action(self, line: Line, children: tuple[Action, ...]) -> Action | None:
        place = self.record.document.place(line)
        name, _, rest = line.rest.partition(",")
        name = name.strip()
        kind = kind_called(name)
        written = written_arguments(rest)
        if kind is None and name not in self.world.own_actions:
            self.findings.unknown(place, name, [*ACTIONS, *OLD_NAMES], "an action")
            return None
        if written is None:
            self.findings.error(place, shown(rest), "arguments `label(Type value)`")
            return None
        if kind is None:
            found, remedy = f"{name}, an action of the model's own", "its Java class is not read"
            self.findings.unsupported(place, found, remedy)
            return Action(name, (), children, place, None, name)
        given = [self._argument(place, *one) for one in written if one[1] is not None]
        arguments = [one for one in given if one is not None]
        if len(arguments) < len(given):
            return None
        matched = self._matched(kind, arguments, place)
        if matched is None:
            return None
        direction = self._direction(kind, written, place)
        return Action(
            kind.name, matched, self._heeded(kind, children, place), place, direction, name
        )

    def _heeded(self, kind: Kind, children: tuple[Action, ...], place: Place) -> tuple[Action, ...]:
        """Return the children that count."""
        most = kind.most_children
        if self.world.older and kind.name == "L_Repeat":
            most = 1
        if most is not None and len(children) > most:
            found = f"{len(children)} actions within {kind.name}"
            self.findings.warn(place, found, f"at most {most}", "the others were left out")
        return children[:most]

    def _direction(
        self, kind: Kind, written: list[tuple[str, str | None]], place: Place
    ) -> str | None:
        if not kind.has_direction:
            return None
        said = written[0][0].strip() if written else ""
        if said not in DIRECTIONS:
            self.findings.error(place, shown(said), f"a direction: {', '.join(DIRECTIONS)}")
            return None
        return said

    def _matched(
        self, kind: Kind, given: list[Argument], place: Place
    ) -> tuple[Argument, ...] | None:
        """Return the arguments in the order in which the kind of action wants them."""
        left = list(given)
        found: dict[int, Argument] = {}
        wanted = list(enumerate(kind.arguments))
        wanted.sort(key=lambda one: not one[1].label)
        for by_label in (True, False):
            for number, parameter in wanted:
                if number not in found and (parameter.label or not by_label):
                    label = parameter.label if by_label else None
                    argument = _chosen(parameter, label, left)
                    if argument is not None:
                        left.remove(argument)
                        found[number] = argument
        missing = [one for number, one in enumerate(kind.arguments) if number not in found]
        for one in missing:
            what = f"{one.label} " if one.label else ""
            expected = f"an argument `{one.label or 'label'}({one.types[0]} …)`"
            self.findings.error(place, f"{kind.name} without its {what}{one.types[0]}", expected)
        converted = [
            self._converted(parameter, found[number], kind, place)
            for number, parameter in enumerate(kind.arguments)
            if number in found
        ]
        complete = [one for one in converted if one is not None]
        return tuple(complete) if len(complete) == len(kind.arguments) else None

    def _converted(
        self, parameter: Parameter, argument: Argument, kind: Kind, place: Place
    ) -> Argument | None:
        """Return an argument as the parameter wants it, or None; says what is wrong."""
        type_ = argument.type if argument.type in parameter.types else parameter.types[0]
        value = argument.value
        if type_ == "Integer" and isinstance(value, float):
            if not value.is_integer():
                self.findings.error(place, shown(value), "a whole number")
                return None
            value = int(value)
        elif type_ == "Double":
            value = float(value)
        elif type_ == "Objet" and argument.type == "String":
            known = self._known(place, str(value), self.world.records["objects"], "an object")
            if known is None:
                return None
            value = known
        constant = argument.constant
        if constant is not None and not parameter.heeds_constants:
            found = f"the constant {shown(constant)}, which {kind.name} does not heed"
            self.findings.warn(place, found, remedy=f"{argument.value} counts")
            constant = None
        elif constant is not None and constant not in self.scheme.records["constants"]:
            constants, instead = self.scheme.records["constants"], f"{argument.value} counts"
            self.findings.unknown(place, constant, constants, "a constant", "warning", instead)
            constant = None
        return replace(argument, type=type_, value=value, constant=constant)

    def _argument(self, place: Place, label: str, content: str | None) -> Argument | None:
        """Return one argument as it is written, or None; says what is wrong."""
        type_, _, text = (content or "").strip().partition(" ")
        if type_ not in TYPES:
            self.findings.unknown(place, type_, TYPES, "a type of arguments")
            return None
        constant = None
        if type_ in NUMBERS:
            text, _, said = text.partition(CONSTANT)
            constant = None if said.strip() in ("", NO_CONSTANT) else said.strip()
        name = text.strip()
        if type_ == "Integer":
            whole = as_whole(name)
            if whole is None:
                self.findings.error(place, shown(name), "a whole number")
                return None
            return Argument(type_, whole, label, place, None, constant)
        if type_ == "Double":
            number = as_number(name)
            if number is None:
                self.findings.error(place, shown(name), "a number")
                return None
            return Argument(type_, number, label, place, None, constant)
        if type_ == "Comparator":
            if name not in COMPARATORS:
                self.findings.error(place, shown(name), f"one of {' '.join(COMPARATORS)}")
                return None
            return Argument(type_, name, label, place)
        if type_ == "String":
            if not text.isprintable() or len(text) > 200:
                self.findings.error(place, shown(text), "at most 200 printed characters")
                return None
            return Argument(type_, text, label, place)
        if type_ == "GroupAndRole":
            return self._group_and_role(place, label, name)
        part, what = WORLD.get(type_) or SCHEME[type_]
        records = self.world.records if type_ in WORLD else self.scheme.records
        known = self._known(place, name, records[part], what)
        return None if known is None else Argument(type_, known, label, place)

    def _group_and_role(self, place: Place, label: str, text: str) -> Argument | None:
        name, colon, said = text.rpartition(":")
        if not colon:
            self.findings.error(place, shown(text), "`group:role`")
            return None
        group = self._known(place, name, self.scheme.roles, "a group")
        if group is None:
            return None
        role = self._known(place, said, self.scheme.roles[group], f"a role of {shown(group)}")
        return None if role is None else Argument("GroupAndRole", group, label, place, role)

    def _known(self, place: Place, text: str, names: Collection[str], what: str) -> str | None:
        """Return the declared name that a text means: all of it, or up to its first blank."""
        found = matching(text, names)
        if found is None and " " in text:
            found = matching(text.split(" ")[0], names)
        if found is None:
            self.findings.unknown(place, text, names, what)
        return found


def _chosen(parameter: Parameter, label: str | None, given: list[Argument]) -> Argument | None:
    """Return the argument that a parameter takes of those left, None if none fits."""
    for types in (parameter.types, _stand_ins(parameter)):
        for one in given:
            if one.type in types and (label is None or one.label.strip() == label):
                return one
    return None


def _stand_ins(parameter: Parameter) -> tuple[str, ...]:
    """Return further types of arguments that are taken for what is wanted."""
    return {"Integer": ("Double",), "Double": ("Integer",), "Objet": ("String",)}.get(
        parameter.types[0], ()
    )
