"""Figures 7.5 and 7.6 of the thesis, and what several attempts at learning to count come to."""

from __future__ import annotations

from pathlib import Path

from socialmind.experiments.studies import Study, Way

WORLDS = 100
QUICK_WORLDS = 10


def steps(out: Path) -> list[Path]:
    """Draw a sequence step by step, world and hierarchy side by side, and the variable over time.

    Args:
        out: the folder.
    """
    from .steps import write_steps

    return write_steps(out)


def attempts(way: Way, out: Path) -> list[Path]:
    """Say what the variables of all attempts hold, and how well they count.

    Args:
        way: how their trainings are come by.
        out: the folder.
    """
    from .representations import write_representations
    from .trainings import PLANS

    trainings = {name: PLANS.training(name, way, out) for name in PLANS}
    return write_representations(trainings, way, QUICK_WORLDS if way is Way.QUICK else WORLDS, out)


studies = (
    Study("figure-7.5", "a robot that counts, step by step (7.5 and 7.6)", steps),
    Study.of_trainings(
        "representations", "what the variables of several attempts at counting hold", attempts
    ),
)
