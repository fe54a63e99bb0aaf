"""Fitting a model to data into a folder, and going on with it."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from socialmind.catalogue import load_model
from socialmind.experiments.calibration.capsule import FitCapsule
from socialmind.experiments.calibration.leading import Lead, Progress
from socialmind.experiments.calibration.log import Log
from socialmind.experiments.calibration.plan import RECOVERIES
from socialmind.experiments.calibration.preparing import Asked, begun, taken_up_from
from socialmind.experiments.calibration.result import Fit
from socialmind.experiments.calibration.space import Range
from socialmind.runs import folders
from socialmind.runs.folders import FINISHED
from socialmind.work.progress import progress_bar
from socialmind.work.workers import workers_here

if TYPE_CHECKING:
    import pandas as pd

    from socialmind.model import Model


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
    progress: bool | None = None,
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
        progress: whether a bar is drawn; by default in notebooks and on terminals, unless
            `on_progress` is given.

    Returns:
        The fit.

    Raises:
        SocialmindError: an unknown name, a range or target that cannot be, a folder in use, no
            room, or no trial that came to its end.
        FitInterrupted: Ctrl-C; what was done is safe, `resume_fit` goes on.
    """
    model_class = load_model(model)
    if cluster is None:
        workers_here(workers)
    asked = Asked(
        target, vary, budget, ticks, method, seeds, recover, data_runs, seed, fixed or {},
        measures or {}, every, compiled,
    )  # fmt: skip
    capsule, notes = begun(model_class, asked, out)
    if on_begin is not None:
        on_begin(notes)
    kind = f"fit {model_class.name}"
    with capsule.locked(), progress_bar(progress, "runs", kind, on_progress) as tell:
        prepared = taken_up_from(capsule, model_class, measures)
        Lead(capsule, prepared).go(workers, cluster, tell)
    return Fit(capsule.folder)


def resume_fit(
    folder: str | Path,
    workers: int | None = None,
    cluster: str | None = None,
    model_class: type[Model] | None = None,
    measures: Mapping[str, Any] | None = None,
    on_progress: Progress | None = None,
    trust: bool = False,
    progress: bool | None = None,
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
        progress: as for `fit`.

    Returns:
        The fit.

    Raises:
        SocialmindError: no fit's folder, in use, or its model or a copy was changed since.
        FitInterrupted: Ctrl-C; what was done is safe.
    """
    capsule = FitCapsule(folder)
    with capsule.locked(), progress_bar(progress, "runs", "fit", on_progress) as tell:
        if capsule.manifest.status != FINISHED:
            prepared = taken_up_from(capsule, model_class, measures, trust)
            capsule.update(platforms=folders.with_this_machine(capsule.manifest.platforms))
            Lead(capsule, prepared).go(workers, cluster, tell)
        Log(capsule.folder).clear()
    return Fit(capsule.folder)
