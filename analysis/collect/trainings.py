"""The trainings behind the tables and figures of chapter 6, each with the command that makes it.

python -m analysis.collect.trainings hierarchy          # all its attempts, gone on with if begun
python -m analysis.collect.trainings all
"""

from __future__ import annotations

import sys
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from socialmind.learning import Curriculum, Lesson, learn, resume
from socialmind.mind import MindDescription

from .controls import LESSONS, MONOLITH, AllAtOnce, hierarchy, monolith

HOME = Path(__file__).parent / "trainings"
SEED = 6
SIX = tuple(LESSONS.curriculum.items)
"""The lessons of the curriculum."""
CONTEXT = Lesson(
    "Avoid in context",
    LESSONS.CollectObjects,
    skill="Avoid",
    master="Collect",
    repetitions=8,
    generations=1000,
    budget=120_000_000,
    settings=LESSONS.FINE,
)
"""Avoid learned anew while Collect steers, by Collect's reward (thesis, 6.2.2)."""
AT_ONCE = 250_000_000
"""Ticks of the six lessons together, for learning all at once."""


@dataclass(frozen=True)
class Plan:
    """A training: what learns what, how often.

    Attributes:
        about: what it is for.
        attempts: how many.
        mind: the mind to begin from.
        curriculum: the lessons.
    """

    about: str
    attempts: int
    mind: Callable[[], MindDescription]
    curriculum: Callable[[], Curriculum]


def by_monolith(lesson: Lesson, first: bool = False) -> Lesson:
    """Return a lesson for the monolith, which goes on from what it knows."""
    return replace(
        lesson,
        skill=MONOLITH,
        master=MONOLITH,
        settings=LESSONS.FINE,
        start="scratch" if first else "known",
    )


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
        settings=LESSONS.FINE,
    )
    return Curriculum((lesson,))


def with_longer_avoid() -> Curriculum:
    """Return the curriculum with as many more ticks for Avoid as learning in context takes."""
    lessons = []
    for lesson in SIX:
        if lesson.name == "Avoid":
            budget = CONTEXT.budget or 0
            lesson = replace(lesson, generations=10_000, budget=38_400_000 + budget)
        lessons.append(lesson)
    return Curriculum(tuple(lessons))


PLANS: Mapping[str, Plan] = {
    "hierarchy": Plan(
        "the curriculum, then Avoid in context (6.1, 6.2)",
        10,
        hierarchy,
        lambda: Curriculum((*SIX, CONTEXT)),
    ),
    "monolith": Plan(
        "the curriculum for one network, then more of Collect (6.1)",
        10,
        monolith,
        lambda: Curriculum(
            (
                *(by_monolith(lesson, place == 0) for place, lesson in enumerate(SIX)),
                by_monolith(replace(CONTEXT, name="More of Collect")),
            )
        ),
    ),
    "hierarchy_at_once": Plan(
        "the hierarchy, final task only (6.1)",
        5,
        hierarchy,
        lambda: at_once(
            tuple(n for n, s in hierarchy().skills.items() if s.genome_size), "Collect"
        ),
    ),
    "monolith_at_once": Plan(
        "the monolith, final task only (6.1)", 5, monolith, lambda: at_once((MONOLITH,), MONOLITH)
    ),
    "longer_avoid": Plan(
        "the curriculum with more ticks for Avoid (6.2)", 5, hierarchy, with_longer_avoid
    ),
}


def train(name: str, attempts: int | None = None, **options: Any) -> Path:
    """Make a training, or go on with it.

    Args:
        name: of the plan.
        attempts: how many; the plan's by default.
        options: for `socialmind.learning.learn`.

    Returns:
        The training's folder.
    """
    plan = PLANS[name]
    folder = HOME / name
    wanted = attempts or plan.attempts
    if (folder / "manifest.json").is_file():
        return resume(folder, attempts=wanted, lessons=plan.curriculum(), **options)
    return learn(
        "collect",
        lessons=plan.curriculum(),
        mind=plan.mind(),
        attempts=wanted,
        seed=SEED,
        out=folder,
        **options,
    )


def _told(attempt: int, lesson: Lesson, result: Any) -> None:
    print(
        f"attempt {attempt}, {lesson.name}: {result.score:.4g} ± {result.deviation:.2g}", flush=True
    )


if __name__ == "__main__":
    for one in PLANS if sys.argv[1:] == ["all"] else sys.argv[1:]:
        print(one, train(one, on_lesson=_told), flush=True)
