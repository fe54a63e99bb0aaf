"""What a run goes on from and ends with: checkpoints checked, tables merged and reopened."""

from __future__ import annotations

import shutil
from dataclasses import asdict, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

from socialmind.errors import SocialmindError
from socialmind.runs import folders
from socialmind.runs.capsule import Capsule, Manifest
from socialmind.runs.checkpoint import Checkpoint
from socialmind.runs.tables.files import check_content, merge, part_name, seal
from socialmind.runs.tables.names import FURTHER, TABLES
from socialmind.work.files import make_room, refuse_folder

if TYPE_CHECKING:
    from socialmind.model import Model


def checked_checkpoint(capsule: Capsule) -> Checkpoint | None:
    """A run's checkpoint, when all that it goes on from is as the run wrote it.

    Raises:
        SocialmindError: a part or a table is missing or was changed; nothing is written yet.
    """
    manifest = capsule.manifest
    checkpoint = None
    if capsule.checkpoint.exists() or capsule.checkpoint.is_symlink():
        checkpoint = Checkpoint.load(capsule.checkpoint)
        if checkpoint.run not in (None, manifest.identity()):
            raise SocialmindError(
                f"{capsule.folder / folders.MANIFEST}: its seed, parameters or schemes are not "
                f"those that {capsule.checkpoint.name} was written with; put them back"
            )
    if manifest.status == folders.FINISHED:
        for name, table in manifest.tables.items():
            check_content(capsule.table(name), table["sha256"])
        return checkpoint
    for name in (*TABLES, *FURTHER):
        refuse_folder(capsule.table(name))
    if checkpoint is not None:
        checkpoint.check_parts(capsule.parts)
    elif capsule.parts.exists() and not capsule.parts.is_dir():
        raise SocialmindError(f"{capsule.parts}: is a file, in the place of a folder; remove it")
    return checkpoint


def restore(model: Model, checkpoint: Checkpoint, path: Path) -> None:
    """Put a model where a run's checkpoint says it was.

    Raises:
        SocialmindError: the checkpoint is not one of this model with these parameters.
    """
    try:
        before = model.parameter_values()
        model.restore(dict(checkpoint.state))
        if model.parameter_values() != before or model.tick != checkpoint.tick:
            raise ValueError("it holds other parameters or another tick than the run")
    except (SocialmindError, ValueError, KeyError, TypeError, IndexError) as error:
        raise SocialmindError(
            f"{path}: {error if str(error) else type(error).__name__}; take the file from a copy "
            "of the folder, or delete it and the run starts again from its first tick"
        ) from error


def finish(capsule: Capsule, checkpoint: Checkpoint) -> None:
    """Merge the parts and declare the run finished; killed anywhere in here, it can be repeated."""
    contents = {}
    for name, of in checkpoint.parts.items():
        parts = [capsule.parts / part for part in of]
        contents[name] = asdict(merge(parts, capsule.table(name), name))
    capsule.update(
        status=folders.FINISHED, tables=contents, **progress_fields(capsule.manifest, checkpoint)
    )
    shutil.rmtree(capsule.parts, ignore_errors=True)


def reopen(capsule: Capsule, checkpoint: Checkpoint | None, length: int) -> Checkpoint:
    """Turn a finished run's tables into parts of a longer run.

    A last row off the grid of recorded ticks was there because the run ended; the longer run
    does not have it. Until the manifest says otherwise the old tables are the truth.
    """
    if checkpoint is None or checkpoint.tick != capsule.manifest.ticks_done:
        raise SocialmindError(
            f"{capsule.folder}: {capsule.checkpoint.name} is missing or of another run, so the "
            f"run cannot be made longer; run anew with --ticks {length}"
        )
    every = capsule.manifest.steps(capsule.manifest.tables)
    schemes_change = any(one.get("schemes") for one in capsule.manifest.interventions)
    capsule.parts.mkdir(exist_ok=True)
    parts, recorded, sums = {}, {}, {}
    for name, step in every.items():
        part = part_name(name, 0)
        off_grid = checkpoint.tick % step
        merge(
            [capsule.table(name)],
            make_room(capsule.parts / part),
            name,
            drop_tick=checkpoint.tick if off_grid else None,
            changing=bool(off_grid) and schemes_change,
        )
        parts[name] = [part]
        sums[part] = seal(capsule.parts / part)
        recorded[name] = checkpoint.tick - off_grid
    reopened = replace(checkpoint, parts=parts, recorded=recorded, sums=sums)
    reopened.save(capsule.checkpoint)
    capsule.update(status=folders.RUNNING, ticks=length, tables={})
    for name in every:
        capsule.table(name).unlink(missing_ok=True)
    return reopened


def progress_fields(manifest: Manifest, checkpoint: Checkpoint) -> dict[str, Any]:
    """The manifest's fields that a checkpoint moves on."""
    return {
        "ticks_done": checkpoint.tick,
        "idle": checkpoint.idle,
        "timings": {
            **manifest.timings,
            "seconds": round(checkpoint.seconds, 3),
            "loop_seconds": round(checkpoint.loop_seconds, 3),
        },
    }


def ticks_done(manifest: Manifest, checkpoint: Checkpoint | None) -> int:
    """How many ticks of a run are safe."""
    if manifest.status == folders.FINISHED:
        return manifest.ticks_done
    return checkpoint.tick if checkpoint else 0
