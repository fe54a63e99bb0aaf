"""The best that a training has found so far, put into a world to be looked at."""

from __future__ import annotations

from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from socialmind.errors import SocialmindError
from socialmind.learning.training import archive, continuing
from socialmind.learning.training.attempt import CHECKPOINT, Attempt, results_of
from socialmind.learning.training.capsule import TrainingCapsule
from socialmind.learning.training.course import TrainingCourse
from socialmind.learning.training.finalists import individual_of
from socialmind.learning.training.teaching import evaluation_of
from socialmind.mind.description import MindDescription
from socialmind.model import Model
from socialmind.sources.trust import programs_in, require


@dataclass(frozen=True, eq=False)
class Acting:
    """The best individual of a lesson, and the worlds of that lesson.

    Attributes:
        attempt: from 1.
        lesson: its name.
        generation: the generation that the individual is from.
        score: its score there.
        ticks: of an episode at most.
        episodes: of the lesson, with its mind.
    """

    attempt: int
    lesson: str
    generation: int
    score: float
    ticks: int
    episodes: Any

    def society(self, seed: int) -> Model:
        """Return the world of an episode before its first tick.

        Args:
            seed: of the world.
        """
        made: Model = self.episodes.model(seed)
        return made


def best_so_far(folder: str | Path, attempt: int) -> Acting:
    """Return the best individual of the lesson that an attempt has in hand, or has finished last.

    Args:
        folder: of a training; it may be going on.
        attempt: its number, from 1.

    Raises:
        SocialmindError: nothing has been found yet; or the lessons can no longer be loaded, as
            where they were given in Python, or where the model was changed.
    """
    capsule = TrainingCapsule(folder)
    manifest = capsule.manifest
    require(programs_in(capsule.mind), False, f"{capsule.folder}: its copy of a mind")
    curriculum = continuing.recorded_curriculum(capsule, None, False)
    mind = MindDescription.load(capsule.mind)
    course = TrainingCourse(curriculum, mind, manifest.seed, manifest.engine)
    home = capsule.attempt(attempt)
    one = Attempt(home, attempt, course)
    teaching = one.teaching
    if teaching is not None and teaching.best is not None:
        lesson, found, learned = teaching.lesson, teaching.best, teaching.learned(teaching.best)
    else:
        results = list(results_of(home)) if (home / CHECKPOINT).is_file() else []
        if not results:
            raise SocialmindError("nothing has been found yet: no generation has been judged")
        file, record, arrays = results[-1]
        by_name = {each.name: each for each in curriculum.lessons}
        lesson = by_name[record["lesson"]]
        with archive.reading(file):
            found = individual_of(archive.part(arrays, "winner/"))
            learned = found.given_to([one.mind.skill(name) for name in record["skills"]])
    evaluation = evaluation_of(lesson, one.mind.with_modules(skills=learned), manifest.engine)
    if not evaluation.of_a_model:
        raise SocialmindError(
            f"the lesson {lesson.name} is judged by {lesson.environment.__name__}, which is no "
            "model and has no world to look at"
        )
    episodes = replace(evaluation, engine="compiled").episodes()
    return Acting(
        attempt, lesson.name, found.generation, found.score, int(episodes.ticks), episodes
    )
