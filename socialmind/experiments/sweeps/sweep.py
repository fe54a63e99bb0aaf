"""Sweeping a model over a design into a folder, and going on with it."""

from __future__ import annotations

import math
import time
from collections import Counter, deque
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import suppress
from pathlib import Path
from typing import TYPE_CHECKING, Any

from socialmind.catalogue import load_model
from socialmind.errors import SocialmindError
from socialmind.experiments.sweeps.capsule import SweepCapsule
from socialmind.experiments.sweeps.columns import ERROR, POINT, REPLICATE, RUN, SEED, STATUS, TICKS
from socialmind.experiments.sweeps.one_run import TIMED_OUT
from socialmind.experiments.sweeps.preparing import Prepared, begun, checked_shocks, taken_up
from socialmind.experiments.sweeps.replicates import Replicates, Until, Waiting
from socialmind.experiments.sweeps.store import RUNS, Store
from socialmind.experiments.sweeps.task import OVERTIME, Done, RunJob, Task, from_stream
from socialmind.runs import folders
from socialmind.runs.folders import FAILED, FINISHED, INTERRUPTED, RUNNING
from socialmind.runs.loop import NO_ROOM
from socialmind.runs.tables.growing import arrow_table
from socialmind.runs.tables.names import AGENTS, SERIES
from socialmind.work.processes import LostProcessError
from socialmind.work.progress import progress_bar
from socialmind.work.signals import deferred_signals
from socialmind.work.workers import Alone, Stopped, Workers, hired, workers_here

if TYPE_CHECKING:
    import pandas as pd

    from socialmind.interventions.shock import Shock
    from socialmind.model import Model

Progress = Callable[[int, int], None]

PENDING = "pending"
JOB_SECONDS = 0.5
"""About so long is a job, of as many runs as it takes."""
MOST_RUNS = 256
"""Runs of a job at most."""
WINDOW_SECONDS = (1.0, 30.0)
"""How long finished runs wait for being written, at the begin of a sweep and after hours."""
PARTS_A_SECOND = 60
"""After so many parts they wait a second longer."""
WINDOW_BYTES = 32 << 20
"""So many bytes of tables do not wait."""
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


