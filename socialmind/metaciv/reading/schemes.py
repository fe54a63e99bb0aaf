"""Cognitive schemes: attributes, constants, cognitons, groups and plans."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import replace
from typing import Literal

from coglogo_py.border.errors import shown
from socialmind.metaciv.description import (
    Attribute,
    Cogniton,
    Constant,
    Group,
    Influence,
    Permit,
    Place,
    Plan,
    Role,
    Scheme,
    Trigger,
)
from socialmind.metaciv.findings import Findings
from socialmind.metaciv.reading.arguments import NO_CONSTANT
from socialmind.metaciv.reading.files import SUFFIX, Folder, Line
from socialmind.metaciv.reading.names import SchemeNames, WorldNames
from socialmind.metaciv.reading.plans import read_plan
from socialmind.metaciv.reading.record import Record, as_whole, fields, unlike

COMPARISONS: dict[int | None, Literal["<", "<=", "==", ">=", ">"]] = {
    2: ">", 1: ">=", 0: "==", -1: "<=", -2: "<",
}  # fmt: skip
"""What the codes of triggers mean."""
PARTS = {
    "attributes": "attribute",
    "constants": "constant",
    "cognitons": "cogniton",
    "groups": "group",
    "plans": "plan",
}
"""The folders of a scheme, and what is in them."""
TYPES = ("belief", "meme", "percept", "skill", "trait")
"""The types of cognitons; all other words mean a culturon."""


def read_scheme(
    folder: Folder, part: str, name: str, place: Place, world: WorldNames, findings: Findings
) -> Scheme:
    """Return the scheme of a folder.

    Args:
        folder: the model's.
        part: the scheme's, below it.
        name: of the scheme.
        place: where its name stands.
        world: what it may name beside its own parts.
        findings: where to note what is wrong with it.
    """
    inside = Folder(folder.root, findings)
    documents = {one: inside.documents(f"{part}/{one}" if part else one) for one in PARTS}
    documents["cognitons"] += inside.documents(
        f"{part}/cloudCognitons" if part else "cloudCognitons"
    )
    records = {one: unlike(documents[one], what, findings) for one, what in PARTS.items()}
    own = SchemeNames(
        records, {one: _role_names(record) for one, record in records["groups"].items()}
    )
    cognitons = [_cogniton(record, own) for record in records["cognitons"].values()]
    permitted = {link.plan for one in cognitons for link in one.permits}
    plans = _plans(own, world, permitted, findings)
    there = {one.name for one in plans}
    return Scheme(
        name,
        tuple(
            Attribute(one, record.number("Starting value", 0.0), record.place)
            for one, record in records["attributes"].items()
        ),
        tuple(
            Constant(one, record.number("Value"), record.place)
            for one, record in records["constants"].items()
        ),
        tuple(
            replace(one, influences=tuple(link for link in one.influences if link.plan in there))
            for one in cognitons
        ),
        tuple(_group(record, own) for record in records["groups"].values()),
        plans,
        place,
    )


def head(folder: Folder, part: str, findings: Findings) -> tuple[str, Place]:
    """Return the name of the scheme in a folder, and where it stands."""
    own = part.rpartition("/")[2]
    document = folder.document(f"{part}/{own}{SUFFIX}")
    if document is None:
        others = folder.documents(part)
        document = others[0] if others else None
    if document is None:
        place = Place(f"{part}/{own}{SUFFIX}", 1)
        findings.warn(place, "no such file", remedy=f"the scheme was called {shown(own)}")
        return own, place
    record = Record(document, findings)
    record.check_name()
    return record.name, record.place


def _kinds(own: SchemeNames) -> dict[str, Literal["plan", "birth", "self"]]:
    """Return what plans are for; of several at birth, or in every tick, the last file's is this."""
    records = own.records["plans"]
    kinds: dict[str, Literal["plan", "birth", "self"]] = dict.fromkeys(records, "plan")
    for name, record in records.items():
        if record.truth("Self"):
            kinds[name] = "self"
        elif record.truth("Birth"):
            kinds[name] = "birth"
    last = {kind: name for name, kind in kinds.items()}
    for name, kind in list(kinds.items()):
        if kind != "plan" and last[kind] != name:
            found = f"a second {kind} plan beside {shown(last[kind])}"
            remedy = f"{shown(last[kind])} counts, the last; this is a plan like others"
            records[name].findings.warn(records[name].place, found, remedy=remedy)
            kinds[name] = "plan"
    return kinds


