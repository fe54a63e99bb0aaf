"""What a training goes on from: its lessons and its model as they were, its files whole."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from socialmind.catalogue import load_model
from socialmind.errors import SocialmindError
from socialmind.learning.lessons.curriculum import Curriculum, Cycle
from socialmind.learning.lessons.lesson import Lesson
from socialmind.learning.training.attempt import Attempt, results_of
from socialmind.learning.training.capsule import (
    TrainingCapsule,
    TrainingManifest,
    with_commit_of_added,
)
from socialmind.learning.training.course import TrainingCourse, curriculum_of
from socialmind.mind.description import MindDescription
from socialmind.runs.folders import refuse_other_version
from socialmind.runs.sources import mind_files_in, what_was_edited
from socialmind.sources.commit import own_commit
from socialmind.sources.folders import MODEL_FILE, catalogue, source_hash
from socialmind.sources.provenance import difference, sources_of
from socialmind.sources.trust import programs_in, require
from socialmind.work.files import refuse_folder


def check_folder(capsule: TrainingCapsule, curriculum: Curriculum) -> None:
    """Look at all that a training goes on from, before anything is written.

    Raises:
        SocialmindError: a file is missing, cut off or changed.
    """
    manifest = capsule.manifest
    if hash_of(mind_files_in(capsule.mind)) != manifest.mind["sha256"]:
        raise SocialmindError(
            f"{capsule.mind}: the training's copy of the mind that it began from is missing or was "
            "changed; take it from a copy of the folder"
        )
    refuse_folder(capsule.curve)
    course = TrainingCourse(
        curriculum, MindDescription.load(capsule.mind), manifest.seed, manifest.engine
    )
    for number in range(1, manifest.attempts + 1):
        if capsule.attempt(number).exists():
            Attempt(capsule.attempt(number), number, course)
            list(results_of(capsule.attempt(number)))


def with_changes(curriculum: Curriculum, changes: Mapping[str, Any]) -> Curriculum:
    """Return a curriculum with what is asked for in place of the lessons' own."""
    alone = {id(item) for item in curriculum.items if isinstance(item, Lesson)}

    def change(lesson: Lesson) -> Lesson:
        fields: dict[str, Any] = {}
        settings = dict(lesson.settings)
        if changes["optimiser"] is not None:
            fields["optimiser"] = changes["optimiser"]
            if changes["optimiser"].upper() != lesson.optimiser.upper():
                settings = {}
        fields["settings"] = {**settings, **changes["settings"]}
        if changes["generations"] is not None:
            fields["generations"] = changes["generations"]
        if changes["budget"] is not None and id(lesson) in alone:
            fields["budget"] = changes["budget"]
        return lesson.changed(**fields)

    return curriculum.with_lessons(change).with_cycles(changes["cycles"], changes["budget"])


def recorded_curriculum(capsule: TrainingCapsule, lessons: Any, trust: bool) -> Curriculum:
    """Return the lessons of a training, as they were; behind them those that are added.

    Raises:
        SocialmindError: they, the model or socialmind are others than they were.
    """
    manifest = capsule.manifest
    refuse_other_version(capsule.folder, "training", manifest.versions)
    if manifest.chosen == [] and lessons is None:
        way = "socialmind.learning.resume(folder, lessons=...)"
        if manifest.command is not None:
            way = f"`{manifest.command}`"
        raise SocialmindError(
            f"{capsule.folder}: its lessons were given in Python; go on with {way}"
        )
    model = None if manifest.model["path"] is None else _recorded_model(capsule)
    if model is not None:
        # Said before anything is run, or asked about.
        if other := what_was_edited(manifest.model, model):
            raise SocialmindError(f"{other}; put the old file back, or start another training")
        require(programs_in(model), trust, f"{capsule.folder}: its model at {model}")
        if other := _changes(manifest, model):
            raise SocialmindError(f"{other}; put the old file back, or start another training")
    given = manifest.chosen if lessons is None else lessons
    named = model if model is not None and (model / MODEL_FILE).is_file() else None
    curriculum, _ = curriculum_of(named, given)
    curriculum = with_changes(curriculum, manifest.changes)
    if as_json(curriculum.record())[: len(manifest.lessons)] != manifest.lessons:
        raise SocialmindError(
            f"{capsule.folder}: the lessons are not those that the training was begun with; "
            "put them back, add others behind them, or start another training"
        )
    return curriculum


def refuse_cycles_within(capsule: TrainingCapsule, curriculum: Curriculum, cycles: int) -> None:
    """Refuse another number of cycles where attempts have begun and lessons follow a cycle.

    Attempts that are behind it would not go back.

    Raises:
        SocialmindError: it is so.
    """
    within = any(isinstance(item, Cycle) for item in curriculum.items[:-1])
    if within and cycles != capsule.manifest.changes["cycles"] and _begun(capsule):
        raise SocialmindError(
            f"{capsule.folder}: cycles={cycles}, but lessons follow a cycle, and attempts that are "
            "behind it do not go back; expected as many cycles as before, or another training"
        )


def _begun(capsule: TrainingCapsule) -> list[int]:
    """Return the attempts that have begun."""
    numbers = range(1, capsule.manifest.attempts + 1)
    return [one for one in numbers if capsule.attempt(one).is_dir()]


def with_added_lessons(capsule: TrainingCapsule, curriculum: Curriculum) -> dict[str, str]:
    """Return the versions of a training that goes on with more lessons than it had, if it does."""
    manifest = capsule.manifest
    known = len(manifest.lessons)
    begun = _begun(capsule)
    if len(curriculum.items) == known or not begun:
        return manifest.versions
    return with_commit_of_added(manifest.versions, known + 1, begun[-1], own_commit())


def _recorded_model(capsule: TrainingCapsule) -> Path:
    """Return where a training's model is: where it stood, or that of its name that ships."""
    name, path = capsule.manifest.model["name"], Path(str(capsule.manifest.model["path"]))
    if (path / MODEL_FILE).is_file() or path.is_file():
        return path
    shipped = catalogue().get(name or "")
    if shipped is None:
        raise SocialmindError(
            f"{capsule.folder}: its model {name} is not at {path}; put its folder there"
        )
    return shipped


def _changes(manifest: TrainingManifest, model: Path) -> str | None:
    """Return what differs between a training's model and the files as they are, or None."""
    if manifest.model.get("sources") is not None:
        return difference(manifest.model["sources"], sources_of(load_model(model)))
    if source_hash(model) != manifest.model["source_sha256"]:
        return f"{model}: the model's source is not the one the training was begun with"
    return None


def as_json(record: Any) -> Any:
    """Return a record as a manifest has it."""
    return json.loads(json.dumps(record, default=str))


def hash_of(files: Mapping[str, bytes]) -> str:
    """Return the hash of a mind's files."""
    total = hashlib.sha256()
    for name, content in sorted(files.items()):
        total.update(f"{name}\0{len(content)}\0".encode() + content)
    return total.hexdigest()