def sweep(
    model: str | Path | type[Model],
    design: pd.DataFrame | Mapping[str, Sequence[Any]] | str | Path | None = None,
    ticks: int | None = None,
    seeds: Sequence[int] = (0,),
    *,
    common: bool = False,
    fixed: Mapping[str, Any] | None = None,
    measures: Mapping[str, Any] | None = None,
    every: int | None = None,
    agents: str | int = "none",
    until: Until | str | None = None,
    at_most: int = 0,
    timeout: float | None = None,
    compiled: bool = True,
    shocks: Sequence[Shock] = (),
    workers: int | None = None,
    cluster: str | None = None,
    out: str | Path | None = None,
    on_begin: Callable[[Sequence[str]], None] | None = None,
    on_progress: Progress | None = None,
    progress: bool | None = None,
) -> Path:
    """Run a model at every point of a design, with replicates, into one folder.

    What comes out hangs on model, design and seeds alone: not on workers, order, or interruptions.

    >>> from socialmind.experiments import designs, sweep                        # doctest: +SKIP
    >>> design = designs.grid({"tool_price": [100, 167, 250]})                   # doctest: +SKIP
    >>> folder = sweep("farmer_artisan", design, 50_000, range(20))              # doctest: +SKIP

    Args:
        model: its name, folder or class.
        design: a row a point, a column for each thing that varies: parameters; words of a scheme
            (`influence.COGNITON.PLAN`, `reinforcement.…`, `start.COGNITON`, `decision_maker.bias`,
            after `POPULATION.` where several have schemes); `scheme` and `mind`, files. A CSV file
            by its path. None for one point.
        ticks: length of a run; the model's own by default.
        seeds: one for each replicate, 0 … 2⁶³ − 1.
        common: whether replicate r has the r-th seed at every point; else a seed of its own is
            derived from that and the point's number.
        fixed: what is set in all runs alike, by the names that columns can have.
        measures: by name an expression (`mean(farmers[-100:])`), `FILE.py:FUNCTION`, or a function
            of some of `model`, `series`, `agents`.
        every: ticks between two rows of the series, about a hundred rows by default; 0 for no
            table of series.
        agents: "none", "last", or the ticks between two records of the agents.
        until: half-width of the 95 % interval that a measure is to have at each point, as
            `0.05:farmers` or `5%:farmers`: replicates are added until it has.
        at_most: replicates at a point, with `until`.
        timeout: seconds that a run may take.
        compiled: False runs the rules in plain Python, with the same result.
        shocks: what is done to the society of every run on its way; functions at the top of a file.
        workers: processes; one for each processor by default. With 1 all is done here.
        cluster: the address of a Dask scheduler, whose workers do the runs then.
        out: folder to make, or an empty one; by default the next number under ``sweeps/``.
        on_begin: called with what is said of the sweep before its first run, line by line.
        on_progress: called with the runs done and their number.
        progress: whether a bar is drawn; by default in notebooks and on terminals, unless
            `on_progress` is given.

    Returns:
        The sweep's folder.

    Raises:
        SocialmindError: an unknown name, a value out of range, a folder in use, no room.
        SweepInterrupted: Ctrl-C; what was done is safe, `resume_sweep` goes on.
    """
    model_class = model if isinstance(model, type) else load_model(model)
    wanted = Until.read(until) if isinstance(until, str) else until
    replicates = Replicates(tuple(seeds), common, wanted, at_most)
    to_come = checked_shocks(shocks)
    if cluster is None:
        workers_here(workers)
    capsule, notes = begun(
        model_class, design, ticks, replicates, fixed or {}, every, agents, measures or {},
        timeout, compiled, to_come, out,
    )  # fmt: skip
    if on_begin is not None:
        on_begin(notes)
    kind = f"sweep {model_class.name}"
    with capsule.locked(), progress_bar(progress, "runs", kind, on_progress) as tell:
        prepared = taken_up(capsule, model_class, measures, shocks=to_come)
        _Sweep(capsule, prepared).go(workers, cluster, tell)
    return capsule.folder


def resume_sweep(
    folder: str | Path,
    retry: bool = False,
    workers: int | None = None,
    cluster: str | None = None,
    model_class: type[Model] | None = None,
    measures: Mapping[str, Any] | None = None,
    on_progress: Progress | None = None,
    trust: bool = False,
    progress: bool | None = None,
) -> Path:
    """Go on with a sweep that was stopped: only the runs that are missing are done.

    Args:
        folder: the sweep's.
        retry: whether runs that failed or took too long are done again.
        workers: as for `sweep`.
        cluster: likewise.
        model_class: the model; loaded from where the sweep says it stands by default.
        measures: those that are functions of Python and stand in no file.
        on_progress: as for `sweep`.
        trust: run programs that this user has neither named nor run before.
        progress: as for `sweep`.

    Returns:
        The sweep's folder.

    Raises:
        SocialmindError: no sweep's folder, in use, or its model or a copy was changed since.
        SweepInterrupted: Ctrl-C; what was done is safe.
    """
    capsule = SweepCapsule(folder)
    with capsule.locked(), progress_bar(progress, "runs", "sweep", on_progress) as tell:
        if capsule.manifest.status == FINISHED and not retry:
            Store(capsule.folder).clear()
            return capsule.folder
        prepared = taken_up(capsule, model_class, measures, trust)
        capsule.update(platforms=folders.with_this_machine(capsule.manifest.platforms))
        _Sweep(capsule, prepared, retry).go(workers, cluster, tell)
    return capsule.folder


class _Jobs:
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


