"""Fitting a model to data into a folder, and going on with it."""

from __future__ import annotations

import time
from collections import deque
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import suppress
from pathlib import Path
from typing import TYPE_CHECKING, Any

from socialmind.catalogue import load_model
from socialmind.errors import SocialmindError
from socialmind.experiments.calibration.capsule import FitCapsule
from socialmind.experiments.calibration.finding import found_by
from socialmind.experiments.calibration.log import Log
from socialmind.experiments.calibration.plan import RECOVERIES
from socialmind.experiments.calibration.preparing import Asked, Prepared, begun, taken_up_from
from socialmind.experiments.calibration.result import Fit
from socialmind.experiments.calibration.search import Group, Search
from socialmind.experiments.calibration.space import Range
from socialmind.experiments.calibration.trying import RunJob, Tried, Trying
from socialmind.experiments.calibration.writing import write_results
from socialmind.runs import folders
from socialmind.runs.folders import FAILED, FINISHED, INTERRUPTED, RUNNING
from socialmind.runs.loop import NO_ROOM
from socialmind.work.signals import deferred_signals
from socialmind.work.workers import Alone, Stopped, Workers, hired, workers_here

if TYPE_CHECKING:
    import pandas as pd

    from socialmind.model import Model

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


def fit(
    model: str | Path | type[Model],
    target: pd.DataFrame | Mapping[str, tuple[float, float]] | Sequence[str] | str | Path,
    vary: Mapping[str, Range],
    budget: int,
    ticks: int | None = None,
    *,
    method: str = "cmaes",
    seeds: int = 5,
    recover: int = RECOVERIES,
    data_runs: int | None = None,
    seed: int = 0,
    fixed: Mapping[str, Any] | None = None,
    measures: Mapping[str, Any] | None = None,
    every: int | None = None,
    compiled: bool = True,
    workers: int | None = None,
    cluster: str | None = None,
    out: str | Path | None = None,
    on_begin: Callable[[Sequence[str]], None] | None = None,
    on_progress: Progress | None = None,
) -> Fit:
    """Fit a model to data, and fit it by the same means to data with known parameters (recovery).

    What comes out hangs on model, target, method, budget and seed alone: not on workers, order, or
    interruptions.

    >>> from socialmind.experiments import fit                                   # doctest: +SKIP
    >>> found = fit("farmer_artisan", {"artisans": (5, 0.5), "farmers": (20, 0.5)},
    ...             {"tool_price": (100, 250)}, 500, 50_000)                     # doctest: +SKIP

    Args:
        model: its name, folder or class.
        target: a series, as a data frame with the column `tick` or the path of a CSV or Parquet
            file of one (`FILE.csv:farmers,artisans` for some columns of it); or statistics by name,
            each a pair of value and error, above 0. A statistic is a measure, or a column of the
            series at the end of a run.
        vary: the range of each parameter, or word of a scheme (`influence.COGNITON.PLAN`, …), that
            is to be found: (low, high), (low, high, "log"), or None for the declared one.
        budget: runs of the fit, and of each recovery.
        ticks: length of a run; to the last tick of a series, else the model's own by default.
        method: `cmaes`, `tpe`, `lhs` or `abc`.
        seeds: runs of a trial, of which the means are compared with the data.
        recover: recoveries: each costs the budget once more. 0 for none, as the report will say.
        data_runs: runs of which the data of a recovery are the mean; 1 by default for a series, for
            statistics 20 and a normal error as large as those given.
        seed: of all draws, 0 … 2⁶³ − 1.
        fixed: what is set in all runs alike.
        measures: by name, as for `sweep`.
        every: ticks between two looks at the series, for measures.
        compiled: False runs the rules in plain Python, with the same result.
        workers: processes; one for each processor by default. With 1 all is done here.
        cluster: the address of a Dask scheduler, whose workers do the runs then.
        out: folder to make, or an empty one; by default the next number under ``fits/``.
        on_begin: called with what is said of the fit before its first run, line by line.
        on_progress: called with the runs done and their number.

    Returns:
        The fit.

    Raises:
        SocialmindError: an unknown name, a range or target that cannot be, a folder in use, no
            room, or no trial that came to its end.
        FitInterrupted: Ctrl-C; what was done is safe, `resume_fit` goes on.
    """
    model_class = model if isinstance(model, type) else load_model(model)
    if cluster is None:
        workers_here(workers)
    asked = Asked(
        target, vary, budget, ticks, method, seeds, recover, data_runs, seed, fixed or {},
        measures or {}, every, compiled,
    )  # fmt: skip
    capsule, notes = begun(model_class, asked, out)
    if on_begin is not None:
        on_begin(notes)
    with capsule.locked():
        prepared = taken_up_from(capsule, model_class, measures)
        _Fitting(capsule, prepared).go(workers, cluster, on_progress)
    return Fit(capsule.folder)


def resume_fit(
    folder: str | Path,
    workers: int | None = None,
    cluster: str | None = None,
    model_class: type[Model] | None = None,
    measures: Mapping[str, Any] | None = None,
    on_progress: Progress | None = None,
    trust: bool = False,
) -> Fit:
    """Go on with a fit that was stopped: only the trials that are missing are made.

    Args:
        folder: the fit's.
        workers: as for `fit`.
        cluster: likewise.
        model_class: the model; loaded from where the fit says it stands by default.
        measures: those that are functions of Python and stand in no file.
        on_progress: as for `fit`.
        trust: run programs that this user has neither named nor run before.

    Returns:
        The fit.

    Raises:
        SocialmindError: no fit's folder, in use, or its model or a copy was changed since.
        FitInterrupted: Ctrl-C; what was done is safe.
    """
    capsule = FitCapsule(folder)
    with capsule.locked():
        if capsule.manifest.status != FINISHED:
            prepared = taken_up_from(capsule, model_class, measures, trust)
            capsule.update(platforms=folders.with_this_machine(capsule.manifest.platforms))
            _Fitting(capsule, prepared).go(workers, cluster, on_progress)
        Log(capsule.folder).clear()
    return Fit(capsule.folder)


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


class _Fitting:
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
