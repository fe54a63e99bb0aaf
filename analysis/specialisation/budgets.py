"""What each lesson of the page was given: attempts, trainings, and ticks of worlds."""

from __future__ import annotations

import numpy as np
import pandas as pd

from socialmind.catalogue import load_file
from socialmind.learning import Training

from .societies import SOCIETIES, TRAINED, Size

CHOOSING = load_file(TRAINED / "choosing_again.py")
MINDS = load_file(TRAINED / "minds.py")
TRAININGS = load_file(TRAINED / "trainings.py")
FIRST = CHOOSING.choosing


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
