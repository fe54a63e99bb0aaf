"""Figures 7.2 and 7.3 of the thesis, and functions of CollectVariable compared."""

from __future__ import annotations

from functools import partial
from pathlib import Path

from socialmind.experiments.studies import Study, Way

WORLDS = 100
QUICK_WORLDS = 10


def trajectory(name: str, number: int, out: Path) -> list[Path]:
    """Draw the ways of the trained robot until it has delivered as many objects as there are.

    Args:
        name: of the study.
        number: of objects in the arena.
        out: the folder.
    """
    from .trajectories import write_trajectory

    return write_trajectory(name, number, out)


def functions(way: Way, out: Path) -> list[Path]:
    """Measure the ways that CollectVariable learned to go with each function.

    Args:
        way: how its trainings are come by.
        out: the folder.
    """
    from .comparison import write_comparison
    from .trainings import PLANS

    trainings = {name: PLANS.training(name, way, out) for name in PLANS}
    return write_comparison(trainings, way, QUICK_WORLDS if way is Way.QUICK else WORLDS, out)


studies = (
    Study("figure-7.2", "one target variable, one object", partial(trajectory, "figure-7.2", 1)),
    Study("figure-7.3", "one target variable, three objects", partial(trajectory, "figure-7.3", 3)),
    Study.of_trainings(
        "target-functions", "functions that choose what a target variable holds", functions
    ),
)
