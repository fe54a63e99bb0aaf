"""Figures 7.2 and 7.3 of the thesis, and functions of CollectVariable compared."""

from __future__ import annotations

from functools import partial
from pathlib import Path

from socialmind.studies import Study

SEED = 73
"""Of the worlds that attempts are scored in."""
WORLDS = 100


def trajectory(name: str, number: int, out: Path) -> list[Path]:
    """Draw the ways of the trained robot until it has delivered as many objects as there are.

    Args:
        name: of the study.
        number: of objects in the arena.
        out: the folder.
    """
    from .trajectories import write_trajectory

    return write_trajectory(name, number, out)


def functions(quick: bool, out: Path) -> list[Path]:
    """Train CollectVariable with each function, or go on with it, and measure the ways.

    Args:
        quick: whether small trainings will do.
        out: the folder, in which trainings are made.
    """
    from .comparison import write_comparison
    from .trainings import COLLECT, PLANS

    return write_comparison(COLLECT.made(PLANS, out, quick), 10 if quick else WORLDS, SEED, out)


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
