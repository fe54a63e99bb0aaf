"""What is in the world: pheromones, terrains, effects, objects, facilities, civilisations."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from typing import Literal

from coglogo_py.border.errors import shown
from socialmind.metaciv.description import (
    Civilisation,
    Deposit,
    Effect,
    Facility,
    Ingredient,
    Object,
    Scheme,
    Terrain,
)
from socialmind.metaciv.reading.record import INT, Record, as_whole, fields

MOST_AGENTS = 1_000_000
"""Agents of a civilisation."""
TARGETS: dict[str, Literal["attribute", "cogniton", "object"]] = {
    "attribut": "attribute",
    "cogniton": "cogniton",
    "objet": "object",
}
KINDS: tuple[Literal["set", "add", "remove"], ...] = ("set", "add", "remove")


def read_terrain(record: Record, pheromones: Collection[str]) -> Terrain:
    """Return the terrain that a file says."""
    deposits = []
    for line in record.document.all("Pheromone"):
        place = record.document.place(line)
        parts = record.parts(line, 3, "`pheromone,initial,growth`")
        if parts is None:
            continue
        pheromone = record.known(line, parts[0], pheromones, "a pheromone")
        initial, growth = (record.number_in(line, one) for one in parts[1:3])
        if growth > 0:
            found, remedy = f"{shown(parts[0])} grows without bound", "MetaCiv knows no cap"
            record.findings.warn(place, found, remedy=remedy)
        if pheromone is not None:
            deposits.append(Deposit(pheromone, initial, growth, place))
    return Terrain(
        record.name,
        record.colour("Couleur"),
        record.whole("Passabilite", low=0),
        record.truth("Infranchissable"),
        tuple(deposits),
        record.place,
    )


def read_effect(
    record: Record, schemes: Collection[Scheme], objects: Collection[str]
) -> Effect | None:
    """Return the effect that a file says; None, with a warning, where its target is nowhere."""
    findings, place = record.findings, record.place
    target_line, name_line = record.document.first("Cible"), record.document.first("NomCible")
    said = "" if target_line is None else target_line.value.strip().lower()
    target = TARGETS.get(said)
    if target is None:
        expected, remedy = f"one of {', '.join(TARGETS)}", "the effect was left out"
        where = record.document.place(target_line)
        findings.warn(where, f"the target {shown(said)}", expected, remedy)
        return None
    names: dict[str, Collection[str]] = {
        "attribute": [one.name for scheme in schemes for one in scheme.attributes],
        "cogniton": [one.name for scheme in schemes for one in scheme.cognitons],
        "object": objects,
    }
    if name_line is None:
        findings.warn(place, "no line `NomCible : …`", None, "the effect was left out")
        return None
    what = f"an {target}" if target != "cogniton" else "a cogniton"
    known = record.known(name_line, name_line.value, names[target], what, "the effect was left out")
    kind = record.whole("Type", 0, 0, 2)
    activation = record.whole("Activation", 2)
    if known is None:
        return None
    return Effect(
        record.name,
        target,
        known,
        record.number("Valeur", 0.0),
        record.truth("Permanence"),
        KINDS[min(max(kind, 0), 2)],
        "possession" if activation == 0 else "use" if activation == 1 else "never",
        place,
    )


def read_object(
    record: Record, objects: Collection[str], effects: Mapping[str, Effect | None]
) -> Object:
    """Return the object that a file says."""
    return Object(
        record.name,
        record.text("Description"),
        _effects(record, effects),
        _recipe(record, objects),
        record.place,
    )


def read_facility(
    record: Record, objects: Collection[str], effects: Mapping[str, Effect | None]
) -> Facility:
    """Return the facility that a file says."""
    return Facility(record.name, _effects(record, effects), _recipe(record, objects), record.place)


def read_civilisation(
    record: Record, schemes: Collection[Scheme], settled: Collection[str], older: bool
) -> Civilisation | None:
    """Return the civilisation that a file says.

    Args:
        record: the file.
        schemes: those that there are.
        settled: the civilisations that the map names; of others a missing scheme is a warning.
        older: whether the folder is of the format of 2014.
    """
    agents = record.whole("Agents", low=0, high=MOST_AGENTS)
    scheme = _scheme(record, schemes, None if record.name in settled else "it was left out", older)
    if scheme is None:
        return None
    cognitons = []
    if older:
        known = [one.name for one in scheme.cognitons]
        for line in record.document.all("Cogniton"):
            name = record.known(line, fields(line.value)[0], known, "a cogniton")
            cognitons += [] if name is None else [name]
    return Civilisation(
        record.name,
        agents,
        record.whole("Scattered", 0, 0, 10_000),
        record.colour("Couleur"),
        scheme.name,
        tuple(dict.fromkeys(cognitons)),
        record.place,
    )


def _scheme(
    record: Record, schemes: Collection[Scheme], instead: str | None, older: bool
) -> Scheme | None:
    names = {one.name: one for one in schemes}
    line = record.document.first("SchemaCognitif")
    if older or (line is None and len(names) == 1):
        scheme = next(iter(schemes))
        if not older:
            found, remedy = "no line `SchemaCognitif : …`", f"it has {shown(scheme.name)}"
            record.findings.warn(record.place, found, remedy=remedy)
        return scheme
    if line is None:
        severity = record.findings.error if instead is None else record.findings.warn
        severity(record.place, "no line `SchemaCognitif : …`", "the name of a scheme", instead)
        return None
    name = record.known(line, line.value, names, "a scheme", instead)
    return None if name is None else names[name]


def _effects(record: Record, effects: Mapping[str, Effect | None]) -> tuple[str, ...]:
    """Return the effects of a thing but those left out; one that is nowhere is a warning."""
    line = record.document.first("Effects")
    if line is None:
        return ()
    found = [
        record.known(line, one, effects, "an effect", "it was left out")
        for one in fields(line.value)
    ]
    return tuple(one for one in found if one is not None and effects[one] is not None)


def _recipe(record: Record, objects: Collection[str]) -> tuple[Ingredient, ...]:
    """Return what a thing is made of."""
    names, counts = record.document.first("Objets"), record.document.first("Nombre")
    if names is None:
        return ()
    parts = fields(names.value)
    numbers = [] if counts is None else fields(counts.value)
    if len(numbers) != len(parts):
        found = f"{len(parts)} objects and {len(numbers)} numbers"
        place = record.document.place(counts or names)
        record.findings.error(place, found, "a number for each object")
        return ()
    recipe = []
    for name, number in zip(parts, numbers, strict=True):
        known = record.known(names, name, objects, "an object")
        count = as_whole(number)
        if count is None or not 0 <= count <= INT[1]:
            place = record.document.place(counts)
            record.findings.error(place, shown(number), "a whole number of 0 or more")
        elif known is not None and count:
            recipe.append(Ingredient(known, count))
    return tuple(recipe)