def _plans(
    own: SchemeNames, world: WorldNames, permitted: Collection[str], findings: Findings
) -> tuple[Plan, ...]:
    """Return the plans but those with faults that nothing ever begins."""
    kept = []
    for name, kind in _kinds(own).items():
        faults = Findings()
        plan = read_plan(Record(own.records["plans"][name].document, faults), kind, own, world)
        unused = kind == "plan" and name not in permitted
        findings.take(faults, "nothing permits this plan" if unused else None)
        if not (unused and faults.errors):
            kept.append(plan)
    return tuple(kept)


def _cogniton(record: Record, own: SchemeNames) -> Cogniton:
    document = record.document
    plans = own.records["plans"]
    permits, influences, triggers = [], [], []
    for line in document.all("Permet"):
        plan = record.known(line, line.value, plans, "a plan")
        if plan is not None:
            permits.append(Permit(plan, document.place(line)))
    for line in document.all("Influence"):
        parts = record.parts(line, 2, "`plan,whole number`")
        if parts is not None:
            plan = record.known(line, ",".join(parts[:-1]), plans, "a plan")
            weight = record.whole_in(line, parts[-1])
            if plan is not None:
                influences.append(Influence(plan, weight, document.place(line)))
    for line in document.all("Trigger"):
        trigger = _trigger(record, line, own)
        triggers += [] if trigger is None else [trigger]
    for line in document.all("Chaine"):
        found, remedy = "a chain, which has no effect in MetaCiv", "it was left out"
        record.findings.warn(document.place(line), found, remedy=remedy)
    line_of_type = document.first("Type")
    type_ = "" if line_of_type is None else line_of_type.value.strip().lower()
    chance, colour, initial = (document.first(one) for one in ("StartChance", "Couleur", "Initial"))
    return Cogniton(
        record.name,
        record.text("Description"),
        type_ if type_ in TYPES else "culturon",
        initial is not None and initial.value.strip() == "1",
        0 if chance is None else min(max(record.whole_in(chance, chance.value), 0), 100),
        None if colour is None else as_whole(colour.value),
        tuple(permits),
        tuple(influences),
        tuple(triggers),
        record.place,
    )


def _trigger(record: Record, line: Line, own: SchemeNames) -> Trigger | None:
    place = record.document.place(line)
    parts = record.parts(line, 3, "`attribute,number,code[,constant]`")
    if parts is None:
        return None
    name, threshold, code, *constants = parts
    attribute = record.known(line, name, own.records["attributes"], "an attribute")
    number = record.number_in(line, threshold)
    comparison = COMPARISONS.get(as_whole(code))
    if comparison is None:
        expected = "a code from -2 to 2: <, <=, ==, >=, >"
        record.findings.error(place, shown(code), expected)
    constant = None
    if constants and constants[0].strip() != NO_CONSTANT:
        known = own.records["constants"]
        instead = f"{threshold} counts"
        constant = record.known(line, constants[0], known, "a constant", instead)
    if attribute is None or comparison is None:
        return None
    return Trigger(attribute, number, comparison, constant, place)


def _role_names(record: Record) -> tuple[str, ...]:
    """Return the roles of a group: those that have a culturon."""
    parts = [fields(line.value) for line in record.document.all("Culturon")]
    return tuple(dict.fromkeys(one[0].strip() for one in parts if len(one) > 1))


def _group(record: Record, own: SchemeNames) -> Group:
    document = record.document
    culturons: dict[str, list[str]] = {}
    places: dict[str, Place] = {}
    for line in document.all("Culturon"):
        parts = record.parts(line, 2, "`role,cogniton`")
        if parts is None:
            continue
        role = record.checked_name(parts[0].strip(), document.place(line))
        places.setdefault(role, document.place(line))
        said = ",".join(parts[1:])
        cogniton = record.known(line, said, own.records["cognitons"], "a cogniton")
        culturons.setdefault(role, []).extend([] if cogniton is None else [cogniton])
    joined, auto_join = None, document.first("AutoJoin")
    if auto_join is not None:
        truth, *role_joined = fields(auto_join.value) or ["false"]
        if record.truth_in(auto_join, truth):
            said, what = ",".join(role_joined), f"a role of {shown(record.name)}"
            joined = record.known(auto_join, said, culturons, what)
    roles = tuple(
        Role(role, tuple(dict.fromkeys(lent)), places[role]) for role, lent in culturons.items()
    )
    return Group(record.name, roles, joined, record.place)
