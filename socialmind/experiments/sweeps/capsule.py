"""A sweep's folder: the manifest that says what the sweep is, and where its files lie."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path
from typing import Annotated, Any, ClassVar

from socialmind.runs import folders
from socialmind.runs import record as kinds
from socialmind.runs.record import within

KIND = "sweep"
_DESIGN = kinds.Fields({"name": kinds.TEXT, "sha256": kinds.SHA256})
_COPY = kinds.Fields(
    {"population": kinds.TEXT, "given": kinds.TEXT, "sha256": kinds.SHA256},
    {"file": kinds.NAME_WITHIN, "folder": kinds.NAME_WITHIN, "name": kinds.TEXT},
)
_REPLICATES = kinds.Fields(
    {
        "seeds": kinds.Many(kinds.SEED),
        "common": kinds.TRUTH,
        "until": kinds.optional(kinds.TEXT),
        "most": kinds.whole(1),
    }
)
_TIMINGS = kinds.Fields({}, {"created": kinds.TEXT, "seconds": kinds.NUMBER})
_COUNTS = kinds.Each(kinds.whole())


@dataclass(frozen=True)
class SweepManifest(folders.FolderManifest):
    """What a sweep is and how far it came; the content of its ``manifest.json``.

    Args:
        model: ``name``, ``path``, ``source_sha256`` and ``sources``, as for a run.
        design: how the design was made: ``name`` (`grid`, `lhs`, …, or `table`), what it was made
            with, and ``sha256`` of ``design.parquet``.
        points: how many points it has.
        columns: what varies, as its columns are called in ``design.parquet``.
        fixed: what is set in all runs alike, by name.
        replicates: ``seeds``, ``common``, ``until``, ``most``.
        ticks: length of a run.
        every: ticks between two rows of the series.
        keeps_series: whether it has ``series.parquet``.
        agents_every: ticks between two records of the agents; 0 for the end alone, None for none.
        measures: by name, their ``expression``, or ``file`` and ``sha256``, or ``function``.
        series_columns: those of the series, as its first society has them.
        interventions: the shocks of every run, in order, as a run's manifest has them.
        timeout: seconds that a run may take; None for any.
        compiled: whether rules run compiled.
        schemes: copies of the schemes: ``population``, ``given`` (the text of the design; empty for
            what the model has), ``file`` and ``sha256``.
        minds: copies of the minds likewise, each a ``folder``.
        status: ``running``, ``interrupted``, ``failed`` or ``finished``.
        counts: runs by status, as far as they are done.
        error: what stopped a failed sweep.
        tables: content of each table of a finished sweep.
        timings: ``created`` (UTC) and ``seconds`` in all.
        versions: of what it stood on.
        platforms: the fingerprints of the machines that led it.
        kind: `sweep`.
        format: of this file.
    """

    model: Annotated[dict[str, Any], kinds.model_called(kinds.TEXT)]
    design: Annotated[dict[str, Any], _DESIGN]
    points: Annotated[int, kinds.whole(1)]
    columns: Annotated[list[str], kinds.Many(kinds.TEXT)]
    fixed: Annotated[dict[str, Any], kinds.Each(kinds.SETTING)]
    replicates: Annotated[dict[str, Any], _REPLICATES]
    ticks: Annotated[int, kinds.whole()]
    every: Annotated[int, kinds.whole(1)]
    keeps_series: Annotated[bool, kinds.TRUTH]
    agents_every: Annotated[int | None, kinds.optional(kinds.whole())]
    measures: Annotated[dict[str, dict[str, str]], kinds.Each(kinds.TEXTS)]
    series_columns: Annotated[list[str], kinds.Many(kinds.TEXT)]
    timeout: Annotated[float | None, kinds.optional(kinds.NUMBER)]
    compiled: Annotated[bool, kinds.TRUTH]
    schemes: Annotated[dict[str, dict[str, str]], kinds.Each(_COPY)]
    minds: Annotated[dict[str, dict[str, str]], kinds.Each(_COPY)]
    status: Annotated[str, folders.STATUS] = folders.RUNNING
    counts: Annotated[dict[str, int], _COUNTS] = field(default_factory=dict)
    error: Annotated[str | None, kinds.optional(kinds.TEXT)] = None
    tables: dict[str, Any] = field(default_factory=dict)
    timings: Annotated[dict[str, Any], _TIMINGS] = field(default_factory=dict)
    versions: Annotated[dict[str, str], kinds.TEXTS] = field(default_factory=dict)
    platforms: Annotated[list[dict[str, str]], kinds.Many(kinds.TEXTS)] = field(
        default_factory=list
    )
    interventions: Annotated[list[dict[str, Any]], kinds.Many(kinds.SHOCK)] = field(
        default_factory=list
    )
    kind: str = KIND
    format: int = folders.FORMAT

    WHAT: ClassVar[str] = KIND


class SweepCapsule(folders.ManifestFolder[SweepManifest]):
    """A sweep's folder on disk.

    Args:
        folder: of an existing sweep.

    Raises:
        SocialmindError: the folder is no sweep's.
    """

    MANIFEST_CLASS = SweepManifest
    HOME = "sweeps"

    @property
    def schemes(self) -> dict[str, Path]:
        """The sweep's own copies of schemes, by their keys in the manifest."""
        return {n: within(self.folder, one["file"]) for n, one in self.manifest.schemes.items()}

    @property
    def minds(self) -> dict[str, Path]:
        """The sweep's own copies of minds, likewise."""
        return {n: within(self.folder, one["folder"]) for n, one in self.manifest.minds.items()}

    def table(self, name: str) -> Path:
        """The file of a table."""
        return within(self.folder, f"{name}.parquet")
