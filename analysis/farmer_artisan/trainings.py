"""Attempts at teaching farmers and artisans to do well, all of them by one mind.

python -m analysis.farmer_artisan.trainings taught       # gone on with if begun
python -m analysis.farmer_artisan.trainings keep taught  # what it came to, into results/

They lie in `trainings/`, and begin with what `results/` holds of them. `learned.py` looks at all of
them.
"""

from __future__ import annotations

import sys
from pathlib import Path

from socialmind.catalogue import load_file, model_folder
from socialmind.experiments.trainings.plans import TrainingPlan, TrainingPlans

LESSONS = load_file(model_folder("farmer_artisan_learned") / "lessons.py")
SEED = 3
ATTEMPTS = 10

PLANS = TrainingPlans(
    Path(__file__).parent,
    {
        "taught": TrainingPlan(
            "farmers and artisans taught for wheat",
            ATTEMPTS,
            lambda: LESSONS.MIND,
            lambda: LESSONS.curriculum,
            "farmer_artisan_learned",
            SEED,
        ),
    },
)


if __name__ == "__main__":
    PLANS.main(sys.argv[1:])
