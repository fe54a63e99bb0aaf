"""One process's work on a fit: giving out runs, keeping what comes of them, the folder's end."""

from __future__ import annotations

import time
from collections import deque
from collections.abc import Callable, Iterator, Sequence
from contextlib import suppress
from pathlib import Path
from typing import Any

from socialmind.errors import SocialmindError
from socialmind.experiments.calibration.capsule import FitCapsule
from socialmind.experiments.calibration.finding import found_by
from socialmind.experiments.calibration.log import Log
from socialmind.experiments.calibration.preparing import Prepared
from socialmind.experiments.calibration.reporting.writing import write_results
from socialmind.experiments.calibration.search import Group, Search
from socialmind.experiments.calibration.trying import RunJob, Tried, Trying
from socialmind.runs.folders import FAILED, FINISHED, INTERRUPTED, RUNNING
from socialmind.runs.loop import NO_ROOM
from socialmind.work.signals import deferred_signals
from socialmind.work.workers import Alone, Stopped, Workers, hired, workers_here

Progress = Callable[[int, int], None]

JOB_SECONDS = 0.2
"""About so long is a job, of as many runs as it takes."""
MOST_RUNS = 64
"""Runs of a job at most."""


class FitInterrupted(KeyboardInterrupt):
    """The user stopped a fit; its folder stands and can be gone on with.

    Args:
        folder: the fit's.
        done: runs that are safe.
        total: runs that there are to be.
        signal_number: what stopped it.
    """

    def __init__(self, folder: Path, done: int, total: int, signal_number: int) -> None:
        super().__init__(f"stopped after {done} of {total} runs")
        self.folder, self.done, self.total = folder, done, total
        self.signal_number = signal_number


class _Jobs:
    """Runs that can be made now, a few to a job; there may be more once some are done.

    Args:
        count: how many work side by side.
    """

    def __init__(self, count: int) -> None:
        self._count = count
        self._waiting: deque[RunJob] = deque()
        self._seconds, self._runs = 0.0, 0.0

    def __iter__(self) -> Iterator[list[RunJob]]:
        return self

    def __next__(self) -> list[RunJob]:
        if not self._waiting:
            raise StopIteration
        size = 1
        if self._runs:
            size = int(JOB_SECONDS / max(self._seconds / self._runs, 1e-6))
        size = max(1, min(size, MOST_RUNS, len(self._waiting) // (2 * self._count)))
        return [self._waiting.popleft() for _ in range(size)]

    def add(self, number: int, group: Group) -> None:
        """Have the runs of a group made."""
        for replicate, seed in enumerate(group.seeds):
            self._waiting.append(RunJob(number, replicate, seed, group.values))

    def note(self, runs: int, seconds: float) -> None:
        """Take down how long runs take; what is long ago counts less."""
        self._seconds, self._runs = 0.8 * self._seconds + seconds, 0.8 * self._runs + runs


class Lead:
    """One process's work on a fit.

    Args:
        capsule: its folder.
        prepared: what it is.
    """

    def __init__(self, capsule: FitCapsule, prepared: Prepared) -> None:
        self._capsule, self._plan, self._common = capsule, prepared.plan, prepared.common
        self._log = Log(capsule.folder)
        self._groups: dict[int, Group] = {}
        self._number = 0
        self._done = 0
        self._begin = time.perf_counter() - float(capsule.manifest.timings["seconds"])

    def go(self, workers: int | None, cluster: str | None, on_progress: Progress | None) -> None:
        """Do what is missing, and leave a finished folder."""
        total = self._plan.runs
        with deferred_signals() as arrived:
            try:
                self._capsule.update(status=RUNNING, error=None)
                try:
                    searches = self._searched(workers, cluster, on_progress, arrived)
                except Stopped:
                    self._capsule.update(status=INTERRUPTED, timings=self._timings())
                    folder = self._capsule.folder
                    raise FitInterrupted(folder, self._done, total, arrived[0]) from None
                found = [found_by(one) for one in searches]
                if found[0].values is None:
                    raise SocialmindError(f"{self._capsule.folder}: {found[0].problem}")
                self._capsule.update(timings=self._timings())
                write_results(self._capsule, self._common, self._plan, searches, found)
                self._capsule.update(status=FINISHED)
                self._log.clear()
            except FitInterrupted:
                raise
            except Exception as error:
                with suppress(OSError):  # there may be no room to say so
                    self._capsule.update(status=FAILED, error=str(error), timings=self._timings())
                if isinstance(error, OSError) and error.errno in NO_ROOM:
                    raise SocialmindError(
                        f"{self._capsule.folder}: {error.strerror}; the trials that were written "
                        "are safe: make room and go on with --resume"
                    ) from error
                raise

    def _timings(self) -> dict[str, Any]:
        seconds = max(0.0, time.perf_counter() - self._begin)
        return {**self._capsule.manifest.timings, "seconds": seconds}

    def _searched(
        self,
        workers: int | None,
        cluster: str | None,
        on_progress: Progress | None,
        arrived: list[int],
    ) -> list[Search]:
        """Do all runs, and return the searches at their end."""
        truths = self._plan.truths()
        searches = [
            Search(self._plan, n, truths[n - 1] if n else None) for n in range(1 + len(truths))
        ]
        known = self._log.read()

        def tell() -> None:
            if on_progress is not None:
                on_progress(self._done, self._plan.runs)

        with self._hired(workers, cluster) as some:
            jobs = _Jobs(some.count)
            for search in searches:
                self._open(search.begin(known), jobs)
            self._done = sum(self._plan.runs_of(kind) for _, kind, _ in known)
            tell()
            # Which columns and ticks are looked at is the same for all searches.
            task = Trying(self._common, self._plan.target, lambda: bool(arrived))
            for _, (tried, seconds) in some.finished(task, jobs, task.stop):
                jobs.note(len(tried), seconds)
                for one in tried:
                    self._take(one, jobs)
                tell()
        return searches

    def _hired(self, workers: int | None, cluster: str | None) -> Workers:
        if cluster is None and workers_here(workers) == 1:
            return Alone()
        return hired(workers, cluster=cluster)

    def _open(self, groups: Sequence[Group], jobs: _Jobs) -> None:
        for group in groups:
            self._groups[self._number] = group
            jobs.add(self._number, group)
            self._number += 1

    def _take(self, tried: Tried, jobs: _Jobs) -> None:
        group = self._groups[tried.job.group]
        group.tried[tried.job.replicate] = tried
        self._done += 1
        if group.whole:
            record = group.record()
            self._log.add(dict(record))
            del self._groups[tried.job.group]
            self._open(group.search.take(record), jobs)
