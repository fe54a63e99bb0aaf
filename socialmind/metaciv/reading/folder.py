"""A model's folder, read as a whole: a description, and all findings at once."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Literal

from coglogo_py.border.errors import shown
from socialmind.errors import SocialmindError
from socialmind.metaciv.description import (
    Civilisation,
    Model,
    Parameters,
    Pheromone,
    Place,
    Scheme,
)
from socialmind.metaciv.findings import Finding, Findings
from socialmind.metaciv.reading.environment import (
    check_places,
    chosen_map,
    read_environment,
    settled,
)
from socialmind.metaciv.reading.files import LARGEST_MAP, Document, Folder
from socialmind.metaciv.reading.names import WorldNames
from socialmind.metaciv.reading.record import Record, unlike
from socialmind.metaciv.reading.schemes import head, read_scheme
from socialmind.metaciv.reading.things import (
    read_civilisation,
    read_effect,
    read_facility,
    read_object,
    read_terrain,
)
from socialmind.sources.folders import METACIV_FILE, spelled

SCHEMES, WORLD = "schemasCognitifs", "simulation"
MAKERS: dict[str, Literal["MaxWeight", "WeightedStochastic", "MaxWeightOx2"]] = {
    "MaxWeightDecisionMaker": "MaxWeight",
    "WeightedStochasticDecisionMaker": "WeightedStochastic",
    "MaxWeightOx2_DecisionMaker": "MaxWeightOx2",
}
"""The decision makers by the names of their classes."""
PARTS = {
    "pheromones": ("itemPheromones", "pheromone"),
    "terrains": ("terrains", "terrain"),
    "effects": ("effects", "effect"),
    "objects": ("objets", "object"),
    "facilities": ("amenagements", "facility"),
    "civilisations": ("civilisations", "civilisation"),
}
"""What there is in the world: the folder, and one of it in words."""


@dataclass(frozen=True, slots=True)
class Reading:
    """What came of reading a folder.

    Args:
        model: what it says; None if there is an error.
        findings: errors, warnings and what is not supported, by file and line.
    """

    model: Model | None
    findings: tuple[Finding, ...]

    @property
    def errors(self) -> tuple[Finding, ...]:
        """The errors alone."""
        return tuple(one for one in self.findings if one.severity == "error")


def read_folder(path: str | Path) -> Reading:
    """Read a model of MetaCiv's, of the format V2.0 or the older, flat one.

    Args:
        path: the folder with `parametres.metaciv`.

    Returns:
        The description and all findings. Nothing of the folder is executed, and no file outside it
        is read.

    Raises:
        SocialmindError: there is no such folder, or no `parametres.metaciv` in it.
    """
    root = Path(path)
    if not root.is_dir():
        raise SocialmindError(f"{path}: no such folder")
    if not spelled(root / METACIV_FILE).is_file():
        raise SocialmindError(
            f"{path}: found no {METACIV_FILE}; expected the folder of a model of MetaCiv's"
        )
    findings = Findings()
    model = _model(Folder(root, findings), findings)
    return Reading(None if findings.errors else model, tuple(findings))


def _model(folder: Folder, findings: Findings) -> Model | None:
    older = not (folder.has(SCHEMES) or folder.has(WORLD))
    home = "" if older else f"{WORLD}/"
    world = WorldNames(
        {
            part: unlike(folder.documents(f"{home}{name}"), what, findings)
            for part, (name, what) in PARTS.items()
        },
        folder.class_names(f"{home}actions"),
        older,
    )
    head_document = folder.document(METACIV_FILE)
    if head_document is None:
        return None
    head_record = Record(head_document, findings)
    chosen = _chosen_map(folder, home, head_document, findings)
    schemes = _schemes(folder, world, findings)
    civilisations = _civilisations(world, schemes, chosen)
    used = _without_unused(schemes, civilisations, older, findings)
    parameters = _parameters(head_record)
    records = world.records
    objects = records["objects"]
    terrains = {
        one: read_terrain(it, records["pheromones"]) for one, it in records["terrains"].items()
    }
    effects = {name: read_effect(one, used, objects) for name, one in records["effects"].items()}
    made = tuple(read_object(one, objects, effects) for one in objects.values())
    facilities = tuple(
        read_facility(one, objects, effects) for one in records["facilities"].values()
    )
    if chosen is None:
        return None
    environment = read_environment(
        Record(chosen, findings), records["terrains"], records["civilisations"]
    )
    if not findings.errors:
        check_places(environment, civilisations, terrains, parameters.dispersion, findings)
    return Model(
        folder.root.name,
        older,
        parameters,
        environment,
        used,
        tuple(civilisations.values()),
        tuple(terrains.values()),
        made,
        facilities,
        tuple(Pheromone(one, record.place) for one, record in records["pheromones"].items()),
        tuple(one for one in effects.values() if one is not None),
    )


def _chosen_map(folder: Folder, home: str, head: Document, findings: Findings) -> Document | None:
    """Return the map that counts; what is odd in others does not matter."""
    of_maps = Findings()
    maps = Folder(folder.root, of_maps).documents(f"{home}environnements", LARGEST_MAP)
    carte = head.first("Carte")
    chosen = chosen_map(maps, carte, head.place(carte), findings)
    for one in of_maps:
        if chosen is None or one.place.file == chosen.file:
            findings.add(one)
    return chosen


def _parameters(record: Record) -> Parameters:
    line = record.document.first("DecisionMaker")
    maker: Literal["MaxWeight", "WeightedStochastic", "MaxWeightOx2"] = "WeightedStochastic"
    if line is not None:
        said = line.value.strip().rpartition(".")[2]
        name = record.known(line, said, MAKERS, "a decision maker")
        maker = maker if name is None else MAKERS[name]
    carte = record.document.first("Carte")
    return Parameters(
        "" if carte is None else carte.value,
        maker,
        record.whole("RoadCreation", 30),
        record.whole("RoadEvaporation", 1),
        record.whole("VisionRadius", 10),
        record.whole("Dispersion", 0, 0, 1) == 1,
        record.document.place(),
    )


def _schemes(
    folder: Folder, world: WorldNames, findings: Findings
) -> dict[str, tuple[Scheme, Findings]]:
    """Return the schemes by name, each with what is wrong in it."""
    if world.older:
        own = Findings()
        place = Place(METACIV_FILE, 1)
        name = folder.root.name
        return {name: (read_scheme(folder, "", name, place, world, own), own)}
    found: dict[str, tuple[Scheme, Findings]] = {}
    for one in folder.folders(SCHEMES):
        part, own = f"{SCHEMES}/{one}", Findings()
        name, place = head(folder, part, findings)
        if name in found:
            remedy = f"{found[name][0].place.file} counts"
            findings.warn(place, f"a second scheme called {shown(name)}", remedy=remedy)
            continue
        found[name] = (read_scheme(folder, part, name, place, world, own), own)
    return found


def _civilisations(
    world: WorldNames,
    schemes: Mapping[str, tuple[Scheme, Findings]],
    chosen: Document | None,
) -> dict[str, Civilisation]:
    on_map = frozenset() if chosen is None else settled(chosen)
    known = [scheme for scheme, _ in schemes.values()]
    found = {}
    for name, record in world.records["civilisations"].items():
        civilisation = read_civilisation(record, known, on_map, world.older)
        if civilisation is not None:
            found[name] = civilisation
    return found


def _without_unused(
    schemes: Mapping[str, tuple[Scheme, Findings]],
    civilisations: Mapping[str, Civilisation],
    older: bool,
    findings: Findings,
) -> tuple[Scheme, ...]:
    """Return the schemes, but one that no civilisation has and in which something is wrong."""
    wanted = {one.scheme for one in civilisations.values()}
    kept = []
    for name, (scheme, own) in schemes.items():
        unused = name not in wanted and not older
        findings.take(own, "no civilisation has this scheme" if unused else None)
        if not (unused and own.errors):
            kept.append(scheme)
    return tuple(kept)
