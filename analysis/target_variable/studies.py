"""Figures 7.2 and 7.3 of the thesis, and functions of CollectVariable compared."""

from __future__ import annotations

import sys
from functools import partial
from pathlib import Path

from socialmind.catalogue import load_file, load_model, model_folder
from socialmind.studies import Study, write_figure

SEED = 73
"""Of the runs that are shown, and of the worlds that attempts are scored in."""
WORLDS = 100
SHOWN = 6000
"""Ticks of a run that is shown at most: it ends with the last object of as many as there are."""


def trajectory(name: str, number: int, out: Path) -> list[Path]:
    """Draw the way of the trained robot until it has delivered as many objects as there are.

    Args:
        name: of the study.
        number: of objects in the arena.
        out: the folder.
    """
    from socialmind.experiments import Run, paper, run

    figures = load_file(model_folder("target_variable") / "figures.py")
    model = load_model("target_variable")
    society = model(seed=SEED, number=number)
    robot = society.tables["robots"][0]
    while society.over is None and society.tick < SHOWN and robot.delivered < number:
        society.advance(1)
    folder = out / f"{name}-run"
    if not folder.is_dir():
        run(model, society.tick, SEED, parameters={"number": number}, out=folder)
    course = figures.course_of(Run(folder))
    rows = [
        {"tick": int(tick), "x": round(float(x), 3), "y": round(float(y), 3), "carrying": int(held)}
        for tick, x, y, held in zip(course.tick, course.x, course.y, course.carrying, strict=True)
    ]
    with paper.style():
        drawn = figures.path(course)
    return write_figure(name, drawn, rows, out)


def functions(quick: bool, out: Path) -> list[Path]:
    """Train CollectVariable with each function, or go on with it, and measure the ways.

    Args:
        quick: whether small trainings will do.
        out: the folder, in which trainings are made.
    """
    from .comparison import write_comparison
    from .trainings import COLLECT, PLANS

    trainings = {}
    for name, plan in PLANS.items():
        one = COLLECT.small(plan) if quick else plan
        print(f"{name}: {one.about}; {one.attempts} attempts", file=sys.stderr, flush=True)
        home = out / ("small_trainings" if quick else "trainings")
        trainings[name] = COLLECT.train(name, home / name, one, on_lesson=COLLECT.told)
    return write_comparison(trainings, 10 if quick else WORLDS, SEED, out)


studies = (
    Study("figure-7.2", "one target variable, one object", partial(trajectory, "figure-7.2", 1)),
    Study("figure-7.3", "one target variable, three objects", partial(trajectory, "figure-7.3", 3)),
    Study(
        "target-functions",
        "functions that choose what a target variable holds",
        partial(functions, False),
        quick=partial(functions, True),
    ),
)
