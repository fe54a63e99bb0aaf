"""The trainings behind the comparison of foraging robots, each with the command that makes it.

python -m analysis.foraging.trainings foraging        # or all; gone on with if begun
python -m analysis.foraging.trainings keep foraging   # what it came to, into results/trainings/
python -m analysis.foraging.trainings ship            # the best attempt's mind into the model

They lie in `trainings/`, and begin with what `results/` holds of them.
"""

from __future__ import annotations

import shutil
import sys
from collections.abc import Callable, Mapping
from dataclasses import replace
from pathlib import Path

from socialmind.catalogue import load_file, model_folder
from socialmind.experiments.trainings.plans import TrainingPlan, TrainingPlans
from socialmind.learning import Curriculum, Lesson, Training
from socialmind.mind import MindDescription

LESSONS = load_file(model_folder("foraging") / "lessons.py")
MINDS = load_file(model_folder("foraging") / "minds.py")
SEED = 6
ATTEMPTS = 3
SMALL = {"attempts": 1, "generations": 3, "population": 20, "repetitions": 2, "ticks": 2000}
"""Of a small training: with four robots in a large arena a tick takes ten times as long as one of
`collect`."""
SHIPPED = "foraging"
DEAF, BLIND = {"hearing": 0.0}, {"company": 0.0}
"""The worlds of robots that hear no signals, and of robots that do not see each other."""

Change = Callable[[Lesson], Lesson | None]


def curriculum(change: Change) -> Curriculum:
    """Return the lessons of the model, changed; those changed to None are left out."""
    changed = (change(lesson) for lesson in LESSONS.curriculum.lessons)
    return Curriculum(tuple(lesson for lesson in changed if lesson is not None))


def same(lesson: Lesson) -> Lesson:
    """Leave a lesson as it is."""
    return lesson


def without(parameters: Mapping[str, float]) -> Change:
    """Return what sets parameters of the group's lessons; a robot alone learns as ever."""

    def change(lesson: Lesson) -> Lesson:
        if lesson.environment is LESSONS.ReachSignal:
            return lesson
        return lesson.changed(parameters={**lesson.parameters, **parameters})

    return change


def at_random(lesson: Lesson) -> Lesson | None:
    """Leave searching out of a lesson, or the lesson where nothing else learns."""
    skills = tuple(one for one in lesson.skills if one != MINDS.SEARCH)
    return replace(lesson, skill=skills) if skills else None


def walker() -> MindDescription:
    """Return the foraging mind whose Search is a random walk."""
    mind: MindDescription = MINDS.walking_at_random(MINDS.forager())
    return mind


def plan(
    about: str, change: Change, mind: Callable[[], MindDescription] = MINDS.forager
) -> TrainingPlan:
    """Return a training of all lessons, changed."""
    return TrainingPlan(about, ATTEMPTS, mind, lambda: curriculum(change), "foraging", SEED)


PLANS = TrainingPlans(
    Path(__file__).parent,
    {
        SHIPPED: plan("all lessons, with signals and in sight of each other", same),
        "deaf": plan("all lessons without signals", without(DEAF)),
        "blind": plan("all lessons without seeing each other", without(BLIND)),
        "random": plan("all lessons with a random walk in place of Search", at_random, walker),
    },
    SMALL,
)


def best_of(training: Training) -> int:
    """Return the attempt that did best in the finals of its last lesson."""
    table = training.lessons
    last = table[table["lesson"] == table["lesson"].iloc[-1]]
    finished = last.sort_values(["score", "attempt"], ascending=[False, True])
    return int(finished["attempt"].iloc[0])


def ship(name: str = SHIPPED) -> Path:
    """Give the model the mind of the best attempt."""
    training = Training(PLANS.kept / name)
    target = model_folder("foraging") / "mind"
    shutil.rmtree(target, ignore_errors=True)
    training.mind(best_of(training)).save(target)
    return target


if __name__ == "__main__":
    if sys.argv[1:2] == ["ship"]:
        print(ship(*sys.argv[2:3]), flush=True)
    else:
        PLANS.main(sys.argv[1:])
