"""The whole schemes and minds of a sweep: the model's own, those that points name, their copies."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from coglogo_py import CognitiveScheme
from socialmind.experiments.sweeps.points.settings import Key, Settings
from socialmind.experiments.sweeps.points.table import (
    Points,
)
from socialmind.experiments.sweeps.points.varied import MIND, SCHEME, Nameable, Varied
from socialmind.mind.description import MindDescription
from socialmind.mind.files.packing import files_of
from socialmind.runs.schemes import as_kept
from socialmind.runs.sources import hash_of
from socialmind.sources.folders import digest
from socialmind.sources.trust import programs_in, remember

SCHEMES, MINDS = "schemes", "minds"
"""The folders of a sweep's copies."""


def schemes_and_minds(
    there: Nameable, points: Points, fixed: Sequence[tuple[Varied, Any]]
) -> tuple[dict[Key, CognitiveScheme], dict[Key, MindDescription]]:
    """Return all schemes and minds: those that the model has, and those that points name.

    Raises:
        SchemeError: a scheme that cannot be read, likewise a mind.
    """
    cls = there.model_class
    schemes: dict[Key, CognitiveScheme] = {(n, ""): one for n, one in there.schemes.items()}
    minds: dict[Key, MindDescription] = {
        (name, ""): one.assembly.description for name, one in cls.steerings().items()
    }
    for one, value in _named(points, fixed):
        path = Path(value).expanduser()
        if one.kind == SCHEME:
            makers = cls.populations[one.population].decision_makers
            schemes[one.population, value] = CognitiveScheme.load(path, makers)
        elif one.kind == MIND:
            remember(programs_in(path))
            minds[one.population, value] = MindDescription.load(path)
    return schemes, minds


def _named(points: Points, fixed: Sequence[tuple[Varied, Any]]) -> list[tuple[Varied, Any]]:
    """Return what names schemes and minds, and each of the names once."""
    found = [(one, value) for one, value in fixed if one.kind in (SCHEME, MIND)]
    for place, one in enumerate(points.columns):
        if one.kind in (SCHEME, MIND):
            values = dict.fromkeys(row[place] for row in points.values)
            found += [(one, value) for value in values]
    return found


def copies(
    there: Nameable, settings: Settings
) -> tuple[dict[str, dict[str, dict[str, str]]], dict[str, bytes]]:
    """Return what the manifest says of schemes and minds, and the content of their copies."""
    records: dict[str, dict[str, dict[str, str]]] = {SCHEMES: {}, MINDS: {}}
    files: dict[str, bytes] = {}
    for (owner, given), scheme in settings.schemes.items():
        key = _key(owner, records[SCHEMES])
        source = given or there.model_class.populations[owner].mind
        if isinstance(source, str | Path) and not given:
            source = there.model_class.folder() / source
        suffix, content = as_kept(scheme if source is None else source)
        file = f"{SCHEMES}/{key}{suffix}"
        files[file] = content
        records[SCHEMES][key] = {
            "population": owner, "given": given, "name": scheme.name, "file": file,
            "sha256": digest(content),
        }  # fmt: skip
    for (owner, given), mind in settings.minds.items():
        key = _key(owner, records[MINDS])
        found = files_of(mind)
        remember({path: content for path, content in found.items() if path.endswith(".py")})
        folder = f"{MINDS}/{key}"
        files |= {f"{folder}/{path}": content for path, content in found.items()}
        records[MINDS][key] = {
            "population": owner, "given": given, "name": mind.name, "folder": folder,
            "sha256": hash_of(found),
        }  # fmt: skip
    return records, files


def _key(owner: str, taken: Mapping[str, Any]) -> str:
    """Return a name for a copy: that of its population, with a number from the second on."""
    count = sum(one["population"] == owner for one in taken.values())
    return f"{owner}-{count}" if count else owner
