"""`socialmind fit`: a model fitted to data, with recovery, and going on with a fit."""

from __future__ import annotations

import os
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from socialmind.commands.console import options
from socialmind.commands.console.many_runs import runs_told
from socialmind.commands.console.terminal import quoted
from socialmind.errors import SocialmindError
from socialmind.work.progress import Told

if TYPE_CHECKING:
    from socialmind.experiments.calibration.result import Fit

RESUMED_WITH = ("resume", "workers", "cluster", "trust", "quiet", "interpreted")
SEVERAL = "may be repeated"


def fit(
    context: typer.Context,
    model: options.ModelUnlessResumed = None,
    target: Annotated[
        list[str] | None,
        typer.Option(
            metavar="FILE.csv|NAME=VALUE±ERROR",
            help=f"A series, with a column tick (FILE.csv:NAME,NAME for some columns of it), or a "
            f"statistic (+- will do for ±); statistics {SEVERAL}.",
        ),
    ] = None,
    vary: Annotated[
        list[str] | None,
        typer.Option(
            metavar="NAME=LOW:HIGH",
            help=f"What is to be found, and where; LOW:HIGH:log for a scale of ratios; {SEVERAL}.",
        ),
    ] = None,
    budget: Annotated[
        int | None,
        typer.Option(**options.FROM_1, help="Runs of the fit, and of each recovery."),
    ] = None,
    method: Annotated[
        str | None, typer.Option(metavar="NAME", help="cmaes, tpe, lhs or abc (cmaes).")
    ] = None,
    seeds: Annotated[
        int | None, typer.Option(**options.FROM_1, help="Runs of a trial (5).")
    ] = None,
    ticks: Annotated[
        int | None,
        typer.Option(**options.FROM_0, help="Length of a run (of the series, or the model's)."),
    ] = None,
    measure: Annotated[
        list[str] | None,
        typer.Option(
            metavar="NAME=EXPRESSION", help=f"What a statistic is, as of sweeps; {SEVERAL}."
        ),
    ] = None,
    every: Annotated[
        int | None,
        typer.Option(**options.FROM_1, help="Ticks between two looks at a series, for measures."),
    ] = None,
    settings: Annotated[
        list[str] | None,
        typer.Option("--set", metavar="NAME=VALUE", help=f"Of all runs alike; {SEVERAL}."),
    ] = None,
    recover: Annotated[
        int | None,
        typer.Option(**options.FROM_0, help="Fits to data with known parameters; 0 for none (10)."),
    ] = None,
    data_runs: Annotated[
        int | None,
        typer.Option(
            **options.FROM_1, help="Runs of which such data are the mean (1; statistics 20)."
        ),
    ] = None,
    seed: options.Seed = None,
    out: Annotated[
        Path | None, typer.Option(metavar="DIR", help="Folder to make (a fresh one under fits/).")
    ] = None,
    interpreted: Annotated[
        bool, typer.Option("--interpreted", help="Run in plain Python; slow, for debugging.")
    ] = False,
    workers: options.Workers = None,
    cluster: Annotated[
        str | None, typer.Option(metavar="ADDRESS", help="Scheduler of a Dask cluster.")
    ] = None,
    resume: Annotated[
        Path | None, typer.Option(metavar="DIR", help="Go on with a fit: only what is missing.")
    ] = None,
    trust: options.Trust = False,
    quiet: options.Quiet = False,
) -> None:
    """Fit a model to data, and find out what such data can tell."""
    os.environ.setdefault("ARROW_DEFAULT_MEMORY_POOL", "system")
    from socialmind.experiments.calibration import fit as fitting

    if resume is not None:
        options.refuse_with_resume(context, "fit", RESUMED_WITH)
        if interpreted:
            raise SocialmindError(
                "--resume with --interpreted: a fit keeps its speed; leave it out"
            )
        with _told(quiet) as on_progress:
            found = fitting.resume_fit(
                resume, workers, cluster, on_progress=on_progress, trust=trust
            )
    else:
        from socialmind.catalogue import load_model
        from socialmind.commands.experiments.sweeping import read_fixed
        from socialmind.experiments.calibration.space import read_vary
        from socialmind.experiments.sweeps.measures.of_runs import read_measures
        from socialmind.experiments.sweeps.preparing import nameable

        if model is None:
            raise SocialmindError(
                "which model? give a name (`socialmind list` shows them) or a folder"
            )
        if budget is None:
            raise SocialmindError("how many runs may it take? give --budget, as --budget 1000")
        model_class = load_model(model)
        fixed = read_fixed(settings or [], nameable(model_class))
        others = {"method": method, "seeds": seeds, "recover": recover}
        given: dict[str, Any] = {name: one for name, one in others.items() if one is not None}
        with _told(quiet, f"fit {model}") as on_progress:
            found = fitting.fit(
                model_class, target or [], read_vary(vary or []), budget, ticks, **given,
                data_runs=data_runs, seed=seed or 0, fixed=fixed,
                measures=read_measures(measure or []), every=every, compiled=not interpreted,
                workers=workers, cluster=cluster, out=out, on_progress=on_progress,
                on_begin=None if quiet else lambda lines: typer.echo("\n".join(lines), err=True),
            )  # fmt: skip
    if not quiet:
        _conclude(found)
    typer.echo(found.folder)


def _conclude(found: Fit) -> None:
    """Say what was found, what recovery says of it, and how to run it."""
    from socialmind.text_table import aligned

    manifest, best = found.manifest, found.best
    seconds = max(float(manifest.timings["seconds"]), 1e-9)
    pace = manifest.runs / seconds
    runs = "run" if manifest.runs == 1 else "runs"
    typer.echo(f"{manifest.runs:,} {runs} in {seconds:,.1f} s, {pace:,.1f} a second", err=True)
    rows = [["", "found", "interval", "the data tell it"]]
    for row in found.parameters.to_dict("records"):
        interval = f"{row['low']:.4g} … {row['high']:.4g}" if row["low"] == row["low"] else "none"
        rows.append([row["parameter"], f"{row['found']:.6g}", interval, row["verdict"]])
    for line in aligned(rows):
        typer.echo(line, err=True)
    if not manifest.recover:
        typer.echo("nobody knows whether such data tell these: --recover 0", err=True)
    folder = quoted(found.folder)
    typer.echo(f"report: {folder}/report.md\nto run it: cd {folder} && {best['run']}", err=True)


@contextmanager
def _told(quiet: bool, kind: str = "fit") -> Iterator[Told | None]:
    """Show how far a fit has come, and say how to go on with one that is stopped."""
    from socialmind.experiments.calibration.leading import FitInterrupted

    with runs_told("fit", quiet, kind, FitInterrupted) as on_progress:
        yield on_progress
