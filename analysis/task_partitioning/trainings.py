"""Attempts at evolving robots that fetch items, on a slope and on flat ground.

python -m analysis.task_partitioning.trainings slope       # or all; gone on with if begun
python -m analysis.task_partitioning.trainings keep slope  # what it came to, into results/
python -m analysis.task_partitioning.trainings ship        # the mind of one attempt, to the model

They lie in `trainings/`, and begin with what `results/` holds of them; `socialmind reproduce
task-partitioning` makes its own.
"""

from __future__ import annotations

import shutil
import sys
from functools import partial
from pathlib import Path

from socialmind.catalogue import load_file, model_folder
from socialmind.experiments.trainings.plans import TrainingPlan, TrainingPlans
from socialmind.learning import Training

from .blocks import lessons_of_blocks, mind_of_blocks

LESSONS = load_file(model_folder("task_partitioning") / "lessons.py")
SEED = 9
ATTEMPTS = 10
SHIPPED = ("slope", 4)
"""The training and the attempt whose mind the model has: picked, as the one that brings most home
in the worlds for choosing. Others of the same training do not divide the way at all."""


def from_primitives(gradient: float, ground: str) -> TrainingPlan:
    """Return the training of minds that begin with nothing but primitives."""
    return TrainingPlan(
        f"from primitives, on {ground}",
        ATTEMPTS,
        lambda: LESSONS.MIND,
        partial(LESSONS.lessons, gradient),
        "task_partitioning",
        SEED,
    )


def from_blocks(gradient: float, ground: str) -> TrainingPlan:
    """Return the training of minds that begin with building blocks."""
    return TrainingPlan(
        f"from building blocks, on {ground}",
        ATTEMPTS,
        partial(mind_of_blocks, gradient),
        partial(lessons_of_blocks, gradient),
        "task_partitioning",
        SEED,
    )


PLANS = TrainingPlans(
    Path(__file__).parent,
    {
        "slope": from_primitives(1.0, "the slope"),
        "flat": from_primitives(0.0, "flat ground"),
        "blocks_slope": from_blocks(1.0, "the slope"),
        "blocks_flat": from_blocks(0.0, "flat ground"),
    },
    {"attempts": 2, "generations": 8, "population": 40, "repetitions": 2},
)


def ship() -> Path:
    """Give the model the mind of the chosen attempt.

    Returns:
        Its folder.
    """
    name, attempt = SHIPPED
    target = model_folder("task_partitioning") / "mind"
    shutil.rmtree(target, ignore_errors=True)
    Training(PLANS.kept / name).mind(attempt).save(target)
    return target


if __name__ == "__main__":
    if sys.argv[1:] == ["ship"]:
        print(ship())
    else:
        PLANS.main(sys.argv[1:])
