"""The trainings of `role_lessons`, as folders that can be gone on with.

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
from socialmind.learning import Curriculum

from .lessons_like_bodies import like_bodies
from .worlds import TRAINING

MODEL = model_folder("foraging_roles")
LESSONS = load_file(MODEL / "role_lessons.py")
ATTEMPTS = 10
FURTHER = 10
"""Of `like_bodies`, for attempts that fall short of what `choosing` asks for."""
FEW, NARROW = 3, 5
"""Of lessons that are kept to show why `delivered_anew` is as it is."""

PLANS = TrainingPlans(
    Path(__file__).parent,
    {
        "delivered_role": TrainingPlan(
            "judged by what is brought home, CollectSelect learned before",
            FEW,
            LESSONS.choosing,
            lambda: LESSONS.delivered,
            "foraging_roles",
            TRAINING,
        ),
        "delivered_narrow": TrainingPlan(
            "the same with a third of the individuals",
            NARROW,
            LESSONS.choosing,
            lambda: LESSONS.narrow,
            "foraging_roles",
            TRAINING,
        ),
        "delivered_anew": TrainingPlan(
            "the same, begun anew until it has succeeded",
            ATTEMPTS,
            LESSONS.choosing,
            lambda: LESSONS.anew,
            "foraging_roles",
            TRAINING,
        ),
        "like_bodies": TrainingPlan(
            "judged by what is brought home, in an economy whose trips are as in bodies",
            ATTEMPTS + FURTHER,
            LESSONS.choosing,
            lambda: like_bodies,
            "foraging_roles",
            TRAINING,
        ),
        "at_once": TrainingPlan(
            "judged by what is brought home, CollectSelect learned together with ForageRole",
            FEW,
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


if __name__ == "__main__":
    PLANS.main(sys.argv[1:])
