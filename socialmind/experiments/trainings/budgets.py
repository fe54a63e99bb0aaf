"""What kept trainings took: attempts, lessons and ticks, in words."""

from __future__ import annotations

from pathlib import Path

from socialmind.learning import Training

MILLION = 1e6


def budget_of(folder: Path) -> str:
    """Return what a kept training was given, as an overview tells it.

    Args:
        folder: of the training.

    Returns:
        Its attempts, lessons, and ticks of an attempt, on the median where they differ.
    """
    lessons = Training(folder).lessons
    each = lessons.groupby("attempt")["ticks"].sum() / MILLION
    names = lessons["lesson"].nunique()
    taught = "a lesson" if names == 1 else f"{names} lessons"
    middle = " on the median" if each.nunique() > 1 else ""
    of = "an attempt" if len(each) == 1 else f"{len(each)} attempts"
    return f"{of}, {taught}, {each.median():,.0f} million ticks an attempt{middle}"
