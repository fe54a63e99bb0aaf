"""How long a training will take, from its folder alone: from how long its last generations took.

`socialmind.learning.training.forecast` knows more: it has loaded the lessons' worlds.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import Any, NamedTuple

RECENT = 20
"""Generations that the pace is taken from."""


class Done(NamedTuple):
    """What an attempt has done of a lesson.

    Attributes:
        attempt: its number, from 1.
        lesson: the lesson's name.
        cycle: which time around it is taught, from 1.
        over: whether it is finished.
        seconds: that each generation took.
    """

    attempt: int
    lesson: str
    cycle: int
    over: bool
    seconds: Sequence[float]


def generations_of(lesson: Mapping[str, Any]) -> int:
    """Return how many generations a lesson has at most, as a manifest describes it."""
    return int(lesson["generations"]) * int(lesson.get("starts", 1))


def seconds_left(
    items: Iterable[Mapping[str, Any]], attempts: int, done: Sequence[Done]
) -> float | None:
    """Return an estimate of the seconds left; None for a training without end or pace.

    Args:
        items: the lessons and cycles of the curriculum, as the manifest has them.
        attempts: how many attempts there are to be.
        done: what is done.

    >>> lesson = {"name": "Go", "generations": 10}
    >>> seconds_left([lesson], 2, [Done(1, "Go", 1, False, [2.0, 2.0, 2.0, 2.0])])
    32.0
    """
    pace = _pace(done)
    known = {(one.attempt, one.lesson, one.cycle): one for one in done}
    left = 0.0
    for item in items:
        rounds = item.get("cycles", 1)
        if rounds is None or not pace:
            return None
        for lesson in item.get("lessons", [item]):
            each = pace.get(lesson["name"], sum(pace.values()) / len(pace))
            for attempt in range(1, attempts + 1):
                for cycle in range(1, rounds + 1):
                    one = known.get((attempt, lesson["name"], cycle))
                    if one is None or not one.over:
                        behind = 0 if one is None else len(one.seconds)
                        left += each * max(0, generations_of(lesson) - behind)
    return left


def _pace(done: Iterable[Done]) -> dict[str, float]:
    """Return the seconds that a generation of each lesson took of late."""
    taken: dict[str, list[float]] = {}
    for one in done:
        # The first holds the compilation.
        taken.setdefault(one.lesson, []).extend(one.seconds[1:] or one.seconds)
    return {name: sum(some[-RECENT:]) / len(some[-RECENT:]) for name, some in taken.items() if some}
