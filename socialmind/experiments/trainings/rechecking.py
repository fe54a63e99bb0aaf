"""Whether kept trainings are still those of today's model, after its files were edited.

`resume` goes on with a training only if its model's files are the very ones it was begun with,
comments included. Here the winners of all kept lessons are judged once more in the worlds of their
finals: if each comes to the same score, to the last bit, the edit changed nothing that learning
sees, and the kept training takes the hash of today's files.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from socialmind.errors import SocialmindError
from socialmind.experiments.trainings.store import LESSONS, differences
from socialmind.learning.lessons.keys import FINAL, JUDGED, seeds_for
from socialmind.learning.lessons.lesson import Lesson
from socialmind.learning.training import archive
from socialmind.learning.training.attempt import result_file, results_of
from socialmind.learning.training.continuing import as_json
from socialmind.learning.training.finalists import Individual, individual_of
from socialmind.learning.training.result import Training
from socialmind.learning.training.teaching import evaluation_of
from socialmind.mind import MindDescription
from socialmind.runs.arrays_file import save_arrays
from socialmind.runs.folders import MANIFEST
from socialmind.sources.folders import model_folder, source_hash
from socialmind.work.files import replace_file

if TYPE_CHECKING:
    from socialmind.experiments.trainings.plans import TrainingPlan


class Rescored(NamedTuple):
    """A kept lesson whose winner was judged again.

    Attributes:
        attempt: of the training.
        lesson: its name.
        before: the score that is kept.
        now: what the winner comes to today.
        deviation: over the worlds of the finals, today.
        file: where the score is kept.
    """

    attempt: int
    lesson: str
    before: float
    now: float
    deviation: float
    file: Path


def recheck(kept: Path, plan: TrainingPlan) -> int:
    """Judge a kept training's winners again, and take today's model for its own if all agree.

    Args:
        kept: its folder.
        plan: what it was made by.

    Returns:
        How many lessons were judged.

    Raises:
        SocialmindError: the lessons are others, or a winner comes to another score.
    """
    training, judged = Training(kept), 0
    for one in _rescored(training, plan):
        if one.now != one.before:
            raise SocialmindError(
                f"{training.folder}: attempt {one.attempt} comes to {one.now} in the finals of "
                f"{one.lesson}, {one.before} when it was trained: the model or the engine "
                "differs; train anew, or rescore where a fault of the scoring was mended"
            )
        judged += 1
    hashed = source_hash(model_folder(plan.model))
    manifest = training.manifest
    model = {key: one for key, one in manifest.model.items() if key != "sources"}
    changed = replace(manifest, model={**model, "source_sha256": hashed})
    replace_file(training.folder / MANIFEST, changed.content())
    return judged


def rescore(kept: Path, plan: TrainingPlan) -> list[Rescored]:
    """Judge a kept training's winners again, and keep the scores that they come to today.

    For a fault of the scoring that was mended: what was learned stays, and who was chosen.

    Args:
        kept: its folder.
        plan: what it was made by.

    Returns:
        The lessons whose scores are others now.

    Raises:
        SocialmindError: the lessons are others.
    """
    others = [one for one in _rescored(Training(kept), plan) if one.now != one.before]
    for one in others:
        record, arrays = archive.load(one.file)
        generation = individual_of(archive.part(arrays, "winner/")).generation
        judged = {
            "score": one.now,
            "deviation": one.deviation,
            "finalists": [(generation, one.now)],  # of the others nobody knows
        }
        save_arrays(one.file, {**record, **judged}, arrays, compressed=True)
    return others


def _rescored(training: Training, plan: TrainingPlan) -> Iterator[Rescored]:
    """Judge the winners of all kept lessons once more, in the worlds of their finals."""
    lessons = list(plan.curriculum().lessons)
    if LESSONS in differences(training, plan):
        known = training.manifest.lessons
        if as_json(plan.curriculum().record())[: len(known)] != known:
            raise SocialmindError(
                f"{training.folder}: of other lessons than the plan has; train anew"
            )
    for one in winners(training, lessons):
        key = training.manifest.seed, one.attempt, one.lesson.name, one.record["cycle"]
        scores = one.scores(seeds_for(one.lesson.finals, FINAL, *key))
        file = result_file(training.folder / "attempts" / str(one.attempt), one.number)
        now, deviation = float(scores.mean()), float(scores.std())
        yield Rescored(one.attempt, one.lesson.name, one.record["score"], now, deviation, file)


@dataclass(frozen=True)
class Winner:
    """The winner of a kept lesson, as it can be judged again.

    Attributes:
        attempt: of the training.
        number: of the lesson among those of the attempt, from 1.
        lesson: the lesson.
        individual: the winner.
        mind: as it was before the lesson.
        engine: of the training.
        record: what is kept of the lesson.
    """

    attempt: int
    number: int
    lesson: Lesson
    individual: Individual
    mind: MindDescription
    engine: str
    record: Mapping[str, Any]

    def scores(self, worlds: Sequence[int]) -> NDArray[np.float64]:
        """Return what it comes to in each of some worlds of its lesson, given by their seeds."""
        episodes = evaluation_of(self.lesson, self.mind, self.engine).episodes()
        scores: NDArray[np.float64] = episodes.run(self.individual.genome[None], worlds).score[0]
        return scores


def winners(training: Training, lessons: Sequence[Lesson]) -> Iterator[Winner]:
    """Yield the winners of all finished lessons of a training, attempt by attempt.

    Args:
        training: that is kept.
        lessons: of its curriculum; one in a cycle has a winner for each time around.
    """
    called = {one.name: one for one in lessons}
    for attempt in training.attempts:
        mind = MindDescription.load(training.folder / "mind")
        done = len(training.lessons[training.lessons["attempt"] == attempt])
        folder = training.folder / "attempts" / str(attempt)
        for number, (_, record, arrays) in enumerate(results_of(folder, done), 1):
            lesson = called[record["lesson"]]
            winner = individual_of(archive.part(arrays, "winner/"))
            yield Winner(attempt, number, lesson, winner, mind, training.manifest.engine, record)
            learned = winner.given_to([mind.skill(one) for one in lesson.skills])
            mind = mind.with_modules(skills=learned)


def in_common_worlds(
    training: Training, lessons: Sequence[Lesson], names: Collection[str], worlds: int
) -> dict[tuple[int, str], float]:
    """Judge the winners of lessons in worlds that nothing else uses, the same for all attempts.

    Finals choose the winner among finalists and have worlds of the attempt's own: so their scores
    are a little too high, and those of two attempts are of different worlds.

    Args:
        training: that is kept.
        lessons: of its curriculum.
        names: of the lessons whose winners are judged; of one in a cycle the last winner.
        worlds: how many.

    Returns:
        The mean score by attempt and lesson.
    """
    return {
        (one.attempt, one.lesson.name): float(
            one.scores(seeds_for(worlds, JUDGED, training.manifest.seed, one.lesson.name)).mean()
        )
        for one in winners(training, lessons)
        if one.lesson.name in names
    }
