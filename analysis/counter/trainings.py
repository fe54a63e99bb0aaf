"""Attempts at learning to count, with other variables and other functions of CountObjects.

python -m analysis.counter.trainings counter            # all its attempts, gone on with if begun
python -m analysis.counter.trainings all

They lie in `trainings/`; `socialmind reproduce representations` makes its own.
"""

from __future__ import annotations

import sys
from collections.abc import Mapping
from functools import partial
from pathlib import Path

from socialmind.catalogue import load_file, model_folder
from socialmind.learning import Curriculum
from socialmind.mind import Perceptron, Simple

COLLECT = load_file(Path(__file__).parents[1] / "collect" / "trainings.py")
LESSONS = load_file(model_folder("counter") / "lessons.py")
HOME = Path(__file__).parent / "trainings"
ATTEMPTS = 10


def plan(about, wanted=2, attempts=ATTEMPTS, **options):
    """Return a training.

    Args:
        about: what it is for.
        wanted: how many objects a sequence has; 0 for a number drawn anew for each.
        attempts: how many.
        options: of the hierarchy.
    """
    return COLLECT.Plan(
        about,
        attempts,
        partial(LESSONS.hierarchy, **options),
        lambda: Curriculum(LESSONS.lessons(wanted)),
        "counter",
    )


PLANS: Mapping[str, COLLECT.Plan] = {
    "counter": plan("a variable that counts, a network without hidden layers"),
    "counter_hidden": plan(
        "a variable that counts, a perceptron of two hidden layers", function=Perceptron(layers=2)
    ),
    "simple": plan(
        "a variable that holds what it is told, an influence network",
        regulation=Simple(),
        function=LESSONS.HOLDING,
    ),
    "wanted": plan("one to four objects, told by a sensor", wanted=0, inputs=LESSONS.WANTED),
}


def wanted_of(name: str) -> int:
    """Return how many objects a sequence of a training has."""
    lesson = PLANS[name].curriculum().lessons[0]
    return int(lesson.parameters["wanted"])


def main(names: list[str]) -> None:
    """Make trainings in `HOME`, or go on with them."""
    for name in PLANS if names == ["all"] else names:
        folder = HOME / name
        print(name, COLLECT.train(name, folder, PLANS[name], on_lesson=COLLECT.told), flush=True)


if __name__ == "__main__":
    main(sys.argv[1:])
