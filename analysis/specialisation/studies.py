"""Programmed against learned specialisation: the comparison, as one page."""

from __future__ import annotations

from pathlib import Path

from socialmind.experiments.studies import Study, Way

NAME = "specialisation"


def compare(way: Way, out: Path) -> list[Path]:
    """Write the page, its figures and its tables.

    Args:
        way: whether all worlds are run for it, few and short ones, or none, and those are shown of
            which tables are kept.
        out: the folder.
    """
    from .making import make, make_of_kept
    from .societies import FULL, QUICK

    command = f"socialmind reproduce {NAME}{way}"
    if way is Way.KEPT:
        return make_of_kept(out, command)
    return make(out, QUICK if way is Way.QUICK else FULL, command)


studies = (
    Study.of_trainings(
        NAME, "programmed against learned roles, mixed societies, farmers who were taught", compare
    ),
)
