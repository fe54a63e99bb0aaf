"""What workers are sent: a few runs at a time, each a number, a seed and a point's values."""

from __future__ import annotations

import os
import threading
import time
import warnings
from collections.abc import Sequence
from contextlib import suppress
from dataclasses import dataclass, field
from multiprocessing import parent_process
from typing import Any

from socialmind.errors import IdleWarning
from socialmind.experiments.sweeps.columns import ERROR, RUN, STATUS, TICKS, Names
from socialmind.experiments.sweeps.one_run import Common, OneRun, Outcome
from socialmind.experiments.sweeps.tables.recording import recorded
from socialmind.work.workers import LOOK_SECONDS, Stop, never

OVERTIME = 75
"""The exit code of a process that ended itself, since a run in it went on and on."""
PATIENCE = 2.0
"""Seconds beyond its time that a run may take to notice, before its process ends."""

LONGEST_WARM_UP = 1800.0
"""Seconds that compiling may take before the first run of a process."""

RunJob = tuple[int, int, tuple[Any, ...]]
"""A run's number, its seed, and the values at its point."""


@dataclass
class Done:
    """What came of the runs of a job.

    Attributes:
        rows: of the runs' table: `run`, `status`, `error`, `ticks`, ends of the series, measures.
        tables: the series and the agents, as Arrow streams.
        seconds: that they took.
    """

    rows: list[dict[str, Any]] = field(default_factory=list)
    tables: dict[str, bytes] = field(default_factory=dict)
    seconds: float = 0.0


@dataclass(frozen=True, eq=False)
class Task:
    """The runs of a sweep as a task of workers.

    Args:
        common: what the runs have in common.
        names: of the columns.
        stop: asked by a worker in this process whether to drop the run in hand.
    """

    common: Common
    names: Names
    stop: Stop = never

    def worker(self) -> RunWorker:
        """Return a worker."""
        return RunWorker(self)

    def __reduce__(self) -> tuple[Any, ...]:
        return Task, (self.common, self.names)


class RunWorker:
    """Does the runs of one job after another.

    Args:
        task: what they have in common.
    """

    def __init__(self, task: Task) -> None:
        self._names = task.names
        self._runs = OneRun(task.common, task.stop)
        self._common = task.common
        self._warm = False
        self._watch = None
        if task.common.timeout is not None and task.stop is never and parent_process() is not None:
            self._watch = _Watch()

    def stop(self) -> None:
        """A worker of another process is ended with it."""

    def do(self, job: Sequence[RunJob]) -> Done:
        """Do the runs of a job."""
        if self._watch is not None and not self._warm:
            self._warm_up(job[0])
        begin, outcomes = time.perf_counter(), []
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", IdleWarning)  # said in the tables, where it is recorded
            for run, seed, values in job:
                if self._watch is not None:
                    self._watch.begin((self._common.timeout or 0.0) + PATIENCE)
                outcomes.append(self._runs.done(run, seed, values))
        if self._watch is not None:
            self._watch.end()
        outcomes, tables = recorded(outcomes)
        rows = [self._row(one) for one in outcomes]
        return Done(rows, tables, time.perf_counter() - begin)

    def _warm_up(self, job: RunJob) -> None:
        """Compile, or load, what runs need: that is no run's time."""
        if self._watch is not None:
            self._watch.begin(LONGEST_WARM_UP)
        with suppress(Exception):  # what is wrong with it the run will say
            for _ in range(2):  # the second society's setup is compiled as well
                self._common.begin(*job[1:]).engine.compile()
        self._warm = True

    def _row(self, outcome: Outcome) -> dict[str, Any]:
        ends = {self._names.of_series(name): value for name, value in outcome.final.items()}
        own = {
            RUN: outcome.run,
            STATUS: outcome.status,
            ERROR: outcome.error,
            TICKS: outcome.ticks,
        }
        return {**own, **ends, **outcome.measured}


class _Watch:
    """Ends this process when what it has in hand takes too long; compiled code hears nothing."""

    def __init__(self) -> None:
        self._end: float | None = None
        threading.Thread(target=self._look, daemon=True).start()

    def begin(self, seconds: float) -> None:
        """Something is in hand from now on, which may take so long."""
        self._end = time.monotonic() + seconds

    def end(self) -> None:
        """Nothing is in hand."""
        self._end = None

    def _look(self) -> None:
        while True:
            time.sleep(LOOK_SECONDS)
            end = self._end
            if end is not None and time.monotonic() > end:
                os._exit(OVERTIME)
