"""A run's folder: the manifest that says what the run is, and where its files lie.

- status ``finished``: the merged tables are the run's result;
- any other status: the checkpoint, if there is one, says which parts of the tables count.
"""

from __future__ import annotations

import hashlib
import json
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, ClassVar

from socialmind.runs.folders import (
    FAILED,
    FINISHED,
    FORMAT,
    INTERRUPTED,
    MANIFEST,
    RUNNING,
    FolderManifest,
    ManifestFolder,
    make_folder,
)
from socialmind.runs.record import (
    NAME_WITHIN,
    NUMBER,
    PATH,
    SETTING,
    SHA256,
    SOURCES,
    TEXT,
    TRUTH,
    Each,
    Fields,
    Many,
    check_record,
    one_of,
    optional,
    whole,
    within,
)
from socialmind.runs.tables import TABLES

IDLE = Fields(
    {}, {"count": whole(), "first_agent": optional(whole()), "first_tick": optional(whole())}
)
_TABLE = Fields({"rows": whole(), "columns": Each(TEXT), "sha256": SHA256}, {})
_BOTH_TABLES = Fields(dict.fromkeys(TABLES, _TABLE), {})
_FIELDS = Fields(
    {
        "model": Fields(
            {"name": TEXT, "path": optional(PATH), "source_sha256": optional(SHA256)},
            {"sources": SOURCES},
        ),
        "parameters": Each(SETTING),
        "seed": whole(0, 2**64 - 1),
        "compiled": TRUTH,
        "schemes": Each(Fields({"file": NAME_WITHIN, "sha256": SHA256}, {"name": TEXT})),
        "ticks": whole(),
        "every": whole(1),
        "agents_every": whole(1),
        "status": one_of(RUNNING, INTERRUPTED, FAILED, FINISHED),
        "ticks_done": whole(),
    },
    {
        "error": optional(TEXT),
        "engine": one_of("compiled", "pymunk"),
        "minds": Each(Fields({"folder": NAME_WITHIN, "sha256": SHA256}, {"name": TEXT})),
        "tables": Each(_TABLE),
        "idle": IDLE,
        "timings": Fields({}, {"created": TEXT, "seconds": NUMBER, "loop_seconds": NUMBER}),
        "versions": Each(TEXT),
        "platforms": Many(Each(TEXT)),
    },
)
"""What a manifest holds; fields that came later may be missing."""


@dataclass(frozen=True)
class Manifest(FolderManifest):
    """What a run is and how far it came; the content of ``manifest.json``.

    Args:
        model: ``name``, ``path`` (folder; None for a class that no file defines), ``source_sha256``
            of the folder's Python files, and ``sources``: all that decided how it runs, as
            `socialmind.sources.provenance.Sources.record` says it.
        parameters: value of every parameter.
        seed: of the run.
        compiled: whether compiled or interpreted; the result is the same.
        schemes: for each population with minds, its cognitive scheme's ``name``, ``file`` (the
            copy in the run's folder) and ``sha256`` of that copy.
        engine: on a plane, what moves the bodies: ``compiled`` or ``pymunk``.
        minds: for each population with hierarchies of skills, the mind's ``name``, ``folder`` (the
            copy in the run's folder) and ``sha256`` of that copy's files.
        ticks: length asked for.
        every: ticks between two rows of the series.
        agents_every: ticks between two recordings of the agents.
        status: ``running``, ``interrupted``, ``failed`` or ``finished``.
        ticks_done: ticks that are safe on disk.
        error: what stopped a failed run.
        tables: content of each merged table: rows, columns and their types, hash.
        idle: how often an agent found no available plan, and the first agent and tick.
        timings: ``created`` (UTC), ``seconds`` in all and ``loop_seconds`` in the model's ticks.
        versions: of what the run stood on.
        platforms: the fingerprints of the machines that computed it; one, unless it moved.
        format: of this file.
    """

    model: dict[str, Any]
    parameters: dict[str, Any]
    seed: int
    compiled: bool
    schemes: dict[str, dict[str, str]]
    ticks: int
    every: int
    agents_every: int
    status: str = RUNNING
    ticks_done: int = 0
    error: str | None = None
    engine: str = "compiled"
    minds: dict[str, dict[str, str]] = field(default_factory=dict)
    tables: dict[str, dict[str, Any]] = field(default_factory=dict)
    idle: dict[str, int | None] = field(default_factory=dict)
    timings: dict[str, Any] = field(default_factory=dict)
    versions: dict[str, str] = field(default_factory=dict)
    platforms: list[dict[str, str]] = field(default_factory=list)
    format: int = FORMAT

    WHAT: ClassVar[str] = "run"
    FIELDS: ClassVar[Fields] = _FIELDS

    @classmethod
    def _check(cls, content: Mapping[str, Any], path: Path) -> None:
        check_record(content["ticks_done"], whole(0, content["ticks"]), f"{path}: ticks_done")
        if content["status"] == FINISHED:
            check_record(content.get("tables"), _BOTH_TABLES, f"{path}: tables of a finished run")

    def identity(self) -> str:
        """Return a hash of what decides the result, apart from the model itself."""
        decides = {
            "parameters": self.parameters,
            "seed": self.seed,
            "engine": self.engine,
            "every": self.every,
            "agents_every": self.agents_every,
            "copies": [
                {name: one["sha256"] for name, one in copies.items()}
                for copies in (self.schemes, self.minds)
            ],
        }
        return hashlib.sha256(json.dumps(decides, sort_keys=True).encode()).hexdigest()


class Capsule(ManifestFolder[Manifest]):
    """A run's folder on disk.

    Args:
        folder: of an existing run.

    Raises:
        SocialmindError: the folder is no run's.
    """

    MANIFEST_CLASS = Manifest

    @classmethod
    def create(cls, out: Path | None, manifest: Manifest, files: Mapping[str, bytes]) -> Capsule:
        """Make a run's folder; it appears whole, with its manifest and schemes, or not at all.

        Args:
            out: a path where nothing is, or an empty folder; None for the next free number
                under ``runs/``.
            manifest: what the run is.
            files: content of the other files that it holds from the start, by name.

        Raises:
            SocialmindError: the folder holds something, or cannot be written.
        """
        content = {**files, MANIFEST: manifest.content()}
        return cls(make_folder(out, "runs", str(manifest.model["name"]), content))

    @property
    def parts(self) -> Path:
        """The folder of the tables' parts, there while the run is not finished."""
        return within(self.folder, "parts")

    @property
    def checkpoint(self) -> Path:
        """The file that the run goes on from."""
        return within(self.folder, "checkpoint.npz")

    @property
    def schemes(self) -> dict[str, Path]:
        """The run's own copies of its scheme files, by population."""
        return {n: within(self.folder, one["file"]) for n, one in self.manifest.schemes.items()}

    @property
    def minds(self) -> dict[str, Path]:
        """The run's own copies of its minds' folders, by population."""
        return {n: within(self.folder, one["folder"]) for n, one in self.manifest.minds.items()}

    def table(self, name: str) -> Path:
        """The merged file of a table."""
        return within(self.folder, f"{name}.parquet")
