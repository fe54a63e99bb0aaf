"""`socialmind sweep`: a model over a design, and going on with a sweep."""

from __future__ import annotations

import os
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from socialmind.commands.console import options
from socialmind.commands.console.many_runs import runs_told
from socialmind.commands.console.terminal import quoted
from socialmind.commands.running import shocks_in
from socialmind.errors import SocialmindError
from socialmind.work.progress import Told

if TYPE_CHECKING:
    import pandas as pd

    from socialmind.experiments.sweeps.points.varied import Nameable, Varied

RESUMED_WITH = ("resume", "retry", "workers", "cluster", "trust", "quiet")
SEVERAL = "may be repeated"


def sweep(
    context: typer.Context,
    model: options.ModelUnlessResumed = None,
    grid: Annotated[
        list[str] | None,
        typer.Option(metavar="NAME=V1,V2,…", help=f"Values, all combined; {SEVERAL}."),
    ] = None,
    sample: Annotated[
        str | None,
        typer.Option(
            metavar="DESIGN:SIZE",
            help="lhs, sobol, halton; saltelli, morris, fast for sensitivity.",
        ),
    ] = None,
    design: Annotated[
        Path | None, typer.Option(metavar="FILE.csv", help="Points, a line each.")
    ] = None,
    ranges: Annotated[
        list[str] | None,
        typer.Option(metavar="NAME=LOW:HIGH", help=f"What --sample varies, and where; {SEVERAL}."),
    ] = None,
    settings: Annotated[
        list[str] | None,
        typer.Option("--set", metavar="NAME=VALUE", help=f"Of all runs alike; {SEVERAL}."),
    ] = None,
    seeds: Annotated[
        str | None, typer.Option(metavar="A:B", help="A seed for each replicate, A … B − 1 (0:1).")
    ] = None,
    common: Annotated[
        bool, typer.Option("--common", help="Replicate r has the r-th seed at every point.")
    ] = False,
    ticks: Annotated[
        int | None, typer.Option(**options.FROM_0, help="Length of a run (the model's).")
    ] = None,
    out: Annotated[
        Path | None, typer.Option(metavar="DIR", help="Folder to make (a fresh one under sweeps/).")
    ] = None,
    every: Annotated[
        int | None,
        typer.Option(
            **options.FROM_0, help="Ticks between two rows of a series (100 rows); 0 for none."
        ),
    ] = None,
    agents: Annotated[
        str, typer.Option(metavar="none|last|K", help="Records of agents: none, at the end, …")
    ] = "none",
    measure: Annotated[
        list[str] | None,
        typer.Option(
            metavar="NAME=EXPRESSION",
            help=f"As settled=mean(farmers[-100:]), or NAME=FILE.py:FUNCTION; {SEVERAL}.",
        ),
    ] = None,
    shock: Annotated[
        list[str] | None,
        typer.Option(
            metavar="TICK:FILE.py:FUNCTION",
            help=f"Function that changes the society of every run at a tick; {SEVERAL}.",
        ),
    ] = None,
    timeout: Annotated[
        float | None, typer.Option(metavar="SECONDS", help="How long a run may take.")
    ] = None,
    until: Annotated[
        str | None,
        typer.Option(
            metavar="WIDTH:MEASURE",
            help="Add replicates until the 95 % interval is ± WIDTH, or WIDTH%.",
        ),
    ] = None,
    at_most: Annotated[
        int | None, typer.Option(**options.FROM_1, help="Replicates at a point, with --until.")
    ] = None,
    interpreted: Annotated[
        bool, typer.Option("--interpreted", help="Run in plain Python; slow, for debugging.")
    ] = False,
    workers: options.Workers = None,
    cluster: Annotated[
        str | None, typer.Option(metavar="ADDRESS", help="Scheduler of a Dask cluster.")
    ] = None,
    resume: Annotated[
        Path | None, typer.Option(metavar="DIR", help="Go on with a sweep: only what is missing.")
    ] = None,
    retry: Annotated[
        bool, typer.Option("--retry", help="With --resume: runs that failed are done again.")
    ] = False,
    trust: options.Trust = False,
    quiet: options.Quiet = False,
) -> None:
    """Run a model at many points, with replicates, into one folder."""
    os.environ.setdefault("ARROW_DEFAULT_MEMORY_POOL", "system")
    from socialmind.experiments.sweeps import sweep as sweeping

    if resume is not None:
        options.refuse_with_resume(context, "sweep", (*RESUMED_WITH, *_unset(context)))
        with _told(quiet) as on_progress:
            folder = sweeping.resume_sweep(
                resume, retry, workers, cluster, on_progress=on_progress, trust=trust
            )
    else:
        from socialmind.catalogue import load_model
        from socialmind.experiments.sweeps.measures.of_runs import read_measures
        from socialmind.experiments.sweeps.preparing import nameable
        from socialmind.experiments.sweeps.replicates import read_seeds

        if model is None:
            raise SocialmindError(
                "which model? give a name (`socialmind list` shows them) or a folder"
            )
        if retry:
            raise SocialmindError("--retry is for --resume: a new sweep has nothing to do again")
        model_class = load_model(model)
        there = nameable(model_class)
        fixed = read_fixed(settings or [], there)
        points = read_design(grid or [], sample, design, ranges or [], there)
        shocks = shocks_in(shock or [])
        with _told(quiet, f"sweep {model}") as on_progress:
            folder = sweeping.sweep(
                model_class, points, ticks, read_seeds(seeds or "0:1"), common=common,
                fixed=fixed, measures=read_measures(measure or []), every=every, agents=agents,
                until=until, at_most=at_most or 0, timeout=timeout, compiled=not interpreted,
                shocks=shocks,
                workers=workers, cluster=cluster, out=out, on_progress=on_progress,
                on_begin=None if quiet else _say,
            )  # fmt: skip
    conclude(folder, quiet)
    typer.echo(folder)


