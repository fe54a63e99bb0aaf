"""The trainings behind the tables and figures of chapter 6, each with the command that makes it.

python -m analysis.collect.trainings hierarchy          # or all; gone on with if begun
python -m analysis.collect.trainings keep hierarchy     # what it came to, into results/trainings/
python -m analysis.collect.trainings recheck hierarchy  # after an edit of the model's files
python -m analysis.collect.trainings rescore hierarchy  # after a fault of the scoring was mended

They lie in `trainings/`, and begin with what `results/` holds of them.
"""

from __future__ import annotations

import sys
from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import Any

from socialmind.catalogue import load_file, model_folder
from socialmind.experiments.trainings.plans import TrainingPlan, TrainingPlans
from socialmind.learning import Curriculum, Training
from socialmind.mind import MindDescription

from .controls import MONOLITH, hierarchy, monolith
from .curricula import (
    COMMON,
    CONTEXT,
    EQUAL,
    FURTHER,
    SIX,
    at_once,
    base_skills,
    equal,
    equal_for_monolith,
    for_monolith,
    with_longer_avoid,
)

TOPIC = Path(__file__).parent
SEED = 6
ALL = sum(EQUAL.values())
"""Ticks of the six lessons of equal length."""


def chosen() -> int:
    """Return the kept attempt at the hierarchy whose mind is that of `collect`: the best one."""
    done = kept_hierarchy().lessons
    done = done[done["lesson"] == "Collect"]
    return int(done.loc[done["score"].idxmax(), "attempt"])


def all_skills() -> tuple[str, ...]:
    """Return the skills of the hierarchy that learn."""
    return tuple(name for name, skill in hierarchy().skills.items() if skill.genome_size)


def kept_hierarchy() -> Training:
    """Return the attempts at the hierarchy that are kept."""
    return Training(TOPIC / "results" / "trainings" / "hierarchy")


# Power management -------------------------------------------------------------------------------


def power() -> Any:
    """Return the module of lessons about the battery."""
    return load_file(model_folder("collect_power") / "lessons.py")


def power_mind(variant: str, folder: str) -> MindDescription:
    """Return a hierarchy that can collect, with what it takes to look after the battery.

    Args:
        variant: `encapsulated` or `retrained` (figure 6.7).
        folder: the model whose trained mind it is: `collect` with the original Avoid,
            `collect_retrained` with all skills below Collect learned in context.
    """
    lessons = power()
    mind: MindDescription = getattr(lessons, variant)(lessons.known(folder))
    return mind


def power_plan(variant: str, folder: str) -> TrainingPlan:
    """Return the training of one variant on one mind."""
    on = {
        "collect": "the original Avoid",
        "collect_retrained": "all skills below Collect retrained in context (attempt 2 of "
        "`in_context`)",
    }[folder]
    return TrainingPlan(
        f"power management, {variant}, on {on} (6.3)",
        5,
        partial(power_mind, variant, folder),
        lambda: Curriculum(power().lessons),
        "collect_power",
        SEED,
    )


# Plans ------------------------------------------------------------------------------------------


def plan(
    about: str,
    attempts: int,
    mind: Callable[[], MindDescription],
    curriculum: Callable[[], Curriculum],
) -> TrainingPlan:
    """Return a training in the world of `collect`; the arguments are those of `TrainingPlan`."""
    return TrainingPlan(about, attempts, mind, curriculum, "collect", SEED)


PLANS = TrainingPlans(
    TOPIC,
    {
        "hierarchy": plan(
            "the curriculum, then Avoid in context (6.1, 6.2)",
            10,
            hierarchy,
            lambda: Curriculum((*SIX, CONTEXT)),
        ),
        "monolith": plan(
            "the curriculum for one network, then more of Collect (6.1)", 10, monolith, for_monolith
        ),
        "hierarchy_at_once": plan(
            "the hierarchy, final task only (6.1)",
            5,
            hierarchy,
            lambda: at_once(all_skills(), "Collect"),
        ),
        "monolith_at_once": plan(
            "the monolith, final task only (6.1)",
            5,
            monolith,
            lambda: at_once((MONOLITH,), MONOLITH),
        ),
        "hierarchy_level": plan(
            "the curriculum with equal ticks, then more of Collect (6.1)", 10, hierarchy, equal
        ),
        "monolith_level": plan(
            "the same for one network, with the hierarchy's ticks in each lesson (6.1)",
            10,
            monolith,
            equal_for_monolith,
        ),
        "hierarchy_level_at_once": plan(
            "the hierarchy, final task only, with the ticks of its six lessons (6.1)",
            5,
            hierarchy,
            lambda: at_once(all_skills(), "Collect", ALL, COMMON),
        ),
        "monolith_level_at_once": plan(
            "the monolith, final task only, with the ticks of its six lessons (6.1)",
            5,
            monolith,
            lambda: at_once((MONOLITH,), MONOLITH, ALL, COMMON),
        ),
        "in_context": plan(
            "more of the hierarchy in context, on one attempt of it (6.2)",
            5,
            lambda: kept_hierarchy().mind(chosen(), CONTEXT.name),
            lambda: Curriculum(FURTHER),
        ),
        "longer_avoid": plan(
            "the curriculum with more ticks for Avoid (6.2)", 5, hierarchy, with_longer_avoid
        ),
        "base_skills": plan(
            "the base skills over 1,000 generations (figure 6.2)", 10, hierarchy, base_skills
        ),
        "power_encapsulated": power_plan("encapsulated", "collect_retrained"),
        "power_retrained": power_plan("retrained", "collect_retrained"),
        "power_encapsulated_original": power_plan("encapsulated", "collect"),
        "power_retrained_original": power_plan("retrained", "collect"),
    },
)


if __name__ == "__main__":
    PLANS.main(sys.argv[1:])
