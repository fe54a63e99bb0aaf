"""The trainings behind the tables and figures of chapter 6, each with the command that makes it.

python -m analysis.collect.trainings hierarchy          # all its attempts, gone on with if begun
python -m analysis.collect.trainings all

They lie in `trainings/`, and begin with what `results/` holds of them.
"""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path
from typing import Any

from socialmind.catalogue import load_file, model_folder
from socialmind.errors import SocialmindError
from socialmind.learning import Curriculum, Lesson, Training, learn, resume
from socialmind.mind import MindDescription

from .controls import LESSONS, MONOLITH, AllAtOnce, hierarchy, monolith

HOME = Path(__file__).parent / "trainings"
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
PACE = 2_000_000
"""Ticks a second that two processors do at least, for a word on how long a training takes."""


@dataclass(frozen=True)
class Plan:
    """A training: what learns what, how often.

    Attributes:
        about: what it is for.
        attempts: how many.
        mind: the mind to begin from.
        curriculum: the lessons.
        model: where they take place.
    """

    about: str
    attempts: int
    mind: Callable[[], MindDescription]
    curriculum: Callable[[], Curriculum]
    model: str = "collect"

    @property
    def seconds(self) -> float:
        """How long all attempts take at most, at `PACE`."""
        return self.attempts * sum(map(most_ticks, self.curriculum().lessons)) / PACE


def most_ticks(lesson: Lesson) -> int:
    """Return the ticks of a lesson whose episodes all last to the end."""
    population = int(lesson.settings["population"])
    generation = population * lesson.repetitions * lesson.episode_ticks
    whole = lesson.generations * generation
    return whole if lesson.budget is None else min(whole, lesson.budget + generation)


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
    return Training(HOME.parent / "results" / "trainings" / "hierarchy")


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


def power_plan(variant: str, folder: str) -> Plan:
    """Return the training of one variant on one Avoid."""
    avoid = {"collect": "original", "collect_retrained": "retrained"}[folder]
    return Plan(
        f"power management, {variant}, on the {avoid} Avoid (6.3)",
        5,
        partial(power_mind, variant, folder),
        lambda: Curriculum(power().lessons),
        "collect_power",
    )


PLANS: Mapping[str, Plan] = {
    "hierarchy": Plan(
        "the curriculum, then Avoid in context (6.1, 6.2)",
        10,
        hierarchy,
        lambda: Curriculum((*SIX, CONTEXT)),
    ),
    "monolith": Plan(
        "the curriculum for one network, then more of Collect (6.1)", 10, monolith, for_monolith
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
    "in_context": Plan(
        "more of the hierarchy in context, on one attempt of it (6.2)",
        3,
        lambda: kept_hierarchy().mind(chosen(), CONTEXT.name),
        lambda: Curriculum(FURTHER),
    ),
    "longer_avoid": Plan(
        "the curriculum with more ticks for Avoid (6.2)", 5, hierarchy, with_longer_avoid
    ),
    "base_skills": Plan(
        "the base skills over 1,000 generations (figure 6.2)", 10, hierarchy, base_skills
    ),
    "power_encapsulated": power_plan("encapsulated", "collect_retrained"),
    "power_retrained": power_plan("retrained", "collect_retrained"),
    "power_encapsulated_original": power_plan("encapsulated", "collect"),
    "power_retrained_original": power_plan("retrained", "collect"),
}


def small(
    plan: Plan,
    attempts: int = 2,
    generations: int = 15,
    population: int = 40,
    repetitions: int = 3,
    ticks: int | None = None,
) -> Plan:
    """Return a plan of a minute or so: its results show that all works, and nothing else.

    Args:
        plan: the whole one.
        attempts: how many.
        generations: of each lesson, at most.
        population: individuals of a generation.
        repetitions: worlds of an individual.
        ticks: of an episode at most; as many as in the whole plan by default.
    """

    def change(lesson: Lesson) -> Lesson:
        return lesson.changed(
            generations=min(lesson.generations, generations),
            budget=None,
            repetitions=repetitions,
            ticks=lesson.ticks if ticks is None else min(lesson.episode_ticks, ticks),
            finals=8,
            validation=min(lesson.validation, 16),
            settings={**lesson.settings, "population": population, "elite": 3},
        )

    return replace(
        plan, attempts=attempts, curriculum=lambda: plan.curriculum().with_lessons(change)
    )


# Training ---------------------------------------------------------------------------------------


def train(name: str, folder: Path, plan: Plan | None = None, **options: Any) -> Path:
    """Make a training, or go on with it.

    Args:
        name: of the plan.
        folder: of the training.
        plan: in place of the one of that name.
        options: for `socialmind.learning.learn`.

    Returns:
        The training's folder.
    """
    plan = plan or plan_of(name)
    if (folder / "manifest.json").is_file():
        return resume(folder, attempts=plan.attempts, lessons=plan.curriculum(), **options)
    return learn(
        plan.model,
        lessons=plan.curriculum(),
        mind=plan.mind(),
        attempts=plan.attempts,
        seed=SEED,
        out=folder,
        **options,
    )


def made(plans: Mapping[str, Plan], out: Path, quick: bool) -> dict[str, Path]:
    """Make trainings below a folder, or go on with them, and say what comes of each lesson.

    Args:
        plans: by name.
        out: the folder.
        quick: whether small ones will do.

    Returns:
        The trainings' folders by name.
    """
    home, folders = out / ("small_trainings" if quick else "trainings"), {}
    for name, plan in plans.items():
        one = small(plan) if quick else plan
        print(f"{name}: {one.about}; {one.attempts} attempts", file=sys.stderr, flush=True)
        folders[name] = train(name, home / name, one, on_lesson=told)
    return folders


def attempts_of(folders: Mapping[str, Path]) -> Iterator[tuple[str, int, MindDescription]]:
    """Yield the name of each training, each of its attempts, and the mind at its end."""
    for name, folder in folders.items():
        training = Training(folder)
        for attempt in sorted(training.lessons["attempt"].unique().tolist()):
            yield name, attempt, training.mind(attempt)


def plan_of(name: str) -> Plan:
    """Return the plan of a name.

    Raises:
        SocialmindError: there is none.
    """
    if name not in PLANS:
        raise SocialmindError(f"no training called {name!r}; expected one of {', '.join(PLANS)}")
    return PLANS[name]


def told(attempt: int, lesson: Lesson, result: Any) -> None:
    """Say what came of a lesson."""
    line = f"attempt {attempt}, {lesson.name}: {result.score:.4g} ± {result.deviation:.2g}"
    print(line, file=sys.stderr, flush=True)


def main(names: list[str]) -> None:
    """Make trainings in `HOME`, or go on with them."""
    from .results import take_out

    for name in PLANS if names == ["all"] else names:
        plan_of(name)
        folder = HOME / name
        if not folder.is_dir():
            take_out(name, folder)
        print(name, train(name, folder, on_lesson=told), flush=True)


if __name__ == "__main__":
    main(sys.argv[1:])
