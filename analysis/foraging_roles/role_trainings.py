"""The trainings of `role_lessons`, ten attempts each, as folders that can be gone on with.

python -m analysis.foraging_roles.role_trainings delivered_role         # or gone on with
python -m analysis.foraging_roles.role_trainings keep delivered_role    # into results/trainings/
python -m analysis.foraging_roles.role_trainings recheck delivered_role # after an edit of the model

They lie in `trainings/`. The first three attempts of `supervised_role` are the three of `learned`
in `trainings.py`, whose lesson it is.
"""

from __future__ import annotations

import sys
from pathlib import Path

from socialmind.catalogue import load_file, model_folder
from socialmind.experiments.trainings.plans import TrainingPlan, TrainingPlans
from socialmind.learning import Curriculum, Training
from socialmind.mind import MindDescription

from .worlds import CHOOSING_ECONOMY, TRAINING

MODEL = model_folder("foraging_roles")
LESSONS = load_file(MODEL / "role_lessons.py")
ATTEMPTS = 10
STARTS = 5
"""Attempts at `delivered_narrow` of which the best one counts as one, chosen in worlds for it."""

PLANS = TrainingPlans(
    Path(__file__).parent,
    {
        "delivered_role": TrainingPlan(
            "judged by what is brought home, CollectSelect learned before",
            ATTEMPTS,
            LESSONS.choosing,
            lambda: LESSONS.delivered,
            "foraging_roles",
            TRAINING,
        ),
        "delivered_narrow": TrainingPlan(
            "the same with a third of the individuals; of five starts the best one counts",
            ATTEMPTS * STARTS,
            LESSONS.choosing,
            lambda: LESSONS.narrow,
            "foraging_roles",
            TRAINING,
        ),
        "at_once": TrainingPlan(
            "judged by what is brought home, CollectSelect learned together with ForageRole",
            ATTEMPTS,
            LESSONS.choosing,
            lambda: LESSONS.together,
            "foraging_roles",
            TRAINING,
        ),
        "supervised_role": TrainingPlan(
            "today's: judged by the variable ROLE, CollectSelect a program",
            ATTEMPTS,
            lambda: LESSONS.foraging(LESSONS.known()),
            lambda: Curriculum((LESSONS.supervised_role,)),
            "foraging_roles",
            TRAINING,
        ),
        "thesis_role": TrainingPlan(
            "as in section 8.2: in bodies, one society, paid near the ratio",
            ATTEMPTS,
            LESSONS.as_in_thesis,
            lambda: LESSONS.thesis,
            "foraging_roles",
            TRAINING,
        ),
    },
)


def best_starts(training: Training, starts: int = STARTS) -> list[int]:
    """Return of each few attempts at a role by deliveries the best one, in worlds for choosing.

    Args:
        training: of `DeliveryEconomy`; attempts of a few that is not complete are left out.
        starts: how many of them are one.
    """
    found, done = [], training.finished
    for first in range(0, len(done) - starts + 1, starts):
        few = done[first : first + starts]
        found.append(max(few, key=lambda attempt: score_in_economy(training.mind(attempt))))
    return found


def score_in_economy(mind: MindDescription) -> float:
    """Return what a mind comes to by the terms of the lesson, in the worlds for choosing."""
    economy = LESSONS.DeliveryEconomy({}, mind, LESSONS.MASTER, LESSONS.ROLE)
    outcome = economy.run([mind.skill(LESSONS.ROLE).genome], list(CHOOSING_ECONOMY))
    return float(outcome.score.mean())


if __name__ == "__main__":
    PLANS.main(sys.argv[1:])
