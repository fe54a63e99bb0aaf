"""How long a training will take: from how long its last generations took."""

from __future__ import annotations

from collections import deque
from collections.abc import Mapping

from socialmind.learning.lessons.curriculum import Position
from socialmind.learning.lessons.lesson import Lesson
from socialmind.learning.training.attempt import News
from socialmind.learning.training.course import TrainingCourse

RECENT = 20
"""Generations that the pace is taken from."""


class Forecast:
    """The time left of a training.

    What is ahead is counted in the ticks that it would take if every episode went on to its end.

    Args:
        course: what is learned.
        attempts: how many attempts there are.
        begun: where those stand that were begun before, by their numbers; None behind the end.
    """

    def __init__(
        self,
        course: TrainingCourse,
        attempts: int,
        begun: Mapping[int, Position | None] | None = None,
    ) -> None:
        self._course = course
        self._attempts = attempts
        self._begun = begun or {}
        self._populations = {one.name: population_of(one, course) for one in self._lessons()}
        self._recent: deque[tuple[str, int, float]] = deque(maxlen=RECENT)
        self._first = True

    def _lessons(self) -> tuple[Lesson, ...]:
        return self._course.curriculum.lessons

    def seconds_left(self, news: News) -> float | None:
        """Return an estimate of the seconds left; None for a training without end.

        Args:
            news: of the last generation.
        """
        lesson = news.lesson
        if self._recent and self._recent[-1][0] != lesson.name:
            self._recent.clear()
            self._first = True
        elif self._recent and self._first:
            # A lesson's first generation here holds the compilation.
            self._recent.clear()
            self._first = False
        self._recent.append((lesson.name, self._generation_ticks(lesson), news.seconds))
        paced = sum(ticks for _, ticks, _ in self._recent)
        later = [
            self._ahead(self._begun.get(one, Position()))
            for one in range(news.attempt + 1, self._attempts + 1)
        ]
        ahead = [one for one in (self._ahead(news.position), *later) if one is not None]
        if not paced or len(ahead) <= len(later):
            return None
        left = sum(ahead) - news.generation * self._generation_ticks(lesson)
        return max(left, 0) * sum(seconds for _, _, seconds in self._recent) / paced

    def _ahead(self, position: Position | None) -> int | None:
        """Return the ticks from a position to the end of an attempt; None for without end."""
        total = 0
        at = position
        curriculum = self._course.curriculum
        while at is not None:
            cycle = curriculum.cycle_at(at)
            if cycle is not None and cycle.cycles is None:
                return None if cycle.budget is None else total + cycle.budget
            lesson = curriculum.at(at)
            ticks = lesson.starts * lesson.generations * self._generation_ticks(lesson)
            total += ticks if lesson.budget is None else min(ticks, lesson.budget)
            at = curriculum.next(at)
        return total

    def _generation_ticks(self, lesson: Lesson) -> int:
        return self._populations[lesson.name] * lesson.repetitions * lesson.episode_ticks


def population_of(lesson: Lesson, course: TrainingCourse) -> int:
    """Return how many individuals a generation of a lesson has."""
    if getattr(lesson.kind, "graphs", False):
        settings = lesson.kind.known_settings
        return int(lesson.settings.get("population", settings["population"].default))
    size = sum(course.mind.skill(name).genome_size for name in lesson.skills)
    return lesson.kind(size, 0, lesson.settings).population
