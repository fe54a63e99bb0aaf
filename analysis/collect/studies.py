"""Figures 6.2 to 6.5 and tables 6.1 to 6.3 of the thesis: a robot learns to collect objects."""

from __future__ import annotations

import sys
from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

from socialmind.errors import SocialmindError
from socialmind.studies import Study

if TYPE_CHECKING:
    from socialmind.learning import Training

QUICK_WORLDS = 20

Source = Callable[[Path, str], "tuple[Training | None, str]"]
"""Gives the training of a plan, if there is one, and a line on where it comes from."""


# Where trainings come from ----------------------------------------------------------------------


def _from_nothing(out: Path, name: str) -> tuple[Training, str]:
    """The whole training, made below a folder, or gone on with."""
    return _made(out / "trainings", name, quick=False)


def _small(out: Path, name: str) -> tuple[Training, str]:
    """A small training."""
    return _made(out / "small_trainings", name, quick=True)


def _made(home: Path, name: str, quick: bool) -> tuple[Training, str]:
    from socialmind.learning import Training

    from .trainings import PACE, SEED, plan_of, small, told, train

    plan = small(plan_of(name)) if quick else plan_of(name)
    folder = home / name
    if not quick:
        _say(
            f"{name}: {plan.about}; {plan.attempts} attempts in {folder}, at most "
            f"{plan.seconds / 60:.0f} minutes at {PACE:,} ticks a second; Ctrl-C stops, and the "
            "same command goes on"
        )
    train(name, folder, plan, on_lesson=told)
    size = "trained small" if quick else "trained from nothing"
    line = f"`{name}`: {plan.about}. {plan.attempts} attempts, {size}, seed {SEED}."
    return Training(folder), line


def _kept(out: Path, name: str) -> tuple[Training | None, str]:
    """The training as `results/` has it; nothing is made below the folder."""
    from socialmind.learning import Training

    from .results import KEPT as HOME
    from .results import differences
    from .trainings import SEED, plan_of

    plan, command = plan_of(name), f"python -m analysis.collect.trainings {name}"
    if not (HOME / name).is_dir():
        return None, f"`{name}`: {plan.about}. Not kept; `{command}` makes it."
    training = Training(HOME / name)
    done = training.manifest.finished
    hours = training.manifest.timings["seconds"] / 3600
    line = (
        f"`{name}`: {plan.about}. {done} of {plan.attempts} attempts, seed {SEED}, "
        f"{hours:.1f} hours; `{command}`."
    )
    changed = differences(training, plan)
    if changed:
        line += f" Since then {', '.join(changed)} changed."
    return training, line


def _say(line: str) -> None:
    print(line, file=sys.stderr, flush=True)


# Tables and figures -----------------------------------------------------------------------------

FULL, QUICK, KEPT = "", " --quick", " --kept"
WAYS: dict[str, tuple[Source, str, str]] = {
    FULL: (_from_nothing, "From training to result", ""),
    QUICK: (
        _small,
        "A small version",
        " Two attempts with small populations and few generations show that all works, and say "
        "nothing about how well anything learns.",
    ),
    KEPT: (_kept, "From the trainings kept in `analysis/collect/results`, scored anew", ""),
}


def _lines(name: str, way: str, told: list[str], about: str) -> list[str]:
    _, made, remark = WAYS[way]
    command = f"`socialmind reproduce {name}{way}`"
    return [f"{made}, by {command}.{remark} {about}", "", *(f"- {one}" for one in told)]


def make_table(name: str, way: str, out: Path) -> list[Path]:
    from .standings import SEED, WORLDS, standing
    from .tables import TABLES, write_table

    (table,) = (one for one in TABLES if one.name == name)
    worlds = QUICK_WORLDS if way == QUICK else WORLDS
    given = {plan: WAYS[way][0](out, plan) for plan in table.plans}
    standings = [
        standing(given[one.plan][0], one, block.benchmark, worlds, report=_say)
        for block in table.blocks
        for one in block.structures
    ]
    about = (
        f"Each mind was scored in {worlds} worlds of the benchmark that no training has seen "
        f"(seed {SEED}), the same ones for all. In brackets are intervals of 95 %: over attempts, "
        "for what another training would come to, and over worlds, for what these minds would come "
        "to in others. The best attempt is the one that did best in the finals of its own lesson."
    )
    told = [line for _, line in given.values()]
    return write_table(table, standings, _lines(name, way, told, about), out)


def make_figure(name: str, way: str, out: Path) -> list[Path]:
    from .figures import FIGURES, write_curves

    (figure,) = (one for one in FIGURES if one.name == name)
    given = {plan: WAYS[way][0](out, plan) for plan in figure.plans}
    trainings = {plan: training for plan, (training, _) in given.items() if training is not None}
    told = [line for _, line in given.values()]
    if not trainings:
        raise SocialmindError(f"{name}: {'; '.join(told)}")
    about = "A line is an attempt."
    return write_curves(figure, trainings, _lines(name, way, told, about), out)


def _study(make: Callable[[str, str, Path], list[Path]], name: str, about: str) -> Study:
    return Study(
        name,
        about,
        partial(make, name, FULL),
        quick=partial(make, name, QUICK),
        kept=partial(make, name, KEPT),
    )


studies = (
    _study(make_figure, "figure-6.2", "GoToObject and GoToDropZone learned, 10 attempts"),
    _study(make_figure, "figure-6.3", "Avoid learned"),
    _study(make_figure, "figure-6.4", "GoToObject+Avoid and GoToDropZone+Avoid learned"),
    _study(make_figure, "figure-6.5", "Collect learned"),
    _study(make_table, "table-6.1", "hierarchy or monolith, curriculum or final task only"),
    _study(make_table, "table-6.2", "more resources for Avoid, or Avoid learned in context"),
    _study(make_table, "table-6.3", "power management, two variants on two Avoids"),
)
