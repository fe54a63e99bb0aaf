"""One process's work on a sweep: giving out runs, keeping what comes of them, the folder's end."""

from __future__ import annotations

import math
import time
import warnings
from collections import Counter, deque
from collections.abc import Callable, Iterator, Sequence
from contextlib import suppress
from pathlib import Path
from typing import Any

from socialmind.errors import SocialmindError
from socialmind.experiments.sweeps.capsule import SweepCapsule
from socialmind.experiments.sweeps.columns import ERROR, RUN, STATUS, TICKS, of_ticks
from socialmind.experiments.sweeps.one_run import TIMED_OUT
from socialmind.experiments.sweeps.preparing import Prepared
from socialmind.experiments.sweeps.replicates import Waiting
from socialmind.experiments.sweeps.tables.store import RUNS, Store
from socialmind.experiments.sweeps.tables.window import Window
from socialmind.experiments.sweeps.task import OVERTIME, Done, RunJob, Task, ignore_idleness
from socialmind.runs.folders import FAILED, FINISHED, INTERRUPTED, RUNNING
from socialmind.runs.loop import NO_ROOM
from socialmind.runs.tables.names import AGENTS, SERIES
from socialmind.work.processes import LostProcessError
from socialmind.work.signals import deferred_signals
from socialmind.work.workers import Alone, Stopped, Workers, hired, workers_here

Progress = Callable[[int, int], None]

JOB_SECONDS = 0.5
"""About so long is a job, of as many runs as it takes."""
MOST_RUNS = 256
"""Runs of a job at most."""
LOST = 2
"""So often a run may lose its process until that counts as its failure."""


class SweepInterrupted(KeyboardInterrupt):
    """The user stopped a sweep; its folder stands and can be gone on with.

    Args:
        folder: the sweep's.
        done: runs that are safe.
        total: runs that there are to be.
        signal_number: what stopped it.
    """

    def __init__(self, folder: Path, done: int, total: int, signal_number: int) -> None:
        super().__init__(
            f"stopped after {done:,} of {total:,} runs; resume_sweep({str(folder)!r}) goes on"
        )
        self.folder, self.done, self.total = folder, done, total
        self.signal_number = signal_number


class Jobs:
    """Runs in jobs: one each at first, then as many as take about half a second.

    Args:
        prepared: the sweep.
        waiting: its runs.
    """

    def __init__(self, prepared: Prepared, waiting: Waiting) -> None:
        self._prepared, self._waiting = prepared, waiting
        self._alone: deque[int] = deque()
        self._seconds, self._runs = 0.0, 0

    def __iter__(self) -> Iterator[list[RunJob]]:
        return self

    def __next__(self) -> list[RunJob]:
        if self._alone:
            return [self._prepared.job_of(self._alone.popleft())]
        job: list[RunJob] = []
        for run in self._waiting:
            job.append(self._prepared.job_of(run))
            if len(job) >= self._size:
                break
        if not job:
            raise StopIteration
        return job

    def alone(self, job: Sequence[RunJob]) -> None:
        """Have the runs of a lost job done again, each by itself."""
        self._alone += [run for run, _, _ in job]

    def note(self, done: Done) -> None:
        """Take down how long runs take; what is long ago counts less."""
        self._seconds = 0.8 * self._seconds + done.seconds
        self._runs = int(0.8 * self._runs) + len(done.rows)

    @property
    def _size(self) -> int:
        if not self._runs:
            return 1
        pace = self._seconds / self._runs
        return max(1, min(MOST_RUNS, int(JOB_SECONDS / max(pace, 1e-6))))


