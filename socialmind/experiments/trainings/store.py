"""Keeping what trainings came to, small enough for a repository, and going on from it.

What is kept is a training's folder of its own, which `Training` reads and `resume` goes on with:
only the generations of lessons that were in hand are not in it, and what can be made anew. It may
be kept again and again while the training is going on.
"""

from __future__ import annotations

import shutil
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

from socialmind.errors import SocialmindError
from socialmind.learning.training import archive
from socialmind.learning.training.attempt import CHECKPOINT, is_through, result_file
from socialmind.learning.training.capsule import TrainingManifest
from socialmind.learning.training.continuing import as_json
from socialmind.learning.training.result import Training
from socialmind.mind.files.packing import files_of
from socialmind.runs.arrays_file import save_arrays
from socialmind.runs.folders import FINISHED, INTERRUPTED, MANIFEST
from socialmind.runs.sources import mind_files_in
from socialmind.sources.folders import model_folder, source_hash
from socialmind.work.files import emptied, remove, replace_file

if TYPE_CHECKING:
    from socialmind.experiments.trainings.plans import TrainingPlan

LESSONS, SOURCE = "the lessons", "the model's source"


def keep(folder: Path, home: Path) -> Path:
    """Keep the finished lessons of a training; it may still be going on.

    Args:
        folder: the training's, called as its plan.
        home: where trainings are kept.

    Returns:
        The folder in which it is kept.

    Raises:
        SocialmindError: another training of this name is kept.
    """
    training = Training(folder)
    target = home / training.folder.name
    known = TrainingManifest.load(target / MANIFEST) if (target / MANIFEST).is_file() else None
    if known is not None and not _are_one(known, training.manifest):
        raise SocialmindError(
            f"{target}: of other lessons, another mind, model or seed than {folder}; "
            "remove it to keep this one"
        )
    if known is None:
        for part in ("mind", "attempts"):  # the manifest comes last: this was stopped before
            if (target / part).is_dir():
                remove(target / part)
        shutil.copytree(
            training.folder / "mind",
            target / "mind",
            ignore=shutil.ignore_patterns("__pycache__"),
        )
    for number in training.attempts:
        _keep_attempt(_attempt(training.folder, number), _attempt(target, number))
    manifest = training.manifest
    if known is not None:
        versions = {**known.versions, **manifest.versions}
        lessons = max(known.lessons, manifest.lessons, key=len)
        manifest = replace(manifest, lessons=lessons, versions=versions)
    replace_file(target / MANIFEST, _manifest(manifest, known, target).content())
    return target


def _are_one(one: TrainingManifest, other: TrainingManifest) -> bool:
    """Whether both are of one training, to which lessons may have been added in between."""
    known = min(len(one.lessons), len(other.lessons))
    first, second = (replace(it, lessons=it.lessons[:known]) for it in (one, other))
    return identity(first) == identity(second)


def _attempt(folder: Path, number: int) -> Path:
    return folder / "attempts" / str(number)


def _keep_attempt(source: Path, target: Path) -> None:
    """Keep an attempt as it was after its last finished lesson."""
    record, arrays = archive.load(source / CHECKPOINT)
    begun = (target / CHECKPOINT).is_file()  # which comes last, too
    before = archive.load(target / CHECKPOINT)[0]["done"] if begun else 0
    if record["done"] <= before:
        return
    target.mkdir(parents=True, exist_ok=True)
    for number in range(before + 1, record["done"] + 1):
        save_arrays(
            result_file(target, number), *archive.load(result_file(source, number)), compressed=True
        )
    # Without the lesson in hand: it begins anew, and comes to the same.
    lasting = {name: one for name, one in arrays.items() if not name.startswith("teaching/")}
    save_arrays(target / CHECKPOINT, {**record, "in_hand": None}, lasting, compressed=True)


def _manifest(
    manifest: TrainingManifest, known: TrainingManifest | None, target: Path
) -> TrainingManifest:
    """Return the manifest of what is kept: without paths of the machine that it was made on."""
    records = [archive.load(one)[0] for one in sorted(target.glob(f"attempts/*/{CHECKPOINT}"))]
    finished = sum(is_through(record, manifest.lessons) for record in records)
    attempts = max(manifest.attempts, known.attempts if known else 0)
    platforms = list(known.platforms) if known else []
    platforms += [one for one in manifest.platforms if one not in platforms]
    return replace(
        manifest,
        model={**manifest.model, "path": manifest.model["name"]},
        attempts=attempts,
        finished=finished,
        status=FINISHED if finished == attempts else INTERRUPTED,
        error=None,
        curve={},
        timings={
            **manifest.timings,
            "seconds": round(sum(float(record["seconds"]) for record in records), 3),
        },
        platforms=platforms,
    )


def identity(manifest: TrainingManifest) -> dict[str, Any]:
    """Return what two trainings have in common whose attempts are interchangeable."""
    return {
        "model": (manifest.model["name"], manifest.model["source_sha256"]),
        "lessons": manifest.lessons,
        "changes": manifest.changes,
        "mind": manifest.mind["sha256"],
        "seed": manifest.seed,
        "engine": manifest.engine,
        "version": manifest.versions.get("socialmind"),
    }


def take_out(kept: Path, folder: Path) -> bool:
    """Copy a kept training to where it can be gone on with.

    Args:
        kept: where it is kept.
        folder: the one to make.

    Returns:
        Whether it is kept at all.
    """
    if not (kept / MANIFEST).is_file():
        return False
    made = emptied(folder)
    shutil.copytree(kept, made)
    made.rename(folder)
    return True


def differences(training: Training, plan: TrainingPlan) -> list[str]:
    """Return in what a training is another one than its plan would give today."""
    manifest = training.manifest
    same = {
        SOURCE: manifest.model["source_sha256"] == source_hash(model_folder(plan.model)),
        LESSONS: manifest.lessons == as_json(plan.curriculum().record()),
        "the mind to begin from": mind_files_in(training.folder / "mind") == files_of(plan.mind()),
        "the seed": manifest.seed == plan.seed,
    }
    return [what for what, agrees in same.items() if not agrees]
