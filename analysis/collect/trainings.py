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
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import Any

from socialmind.catalogue import load_file, model_folder
from socialmind.experiments.trainings.plans import TrainingPlan, TrainingPlans, most_ticks
from socialmind.learning import Curriculum, Lesson, Training
from socialmind.mind import MindDescription

from .controls import LESSONS, MONOLITH, AllAtOnce, hierarchy, monolith

TOPIC = Path(__file__).parent
SEED = 6
SIX = tuple(LESSONS.curriculum.items)
"""The lessons of the curriculum."""
CONTEXT, *FURTHER = load_file(model_folder("collect_retrained") / "lessons.py").curriculum.lessons
"""Avoid, as in the thesis (6.2.2), and then more of the hierarchy, learned while Collect steers."""
MORE = "More of Collect"
"""The monolith's lesson in place of the first."""
AT_ONCE = 320_000_000
"""Ticks of the six lessons together, for learning all at once."""
LONG = 0.98
"""How steps narrow each generation in lessons of some hundreds of generations."""
COMMON = 64
"""Worlds on which the base skills' curves are validated."""


# Lessons ----------------------------------------------------------------------------------------


def by_monolith(lesson: Lesson, first: bool = False) -> Lesson:
    """Return a lesson for the monolith, which goes on from what it knows, in fine steps."""
    return replace(
        lesson,
        skill=MONOLITH,
        master=MONOLITH,
        settings={**LESSONS.FINE, "population": lesson.settings["population"]},
        start="scratch" if first else "known",
    )


def for_monolith() -> Curriculum:
    """Return the curriculum for one network, then as many ticks more of Collect."""
    six = [by_monolith(lesson, place == 0) for place, lesson in enumerate(SIX)]
    return Curriculum((*six, by_monolith(replace(CONTEXT, name=MORE))))


def at_once(skills: tuple[str, ...], master: str) -> Curriculum:
    """Return the one lesson of learning everything as a single task."""
    lesson = Lesson(
        "All at once",
        AllAtOnce,
        skill=skills,
        master=master,
        repetitions=6,
        generations=10_000,
        budget=AT_ONCE,
        settings={**LESSONS.FINE, "narrowing": LONG},
    )
    return Curriculum((lesson,))


def with_longer_avoid() -> Curriculum:
    """Return the curriculum with as many more ticks for Avoid as learning in context takes."""
    lessons = []
    for lesson in SIX:
        if lesson.name == "Avoid":
            budget = CONTEXT.budget or 0
            lesson = replace(
                lesson,
                generations=10_000,
                budget=most_ticks(lesson) + budget,
                settings={**lesson.settings, "narrowing": LONG},
            )
        lessons.append(lesson)
    return Curriculum(tuple(lessons))


def chosen() -> int:
    """Return the kept attempt at the hierarchy whose mind is that of `collect`: the best one."""
    done = kept_hierarchy().lessons
    done = done[done["lesson"] == "Collect"]
    return int(done.loc[done["score"].idxmax(), "attempt"])


def kept_hierarchy() -> Training:
    """Return the attempts at the hierarchy that are kept."""
    return Training(TOPIC / "results" / "trainings" / "hierarchy")


def base_skills() -> Curriculum:
    """Return the two base skills' lessons as long as the thesis's, with curves on common worlds."""
    return Curriculum(
        replace(lesson, generations=1000, validation=COMMON)
        for lesson in SIX
        if lesson.name in ("GoToObject", "GoToDropZone")
    )


# Power management -------------------------------------------------------------------------------


def power() -> Any:
    """Return the module of lessons about the battery."""
    return load_file(model_folder("collect_power") / "lessons.py")


def power_mind(variant: str, folder: str) -> MindDescription:
    """Return a hierarchy that can collect, with what it takes to look after the battery.

    Args:
        variant: `encapsulated` or `retrained` (figure 6.7).
        folder: the model whose trained mind it is: `collect` with the original Avoid,
            `collect_retrained` with the one learned in context.
    """
    lessons = power()
    mind: MindDescription = getattr(lessons, variant)(lessons.known(folder))
    return mind


def power_plan(variant: str, folder: str) -> TrainingPlan:
    """Return the training of one variant on one Avoid."""
    avoid = {"collect": "original", "collect_retrained": "retrained"}[folder]
    return TrainingPlan(
        f"power management, {variant}, on the {avoid} Avoid (6.3)",
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
            lambda: at_once(
                tuple(n for n, s in hierarchy().skills.items() if s.genome_size), "Collect"
            ),
        ),
        "monolith_at_once": plan(
            "the monolith, final task only (6.1)",
            5,
            monolith,
            lambda: at_once((MONOLITH,), MONOLITH),
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
