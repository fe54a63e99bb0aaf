"""The arguments of actions: as they are written, and as a kind of action wants them."""

from __future__ import annotations

import re
from collections.abc import Collection
from dataclasses import replace
from typing import NamedTuple

from coglogo_py.border.errors import shown
from socialmind.metaciv.actions import COMPARATORS, Kind, Parameter
from socialmind.metaciv.description import Argument, Place
from socialmind.metaciv.findings import Findings
from socialmind.metaciv.reading.names import SchemeNames, WorldNames
from socialmind.metaciv.reading.record import INT, LONGEST_NAME, as_number, as_whole, matching

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
STAND_INS = {"Integer": ("Double",), "Double": ("Integer",), "Objet": ("String",)}
"""Further types of arguments that are taken for what is wanted."""


class Written(NamedTuple):
    """An argument as it is written: `label(content)`, or a label alone."""

    label: str
    content: str | None


_TYPED = re.compile(rf"\((?=(?:{'|'.join(TYPES)}) )")
"""Where the content of an argument begins; a label may hold brackets too."""


def written_arguments(rest: str) -> list[Written] | None:
    """Return what stands behind an action's name; None if it is malformed.

    >>> written_arguments("EAST")
    [Written(label='EAST', content=None)]
    >>> for one in written_arguments("Modified object(Objet Bread, brown),n (ticks)(Integer 1)"):
    ...     print(one.label, "|", one.content)
    Modified object | Objet Bread, brown
    n (ticks) | Integer 1
    >>> written_arguments("n(Integer 1") is None
    True
    """
    found: list[Written] = []
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
            content = rest[opened + 1 : closed].split(";")[0]
            found.append(Written(rest[at:opened], content))
            at = closed + 2
        else:
            end = len(rest) if comma < 0 else comma
            found.append(Written(rest[at:end], None))
            at = end + 1
    return found


class Arguments:
    """Reads what actions are given.

    Args:
        findings: where to note what is wrong.
        scheme: what the plan's scheme may name.
        world: what all schemes may name.
    """

    def __init__(self, findings: Findings, scheme: SchemeNames, world: WorldNames) -> None:
        self.findings, self.scheme, self.world = findings, scheme, world

    def read(self, kind: Kind, written: list[Written], place: Place) -> tuple[Argument, ...] | None:
        """Return what an action is given, in the order in which its kind wants it.

        Args:
            kind: of the action.
            written: what stands behind its name; what has no content counts for nothing.
            place: of the action.

        Returns:
            The arguments; None if there is something wrong, which was said.
        """
        contents = [(one.label, one.content) for one in written if one.content is not None]
        given = [self._argument(place, label, content) for label, content in contents]
        if None in given:
            return None
        left = [one for one in given if one is not None]
        found: dict[int, Argument] = {}
        for by_label in (True, False):
            for number, parameter in enumerate(kind.arguments):
                if number not in found and (parameter.label or not by_label):
                    chosen = _chosen(parameter, left, by_label)
                    if chosen is not None:
                        left.remove(chosen)
                        found[number] = chosen
        complete = []
        for number, parameter in enumerate(kind.arguments):
            if number in found:
                complete.append(self._converted(parameter, found[number], kind, place))
            else:
                what = " ".join(one for one in (parameter.label, parameter.types[0]) if one)
                expected = f"an argument `{parameter.label or 'label'}({parameter.types[0]} …)`"
                self.findings.error(place, f"{kind.name} without its {what}", expected)
                complete.append(None)
        whole = tuple(one for one in complete if one is not None)
        if len(whole) < len(complete):
            return None
        groups = [one for one in whole if one.type == "GroupAndRole"]
        for one in groups[1:]:
            if one.value != groups[0].value:
                both = f"{one.value}:{one.role} beside {groups[0].value}:{groups[0].role}"
                self.findings.error(place, both, "two roles of one group")
                return None
        return whole

    def _converted(
        self, parameter: Parameter, argument: Argument, kind: Kind, place: Place
    ) -> Argument | None:
        """Return an argument as the parameter wants it, or None; says what is wrong."""
        type_ = argument.type if argument.type in parameter.types else parameter.types[0]
        value = argument.value
        if type_ == "Integer" and isinstance(value, float):
            if not value.is_integer() or not INT[0] <= value <= INT[1]:
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

    def _argument(self, place: Place, label: str, content: str) -> Argument | None:
        """Return one argument as it is written, or None; says what is wrong."""
        type_, _, text = content.strip().partition(" ")
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
            if not text.isprintable() or len(text) > LONGEST_NAME:
                expected = f"at most {LONGEST_NAME} printed characters"
                self.findings.error(place, shown(text), expected)
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


def _chosen(parameter: Parameter, left: list[Argument], by_label: bool) -> Argument | None:
    """Return the argument that a parameter takes of those left, None if none fits."""
    for types in (parameter.types, STAND_INS.get(parameter.types[0], ())):
        for one in left:
            if one.type in types and (not by_label or one.label.strip() == parameter.label):
                return one
    return None
