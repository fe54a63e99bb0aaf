"""Figures 7.5 and 7.6 of the thesis, and what several attempts at learning to count come to."""

from __future__ import annotations

from functools import partial
from pathlib import Path

from socialmind.studies import Study

SEED = 75
"""Of the worlds that attempts are scored in."""
WORLDS = 100


def steps(out: Path) -> list[Path]:
    """Draw a sequence step by step, world and hierarchy side by side, and the variable over time.

    Args:
        out: the folder.
    """
    from .steps import write_steps

    return write_steps(out)


def attempts(quick: bool, out: Path) -> list[Path]:
    """Train all attempts, or go on with them, and say what their variables hold.

    Args:
        quick: whether small trainings will do.
        out: the folder, in which trainings are made.
    """
    from .representations import write_representations
    from .trainings import COLLECT, PLANS

    return write_representations(
        COLLECT.made(PLANS, out, quick), 10 if quick else WORLDS, SEED, out
    )


studies = (
    Study("figure-7.5", "a robot that counts, step by step (7.5 and 7.6)", steps),
    Study(
        "representations",
        "what the variables of several attempts at counting hold",
        partial(attempts, False),
        quick=partial(attempts, True),
    ),
)
