"""Trainings as plans: what learns what, how often; made from nothing, small, or from what is kept.

A study stands on trainings that take hours. Its plans say what they are; each is made in a folder
that can be gone on with, and what came of it is kept beside the study, small enough for a
repository.
"""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field, replace
from functools import partial
from pathlib import Path
from typing import Any

from socialmind.errors import SocialmindError, nearest
from socialmind.experiments.studies import Way
from socialmind.experiments.trainings.rechecking import recheck, rescore
from socialmind.experiments.trainings.rerunning import kept_with, rerun, write_down
from socialmind.experiments.trainings.store import differences, keep, take_out
from socialmind.learning.lessons.curriculum import Curriculum
from socialmind.learning.lessons.lesson import Lesson
from socialmind.learning.training.course import TrainingCourse
from socialmind.learning.training.execution import TrainingInterrupted, learn, resume
from socialmind.learning.training.forecast import population_of
from socialmind.learning.training.result import Training
from socialmind.mind import MindDescription
from socialmind.runs.folders import MANIFEST

PACE = 2_000_000
"""Ticks a second that two processors do at least with one robot in each world, for a word on how
long a training takes."""

RERUNS = "reruns.csv"
"""In a topic's results: which kept attempts were trained anew, and how they came out."""
USAGE = """\
python -m {module} NAME …              make trainings, or go on with them
python -m {module} keep NAME …         keep what they came to, in results/trainings/
python -m {module} recheck NAME …      after an edit of the model: do kept winners score the same?
python -m {module} rescore NAME …      take scores of kept winners as they come out today
python -m {module} rerun NAME NUMBER … train kept attempts anew, compare, note in results/reruns.csv

NAME: all (but for rerun), or some of {names}"""


@dataclass(frozen=True)
class TrainingPlan:
    """A training: what learns what, how often.

    Attributes:
        about: what it is for.
        attempts: how many.
        mind: gives the mind to begin from.
        curriculum: gives the lessons.
        model: the name of the model in which they take place.
        seed: of every draw.
    """

    about: str
    attempts: int
    mind: Callable[[], MindDescription]
    curriculum: Callable[[], Curriculum]
    model: str
    seed: int = 0

    @property
    def seconds(self) -> float:
        """How long all attempts take at most, at `PACE`."""
        course = TrainingCourse(self.curriculum(), self.mind(), self.seed, "compiled")
        lessons = course.curriculum.lessons
        ticks = sum(most_ticks(one, population_of(one, course)) for one in lessons)
        return self.attempts * ticks / PACE

    def small(
        self,
        attempts: int = 2,
        generations: int = 15,
        population: int = 40,
        repetitions: int = 3,
        ticks: int | None = None,
    ) -> TrainingPlan:
        """Return a plan of a minute or so: its results show that all works, and nothing else.

        Args:
            attempts: how many.
            generations: of each lesson, at most.
            population: individuals of a generation.
            repetitions: worlds of an individual.
            ticks: of an episode at most; as many as in the whole plan by default.
        """

        def change(lesson: Lesson) -> Lesson:
            given = {"population": population, "elite": 3}
            few = {name: one for name, one in given.items() if name in lesson.kind.known_settings}
            return lesson.changed(
                generations=min(lesson.generations, generations),
                starts=min(lesson.starts, 2),
                budget=None,
                repetitions=repetitions,
                ticks=lesson.ticks if ticks is None else min(lesson.episode_ticks, ticks),
                finals=8,
                validation=min(lesson.validation, 16),
                settings={**lesson.settings, **few},
            )

        return replace(
            self, attempts=attempts, curriculum=lambda: self.curriculum().with_lessons(change)
        )

    def train(self, folder: Path, **options: Any) -> Training:
        """Make the training, or go on with it.

        Args:
            folder: of the training.
            options: for `socialmind.learning.learn`.
        """
        if (folder / MANIFEST).is_file():
            resume(folder, attempts=self.attempts, lessons=self.curriculum(), **options)
        else:
            learn(
                self.model,
                lessons=self.curriculum(),
                mind=self.mind(),
                attempts=self.attempts,
                seed=self.seed,
                out=folder,
                **options,
            )
        return Training(folder)


