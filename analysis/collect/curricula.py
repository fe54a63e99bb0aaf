"""What learns to collect learns in which lessons, and for how long.

The thesis gave each skill 1,000 generations and Collect 1,500 (6.1); its monolith learned the same
curriculum. The curriculum of `collect` is shorter. So there are lessons of equal length as well:
both structures spend the same ticks on each of the six, on the first five what the hierarchy spends
on them in the curriculum, and on the last one `COLLECTING` ticks; who learns the final task alone
spends as many in all. They are judged on common worlds too (`validation`), so that one sees in the
curve against ticks whether it has levelled off. The monolith had not; so both go on with Collect
for `LONGER` ticks, and then for `COLLECTING` more, in lessons of their own that begin with large
steps again. Then the hierarchy has, and the monolith alone goes on for `COLLECTING` once more.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from socialmind.catalogue import load_file, model_folder
from socialmind.experiments.trainings.plans import most_ticks
from socialmind.learning import Curriculum, Lesson

from .controls import LESSONS, MONOLITH, AllAtOnce

SIX = tuple(LESSONS.curriculum.items)
"""The lessons of the curriculum."""
CONTEXT, *FURTHER = load_file(model_folder("collect_retrained") / "lessons.py").curriculum.lessons
"""Avoid, as in the thesis (6.2.2), and then more of the hierarchy, learned while Collect steers."""
MORE = "More of Collect"
"""The monolith's lesson in place of the first, and one behind the six where ticks are equal."""
STILL_MORE = "Still more of Collect"
"""The last lesson where ticks are equal."""
EVEN_MORE = "Even more of Collect"
"""The monolith's lesson behind it, which the hierarchy has no equal of."""
AT_ONCE = 320_000_000
"""Ticks of the six lessons together, for learning all at once."""
LONG = 0.98
"""How steps narrow each generation in lessons of some hundreds of generations."""
COMMON = 64
"""Worlds on which curves are validated."""
COLLECTING = 600_000_000
"""Ticks of Collect in lessons of equal length: some 16 times those of ten generations."""
EQUAL = {
    "GoToObject": 36_000_000,
    "GoToDropZone": 36_000_000,
    "Avoid": 61_000_000,
    "GoToObject+Avoid": 65_000_000,
    "GoToDropZone+Avoid": 68_000_000,
    "Collect": COLLECTING,
}
"""Ticks of each lesson where the structures have equal ones."""
LONGER = 400_000_000
"""Ticks of Collect in the first lesson behind those."""
SHORTER = 0.97
"""How steps narrow in it, so that they come to the same in the end."""
ENDLESS = 10_000
"""Generations that no lesson comes to: its ticks end it."""


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


def at_once(
    skills: tuple[str, ...], master: str, ticks: int = AT_ONCE, validation: int = 0
) -> Curriculum:
    """Return the one lesson of learning everything as a single task.

    Args:
        skills: that learn.
        master: of the hierarchy.
        ticks: of the lesson.
        validation: common worlds on which its curve is judged too.
    """
    lesson = Lesson(
        "All at once",
        AllAtOnce,
        skill=skills,
        master=master,
        repetitions=6,
        generations=ENDLESS,
        budget=ticks,
        validation=validation,
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
                generations=ENDLESS,
                budget=most_ticks(lesson) + budget,
                settings={**lesson.settings, "narrowing": LONG},
            )
        lessons.append(lesson)
    return Curriculum(tuple(lessons))


def base_skills() -> Curriculum:
    """Return the two base skills' lessons as long as the thesis's, with curves on common worlds."""
    return Curriculum(
        replace(lesson, generations=1000, validation=COMMON)
        for lesson in SIX
        if lesson.name in ("GoToObject", "GoToDropZone")
    )


def by_ticks(lesson: Lesson) -> Lesson:
    """Return a lesson that its equal ticks end."""
    changed = lesson.changed(
        generations=ENDLESS, budget=EQUAL[lesson.name], ticks=lesson.episode_ticks
    )
    if lesson.name != "Collect":
        return changed
    return changed.changed(validation=COMMON, settings={**lesson.settings, "narrowing": LONG})


def and_more(lessons: Sequence[Lesson]) -> Curriculum:
    """Return lessons of equal length, and more of the last one, twice."""
    *_, last = lessons
    settings = {**last.settings, "narrowing": SHORTER}
    more = replace(last, name=MORE, budget=LONGER, start="known", settings=settings)
    still_more = replace(last, name=STILL_MORE, start="known")
    return Curriculum((*lessons, more, still_more))


def equal() -> Curriculum:
    """Return the lessons of equal length, for the hierarchy."""
    return and_more([by_ticks(lesson) for lesson in SIX])


def equal_for_monolith() -> Curriculum:
    """Return them for one network, which goes on from what it knows, and one lesson more."""
    six = []
    for place, lesson in enumerate(SIX):
        taught = by_monolith(lesson, place == 0)
        six.append(by_ticks(replace(taught, name=lesson.name)))
    lessons = and_more(six).lessons
    return Curriculum((*lessons, replace(lessons[-1], name=EVEN_MORE)))
