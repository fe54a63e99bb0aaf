"""Sweeping a model over a design into a folder, and going on with it."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from coglogo_py.border.errors import shown
from socialmind.catalogue import load_model
from socialmind.errors import SocialmindError
from socialmind.experiments.sweeps.beginning import begun
from socialmind.experiments.sweeps.capsule import SweepCapsule
from socialmind.experiments.sweeps.leading import Lead, Progress
from socialmind.experiments.sweeps.preparing import checked_shocks, taken_up
from socialmind.experiments.sweeps.replicates import Replicates, Until
from socialmind.experiments.sweeps.tables.store import Store
from socialmind.runs import folders
from socialmind.runs.folders import FINISHED
from socialmind.work.progress import progress_bar
from socialmind.work.workers import workers_here

if TYPE_CHECKING:
    import pandas as pd

    from socialmind.interventions.shock import Shock
    from socialmind.model import Model


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
    model_class = load_model(model)
    wanted = Until.read(until) if isinstance(until, str) else until
    if not isinstance(seeds, Iterable):
        raise SocialmindError(f"seeds: found {shown(seeds)}; expected several, as range(20)")
    if measures is not None and not isinstance(measures, Mapping):
        raise SocialmindError(
            f"measures: found {shown(measures)}; expected measures by their names"
        )
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
        Lead(capsule, prepared).go(workers, cluster, tell)
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
        store = Store(capsule.folder)
        if capsule.manifest.status == FINISHED:
            store.clear()  # whoever did so before may have been killed half-way
            if not retry:
                return capsule.folder
        store.note_running(())
        prepared = taken_up(capsule, model_class, measures, trust)
        capsule.update(platforms=folders.with_this_machine(capsule.manifest.platforms))
        Lead(capsule, prepared, retry).go(workers, cluster, tell)
    return capsule.folder