def read_design(
    grid: Sequence[str],
    sample: str | None,
    file: Path | None,
    ranges: Sequence[str],
    there: Nameable,
) -> pd.DataFrame | Path | None:
    """Return the design that options name: a table, a file, or None where nothing varies.

    Raises:
        SocialmindError: they do not go together, or name what there is not.
    """
    from socialmind.experiments import designs

    given = [
        name for name, one in {"--grid": grid, "--sample": sample, "--design": file}.items() if one
    ]
    if len(given) > 1:
        raise SocialmindError(
            f"{' and '.join(given)}: give one of them; a file can hold any points: --design"
        )
    if ranges and sample is None:
        raise SocialmindError("--ranges is for --sample; leave it out, or say which: lhs:200")
    if file is not None:
        return file
    if grid:
        return designs.grid(read_grid(grid, there))
    if sample is None:
        return None
    name, _, size = sample.partition(":")
    sampler = designs.sampler_called(name)
    if not size.isdecimal():
        raise SocialmindError(f"--sample {sample}: expected {name}:SIZE, as {name}:256")
    bounds, whole = read_ranges(ranges, there)
    return sampler.make(bounds, int(size), whole=whole)


def read_grid(texts: Sequence[str], there: Nameable) -> dict[str, list[Any]]:
    """Return the values of each name of `--grid`.

    Raises:
        SocialmindError: an unknown name, one that stands twice, or values that cannot be.
    """
    found: dict[str, list[Any]] = {}
    for text in texts:
        one, said = _named("--grid", text, there, "NAME=V1,V2,…")
        if one.name in found:
            raise SocialmindError(f"--grid {one.name}: stands twice; give all its values at once")
        values = [one.read(part.strip()) for part in said.split(",")]
        if len(set(values)) < len(values):
            raise SocialmindError(f"--grid {text}: a value stands twice; give each once")
        found[one.name] = values
    return found


