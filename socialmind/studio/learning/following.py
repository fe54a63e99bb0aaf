"""A training followed while it goes on: its folder is read, and of it only what has changed."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from socialmind.learning.training import archive
from socialmind.learning.training.attempt import (
    CHECKPOINT,
    load_checkpoint,
    load_result,
    result_file,
)
from socialmind.learning.training.capsule import TrainingCapsule
from socialmind.learning.training.curve import checked_rows
from socialmind.learning.training.finalists import individual_of
from socialmind.learning.training.teaching import COLUMNS, VALIDATED
from socialmind.studio.learning.listing import lessons_in, summary
from socialmind.studio.learning.time_left import RECENT, Done, generations_of, seconds_left

SHOWN = ("generation", "best", "mean", "best_so_far", VALIDATED)
"""The columns of the curve that a page is told."""
_PLACE = {name: place for place, name in enumerate((*COLUMNS, VALIDATED))}


@dataclass(frozen=True, eq=False)
class _Taught:
    """A lesson of an attempt: its curve so far, and what came of it if it is finished."""

    lesson: str
    cycle: int
    rows: NDArray[np.float64]
    result: dict[str, Any] | None = None


@dataclass
class _Seen:
    """What was last read of an attempt."""

    stamp: tuple[int, int] = (0, 0)
    finished: list[_Taught] = field(default_factory=list)
    in_hand: _Taught | None = None

    @property
    def taught(self) -> list[_Taught]:
        """Its lessons in the order in which they were taught."""
        return self.finished + ([] if self.in_hand is None else [self.in_hand])


class Follower:
    """Follows one training by looking into its folder now and then.

    Files that have not changed since are not read again; a lesson's file never changes.

    Args:
        folder: the training's.
    """

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self._seen: dict[int, _Seen] = {}

    def told(self, known: Sequence[int] = ()) -> dict[str, Any]:
        """Return how the training stands.

        Args:
            known: how many rows of the curve are known already, attempt by attempt; an attempt
                only gains rows, so those behind them are told.

        Returns:
            The `summary`, the lessons, what goes on now, the time left, the curve's new rows and
            the results of finished lessons.

        Raises:
            SocialmindError: a file of the folder is broken.
        """
        said = summary(self.folder)
        if said["status"] == "broken":
            return said
        capsule = TrainingCapsule(self.folder)
        items = capsule.manifest.lessons
        lessons = lessons_in(items)
        for number in range(1, capsule.manifest.attempts + 1):
            self._look(number, capsule.attempt(number))
        done = [
            Done(number, one.lesson, one.cycle, one.result is not None, _seconds(one))
            for number, seen in sorted(self._seen.items())
            for one in seen.taught
        ]
        going = said["status"] == "running"
        said["lessons"] = [
            {
                "name": one["name"],
                "skills": one["skills"],
                "master": one["master"],
                "optimiser": one["optimiser"],
                "generations": generations_of(one),
            }
            for one in lessons
        ]
        said["now"] = self._now({one["name"]: generations_of(one) for one in lessons})
        left = seconds_left(items, capsule.manifest.attempts, done)
        said["left"] = None if said["status"] == "finished" else left
        said["ticks_a_second"] = self._pace() if going else None
        said["curve"] = self._new_rows(known)
        said["results"] = [
            {"attempt": number, "lesson": one.lesson, "cycle": one.cycle, **one.result}
            for number, seen in sorted(self._seen.items())
            for one in seen.finished
            if one.result is not None
        ]
        return said

    def _look(self, number: int, folder: Path) -> None:
        """Read of an attempt what has changed."""
        try:
            now = (folder / CHECKPOINT).stat()
        except FileNotFoundError:
            self._seen.pop(number, None)
            return
        stamp = (now.st_mtime_ns, now.st_size)
        seen = self._seen.setdefault(number, _Seen())
        if seen.stamp == stamp:
            return
        record, arrays = load_checkpoint(folder)
        del seen.finished[record["done"] :]
        for place in range(len(seen.finished) + 1, record["done"] + 1):
            seen.finished.append(_finished(folder, place))
        seen.in_hand = None
        if record["in_hand"] is not None:
            with archive.reading(folder / CHECKPOINT):
                rows = checked_rows(arrays["teaching/rows"])
                cycle = int(record["position"][1])
            seen.in_hand = _Taught(record["in_hand"], cycle, rows)
        seen.stamp = stamp

    def _now(self, generations: dict[str, int]) -> dict[str, Any] | None:
        """Return what is taught now, or was last: the lesson in hand of the last attempt."""
        for number, seen in sorted(self._seen.items(), reverse=True):
            one = seen.in_hand
            if one is None or not len(one.rows):
                continue
            return {
                "attempt": number,
                "lesson": one.lesson,
                "cycle": one.cycle,
                "generation": len(one.rows),
                "of": generations.get(one.lesson),
                "best": _number(one.rows[-1, _PLACE["best"]]),
                "mean": _number(one.rows[-1, _PLACE["mean"]]),
                "best_so_far": _number(one.rows[-1, _PLACE["best_so_far"]]),
            }
        return None

    def _pace(self) -> float | None:
        """Return the ticks a second of the last generations of the lesson in hand."""
        for _, seen in sorted(self._seen.items(), reverse=True):
            one = seen.in_hand
            if one is None or len(one.rows) < 2:
                continue
            last = one.rows[-RECENT - 1 :]
            ticks = last[-1, _PLACE["ticks"]] - last[0, _PLACE["ticks"]]
            return _number(ticks / max(last[1:, _PLACE["seconds"]].sum(), 1e-9))
        return None

    def _new_rows(self, known: Sequence[int]) -> list[dict[str, Any]]:
        """Return the rows that are not known, lesson by lesson, as columns."""
        parts = []
        for number, seen in sorted(self._seen.items()):
            skip = known[number - 1] if number <= len(known) else 0
            for one in seen.taught:
                rows = one.rows[min(skip, len(one.rows)) :]
                skip = max(0, skip - len(one.rows))
                if not len(rows):
                    continue
                columns = {
                    name: [_number(value) for value in rows[:, _PLACE[name]].tolist()]
                    for name in SHOWN
                    if _PLACE[name] < rows.shape[1]
                }
                parts.append(
                    {"attempt": number, "lesson": one.lesson, "cycle": one.cycle, **columns}
                )
        return parts


def _finished(folder: Path, place: int) -> _Taught:
    """Read what came of a lesson."""
    record, arrays = load_result(folder, place)
    with archive.reading(result_file(folder, place)):
        winner = individual_of(archive.part(arrays, "winner/"))
        result = {
            "score": _number(record["score"]),
            "deviation": _number(record["deviation"]),
            "generation": winner.generation,
            "ticks": record["ticks"],
        }
        return _Taught(record["lesson"], record["cycle"], checked_rows(arrays["rows"]), result)


def _seconds(one: _Taught) -> list[float]:
    return [] if not len(one.rows) else list(one.rows[:, _PLACE["seconds"]].tolist())


def _number(value: float) -> float | None:
    """Return a number as pages draw it: seven digits, None for one that is not finite."""
    return float(f"{value:.7g}") if math.isfinite(value) else None
