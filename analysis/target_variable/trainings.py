"""Functions of CollectVariable compared: what lets one of two signals through, and what does not.

python -m analysis.target_variable.trainings selecting        # or all; gone on with if begun
python -m analysis.target_variable.trainings keep selecting   # into results/trainings/

They lie in `trainings/`, and begin with what `results/` holds of them. The skills below
CollectVariable are those of the model's trained mind, so that the comparison is about
CollectVariable alone.
"""

from __future__ import annotations

import sys
from collections.abc import Mapping
from functools import partial
from pathlib import Path

from socialmind.catalogue import load_file, model_folder
from socialmind.experiments.trainings.plans import TrainingPlan, TrainingPlans
from socialmind.learning import Curriculum
from socialmind.mind import InfluenceNetwork, InternalFunction, MindDescription, Perceptron

FOLDER = model_folder("target_variable")
LESSONS = load_file(FOLDER / "lessons.py")
SEED = 6
ATTEMPTS = 5
FUNCTIONS: Mapping[str, tuple[str, InternalFunction]] = {
    "selecting": ("the influence network of the model", LESSONS.SELECTING),
    "selecting_hidden": (
        "an influence network with a hidden layer",
        InfluenceNetwork(branches=1, passes=(2, 3), layers=1),
    ),
    "linear": ("a network without hidden layers", Perceptron(layers=0)),
    "perceptron": ("the thesis's perceptron of two hidden layers", Perceptron(layers=2)),
}
"""By name: what it is, and the function."""


def known(function: InternalFunction) -> MindDescription:
    """Return the trained hierarchy with another function of CollectVariable, to be learned."""
    mind = MindDescription.load(FOLDER / "mind")
    master = mind.skills[LESSONS.MASTER].changed(function=function, genome=None)
    return mind.with_modules(skills=[master])


def curriculum() -> Curriculum:
    """Return the one lesson of CollectVariable, as long for all of them."""
    (lesson,) = (one for one in LESSONS.lessons if one.name == LESSONS.MASTER)
    return Curriculum((lesson.changed(generations=40),))


PLANS = TrainingPlans(
    Path(__file__).parent,
    {
        name: TrainingPlan(
            about, ATTEMPTS, partial(known, function), curriculum, "target_variable", SEED
        )
        for name, (about, function) in FUNCTIONS.items()
    },
)


if __name__ == "__main__":
    PLANS.main(sys.argv[1:])
