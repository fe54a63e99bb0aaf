"""`socialmind run`, `plot` and `replay`: running and drawing, with progress and warnings."""

from __future__ import annotations

import os
import sys
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING

import typer

from socialmind.catalogue import load_model
from socialmind.errors import SocialmindError, nearest
from socialmind.runs import execution
from socialmind.runs.capsule import Capsule

if TYPE_CHECKING:
    from socialmind.model import Model
    from socialmind.runs.execution import Progress

Value = float | int | bool | str


def start(
    model: str,
    ticks: int | None,
    seed: int,
    settings: Sequence[str],
    schemes: Sequence[str],
    minds: Sequence[str],
    every: int | None,
    agents_every: int | None,
    out: Path | None,
    compiled: bool,
    quiet: bool,
    engine: str = "compiled",
) -> Path:
    """Run a model into a folder; the options of `socialmind run`."""
    _save_memory()
    model_class = load_model(model)
    parameters = read_settings(model_class, settings)
    scheme, mind = by_population(schemes, "--scheme"), by_population(minds, "--mind")
    with progress_bar(quiet, f"run {model}") as on_progress:
        folder = execution.run(
            model_class, ticks, seed, parameters, scheme, mind, every, agents_every, out, compiled,
            on_progress, engine=engine,
        )  # fmt: skip
    _conclude(folder, quiet)
    return folder


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


def go_on(
    folder: Path,
    ticks: int | None,
    compiled: bool | None,
    quiet: bool,
    kept: bool = False,
    trust: bool = False,
) -> Path:
    """Go on with a run; `socialmind run --resume`."""
    _save_memory()
    with progress_bar(quiet) as on_progress:
        folder = execution.resume(
            folder, ticks, compiled, on_progress=on_progress, kept=kept, trust=trust
        )
    _conclude(folder, quiet)
    return folder


def draw(folder: Path, trust: bool = False) -> list[Path]:
    """Draw a run's figures without a window; gives the files."""
    # A model's figures.py may use pyplot, which looks for a screen unless told not to.
    os.environ["MPLBACKEND"] = "Agg"
    from socialmind.runs.figures import draw_figures

    return draw_figures(folder, trust)


def again(folder: Path, quiet: bool, kept: bool = False, trust: bool = False) -> bool:
    """Replay a run and say what comes out; True when it is equal."""
    from socialmind.runs.verification import replay

    with progress_bar(quiet) as on_progress:
        found = replay(folder, on_progress=on_progress, kept=kept, trust=trust)
    for note in found.notes:
        typer.echo(f"note: {note}", err=True)
    for difference in found.differences:
        typer.echo(f"different: {difference}")
    if found.equal:
        typer.echo("equal" if found.exact else "equal within 1e-6 (another platform)")
    return found.equal


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


@contextmanager
def progress_bar(quiet: bool, kind: str = "run") -> Iterator[Progress | None]:
    """A bar on stderr with ticks a second and the time left, where stderr is a terminal.

    Args:
        quiet: show none.
        kind: what runs, by which the time that compiling takes is remembered.
    """
    if quiet or not sys.stderr.isatty():
        yield None
        return
    from rich import progress
    from rich.console import Console

    from socialmind.commands.compiling import told_of_compiling

    with progress.Progress(
        progress.TextColumn("{task.completed:,.0f} of {task.total:,.0f} ticks"),
        progress.BarColumn(),
        progress.TaskProgressColumn(),
        progress.TextColumn("{task.fields[pace]}"),
        progress.TimeRemainingColumn(),
        progress.TextColumn("{task.description}"),
        console=Console(stderr=True),
        transient=True,
        auto_refresh=False,
    ) as bar:
        task = bar.add_task("", total=1, pace="", start=False)

        def say(what: str) -> None:
            bar.update(task, description=what, refresh=True)

        def on_progress(done: int, length: int) -> None:
            if not bar.tasks[task].started:
                bar.start_task(task)
                bar.update(task, completed=done)
            speed = bar.tasks[task].finished_speed or bar.tasks[task].speed
            pace = f"{speed:,.0f} ticks/s" if speed else ""
            bar.update(task, total=length, completed=done, pace=pace, refresh=True)

        with told_of_compiling(kind, say):
            yield on_progress


def _save_memory() -> None:
    """Let Arrow give memory back, rather than keep it for the next table of a large society."""
    os.environ.setdefault("ARROW_DEFAULT_MEMORY_POOL", "system")


def _conclude(folder: Path, quiet: bool) -> None:
    """Say how long the run took, and warn of agents that found nothing to do."""
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
