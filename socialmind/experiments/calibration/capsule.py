"""A fit's folder: the manifest that says what the fit is, and where its files lie."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path
from typing import Annotated, Any, ClassVar

from socialmind.experiments.sweeps.capsule import SweepCapsule
from socialmind.runs import folders
from socialmind.runs import record as kinds
from socialmind.runs.record import within

KIND = "fit"
SETTING = "setting"
"""The folder of what all runs have in common, kept as a sweep keeps it."""
TARGET = "target.csv"
_TARGET = kinds.Fields({"kind": kinds.TEXT, "sha256": kinds.SHA256}, {"file": kinds.TEXT})
_RANGE = kinds.Fields({"name": kinds.TEXT, "low": kinds.ANY, "high": kinds.ANY, "log": kinds.TRUTH})
_TIMINGS = kinds.Fields({}, {"created": kinds.TEXT, "seconds": kinds.NUMBER})


@dataclass(frozen=True)
class FitManifest(folders.FolderManifest):
    """What a fit is and how far it came; the content of its ``manifest.json``.

    Args:
        model: ``name``, ``path``, ``source_sha256`` and ``sources``, as for a run.
        target: ``kind`` (`series` or `statistics`), ``file``, and ``sha256`` of ``target.csv``.
        vary: ``name``, ``low``, ``high`` and ``log`` of all that varies.
        method: by name.
        budget: runs of the fit, and of each recovery.
        seeds: runs of a trial.
        recover: recoveries.
        data_runs: runs of which known data are the mean.
        seed: of all draws.
        ticks: length of a run.
        runs: that there are to be.
        fixed: what is set in all runs alike, by name.
        measures: by name, as a sweep's manifest has them.
        status: ``running``, ``interrupted``, ``failed`` or ``finished``.
        error: what stopped a failed fit.
        timings: ``created`` (UTC) and ``seconds`` in all.
        versions: of what it stood on, the method's library among them.
        platforms: the fingerprints of the machines that led it.
        kind: `fit`.
        format: of this file.
    """

    model: Annotated[dict[str, Any], kinds.model_called(kinds.TEXT)]
    target: Annotated[dict[str, Any], _TARGET]
    vary: Annotated[list[dict[str, Any]], kinds.Many(_RANGE)]
    method: Annotated[str, kinds.TEXT]
    budget: Annotated[int, kinds.whole(1)]
    seeds: Annotated[int, kinds.whole(1)]
    recover: Annotated[int, kinds.whole()]
    data_runs: Annotated[int, kinds.whole(1)]
    seed: Annotated[int, kinds.SEED]
    ticks: Annotated[int, kinds.whole()]
    runs: Annotated[int, kinds.whole(1)]
    fixed: Annotated[dict[str, Any], kinds.Each(kinds.SETTING)]
    measures: Annotated[dict[str, dict[str, str]], kinds.Each(kinds.TEXTS)]
    status: Annotated[str, folders.STATUS] = folders.RUNNING
    error: Annotated[str | None, kinds.optional(kinds.TEXT)] = None
    timings: Annotated[dict[str, Any], _TIMINGS] = field(default_factory=dict)
    versions: Annotated[dict[str, str], kinds.TEXTS] = field(default_factory=dict)
    platforms: Annotated[list[dict[str, str]], kinds.Many(kinds.TEXTS)] = field(
        default_factory=list
    )
    kind: str = KIND
    format: int = folders.FORMAT

    WHAT: ClassVar[str] = KIND


class FitCapsule(folders.ManifestFolder[FitManifest]):
    """A fit's folder on disk.

    Args:
        folder: of an existing fit.

    Raises:
        SocialmindError: the folder is no fit's.
    """

    MANIFEST_CLASS = FitManifest
    HOME = "fits"

    def setting(self) -> SweepCapsule:
        """What all runs have in common."""
        return SweepCapsule(self.folder / SETTING)

    def table(self, name: str) -> Path:
        """The file of a table."""
        return within(self.folder, f"{name}.parquet")
