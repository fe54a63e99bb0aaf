"""Programmed against learned specialisation: the comparison, as one page."""

from __future__ import annotations

from functools import partial
from pathlib import Path

from socialmind.experiments.studies import Study

NAME = "specialisation"


def compare(out: Path, quick: bool = False) -> list[Path]:
    """Run all societies, and write the page, its figures and its tables.

    Args:
        out: the folder.
        quick: whether few and short worlds will do.
    """
    from .making import make
    from .societies import FULL, QUICK

    command = f"socialmind reproduce {NAME}{' --quick' if quick else ''}"
    return make(out, QUICK if quick else FULL, command)


studies = (
    Study(
        NAME, "programmed against learned roles, mixed societies, farmers who were taught", compare,
        quick=partial(compare, quick=True),
    ),
)  # fmt: skip