def most_ticks(lesson: Lesson, population: int | None = None) -> int:
    """Return the ticks of a lesson whose episodes all last to the end.

    Args:
        lesson: which.
        population: individuals in a generation; as its settings say by default.
    """
    population = population or int(lesson.settings["population"])
    generation = population * lesson.repetitions * lesson.episode_ticks
    whole = lesson.starts * lesson.generations * generation
    return whole if lesson.budget is None else min(whole, lesson.budget + generation)


@dataclass(frozen=True, eq=False)
class TrainingPlans(Mapping[str, TrainingPlan]):
    """The plans of a study's topic by name, and where their trainings lie.

    Attributes:
        topic: its folder. Trainings are made in its `trainings/`, and what they came to is kept in
            its `results/trainings/`.
        plans: by name.
        small: arguments of `TrainingPlan.small` for quick versions, where they are not its own.
    """

    topic: Path
    plans: Mapping[str, TrainingPlan]
    small: Mapping[str, int] = field(default_factory=dict)

    def __getitem__(self, name: str) -> TrainingPlan:
        return self.plans[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self.plans)

    def __len__(self) -> int:
        return len(self.plans)

    @property
    def home(self) -> Path:
        """Where trainings are made."""
        return self.topic / "trainings"

    @property
    def kept(self) -> Path:
        """Where what they came to is kept."""
        return self.topic / "results" / "trainings"

    def train_on(self, name: str) -> Training:
        """Make a training in `home`, or go on with it; it begins with what is kept of it.

        Args:
            name: of the plan.
        """
        plan, folder = self[name], self.home / name
        if not folder.is_dir():
            take_out(self.kept / name, folder)
        told = {"module": module, "name": name} if (module := _module()) else None
        return plan.train(folder, on_lesson=print_lesson, plan=told)

    def training(self, name: str, way: Way, out: Path) -> tuple[Training | None, str]:
        """Return a training for a study, and a line on where it comes from.

        Args:
            name: of the plan.
            way: in which the study is made. In full and quick versions the training is made below
                `out`, or gone on with; else it is the kept one, None where there is none.
            out: the study's folder.
        """
        plan = self[name]
        if way is Way.KEPT:
            return self._kept(name)
        home = out / ("trainings" if way is Way.FULL else "small_trainings")
        plan = plan if way is Way.FULL else plan.small(**self.small)
        line = f"{name}: {plan.about}; {_counted(plan.attempts)} in {home / name}"
        if way is Way.FULL:
            line += (
                f", some {plan.seconds / 60:.0f} minutes at {PACE:,} ticks a second; Ctrl-C stops, "
                "and the same command goes on"
            )
        print(line, file=sys.stderr, flush=True)
        training = plan.train(home / name, on_lesson=print_lesson)
        size = "trained from nothing" if way is Way.FULL else "trained small"
        return training, (
            f"`{name}`: {plan.about}. {_counted(len(training.attempts))}, {size}, seed {plan.seed}."
        )

    def _kept(self, name: str) -> tuple[Training | None, str]:
        plan, command = self[name], f"python -m analysis.{self.topic.name}.trainings {name}"
        if not (self.kept / name).is_dir():
            return None, f"`{name}`: {plan.about}. Not kept; `{command}` makes it."
        training = Training(self.kept / name)
        done, minutes = training.manifest.finished, training.manifest.timings["seconds"] / 60
        took = f"{minutes / 60:.1f} hours" if minutes > 6 else f"{minutes:.0f} minutes"
        line = (
            f"`{name}`: {plan.about}. {done} of {plan.attempts} attempts, seed {plan.seed}, "
            f"{took}; `{command}`."
        )
        changed = differences(training, plan)
        return training, line + (f" Since then {', '.join(changed)} changed." if changed else "")

    def main(self, words: list[str]) -> None:
        """Make trainings, keep what they came to, judge what is kept again, or train it again.

        Args:
            words: of the command: names of plans, or `all`; before them `keep`, `recheck` or
                `rescore`, if it is not about making them. Or `rerun`, one name, and the numbers of
                kept attempts to train anew from their seed and to compare.

        Raises:
            SystemExit: with a line on what is wrong: a name that no plan has, …; before anything
                is done.
        """
        if {"-h", "--help"} & set(words):
            print(USAGE.format(module=_module() or "MODULE", names=", ".join(self)))
            return
        acts = (["keep"], ["recheck"], ["rescore"], ["rerun"])
        act, *names = words if words[:1] in acts else ["make", *words]
        try:
            if act == "rerun":
                self._rerun(names)
                return
            for name in self._chosen(names):
                print(self._done(act, name), flush=True)
        except SocialmindError as error:
            raise SystemExit(f"error: {error}") from error
        except TrainingInterrupted as stop:
            print(f"{stop.where}; the same command goes on", file=sys.stderr, flush=True)
            raise SystemExit(128 + stop.signal_number) from None

    def _rerun(self, words: list[str]) -> None:
        """Train kept attempts anew; say of each that it came out again, and write it down."""
        if words[:1] in ([], ["all"]):
            raise SocialmindError(f"which training? expected one of {', '.join(self)}")
        (name,) = self._chosen(words[:1])
        if not words[1:] or not all(word.isdecimal() for word in words[1:]):
            raise SocialmindError(f"which attempts? expected `rerun {name}` and their numbers")
        attempts = [int(word) for word in words[1:]]
        for attempt in attempts:
            kept_with(self.kept / name, attempt)
        for attempt in attempts:
            note = partial(write_down, self.kept.parent / RERUNS, name, attempt)
            found = rerun(self.kept / name, _module(), attempt, self.home / "rerun", note)
            scores = [
                f"{one.lesson} {one.now:.5g}"
                + (f" (kept {one.before:.5g})" if one.now != one.before else "")
                for one in found
            ]
            print(f"{name}, attempt {attempt}: the same weights; {', '.join(scores)}", flush=True)

    def _chosen(self, names: list[str]) -> list[str]:
        if names == ["all"]:
            return list(self)
        if not names:
            raise SocialmindError(f"which training? expected all, or some of {', '.join(self)}")
        for name in names:
            if name not in self:
                raise SocialmindError(f"no training called {name!r}; {nearest(name, self)}")
        return names

    def _done(self, act: str, name: str) -> str:
        """Do it with a training; return a line on what came of it."""
        if act == "keep":
            return str(keep(self.home / name, self.kept))
        if act == "recheck":
            count = recheck(self.kept / name, self[name])
            return f"{name}: {count} lessons come to the same scores"
        if act == "rescore":
            found = [
                f"attempt {one.attempt} {one.lesson} {one.before:.5g} → {one.now:.5g}"
                for one in rescore(self.kept / name, self[name])
            ]
            return f"{name}: {'; '.join(found) or 'all lessons come to the same scores'}"
        return f"{name} {self.train_on(name).folder}"


def attempts_of(
    trainings: Mapping[str, Training | None],
) -> Iterator[tuple[str, int, MindDescription]]:
    """Yield the name of each training, each attempt that is finished, and the mind at its end.

    Args:
        trainings: by name; None where there is none.
    """
    for name, training in trainings.items():
        if training is None:
            continue
        for attempt in training.finished:
            yield name, attempt, training.mind(attempt)


def _module() -> str:
    """Return the module that `python -m` runs, whose command this is."""
    spec = getattr(sys.modules["__main__"], "__spec__", None)
    return "" if spec is None else str(spec.name)


def print_lesson(attempt: int, lesson: Lesson, result: Any) -> None:
    """Say what came of a lesson."""
    line = f"attempt {attempt}, {lesson.name}: {result.score:.4g} ± {result.deviation:.2g}"
    print(line, file=sys.stderr, flush=True)


def _counted(attempts: int) -> str:
    return f"{attempts} attempt{'s' if attempts > 1 else ''}"
