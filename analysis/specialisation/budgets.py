"""What each lesson of the page was given, and paid for: trainings, ticks of worlds, its loss."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
import pandas as pd

from socialmind.catalogue import load_file
from socialmind.learning import Training

from .societies import SOCIETIES, TRAINED, Size

CHOOSING = load_file(TRAINED / "choosing_again.py")
MINDS = load_file(TRAINED / "minds.py")
TRAININGS = load_file(TRAINED / "trainings.py")
FIRST = CHOOSING.choosing
TERMS: Mapping[str, str] = {
    "off": "being away from the wanted split, all robots all the time",
    "off_late": "the same when there was time to settle",
    "out_late": "being more than one robot away then",
    "unsettled": "ever being so in the last quarter",
    "change": "a change of role for each robot and 10,000 ticks, then",
    "turns": "a change of what a robot brings, at any time",
    "counts": "the counts’ share of B being away from the wanted one",
    "missing": "objects not brought home, all of them",
}
"""What a loss is made of, in words."""


def budgets(size: Size) -> pd.DataFrame:
    """Return what the lessons of societies were given, in thousand million ticks of a world.

    Args:
        size: of the study: of how many attempts, the first ones, is told.

    Returns:
        A row for each society that learned: `lesson`, `attempts`, `trainings` (more than attempts
        where some began anew), the least, the median and the greatest `ticks` of an attempt,
        all its trainings and starts together, and `choosing`, those in bodies in which its
        mind was chosen, on the mean.
    """
    rows = []
    for one in SOCIETIES.values():
        lesson = "learned" if one.name == "picked" else one.lesson
        if not lesson:
            continue
        own, chosen = given(lesson)
        own = own[: 1 if one.name == "picked" else size.attempts]
        ticks = np.array([sum(one) for one in own])
        rows.append(
            {
                "society": one.name,
                "lesson": FIRST.TRAINED if lesson == CHOOSING.NAME else lesson,
                "attempts": len(own),
                "trainings": sum(map(len, own)), "least": ticks.min() / 1e9,
                "median": np.median(ticks) / 1e9, "greatest": ticks.max() / 1e9,
                "choosing": chosen / 1e9,
            }
        )  # fmt: skip
    return pd.DataFrame(rows)


def given(lesson: str) -> tuple[list[list[float]], float]:
    """Return the ticks of each attempt's trainings, and those in which its mind was chosen."""
    plans = FIRST.PLANS
    if lesson == CHOOSING.NAME:
        kept = _ticks(FIRST.TRAINED)
        own = FIRST.trainings_of(FIRST.read()).values()
        return [[kept[one] for one in several] for several in own], _ticks_of_choosing() / len(own)
    if lesson in plans:
        return [[one] for one in _ticks(lesson).values()], 0.0
    several = len(MINDS.attempts_at(lesson)) if lesson != "learned" else 1
    return [[_ticks_of_plan()]] * several, 0.0


def _ticks(trained: str) -> dict[int, float]:
    """The ticks of each kept training of a plan, by its number."""
    lessons = Training(FIRST.PLANS.kept / trained).lessons
    return {int(number): float(part["ticks"].sum()) for number, part in lessons.groupby("attempt")}


def _ticks_of_choosing() -> float:
    """The ticks of all worlds in which minds were chosen: each condition that was judged."""
    judged = (FIRST.read(), CHOOSING.read())
    conditions = sum(int(table[list(FIRST.CONDITIONS)].notna().sum().sum()) for table in judged)
    return conditions * float(FIRST.WORLDS) * FIRST.TICKS


def _ticks_of_plan() -> float:
    """The ticks of the model's own lesson, as it declares them, with its finals."""
    one = TRAININGS.LESSONS.lesson
    worlds = one.settings["population"] * one.repetitions * one.generations
    return float((worlds + one.finalists * one.finals) * TRAININGS.ECONOMY.Economy.ticks)


def losses() -> pd.DataFrame:
    """Return what costs a lesson how much, a row for each term of a loss and a column a society.

    Of a lesson with several parts it is the last one's, which its mind comes from.
    """
    found: dict[str, dict[str, float]] = {}
    for one in SOCIETIES.values():
        if not one.lesson:
            continue
        own = {**vars(TRAININGS.ECONOMY.Terms()), **_terms(one.lesson)}
        found[one.name] = {term: float(own.get(term, 0.0)) for term in TERMS}
    return pd.DataFrame(found)


def _terms(lesson: str) -> Mapping[str, Any]:
    """The terms in which a lesson differs from the model's own."""
    trained = FIRST.TRAINED if lesson == CHOOSING.NAME else lesson
    if trained in FIRST.PLANS:
        *_, last = FIRST.PLANS[trained].curriculum().lessons
        judged_by_deliveries = "Delivery" in last.environment.__name__
        return {"missing": 1.0 if judged_by_deliveries else 0.0, **last.parameters}
    return dict(TRAININGS.PLANS[lesson].terms) if lesson in TRAININGS.PLANS else {}
