"""Figures 7.5 and 7.6 of the thesis, and what several attempts at learning to count come to."""

from __future__ import annotations

import sys
from functools import partial
from pathlib import Path

from socialmind.catalogue import load_file, load_model, model_folder
from socialmind.studies import Study, write_figure

SEED = 75
"""Of the run that is shown, and of the worlds that attempts are scored in."""
TICKS = 6000
"""Of the run that is shown: two sequences or more."""
WORLDS = 100
FIGURES = model_folder("counter") / "figures.py"


def steps(name: str, out: Path) -> list[Path]:
    """Draw a sequence step by step, world and hierarchy side by side, and the variable over time.

    Args:
        name: of the study.
        out: the folder.
    """
    from socialmind.experiments import Run, paper, run
    from socialmind.experiments.page import Style
    from socialmind.experiments.rendering import draw_moments

    figures = load_file(FIGURES)
    folder = out / f"{name}-run"
    if not folder.is_dir():
        run(load_model("counter"), TICKS, SEED, out=folder)
    memory = figures.memory_of(Run(folder))
    shown = figures.sequences(memory)[0]
    ticks = [int(memory.tick[place]) for place in shown]
    style = Style(mind=True, trail=600)
    written = [draw_moments(folder, out / f"{name}{end}", ticks, style) for end in (".pdf", ".png")]
    rows = [
        {
            "step": number,
            "tick": int(memory.tick[place]),
            "variable": float(memory.value[place]),
            **{skill: float(values[place]) for skill, values in memory.influence.items()},
            "carrying": int(memory.carrying[place]),
            "delivered": int(memory.delivered[place]),
            "correct": int(memory.correct[place]),
        }
        for number, place in enumerate(shown, 1)
    ]
    with paper.style():
        drawn = figures.over_time(memory)
    return [*written, *write_figure(f"{name}-memory", drawn, rows, out)]


def attempts(quick: bool, out: Path) -> list[Path]:
    """Train all attempts, or go on with them, and say what their variables hold.

    Args:
        quick: whether small trainings will do.
        out: the folder, in which trainings are made.
    """
    from .representations import write_representations
    from .trainings import COLLECT, PLANS

    trainings = {}
    for name, plan in PLANS.items():
        one = COLLECT.small(plan) if quick else plan
        print(f"{name}: {one.about}; {one.attempts} attempts", file=sys.stderr, flush=True)
        home = out / ("small_trainings" if quick else "trainings")
        trainings[name] = COLLECT.train(name, home / name, one, on_lesson=COLLECT.told)
    return write_representations(trainings, 10 if quick else WORLDS, SEED, out)


studies = (
    Study("figure-7.5", "a robot that counts, step by step", partial(steps, "figure-7.5")),
    Study(
        "representations",
        "what the variables of several attempts at counting hold",
        partial(attempts, False),
        quick=partial(attempts, True),
    ),
)
