"""What workers do: runs at some values, and what the data speak of as it is in them."""

from __future__ import annotations

import time
import warnings
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from socialmind.errors import IdleWarning, SocialmindError
from socialmind.experiments.calibration.distance import Values
from socialmind.experiments.calibration.target import Target
from socialmind.experiments.sweeps.one_run import Common, OneRun
from socialmind.runs.folders import FINISHED
from socialmind.work.workers import Stop, never


@dataclass(frozen=True)
class RunJob:
    """A run.

    Attributes:
        group: the number of the group that it belongs to.
        replicate: its number there.
        seed: its seed.
        values: of what varies.
    """

    group: int
    replicate: int
    seed: int
    values: tuple[Any, ...]


@dataclass(frozen=True)
class Tried:
    """What came of a run.

    Attributes:
        job: the run.
        found: what the data speak of; None for a run that failed.
        error: why, in one line.
    """

    job: RunJob
    found: Values | None
    error: str | None = None


@dataclass(frozen=True, eq=False)
class Trying:
    """The runs of a fit as a task of workers.

    Args:
        common: what they have in common.
        target: says what is looked at.
        stop: asked by a worker in this process whether to drop the run in hand.
    """

    common: Common
    target: Target
    stop: Stop = never

    def worker(self) -> _Worker:
        """Return a worker."""
        return _Worker(self)

    def __reduce__(self) -> tuple[Any, ...]:
        return Trying, (self.common, self.target)


class _Worker:
    def __init__(self, task: Trying) -> None:
        self._runs = OneRun(task.common, task.stop)
        self._target = task.target

    def stop(self) -> None:
        """A worker of another process is ended with it."""

    def do(self, jobs: Sequence[RunJob]) -> tuple[list[Tried], float]:
        """Do some runs, and say how many seconds they took."""
        begin = time.perf_counter()
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", IdleWarning)
            found = [self._tried(job) for job in jobs]
        return found, time.perf_counter() - begin

    def _tried(self, job: RunJob) -> Tried:
        outcome = self._runs.done(job.group, job.seed, job.values)
        if outcome.status != FINISHED:
            return Tried(job, None, outcome.error)
        try:
            return Tried(job, self._target.observed(outcome))
        except SocialmindError as error:
            return Tried(job, None, f"compare: {error}")