def read_ranges(
    texts: Sequence[str], there: Nameable
) -> tuple[dict[str, tuple[float, float]], list[str]]:
    """Return the ranges of what `--sample` varies, and which of these are whole numbers.

    Without any all parameters vary that have a lower and an upper border.

    Raises:
        SocialmindError: an unknown name, no range, or one beyond what is declared.
    """
    bounds: dict[str, tuple[float, float]] = {}
    whole = []
    for text in texts:
        one, said = _named("--ranges", text, there, "NAME=LOW:HIGH", bare=True)
        if one.name in bounds:
            raise SocialmindError(f"--ranges {one.name}: stands twice; give it once")
        if said:
            low, colon, high = said.partition(":")
            try:
                ends = float(low), float(high)
            except ValueError:
                colon = ""
                ends = 0.0, 0.0
            if not colon:
                raise SocialmindError(f"--ranges {text}: expected {one.name}=LOW:HIGH")
            if one.parameter is not None and one.parameter.kind not in (int, float):
                one.bounds()  # which says what to write instead
            for end in ends:
                one.checked(int(end) if one.whole and end == int(end) else end)
            bounds[one.name] = ends
        else:
            bounds[one.name] = one.bounds()
        if one.whole:
            whole.append(one.name)
    if not bounds:
        parameters = there.model_class.parameters
        for name, parameter in parameters.items():
            if parameter.low is not None and parameter.high is not None:
                bounds[name] = parameter.low, parameter.high
                if parameter.kind is int:
                    whole.append(name)
    if not bounds:
        raise SocialmindError(
            f"--sample: no parameter of {there.model_class.name} has both borders declared; give "
            "--ranges NAME=LOW:HIGH"
        )
    return bounds, whole


def read_fixed(texts: Sequence[str], there: Nameable) -> dict[str, Any]:
    """Return what `--set` sets; of two for one name the later counts."""
    found = {}
    for text in texts:
        one, said = _named("--set", text, there, "NAME=VALUE")
        found[one.name] = one.read(said)
    return found


def _named(
    option: str, text: str, there: Nameable, form: str, bare: bool = False
) -> tuple[Varied, str]:
    name, equals, said = (part.strip() for part in text.partition("="))
    if not name or ((not equals or not said) and not bare):
        raise SocialmindError(f"{option} {text}: expected {form}")
    return there.called(name), said


def _unset(context: typer.Context) -> list[str]:
    """Return the parameters that have their defaults."""
    defaults = {"agents": "none", "common": False, "interpreted": False}
    return [name for name, value in defaults.items() if context.params[name] == value]


def _say(lines: Sequence[str]) -> None:
    for line in lines:
        typer.echo(line, err=True)


@contextmanager
def _told(quiet: bool, kind: str = "sweep") -> Iterator[Told | None]:
    """Show how far a sweep has come, and say how to go on with one that is stopped."""
    from socialmind.experiments.sweeps.leading import SweepInterrupted

    with runs_told("sweep", quiet, kind, SweepInterrupted) as on_progress:
        yield on_progress


def conclude(folder: Path, quiet: bool) -> None:
    """Say how many runs there are, how long they took, and what failed."""
    from socialmind.experiments.sweeps.capsule import SweepCapsule

    if quiet:
        return
    manifest = SweepCapsule(folder).manifest
    total = sum(manifest.counts.values())
    seconds = max(float(manifest.timings["seconds"]), 1e-9)
    runs = "run" if total == 1 else "runs"
    typer.echo(f"{total:,} {runs} in {seconds:,.1f} s, {total / seconds:,.1f} a second", err=True)
    odd = {status: n for status, n in manifest.counts.items() if status != "finished"}
    if odd:
        what = ", ".join(f"{n:,} {status.replace('_', ' ')}" for status, n in odd.items())
        typer.echo(
            f"{what}: the column error of runs.parquet says why; once that is mended, "
            f"`socialmind sweep --resume {quoted(folder)} --retry`",
            err=True,
        )
