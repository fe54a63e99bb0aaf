"""The map: which file it is, its size, terrains, rows, and where civilisations begin."""

from __future__ import annotations

from collections.abc import Mapping

from coglogo_py.border.errors import shown
from socialmind.metaciv.description import (
    Civilisation,
    Environment,
    Place,
    Settlement,
    Terrain,
)
from socialmind.metaciv.findings import Findings
from socialmind.metaciv.reading.files import SUFFIX, Document, Line
from socialmind.metaciv.reading.record import Record, fields, matching

WIDEST = 5_000
"""Cells."""
LARGEST = 4_000_000
"""Cells of the map."""


def chosen_map(
    documents: list[Document], carte: Line | None, place: Place, findings: Findings
) -> Document | None:
    """Return the file of the map that the parameters name; None if there is none.

    Args:
        documents: the maps.
        carte: the line that names one.
        place: where it stands, or should.
        findings: where to note what is wrong.
    """
    if carte is None:
        if len(documents) == 1:
            found, remedy = "no line `Carte : …`", f"the map is {documents[0].file}, the only one"
            findings.warn(place, found, remedy=remedy)
            return documents[0]
        findings.error(place, "no line `Carte : …`", "the name of the map's file")
        return None
    by_name = {Record(one, findings).name: one for one in reversed(documents)}
    by_file = {one.stem.strip(): one for one in documents}
    said = carte.value.strip()
    for name in (said, said.removesuffix(SUFFIX), said.split(".")[0]):
        for known in (by_name, by_file):
            found_name = matching(name, known)
            if found_name is not None:
                return known[found_name]
    findings.unknown(place, said, by_file, "a map")
    return None


def settled(document: Document) -> frozenset[str]:
    """Return the civilisations that a map names."""
    lines = [fields(line.value) for line in document.all("Civilisation")]
    return frozenset(",".join(one[:-2]).strip() for one in lines)


def read_environment(
    record: Record, terrains: Mapping[str, Record], civilisations: Mapping[str, Record]
) -> Environment:
    """Return the map that a file says.

    Args:
        record: the file.
        terrains: those that there are.
        civilisations: those that there are; others on the map are left out, with a warning.
    """
    record.check_name()
    width = record.whole("Largeur", low=1, high=WIDEST)
    height = record.whole("Hauteur", low=1, high=WIDEST)
    if width * height > LARGEST:
        place = record.document.place(record.document.first("Largeur"))
        record.findings.error(place, f"{width} × {height} cells", f"at most {LARGEST}")
        height = 1
    lines = record.document.all("Terrain")
    rows = _rows(record, width, height, len(lines))
    return Environment(
        record.name,
        width,
        height,
        _settlements(record, width, height, civilisations),
        _terrains(record, lines, rows, terrains),
        rows,
        record.place,
    )


def _rows(record: Record, width: int, height: int, terrains: int) -> tuple[tuple[int, ...], ...]:
    lines = record.document.all("Rang")
    if len(lines) < height:
        last = record.document.place(lines[-1] if lines else None)
        record.findings.error(last, f"{len(lines)} rows `Rang : …`", f"{height}, the map's Hauteur")
    elif len(lines) > height:
        place, found = record.document.place(lines[height]), f"{len(lines)} rows `Rang : …`"
        remedy = "the further ones were left out"
        record.findings.warn(place, found, f"{height}, the map's Hauteur", remedy)
    return tuple(
        _row(record, line, number, width, terrains)
        for number, line in enumerate(lines[:height], start=1)
    )


def _row(record: Record, line: Line, number: int, width: int, terrains: int) -> tuple[int, ...]:
    """Return the indices of a row, as many as it should have."""
    entries = fields(line.value)
    place = record.document.place(line)
    if len(entries) != width:
        found = f"{len(entries)} entries in row {number}"
        record.findings.error(place, found, f"{width}, the map's Largeur")
        entries = entries[:width]
    try:
        indices = tuple(map(int, entries))
        if indices and min(indices) >= 0 and max(indices) < terrains:
            return indices
    except ValueError:
        pass
    wrong = next(
        (one for one in entries if not (one.isdecimal() and len(one) < 10 and int(one) < terrains)),
        None,
    )
    if wrong is not None:
        expected = f"the index of a terrain, from 0 to {terrains - 1}"
        record.findings.error(place, f"{shown(wrong)} in row {number}", expected)
    return ()


def _terrains(
    record: Record,
    lines: list[Line],
    rows: tuple[tuple[int, ...], ...],
    terrains: Mapping[str, Record],
) -> tuple[str, ...]:
    """Return the names by index; one that is nowhere is an error if a row uses it."""
    names = []
    for index, line in enumerate(lines):
        name = matching(line.value, terrains)
        if name is None:
            place = record.document.place(line)
            user = next((number for number, row in enumerate(rows, 1) if index in row), None)
            what = "a terrain"
            if user is None:
                instead = "no row uses it"
                record.findings.unknown(place, line.value, terrains, what, "warning", instead)
            else:
                use = f"row {user} uses it (index {index})"
                record.findings.unknown(place, line.value, terrains, what, "error", use)
        names.append(line.value.strip() if name is None else name)
    return tuple(names)


def _settlements(
    record: Record, width: int, height: int, civilisations: Mapping[str, Record]
) -> tuple[Settlement, ...]:
    found = []
    for line in record.document.all("Civilisation"):
        parts = record.parts(line, 3, "`civilisation,column,row`")
        if parts is None:
            continue
        said = ",".join(parts[:-2])
        instead = "nobody begins there"
        name = record.known(line, said, civilisations, "a civilisation", instead)
        u = record.whole_in(line, parts[-2], 0, width - 1)
        v = record.whole_in(line, parts[-1], 0, height)
        if name is not None:
            found.append(Settlement(name, u, v, record.document.place(line)))
    if not found:
        expected = "a line `Civilisation : …` with the name of one that has a file"
        record.findings.error(record.place, "nobody begins on the map", expected)
    return tuple(found)


def check_places(
    environment: Environment,
    civilisations: Mapping[str, Civilisation],
    terrains: Mapping[str, Terrain],
    dispersion: bool,
    findings: Findings,
) -> None:
    """Say of each place whose agents could stand nowhere, since all cells are impassable."""
    width, height = environment.width, environment.height
    blocked = [
        terrains[one].impassable if one in terrains else False for one in environment.terrains
    ]
    for one in environment.settlements:
        people = civilisations.get(one.civilisation)
        if people is None or people.agents == 0:
            continue
        x, y = one.u, (height - one.v) % height
        columns, rows = _reach(x, y, people, dispersion)
        free = any(
            not blocked[environment.rows[height - 1 - row % height][column % width]]
            for row in rows[:height]
            for column in columns[:width]
        )
        if not free:
            terrain = environment.terrains[environment.rows[height - 1 - y][x]]
            found = f"{shown(people.name)} begins on {shown(terrain)}, which nobody can enter"
            findings.error(one.place, found, remedy="move the place, or scatter its agents")


def _reach(x: int, y: int, people: Civilisation, dispersion: bool) -> tuple[range, range]:
    """Return the columns and rows, over the edge, where agents of a place may begin."""
    if dispersion:
        around = 0
        while (2 * around + 1) ** 2 < people.agents:
            around += 1
        return range(x - around, x + around + 1), range(y - around, y + around + 1)
    side = max(2 * people.scattered, 1)
    return range(x, x + side), range(y, y + side)
