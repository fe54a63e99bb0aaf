"""A run's folder: the manifest that says what the run is, and where its files lie.

- status ``finished``: the merged tables are the run's result;
- any other status: the checkpoint, if there is one, says which parts of the tables count.
"""

from __future__ import annotations

import hashlib
import json
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Annotated, Any, ClassVar

from socialmind.runs import folders
from socialmind.runs import record as kinds
from socialmind.runs.record import check_record, within
from socialmind.runs.tables.names import EVENTS, FURTHER, SERIES, TABLES

IDLE = kinds.Fields(
    {},
    {
        "count": kinds.whole(),
        "first_agent": kinds.optional(kinds.whole()),
        "first_tick": kinds.optional(kinds.whole()),
    },
)
_TABLE = kinds.Fields({"rows": kinds.whole(), "columns": kinds.TEXTS, "sha256": kinds.SHA256})
_TIMINGS = kinds.Fields(
    {}, {"created": kinds.TEXT, "seconds": kinds.NUMBER, "loop_seconds": kinds.NUMBER}
)
_ALL_TABLES = kinds.Fields(dict.fromkeys(TABLES, _TABLE), dict.fromkeys(FURTHER, _TABLE))
_RECORDED = kinds.Kind(
    "names of tables, or null",
    lambda value: (
        value is None
        or (isinstance(value, list) and set(TABLES) <= set(map(str, value)) <= {*TABLES, *FURTHER})
    ),
)


def _copied(place: str) -> kinds.Fields:
    """Return the record of a copy in the run's folder, whose field `place` says where it is."""
    return kinds.Fields({place: kinds.NAME_WITHIN, "sha256": kinds.SHA256}, {"name": kinds.TEXT})


_COMMANDS = kinds.Kind(
    "a list of numbers, or null",
    lambda value: (
        value is None or (isinstance(value, list) and all(map(kinds.NUMBER.holds, value)))
    ),
)
_INTERVENTION = kinds.Fields(
    {"tick": kinds.whole()},
    {
        "function": kinds.TEXT,
        "file": kinds.NAME_WITHIN,
        "sources": kinds.SOURCES,
        "parameters": kinds.Each(kinds.SETTING),
        "schemes": kinds.Each(_copied("file")),
        "population": kinds.TEXT,
        "agent": kinds.whole(),
        "part": kinds.TEXT,
        "value": kinds.optional(kinds.SETTING),
        "commands": _COMMANDS,
    },
)
_OF_SHOCKS, _OF_CHANGES = ("function", "file", "sources"), ("parameters", "schemes")
_OF_EDITS = ("population", "agent", "part", "value")
_OF_STEERING = ("population", "agent", "commands")
_BRANCH = kinds.Kind(
    "of which run, at which tick and with what change a run is a branch, or null",
    lambda value: (
        value is None
        or (
            isinstance(value, dict)
            and all(isinstance(value.get(one), str) for one in ("run", "identity"))
            and kinds.whole().holds(value.get("tick"))
            and isinstance(value.get("change"), list)
        )
    ),
)


@dataclass(frozen=True)
class Manifest(folders.FolderManifest):
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
        recorded: the tables that it records; None in runs of before, which have what their
            checkpoint says.
        interventions: what is done to it on its way, in order: the ``tick``, and of a shock the
            ``function``, the ``file`` (the copy in the run's folder) and its ``sources``; of a
            change the ``parameters`` and ``schemes``; of an edit the ``population``, ``agent``,
            ``part`` and ``value``; of steering by hand the ``population``, ``agent`` and
            ``commands``.
        branch: of a branch: the ``run`` that it left, as a path, that run's ``identity``, the
            ``tick`` and the ``change``, in words.
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

    model: Annotated[dict[str, Any], kinds.model_called(kinds.TEXT)]
    parameters: Annotated[dict[str, Any], kinds.Each(kinds.SETTING)]
    seed: Annotated[int, kinds.SEED]
    compiled: Annotated[bool, kinds.TRUTH]
    schemes: Annotated[dict[str, dict[str, str]], kinds.Each(_copied("file"))]
    ticks: Annotated[int, kinds.whole()]
    every: Annotated[int, kinds.whole(1)]
    agents_every: Annotated[int, kinds.whole(1)]
    status: Annotated[str, folders.STATUS] = folders.RUNNING
    ticks_done: Annotated[int, kinds.whole()] = 0
    error: Annotated[str | None, kinds.optional(kinds.TEXT)] = None
    engine: Annotated[str, kinds.ENGINE] = "compiled"
    minds: Annotated[dict[str, dict[str, str]], kinds.Each(_copied("folder"))] = field(
        default_factory=dict
    )
    tables: Annotated[dict[str, dict[str, Any]], kinds.Each(_TABLE)] = field(default_factory=dict)
    idle: Annotated[dict[str, int | None], IDLE] = field(default_factory=dict)
    timings: Annotated[dict[str, Any], _TIMINGS] = field(default_factory=dict)
    versions: Annotated[dict[str, str], kinds.TEXTS] = field(default_factory=dict)
    platforms: Annotated[list[dict[str, str]], kinds.Many(kinds.TEXTS)] = field(
        default_factory=list
    )
    recorded: Annotated[list[str] | None, _RECORDED] = None
    interventions: Annotated[list[dict[str, Any]], kinds.Many(_INTERVENTION)] = field(
        default_factory=list
    )
    branch: Annotated[dict[str, Any] | None, _BRANCH] = None
    format: int = folders.FORMAT

    NEEDED: ClassVar[tuple[str, ...]] = ("status", "ticks_done")
    WHAT: ClassVar[str] = "run"

    @classmethod
    def _check(cls, content: Mapping[str, Any], path: Path) -> None:
        check_record(content["ticks_done"], kinds.whole(0, content["ticks"]), f"{path}: ticks_done")
        for number, one in enumerate(content.get("interventions", ())):
            needed: tuple[str, ...] = _OF_EDITS if "agent" in one else _OF_CHANGES
            if "function" in one:
                needed = _OF_SHOCKS
            elif "commands" in one:
                needed = _OF_STEERING
            place = f"{path}: interventions[{number}]"
            check_record(one, kinds.Fields(dict.fromkeys(needed, kinds.ANY)), place)
        if content["status"] == folders.FINISHED:
            check_record(content.get("tables"), _ALL_TABLES, f"{path}: tables of a finished run")

    def steps(self, names: Iterable[str]) -> dict[str, int]:
        """Return the ticks between two recordings of tables, by their names."""
        of = {SERIES: self.every, EVENTS: 1}
        return {name: of.get(name, self.agents_every) for name in names}

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
        if self.interventions:
            decides["interventions"] = self.interventions
        return hashlib.sha256(json.dumps(decides, sort_keys=True).encode()).hexdigest()


class Capsule(folders.ManifestFolder[Manifest]):
    """A run's folder on disk.

    Args:
        folder: of an existing run.

    Raises:
        SocialmindError: the folder is no run's.
    """

    MANIFEST_CLASS = Manifest
    HOME = "runs"

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