class _Sweep:
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
        self._window = _Window(self._store, prepared)
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
        jobs = _Jobs(self._prepared, self._waiting)

        def stop() -> bool:
            self._window.write_if_due()
            return bool(arrived)

        def instead(job: list[RunJob], error: BaseException) -> Done | None:
            return self._lost(jobs, job, error)

        def tell() -> None:
            if on_progress is not None:
                on_progress(sum(self._counts.values()), self._waiting.total)

        task = Task(self._prepared.common, self._prepared.names, stop)
        tell()
        with self._hired(workers, cluster) as some:
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

    def _lost(self, jobs: _Jobs, job: list[RunJob], error: BaseException) -> Done | None:
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
        replicates = self._prepared.replicates

        def pending() -> Iterator[dict[str, Any]]:
            for point in range(len(self._prepared.points.values)):
                for replicate in range(len(replicates.seeds)):
                    run = replicates.run_of(point, replicate)
                    if run not in done:
                        yield _whole_row(self._prepared, {RUN: run, STATUS: PENDING, ERROR: None})

        self._store.merge(RUNS, self._first(), pending())

    def _finish(self) -> None:
        """Write the sorted tables, and take the parts away."""
        self._window.write()
        tables = {}
        for name in (SERIES, AGENTS, RUNS):
            first = self._first() if name == RUNS else [RUN, "tick", *self._prepared.series]
            content = self._store.merge(name, first)
            if content is not None:
                tables[name] = {
                    "rows": content.rows, "columns": content.columns, "sha256": content.sha256,
                }  # fmt: skip
        self._capsule.update(status=FINISHED, tables=tables, **self._progress())
        self._store.clear()


class _Window:
    """Finished runs that wait for being written.

    Args:
        store: where they go.
        prepared: the sweep.
    """

    def __init__(self, store: Store, prepared: Prepared) -> None:
        self._store, self._prepared = store, prepared
        self._rows: list[dict[str, Any]] = []
        self._tables: dict[str, list[bytes]] = {SERIES: [], AGENTS: []}
        self._bytes = 0
        self._parts = 0
        self._last = time.monotonic()

    def add(self, done: Done) -> None:
        """Take up the runs of a job."""
        self._rows += done.rows
        for name, content in done.tables.items():
            self._tables[name].append(content)
            self._bytes += len(content)
        self.write_if_due()

    def write_if_due(self) -> None:
        """Write what waits, if it has waited long enough."""
        least, most = WINDOW_SECONDS
        wait = min(least + self._parts / PARTS_A_SECOND, most)
        if self._bytes > WINDOW_BYTES or time.monotonic() - self._last > wait:
            self.write()

    def write(self) -> None:
        """Write what waits as a part."""
        if self._rows:
            tables = {
                name: [from_stream(one) for one in several]
                for name, several in self._tables.items()
            }
            rows = [_whole_row(self._prepared, row) for row in self._rows]
            names = dict.fromkeys(name for row in rows for name in row)
            columns = {name: [row.get(name) for row in rows] for name in names}
            try:
                pieces = [arrow_table([columns], RUNS)]
            except SocialmindError:  # a column is text in one run and a number in another
                pieces = [arrow_table([{k: [v] for k, v in row.items()}], RUNS) for row in rows]
            self._store.write({**tables, RUNS: pieces})
            self._rows, self._tables, self._bytes = [], {SERIES: [], AGENTS: []}, 0
            self._parts += 1
        self._last = time.monotonic()


def _whole_row(prepared: Prepared, row: Mapping[str, Any]) -> dict[str, Any]:
    """Return a row of the runs' table, with what a run's number says."""
    run, seed, values = prepared.job_of(row[RUN])
    point, replicate = prepared.replicates.place_of(run)
    names = [prepared.names.of_varied(one.name) for one in prepared.points.columns]
    design = dict(zip(names, values, strict=True))
    return {RUN: run, POINT: point, REPLICATE: replicate, **design, SEED: seed, **row}


def _number(value: Any) -> float | None:
    """Return a number of a table, None where there is none."""
    if isinstance(value, bool | int | float) and math.isfinite(value):
        return float(value)
    return None
