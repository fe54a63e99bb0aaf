"""`socialmind run` and `replay`: running, with progress and warnings."""

from __future__ import annotations

import os
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from socialmind.commands.console import options
from socialmind.commands.importing import imported_for_run, names_metaciv
from socialmind.errors import SocialmindError, nearest
from socialmind.work.progress import progress_bar

if TYPE_CHECKING:
    from socialmind.interventions.shock import Shock
    from socialmind.model import Model

Value = float | int | bool | str

MADE_AGAIN_WITH = ("from_sweep", "number", "out", "figures", "interpreted", "trust", "quiet")
RESUMED_WITH = ("ticks", "figures", "interpreted", "resume", "source", "trust", "quiet")


def run(
    context: typer.Context,
    model: options.ModelUnlessResumed = None,
    ticks: Annotated[int | None, typer.Option(**options.FROM_0, help="Length of the run.")] = None,
    seed: options.Seed = None,
    settings: options.Parameters = None,
    scheme: Annotated[
        list[str] | None,
        typer.Option(metavar="[POPULATION=]FILE", help="Cognitive scheme in place of the model's."),
    ] = None,
    mind: options.Minds = None,
    every: Annotated[
        int | None,
        typer.Option(**options.FROM_1, help="Ticks between two rows of the series (500 rows)."),
    ] = None,
    agents_every: Annotated[
        int | None, typer.Option(**options.FROM_1, help="Ticks between two records of the agents.")
    ] = None,
    out: options.Out = None,
    shock: Annotated[
        list[str] | None,
        typer.Option(
            metavar="TICK:FILE.py:FUNCTION", help="Function that changes the society at a tick."
        ),
    ] = None,
    figures: Annotated[bool, typer.Option("--figures", help="Draw the figures as well.")] = False,
    interpreted: Annotated[
        bool, typer.Option("--interpreted", help="Run in plain Python; slow, for debugging.")
    ] = False,
    engine: Annotated[
        str | None,
        typer.Option(
            metavar="NAME", help="What moves bodies on a plane: compiled or pymunk (compiled)."
        ),
    ] = None,
    links: Annotated[
        bool | None,
        typer.Option(
            "--links/--no-links", help="Whether links are recorded too (as the model says)."
        ),
    ] = None,
    events: Annotated[
        bool | None,
        typer.Option("--events/--no-events", help="Whether births and deaths are (they are)."),
    ] = None,
    resume: Annotated[
        Path | None,
        typer.Option(metavar="DIR", help="Go on with a run; --ticks makes a finished one longer."),
    ] = None,
    from_sweep: Annotated[
        Path | None, typer.Option(metavar="DIR", help="Make a run of a sweep again: see --number.")
    ] = None,
    number: Annotated[
        int | None, typer.Option(**options.FROM_0, help="Its number, the column `run`.")
    ] = None,
    source: options.Source = None,
    trust: options.Trust = False,
    quiet: options.Quiet = False,
) -> None:
    """Run a model into a folder, or go on with a run."""
    from socialmind.runs import execution

    # Let Arrow give memory back, rather than keep it for the next table of a large society.
    os.environ.setdefault("ARROW_DEFAULT_MEMORY_POOL", "system")
    if (from_sweep is None) != (number is None):
        raise SocialmindError("--from-sweep DIR and --number N go together; give both")
    if from_sweep is not None and number is not None:
        options.refuse_beside(context, "--from-sweep", "run of a sweep", MADE_AGAIN_WITH)
        from socialmind.experiments.sweeps.remaking import remake_run

        with progress_bar(options.seen(quiet), "ticks", "run") as on_progress:
            folder = remake_run(
                from_sweep, number, out, False if interpreted else None, on_progress=on_progress,
                trust=trust,
            )  # fmt: skip
    elif resume is None:
        if model is None:
            raise SocialmindError(
                "which model? give a name (`socialmind list` shows them) or a folder"
            )
        if source is not None:
            raise SocialmindError("--source is for --resume: a new run has no copies yet")
        shocks = shocks_in(shock or [])
        schemes = by_population(scheme or [], "--scheme")
        minds = by_population(mind or [], "--mind")
        with _model_and_folder(model, out, quiet) as (model_class, place):
            parameters = read_settings(model_class, settings or [])
            with progress_bar(options.seen(quiet), "ticks", f"run {model}") as on_progress:
                folder = execution.run(
                    model_class, ticks, seed or 0, parameters, schemes, minds, every, agents_every,
                    place, not interpreted, on_progress, engine=engine or "compiled",
                    links=links, events=events, interventions=shocks,
                )  # fmt: skip
    else:
        options.refuse_with_resume(context, "run", RESUMED_WITH)
        with progress_bar(options.seen(quiet), "ticks", "run") as on_progress:
            folder = execution.resume(
                resume, ticks, False if interpreted else None, on_progress=on_progress,
                kept=options.is_kept(source), trust=trust,
            )  # fmt: skip
    conclude(folder, quiet)
    if figures:
        draw(folder, trust)
    typer.echo(folder)


