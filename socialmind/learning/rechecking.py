"""Whether kept trainings are still those of today's model, after its files were edited.

`resume` goes on with a training only if its model's files are the very ones it was begun with,
comments included. Here the winners of all kept lessons are judged once more in the worlds of their
finals: if each comes to the same score, to the last bit, the edit changed nothing that learning
sees, and the kept training takes the hash of today's files.
"""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from socialmind.catalogue import model_folder, source_hash
from socialmind.errors import SocialmindError
from socialmind.experiments.capsule import MANIFEST, replace_file
from socialmind.learning import archive
from socialmind.learning.attempt import load_result
from socialmind.learning.finalists import individual_of
from socialmind.learning.kept import LESSONS, differences
from socialmind.learning.keys import FINAL, seeds_for
from socialmind.learning.lesson import Lesson
from socialmind.learning.result import Training
from socialmind.learning.teaching import ground_of
from socialmind.mind import MindDescription

if TYPE_CHECKING:
    from socialmind.learning.plans import Plan


def recheck(kept: Path, plan: Plan) -> int:
    """Judge a kept training's winners again, and take today's model for its own if all agree.

    Args:
        kept: its folder.
        plan: what it was made by.

    Returns:
        How many lessons were judged.

    Raises:
        SocialmindError: the lessons are others, or a winner comes to another score.
    """
    training = Training(kept)
    if LESSONS in differences(training, plan):
        raise SocialmindError(f"{training.folder}: of other lessons than the plan has; train anew")
    judged = 0
    for attempt in training.attempts:
        judged += _judge(training, attempt, plan)
    hashed = source_hash(model_folder(plan.model))
    manifest = training.manifest
    model = {key: one for key, one in manifest.model.items() if key != "sources"}
    changed = replace(manifest, model={**model, "source_sha256": hashed})
    replace_file(training.folder / MANIFEST, changed.content())
    return judged


def _judge(training: Training, attempt: int, plan: Plan) -> int:
    """Judge the winners of an attempt's lessons; return how many there are."""
    mind = MindDescription.load(training.folder / "mind")
    lessons = list(plan.curriculum().lessons)
    done = len(training.lessons[training.lessons["attempt"] == attempt])
    for number, lesson in enumerate(lessons[:done], 1):
        folder = training.folder / "attempts" / str(attempt)
        record, arrays = load_result(folder, number)
        winner = individual_of(archive.part(arrays, "winner/"))
        found = _finals(lesson, mind, winner.genome, (training.manifest.seed, attempt), training)
        if found != record["score"]:
            raise SocialmindError(
                f"{training.folder}: attempt {attempt} comes to {found} in the finals of "
                f"{lesson.name}, {record['score']} when it was trained: the model or the engine "
                "differs; train anew"
            )
        mind = mind.with_modules(skills=winner.given_to([mind.skill(one) for one in lesson.skills]))
    return min(done, len(lessons))


def _finals(
    lesson: Lesson,
    mind: MindDescription,
    genome: np.ndarray,
    key: tuple[int, int],
    training: Training,
) -> float:
    episodes = ground_of(lesson, mind, training.manifest.engine).episodes()
    worlds = seeds_for(lesson.finals, FINAL, *key, lesson.name, 1)
    return float(episodes.run(genome[None], worlds).score.mean(axis=1)[0])
