"""Hierarchy and monolith with the same ticks in each lesson, and enough of Collect to level off.

python -m analysis.collect.level monolith_level          # or hierarchy_level; gone on with if begun
python -m analysis.collect.level keep monolith_level     # into results/trainings/

The thesis gave each skill 1,000 generations and Collect 1,500 (6.1); its monolith learned the same
curriculum. Here both structures spend the same ticks on each of the six lessons: on the first five
what the hierarchy of `trainings.py` spent on them, and on the last `LEVEL` ticks. The best
individual of each generation is judged on common worlds too (`validation`), so that one sees in the
curve against ticks whether it has levelled off.
"""

from __future__ import annotations

import sys
from dataclasses import replace
from pathlib import Path

from socialmind.experiments.trainings.plans import TrainingPlan, TrainingPlans
from socialmind.learning import Curriculum, Lesson

from .controls import hierarchy, monolith
from .trainings import COMMON, LONG, SEED, SIX, by_monolith

ATTEMPTS = 10
LEVEL = 600_000_000
"""Ticks of Collect: some 16 times those of ten generations."""
BUDGETS = {
    "GoToObject": 36_000_000,
    "GoToDropZone": 36_000_000,
    "Avoid": 61_000_000,
    "GoToObject+Avoid": 65_000_000,
    "GoToDropZone+Avoid": 68_000_000,
    "Collect": LEVEL,
}
"""Ticks of each lesson, for both structures."""
ENOUGH = 10_000
"""Generations that no lesson comes to: its ticks end it."""


def by_ticks(lesson: Lesson) -> Lesson:
    """Return a lesson that ends by ticks."""
    changed = lesson.changed(
        generations=ENOUGH, budget=BUDGETS[lesson.name], ticks=lesson.episode_ticks
    )
    if lesson.name != "Collect":
        return changed
    return changed.changed(validation=COMMON, settings={**lesson.settings, "narrowing": LONG})


def of_hierarchy() -> Curriculum:
    """Return the six lessons for the hierarchy."""
    return Curriculum(tuple(by_ticks(lesson) for lesson in SIX))


def of_monolith() -> Curriculum:
    """Return the six lessons for one network, which goes on from what it knows."""
    six = []
    for place, lesson in enumerate(SIX):
        taught = by_monolith(lesson, place == 0)
        six.append(by_ticks(replace(taught, name=lesson.name)))
    return Curriculum(tuple(six))


PLANS = TrainingPlans(
    Path(__file__).parent,
    {
        "monolith_level": TrainingPlan(
            "one network, as many ticks as the hierarchy in each lesson, until it levels off (6.1)",
            ATTEMPTS,
            monolith,
            of_monolith,
            "collect",
            SEED,
        ),
        "hierarchy_level": TrainingPlan(
            "the hierarchy with the same ticks, until it levels off (6.1)",
            ATTEMPTS,
            hierarchy,
            of_hierarchy,
            "collect",
            SEED,
        ),
    },
)


if __name__ == "__main__":
    PLANS.main(sys.argv[1:])
