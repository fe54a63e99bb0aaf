"""What each lesson of the page was given: attempts, trainings, and ticks of a robot."""

from __future__ import annotations

import numpy as np
import pandas as pd

from socialmind.catalogue import load_file
from socialmind.learning import Training

from .societies import SOCIETIES, TRAINED, Size

CHOOSING = load_file(TRAINED / "choosing_again.py")
TRAININGS = load_file(TRAINED / "trainings.py")
FIRST = CHOOSING.choosing
IN_BODIES, CHOSEN = 60_000, "chosen_again"
"""Ticks of a world in which minds are chosen; the lesson whose minds are."""


def budgets(size: Size) -> pd.DataFrame:
    """Return what the lessons of societies were given, in thousand million ticks of a world.

    Args:
        size: of the study; attempts are those that it has.

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
        ticks, trainings, chosen = given(lesson)
        if one.name == "picked":
            ticks, trainings = ticks[:1], 1
        attempts = min(len(ticks), size.attempts or len(ticks))
        rows.append(
            {
                "society": one.name, "lesson": lesson, "attempts": attempts,
                "trainings": trainings, "least": ticks.min() / 1e9,
                "median": np.median(ticks) / 1e9, "greatest": ticks.max() / 1e9,
                "choosing": chosen / 1e9,
            }
        )  # fmt: skip
    return pd.DataFrame(rows)


def given(lesson: str) -> tuple[np.ndarray, int, float]:
    """Return the ticks of each attempt at a lesson, how many trainings, and ticks of choosing."""
    plans = FIRST.PLANS
    if lesson == CHOSEN:
        kept = Training(plans.kept / FIRST.TRAINED).lessons.groupby("attempt")["ticks"].sum()
        own = FIRST.trainings_of(FIRST.read())
        ticks = np.array([kept.loc[several].sum() for several in own.values()])
        return ticks, sum(map(len, own.values())), _ticks_of_choosing() / len(own)
    if lesson in plans:
        kept = Training(plans.kept / lesson).lessons.groupby("attempt")["ticks"].sum()
        return kept.to_numpy(), len(kept), 0.0
    attempts = len(TRAININGS.kept().get(lesson, [])) or 1
    return np.full(attempts, _ticks_of_plan()), attempts, 0.0


def _ticks_of_choosing() -> float:
    """The ticks of all worlds in which minds were chosen: each condition that was judged."""
    judged = (FIRST.read(), CHOOSING.read())
    conditions = sum(int(table[list(FIRST.CONDITIONS)].notna().sum().sum()) for table in judged)
    return conditions * float(FIRST.WORLDS) * IN_BODIES


def _ticks_of_plan() -> float:
    """The ticks of the model's own lesson, as it declares them, with its finals."""
    one = TRAININGS.LESSONS.lesson
    worlds = one.settings["population"] * one.repetitions * one.generations
    return float((worlds + one.finalists * one.finals) * TRAININGS.ECONOMY.Economy.ticks)
