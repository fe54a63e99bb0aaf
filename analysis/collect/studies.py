"""Figures 6.2 to 6.5 and tables 6.1 to 6.3 of the thesis: a robot learns to collect objects."""

from __future__ import annotations

import sys
from collections.abc import Callable
from functools import partial
from pathlib import Path

from socialmind.errors import SocialmindError
from socialmind.experiments.studies import Study, Way

QUICK_WORLDS = 20


def _lines(name: str, way: Way, told: list[str], about: str) -> list[str]:
    return [f"{way.said(name, 'collect')} {about}".strip(), "", *(f"- {one}" for one in told)]


def _say(line: str) -> None:
    print(line, file=sys.stderr, flush=True)


def make_table(name: str, way: Way, out: Path) -> list[Path]:
    from .standings import SEED, WORLDS, standing
    from .tables import TABLES, write_table
    from .trainings import PLANS

    (table,) = (one for one in TABLES if one.name == name)
    worlds = QUICK_WORLDS if way is Way.QUICK else WORLDS
    given = {plan: PLANS.training(plan, way, out) for plan in table.plans}
    standings = [
        standing(given[one.plan][0], one, block.benchmark, worlds, report=_say)
        for block in table.blocks
        for one in block.structures
    ]
    about = (
        f"Each mind was scored in {worlds} worlds of the benchmark that no training has seen "
        f"(seed {SEED}), the same ones for all. In brackets are intervals of 95 %: over attempts, "
        "for what another training would come to, and over worlds, for what these minds would come "
        "to in others. The best attempt is the one that did best in the finals of its own lesson. "
        "**No budget is the thesis's**: it has more generations of each skill, of how many "
        "individuals and worlds it does not tell. Ours is that of the training, in all lessons up "
        "to the one judged; `in_context` and power management begin with what was learned before."
    )
    told = [line for _, line in given.values()]
    return write_table(table, standings, _lines(name, way, told, about), out)


def make_figure(name: str, way: Way, out: Path) -> list[Path]:
    from socialmind.experiments.trainings.rechecking import in_common_worlds

    from .figure_pages import write_curves
    from .figures import FIGURES, WORLDS
    from .trainings import PLANS

    (figure,) = (one for one in FIGURES if one.name == name)
    worlds = QUICK_WORLDS if way is Way.QUICK else WORLDS
    given = {plan: PLANS.training(plan, way, out) for plan in figure.plans}
    trainings = {plan: training for plan, (training, _) in given.items() if training is not None}
    told = [line for _, line in given.values()]
    if not trainings:
        raise SocialmindError(f"{name}: {'; '.join(told)}")
    about = (
        f"The winner of each lesson was judged once more in {worlds} worlds that all attempts "
        "share and nothing else uses."
    )
    judged = {
        plan: in_common_worlds(
            training, PLANS[plan].curriculum().lessons, {*figure.lessons, *figure.beside}, worlds
        )
        for plan, training in trainings.items()
    }
    return write_curves(figure, trainings, judged, _lines(name, way, told, about), out)


def make_equal_ticks(name: str, way: Way, out: Path) -> list[Path]:
    from .equal_ticks import PANELS, write
    from .trainings import PLANS

    given = {plan: PLANS.training(plan, way, out) for plan, *_ in PANELS}
    trainings = {plan: training for plan, (training, _) in given.items() if training is not None}
    told = [line for _, line in given.values()]
    if not any(training.finished for training in trainings.values()):
        raise SocialmindError(f"{name}: {'; '.join(told)}")
    return write(trainings, _lines(name, way, told, ""), out)


def _study(make: Callable[[str, Way, Path], list[Path]], name: str, about: str) -> Study:
    return Study.of_trainings(name, about, partial(make, name))


studies = (
    _study(make_figure, "figure-6.2", "GoToObject and GoToDropZone learned, 10 attempts"),
    _study(make_figure, "figure-6.3", "Avoid learned"),
    _study(make_figure, "figure-6.4", "GoToObject+Avoid and GoToDropZone+Avoid learned"),
    _study(make_figure, "figure-6.5", "Collect learned"),
    _study(
        make_equal_ticks,
        "figure-6.5-equal-ticks",
        "hierarchy and monolith with equal ticks, and whether they level off",
    ),
    _study(make_table, "table-6.1", "hierarchy or monolith, curriculum or final task only"),
    _study(make_table, "table-6.1-equal-ticks", "the same with equal ticks in each lesson"),
    _study(make_table, "table-6.2", "more resources for Avoid, or Avoid learned in context"),
    _study(make_table, "table-6.3", "power management, two variants on two Avoids"),
)
