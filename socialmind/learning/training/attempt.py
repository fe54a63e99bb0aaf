"""One attempt at a curriculum: its lessons in order, safe on disk after every generation.

Its files lie in a folder of its own:

- `checkpoint.npz`: the lesson in hand at its last generation, the weights learned so far, and how
  many lessons are done;
- `lesson-001.npz` …: what came of each lesson that is done.

A file of a lesson counts once the checkpoint says so.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from socialmind.learning.episodes.evaluators import Evaluators
from socialmind.learning.lessons.curriculum import Position
from socialmind.learning.lessons.lesson import Lesson
from socialmind.learning.training import archive
from socialmind.learning.training.course import TrainingCourse
from socialmind.learning.training.finalists import arrays_of
from socialmind.learning.training.teaching import Result, Teaching
from socialmind.mind.functions.neat.graph import NeatGraph
from socialmind.runs import record as kinds
from socialmind.runs.arrays_file import save_arrays
from socialmind.work.workers import Stop

CHECKPOINT = "checkpoint.npz"


@dataclass(frozen=True)
class News:
    """What a generation came to.

    Attributes:
        attempt: its number, from 1.
        lesson: the lesson.
        position: where it stands in the curriculum.
        generation: how many of its generations are done.
        best, mean: of the generation's scores.
        ticks: of the generation.
        seconds: that it took.
        population: how many individuals it had.
    """

    attempt: int
    lesson: Lesson
    position: Position
    generation: int
    best: float
    mean: float
    ticks: int
    seconds: float
    population: int


class Attempt:
    """An attempt, as its folder has it.

    Args:
        folder: of the attempt; made by the first checkpoint.
        number: of the attempt, from 1; its draws hang on it.
        course: what is learned.

    Attributes:
        position: where in the curriculum it is; None behind the end.

    Raises:
        SocialmindError: its files are not whole.
    """

    def __init__(self, folder: Path, number: int, course: TrainingCourse) -> None:
        self.folder = folder
        self.number = number
        self.course = course
        self.mind = course.mind
        self.done = 0
        self.seconds = 0.0
        self._item_ticks = 0
        self.position: Position | None = Position()
        self._teaching: Teaching | None = None
        if (folder / CHECKPOINT).exists():
            with archive.reading(folder / CHECKPOINT):
                self._restore()

    @property
    def finished(self) -> bool:
        """Whether all lessons are done."""
        return self.position is None

    @property
    def teaching(self) -> Teaching | None:
        """The lesson in hand, as its last generation left it; None between two lessons."""
        return self._teaching

    @property
    def generation(self) -> int:
        """How many generations of the lesson in hand are done."""
        return 0 if self._teaching is None else self._teaching.generation

    def go(
        self,
        evaluators: Evaluators,
        stop: Stop,
        on_generation: Callable[[News], None],
        on_lesson: Callable[[Attempt, Lesson, Result], None],
    ) -> None:
        """Go on to the end of the curriculum.

        Args:
            evaluators: who evaluate.
            stop: asked now and then whether to drop what is in hand.
            on_generation: called after each generation, when it is safe on disk.
            on_lesson: called after each lesson, likewise.

        Raises:
            Stopped: `stop` said so; the last checkpoint stands.
        """
        while self.position is not None:
            begun = time.perf_counter()
            if self._teaching is None:
                self._teaching = self._taught(self.position)
            teaching, position = self._teaching, self.position
            while not (teaching.over or self._cycle_over):
                teaching.advance(evaluators, stop)
                self.seconds += max(0.0, time.perf_counter() - begun)
                begun = time.perf_counter()
                self._checkpoint()
                on_generation(self._news(teaching, position))
            result = teaching.result(evaluators, stop)
            self.seconds += max(0.0, time.perf_counter() - begun)
            self._conclude(teaching, result)
            on_lesson(self, teaching.lesson, result)

    @property
    def _cycle_over(self) -> bool:
        """Whether the budget of the cycle in hand is used up."""
        cycle = None if self.position is None else self.course.curriculum.cycle_at(self.position)
        if cycle is None or cycle.budget is None or self.generation == 0:
            return False
        in_hand = 0 if self._teaching is None else self._teaching.ticks
        return self._item_ticks + in_hand >= cycle.budget

    def _taught(self, position: Position, resumed: bool = False) -> Teaching:
        lesson = self.course.curriculum.at(position)
        key = (self.course.seed, self.number, lesson.name, position.cycle)
        return Teaching(lesson, self.mind, key, self.course.engine, resumed)

    def _conclude(self, teaching: Teaching, result: Result) -> None:
        """Freeze what a lesson has given, and turn to the next one."""
        self.mind = self.mind.with_modules(skills=teaching.learned(result.winner))
        position = self.position or Position()
        write_result(self.folder, self.done + 1, teaching.lesson, position, result)
        self.done += 1
        self._item_ticks += result.ticks
        self._teaching = None
        self._turn_from(position)
        self._checkpoint(position)

    def _turn_from(self, position: Position) -> None:
        """Turn to the lesson behind a position."""
        cycle = self.course.curriculum.cycle_at(position)
        over = cycle is not None and cycle.budget is not None and self._item_ticks >= cycle.budget
        self.position = self.course.curriculum.next(position, over)
        if self.position is not None and self.position.item != position.item:
            self._item_ticks = 0

    def _checkpoint(self, last: Position | None = None) -> None:
        """Make all that is done safe.

        Args:
            last: the position of the lesson that has just been concluded.
        """
        changed = {
            name: skill
            for name, skill in self.mind.skills.items()
            if skill is not self.course.mind.skills[name]
        }
        graphs = {
            name: skill.function.to_lines()
            for name, skill in changed.items()
            if isinstance(skill.function, NeatGraph)
        }
        record = {
            "position": self.position,
            "last": last,
            "done": self.done,
            "item_ticks": self._item_ticks,
            "seconds": self.seconds,
            "in_hand": None if self._teaching is None else self._teaching.lesson.name,
            "graphs": graphs,
        }
        arrays: dict[str, Any] = {f"learned/{name}": one.genome for name, one in changed.items()}
        if self._teaching is not None:
            arrays |= archive.under("teaching/", self._teaching.state())
        self.folder.mkdir(parents=True, exist_ok=True)
        save_arrays(self.folder / CHECKPOINT, record, arrays)

    def _restore(self) -> None:
        record, arrays = load_checkpoint(self.folder)
        skills = []
        for name, genome in archive.part(arrays, "learned/").items():
            skill = self.mind.skill(name)
            function = skill.function
            if name in record["graphs"]:
                function = NeatGraph.from_lines(record["graphs"][name])
            skills.append(skill.changed(function=function, genome=genome))
        self.mind = self.mind.with_modules(skills=skills)
        self.done = record["done"]
        self.seconds = record["seconds"]
        self._item_ticks = record["item_ticks"]
        if record["position"] is not None:
            self.position = Position(*record["position"])
        else:
            # A cycle may go round again, and lessons follow, since the attempt was finished.
            self._turn_from(Position(*record["last"]))
        if record["in_hand"] and self.position is not None:
            self._teaching = self._taught(self.position, resumed=True)
            self._teaching.restore(archive.part(arrays, "teaching/"))

    def _news(self, teaching: Teaching, position: Position) -> News:
        before = teaching.rows[-2][5] if len(teaching.rows) > 1 else 0.0
        _, best, mean, _, _, ticks, seconds, *_ = teaching.rows[-1]
        population = teaching.optimiser.population
        return News(
            self.number, teaching.lesson, position, teaching.generation, best, mean,
            int(ticks - before), seconds, population,
        )  # fmt: skip


def _at(value: Any) -> bool:
    length = len(Position._fields)
    return isinstance(value, list) and len(value) == length and all(map(kinds.whole().holds, value))


_POSITION = kinds.optional(kinds.Kind("a position in the curriculum", _at))
_CHECKPOINT = kinds.Fields(
    {
        "position": _POSITION,
        "done": kinds.whole(0, 10**6),
        "item_ticks": kinds.whole(),
        "seconds": kinds.NUMBER,
        "in_hand": kinds.optional(kinds.TEXT),
        "graphs": kinds.Each(kinds.Many(kinds.TEXT)),
    },
    {"last": _POSITION},
)
_RESULT = kinds.Fields(
    {
        "lesson": kinds.TEXT,
        "cycle": kinds.whole(),
        "skills": kinds.Many(kinds.TEXT),
        "ticks": kinds.whole(),
    }
)


def load_checkpoint(folder: Path) -> tuple[dict[str, Any], dict[str, Any]]:
    """Return the record and the arrays that an attempt goes on from.

    Raises:
        SocialmindError: the file is not what a training wrote.
    """
    return archive.load(folder / CHECKPOINT, _CHECKPOINT)


def is_through(record: Mapping[str, Any], lessons: Sequence[Mapping[str, Any]]) -> bool:
    """Return whether the attempt of a checkpoint's record is behind the last of its lessons.

    Args:
        record: of `load_checkpoint`.
        lessons: those that its manifest tells of its training, a cycle as one; some, or rounds of a
            cycle at the end, may have been added since.
    """
    last = record.get("last")
    if record["position"] is not None or last is None:
        return record["position"] is None
    item, cycle, _ = last
    rounds, budget = (lessons[item].get(what) for what in ("cycles", "budget"))
    over = budget is not None and record["item_ticks"] >= budget
    return item + 1 >= len(lessons) and (rounds is None or cycle >= rounds or over)


def load_result(folder: Path, number: int) -> tuple[dict[str, Any], dict[str, Any]]:
    """Return what came of an attempt's lesson, counted from 1.

    Raises:
        SocialmindError: the file is not what a training wrote.
    """
    return archive.load(result_file(folder, number), _RESULT)


def results_of(
    folder: Path, done: int | None = None
) -> Iterator[tuple[Path, dict[str, Any], dict[str, Any]]]:
    """Yield the file, the record and the arrays of each lesson that an attempt has finished.

    Args:
        folder: of the attempt.
        done: how many it had finished; as many as its checkpoint says by default.

    Raises:
        SocialmindError: a file is not what a training wrote.
    """
    if done is None:
        known = (folder / CHECKPOINT).is_file()
        done = load_checkpoint(folder)[0]["done"] if known else 0
    for number in range(1, done + 1):
        yield result_file(folder, number), *load_result(folder, number)


def write_result(
    folder: Path, number: int, lesson: Lesson, position: Position, result: Result
) -> None:
    """Write what came of a lesson.

    Args:
        folder: of the attempt.
        number: which lesson of the attempt it was, from 1.
        lesson: the lesson.
        position: where it stands in the curriculum.
        result: what came of it.
    """
    record = {
        "lesson": lesson.name,
        "cycle": position.cycle,
        "skills": lesson.skills,
        "score": result.score,
        "deviation": result.deviation,
        "finalists": result.finalists,
        "ticks": result.ticks,
    }
    arrays: Mapping[str, Any] = {
        "rows": result.rows,
        **archive.under("winner/", arrays_of(result.winner)),
        **archive.under("best/", arrays_of(result.best)),
    }
    folder.mkdir(parents=True, exist_ok=True)
    save_arrays(result_file(folder, number), record, arrays)


def result_file(folder: Path, number: int) -> Path:
    """Return the file of what came of an attempt's lesson, counted from 1."""
    return folder / f"lesson-{number:03d}.npz"
