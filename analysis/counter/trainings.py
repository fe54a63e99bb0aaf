"""Attempts at learning to count, with other variables and other functions of CountObjects.

python -m analysis.counter.trainings counter        # or all; gone on with if begun
python -m analysis.counter.trainings keep counter   # what it came to, into results/trainings/
python -m analysis.counter.trainings ship           # the minds of two attempts, into the model

They lie in `trainings/`, and begin with what `results/` holds of them; `socialmind reproduce
representations` makes its own.
"""

from __future__ import annotations

import shutil
import sys
from functools import partial
from pathlib import Path

from socialmind.catalogue import load_file, model_folder
from socialmind.experiments.trainings.plans import TrainingPlan, TrainingPlans
from socialmind.learning import Curriculum, Training
from socialmind.mind import Perceptron, Simple

LESSONS = load_file(model_folder("counter") / "lessons.py")
SEED = 6
ATTEMPTS = 10
SHIPPED = {"counter": (7, "mind"), "wanted": (2, "mind_wanted")}
"""The attempts that the model has the minds of, and their folders in it. By `results/`, attempt 7
of `counter` has the most correct sequences a run; attempt 3 a larger share of correct ones, but it
takes the next object along when it validates, which the thesis's robot does not. Attempt 2 of
`wanted` has the largest share."""


def plan(about, wanted=2, **options):
    """Return a training.

    Args:
        about: what it is for.
        wanted: how many objects a sequence has; 0 for a number drawn anew for each.
        options: of the hierarchy.
    """
    return TrainingPlan(
        about,
        ATTEMPTS,
        partial(LESSONS.hierarchy, **options),
        lambda: Curriculum(LESSONS.lessons(wanted)),
        "counter",
        SEED,
    )


PLANS = TrainingPlans(
    Path(__file__).parent,
    {
        "counter": plan("a variable that counts, a network without hidden layers"),
        "counter_hidden": plan(
            "a variable that counts, a perceptron of two hidden layers",
            function=Perceptron(layers=2),
        ),
        "simple": plan(
            "a variable that holds what it is told, an influence network",
            regulation=Simple(),
            function=LESSONS.HOLDING,
        ),
        "wanted": plan("one to four objects, told by a sensor", wanted=0, inputs=LESSONS.WANTED),
    },
)


def wanted_of(name: str) -> int:
    """Return how many objects a sequence of a training has."""
    lesson = PLANS[name].curriculum().lessons[0]
    return int(lesson.parameters["wanted"])


def ship() -> list[Path]:
    """Give the model the minds of the chosen attempts.

    Returns:
        Their folders.
    """
    targets = []
    for name, (attempt, mind) in SHIPPED.items():
        target = model_folder("counter") / mind
        shutil.rmtree(target, ignore_errors=True)
        Training(PLANS.kept / name).mind(attempt).save(target)
        targets.append(target)
    return targets


if __name__ == "__main__":
    if sys.argv[1:] == ["ship"]:
        print(*ship(), sep="\n")
    else:
        PLANS.main(sys.argv[1:])
