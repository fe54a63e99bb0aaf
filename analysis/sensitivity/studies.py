"""What the farmer-artisan society depends on: a screening, and shares of the variance."""

from __future__ import annotations

from functools import partial
from pathlib import Path

from socialmind.experiments.studies import Study

NAME = "sensitivity"


def make(out: Path, quick: bool = False) -> list[Path]:
    """Sweep the society, and write tables and figures.

    Args:
        out: the folder.
        quick: whether few and short runs will do.
    """
    from .study import make as made

    return made(out, quick)


def redraw(out: Path) -> list[Path]:
    """Draw the figures from the kept tables; the argument is as above."""
    from .study import redrawn

    return redrawn(out)


studies = (
    Study(
        NAME, "which parameters of the farmer-artisan society count: Morris, then Sobol", make,
        quick=partial(make, quick=True), kept=redraw,
    ),
)  # fmt: skip
