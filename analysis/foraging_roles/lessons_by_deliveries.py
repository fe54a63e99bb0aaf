"""What the attempts at roles by deliveries come to in the economy without bodies.

python -m analysis.foraging_roles.lessons_by_deliveries [--quick]

A row of `results/lessons_by_deliveries.csv` is an attempt at a lesson under a condition: the share
of worlds that stay within one robot of the wanted split, by what robots bring home, all through the
last quarter.
"""

from __future__ import annotations

import sys
from collections.abc import Sequence
from pathlib import Path

import pandas as pd

from .contestants import Contestant
from .economy_worlds import worlds_of
from .large_groups import run_out
from .minds import minds_of
from .results import IN_THE_ECONOMY
from .worlds import REPORTED_ECONOMY

OUT = Path(__file__).parent / "results" / "lessons_by_deliveries.csv"
LESSONS = ("delivered_narrow", "delivered_role", "at_once")
TICKS, SHORT = 60_000, 8_000
FEW = 2


def within_one(one: Contestant, condition: str, worlds: Sequence[int], ticks: int = TICKS) -> float:
    """Return the share of worlds that stay within one robot of the wanted split.

    Args:
        one: the robots.
        condition: what happens to them.
        worlds: their seeds.
        ticks: of a run.
    """
    found, minds = worlds_of(one, IN_THE_ECONOMY[condition], worlds, ticks)
    run_out(found, minds)
    return float((found.out_last == 0).mean())


def judged(worlds: Sequence[int], ticks: int = TICKS) -> pd.DataFrame:
    """Return what every attempt that is kept comes to, a row for each condition."""
    return pd.DataFrame(
        {
            "lesson": lesson,
            "attempt": attempt,
            "condition": condition,
            "worlds": len(worlds),
            "within_one": within_one(Contestant(lesson, attempt, mind), condition, worlds, ticks),
        }
        for lesson in LESSONS
        for attempt, mind in minds_of(lesson).items()
        for condition in IN_THE_ECONOMY
    )


def main(arguments: Sequence[str]) -> None:
    """Judge all, keep and print what comes of it."""
    quick = "--quick" in arguments
    found = judged(REPORTED_ECONOMY[:FEW], SHORT) if quick else judged(REPORTED_ECONOMY)
    if not quick:
        found.to_csv(OUT, index=False, float_format="%.6g", lineterminator="\n")
    table = found.pivot(index=["lesson", "attempt"], columns="condition", values="within_one")
    print(table[list(IN_THE_ECONOMY)].round(2).to_string())


if __name__ == "__main__":
    main(sys.argv[1:])