@contextmanager
def _model_and_folder(
    model: str, out: Path | None, quiet: bool
) -> Iterator[tuple[type[Model], Path | None]]:
    """Give the class of a model and where its run goes; one of MetaCiv's is written there first."""
    from socialmind.catalogue import load_model
    from socialmind.runs.folders import OWN_MODEL

    if not names_metaciv(model):
        yield load_model(model), out
        return
    with imported_for_run(model, out, quiet) as folder:
        yield load_model(folder / OWN_MODEL), folder


def replay(
    folder: options.Folder,
    source: options.Source = None,
    trust: options.Trust = False,
    quiet: options.Quiet = False,
) -> None:
    """Run a run again and compare: exit code 0 when it comes out equal, 1 when not."""
    from socialmind.runs import verification

    with progress_bar(options.seen(quiet), "ticks", "run") as on_progress:
        found = verification.replay(
            folder, on_progress=on_progress, kept=options.is_kept(source), trust=trust
        )
    for note in found.notes:
        typer.echo(f"note: {note}", err=True)
    for difference in found.differences:
        typer.echo(f"different: {difference}")
    if not found.equal:
        raise typer.Exit(1)
    typer.echo("equal" if found.exact else "equal within 1e-6 (another platform)")


def draw(folder: Path, trust: bool = False) -> list[Path]:
    """Draw a run's figures without a window; gives the files."""
    # A model's figures.py may use pyplot, which looks for a screen unless told not to.
    os.environ["MPLBACKEND"] = "Agg"
    from socialmind.runs.figures import draw_figures

    return draw_figures(folder, trust)


def by_population(values: Sequence[str], option: str) -> Path | dict[str, Path] | None:
    """Return the files that an option names: one for the model, or one for each population.

    Args:
        values: `FILE`, or `POPULATION=FILE` as often as there are populations.
        option: the option, for errors.

    Raises:
        SocialmindError: there is no such file, or several without populations.
    """
    named: dict[str, Path] = {}
    for value in values:
        population, sign, file = value.partition("=")
        alone = not sign or Path(value).exists()
        path = Path(value if alone else file)
        if not path.exists():
            raise SocialmindError(f"{path}: no such file or folder")
        if alone and len(values) == 1:
            return path
        if alone or population in named:
            raise SocialmindError(
                f"{option} {value}: one of several; write {option} POPULATION={path}, each once"
            )
        named[population] = path
    return named or None


def read_settings(model_class: type[Model], settings: Sequence[str]) -> dict[str, Value]:
    """Parameters from the command line.

    Args:
        model_class: the model.
        settings: ``name=value`` each; of two for one name the later counts.

    Raises:
        SocialmindError: no ``=``, an unknown name, or a value that the parameter cannot take.
    """
    known = model_class.parameters
    values = {}
    for setting in settings:
        name, equals, text = (part.strip() for part in setting.partition("="))
        if not equals:
            raise SocialmindError(f"--set {setting}: expected NAME=VALUE")
        name = name.replace("-", "_")
        if name not in known:
            raise SocialmindError(f"no parameter called {name}; {nearest(name, known)}")
        values[name] = known[name].read(text)
    return values


def shocks_in(texts: Sequence[str]) -> list[Shock]:
    """Return the shocks that `--shock` names."""
    if not texts:
        return []
    from socialmind.interventions.shock import Shock

    return [Shock.parsed(one) for one in texts]


def conclude(folder: Path, quiet: bool) -> None:
    """Say how long the run took, and warn of agents that found nothing to do."""
    from socialmind.runs.capsule import Capsule

    manifest = Capsule(folder).manifest
    if not quiet:
        seconds = manifest.timings["seconds"]
        typer.echo(f"{manifest.ticks_done:,} ticks in {seconds:.1f} s", err=True)
    count = manifest.idle.get("count") or 0
    if count:
        typer.echo(
            f"warning: {count:,} times an agent found no available plan and did nothing, first "
            f"agent {manifest.idle['first_agent']} at tick {manifest.idle['first_tick']}; "
            "`socialmind explain` shows why",
            err=True,
        )