class Lead:
    """One process's work on a sweep.

    Args:
        capsule: its folder.
        prepared: what it is.
        retry: whether runs that failed are done again.
    """

    def __init__(self, capsule: SweepCapsule, prepared: Prepared, retry: bool = False) -> None:
        self._capsule, self._prepared, self._retry = capsule, prepared, retry
        self._store = Store(capsule.folder)
        self._counts: Counter[str] = Counter()
        self._losses: Counter[int] = Counter()
        self._noted: tuple[list[int], int] = [], 0
        self._window = Window(self._store, prepared.rows)
        self._begin = time.perf_counter() - float(capsule.manifest.timings["seconds"])
        until = prepared.replicates.until
        self._wanted = None if until is None else until.measure

    def go(self, workers: int | None, cluster: str | None, on_progress: Progress | None) -> None:
        """Do what is missing, and leave a finished folder."""
        with deferred_signals() as arrived:
            try:
                self._store.begin(again=bool(self._capsule.manifest.tables))
                self._waiting = self._known()
                self._capsule.update(status=RUNNING, error=None)
                try:
                    self._work(workers, cluster, on_progress, arrived)
                except Stopped:
                    self._window.write()
                    self._store.note_running(())
                    self._show_pending()
                    self._capsule.update(status=INTERRUPTED, **self._progress())
                    done = sum(self._counts.values())
                    total = self._waiting.total
                    raise SweepInterrupted(self._capsule.folder, done, total, arrived[0]) from None
                self._finish()
            except SweepInterrupted:
                raise
            except Exception as error:
                with suppress(OSError):  # there may be no room to say so
                    self._capsule.update(status=FAILED, error=str(error), **self._progress())
                if isinstance(error, OSError) and error.errno in NO_ROOM:
                    raise SocialmindError(
                        f"{self._capsule.folder}: {error.strerror}; the runs that were written are "
                        "safe: make room and go on with --resume"
                    ) from error
                raise

    def _note_running(self, jobs: Sequence[Sequence[RunJob]]) -> None:
        """Write down which runs are begun and not yet safe, when others are: `Sweep` shows them."""
        at_work = [run for job in jobs for run, _, _ in job]
        waiting = self._window.runs
        if (at_work, len(waiting)) != self._noted:
            self._noted = at_work, len(waiting)
            with suppress(OSError):  # where there is no room, results will say so
                self._store.note_running([*at_work, *waiting])

    def _known(self) -> Waiting:
        """Return the runs to be done, from those that are."""
        known: dict[int, float | None] = {}
        wanted = [] if self._wanted is None else [self._column(self._wanted)]
        for row in self._store.rows([STATUS, *wanted]):
            if self._retry and row[STATUS] != FINISHED:
                continue
            self._counts[row[STATUS]] += 1
            known[row[RUN]] = _number(row.get(wanted[0])) if wanted else None
        return Waiting(len(self._prepared.points.values), self._prepared.replicates, known)

    def _column(self, measure: str) -> str:
        names = self._prepared.names
        return measure if measure in names.measures else names.of_series(measure)

    def _work(
        self,
        workers: int | None,
        cluster: str | None,
        on_progress: Progress | None,
        arrived: list[int],
    ) -> None:
        jobs = Jobs(self._prepared, self._waiting)

        def stop() -> bool:
            self._window.write_if_due()
            self._note_running(some.in_hand())
            return bool(arrived)

        def instead(job: list[RunJob], error: BaseException) -> Done | None:
            return self._lost(jobs, job, error)

        def tell() -> None:
            if on_progress is not None:
                on_progress(sum(self._counts.values()), self._waiting.total)

        task = Task(self._prepared.common, self._prepared.names, stop)
        tell()
        # Around all jobs, not each: Python then tells a model's own warnings once.
        with warnings.catch_warnings(), self._hired(workers, cluster) as some:
            ignore_idleness()
            for _, done in some.finished(task, jobs, stop, instead):
                if done is not None:
                    self._take(done)
                    jobs.note(done)
                    tell()

    def _hired(self, workers: int | None, cluster: str | None) -> Workers:
        """Return workers: this thread for one, unless a run could hang in it."""
        if cluster is None and workers_here(workers) == 1:
            if self._prepared.common.timeout is None:
                return Alone()
            return hired(1)
        return hired(workers, cluster=cluster)

    def _take(self, done: Done) -> None:
        wanted = None if self._wanted is None else self._column(self._wanted)
        self._window.add(done)
        for row in done.rows:
            self._counts[row[STATUS]] += 1
            self._waiting.note(row[RUN], None if wanted is None else _number(row.get(wanted)))

    def _lost(self, jobs: Jobs, job: list[RunJob], error: BaseException) -> Done | None:
        """Return what comes of runs whose process was lost: nothing yet, where that may change."""
        code = error.code if isinstance(error, LostProcessError) else None
        timeout = self._prepared.common.timeout
        if len(job) == 1:
            run = job[0][0]
            self._losses[run] += 1
            if timeout is not None and code in (OVERTIME, None):  # a cluster does not say which
                lost = "" if code == OVERTIME else ", or its worker was lost"
                said = f"took longer than {timeout:g} s{lost}"
                return Done([{RUN: run, STATUS: TIMED_OUT, ERROR: said, TICKS: 0}])
            if self._losses[run] >= LOST:
                ended = f"by signal {-code}" if code is not None and code < 0 else "by itself"
                said = f"run: its process was ended {ended}, {LOST} times; is there memory enough?"
                return Done([{RUN: run, STATUS: FAILED, ERROR: said, TICKS: 0}])
        jobs.alone(job)
        return None

    def _progress(self) -> dict[str, Any]:
        seconds = max(0.0, time.perf_counter() - self._begin)
        timings = {**self._capsule.manifest.timings, "seconds": seconds}
        return {"counts": dict(sorted(self._counts.items())), "timings": timings}

    def _first(self) -> list[str]:
        return self._prepared.names.first(self._prepared.series)

    def _show_pending(self) -> None:
        """Write the table of runs as far as they are done; the others are pending."""
        done = {row[RUN] for row in self._store.rows([])}
        self._store.merge(RUNS, self._first(), self._prepared.rows.missing(done))

    def _finish(self) -> None:
        """Write the sorted tables, and take the parts away."""
        self._window.write()
        tables = {}
        for name in (SERIES, AGENTS, RUNS):
            ticked = [of_ticks(one, name) for one in self._prepared.series]
            first = self._first() if name == RUNS else [RUN, "tick", *ticked]
            content = self._store.merge(name, first)
            if content is not None:
                tables[name] = {
                    "rows": content.rows, "columns": content.columns, "sha256": content.sha256,
                }  # fmt: skip
        self._capsule.update(status=FINISHED, tables=tables, **self._progress())
        self._store.clear()


def _number(value: Any) -> float | None:
    """Return a number of a table, None where there is none."""
    if isinstance(value, bool | int | float) and math.isfinite(value):
        return float(value)
    return None
