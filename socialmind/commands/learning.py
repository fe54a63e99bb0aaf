"""`socialmind learn`: teaching a mind, with progress, and what came of it."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from socialmind.commands.console import options
from socialmind.commands.console.terminal import quoted
from socialmind.errors import SocialmindError

if TYPE_CHECKING:
    from socialmind.learning.lessons.lesson import Lesson
    from socialmind.learning.training.teaching import Result

RESUMED_WITH = ("attempts", "cycles", "workers", "cluster", "resume", "trust", "quiet")


def learn(
    context: typer.Context,
    model: options.ModelUnlessResumed = None,
    lesson: Annotated[
        list[str] | None,
        typer.Option(
            metavar="NAME|FILE", help="A lesson, a curriculum or a .simbatch file (all lessons)."
        ),
    ] = None,
    attempts: Annotated[
        int | None, typer.Option(**options.FROM_1, help="Independent attempts (1).")
    ] = None,
    mind: Annotated[
        Path | None, typer.Option(metavar="DIR", help="Mind to begin from (the model's).")
    ] = None,
    optimiser: Annotated[
        str | None, typer.Option(metavar="NAME", help="GENETIC, NEAT, ANNEALING or CMAES.")
    ] = None,
    settings: Annotated[
        list[str] | None,
        typer.Option("--set", metavar="NAME=NUMBER", help="Setting of optimisers; may repeat."),
    ] = None,
    generations: Annotated[
        int | None,
        typer.Option(**options.FROM_1, help="Generations of each lesson (the lesson's)."),
    ] = None,
    ticks_budget: Annotated[
        int | None, typer.Option(**options.FROM_1, help="Ticks after which no generation begins.")
    ] = None,
    cycles: Annotated[
        int | None, typer.Option(**options.FROM_1, help="How often lessons in a cycle are taught.")
    ] = None,
    seed: options.Seed = None,
    engine: Annotated[
        str | None, typer.Option(metavar="ENGINE", help="compiled (as by default) or pymunk.")
    ] = None,
    workers: options.Workers = None,
    cluster: Annotated[
        str | None, typer.Option(metavar="ADDRESS", help="Work on a Dask cluster: tcp://HOST:8786.")
    ] = None,
    out: Annotated[
        Path | None,
        typer.Option(metavar="DIR", help="Folder to make (a fresh one under trainings/)."),
    ] = None,
    resume: Annotated[
        Path | None,
        typer.Option(metavar="DIR", help="Go on with a training; --attempts adds attempts."),
    ] = None,
    trust: options.Trust = False,
    quiet: options.Quiet = False,
) -> None:
    """Teach the mind of a model its lessons, or go on with a training."""
    from socialmind.learning.training import execution

    if resume is None:
        if model is None:
            raise SocialmindError("which model? give a name or a folder with a lessons.py")
        with _told(quiet, f"learn {model}") as told:
            folder = execution.learn(
                model, settings=read_settings(settings or []), lessons=lesson, mind=mind,
                attempts=attempts or 1, seed=seed or 0, out=out, engine=engine or "compiled",
                optimiser=optimiser, generations=generations, budget=ticks_budget, cycles=cycles,
                workers=workers, cluster=cluster, **told,
            )  # fmt: skip
    else:
        options.refuse_with_resume(context, "training", RESUMED_WITH)
        with _told(quiet) as told:
            folder = execution.resume(
                resume, attempts=attempts, cycles=cycles, workers=workers, cluster=cluster,
                trust=trust, **told,
            )  # fmt: skip
    conclude(folder, quiet)
    typer.echo(folder)


def read_settings(settings: Sequence[str]) -> dict[str, float]:
    """Return the settings of optimisers from the command line.

    Args:
        settings: ``name=value`` each; of two for one name the later counts.

    Raises:
        SocialmindError: no ``=``, or a value that is no number.
    """
    values = {}
    for setting in settings:
        name, sign, text = (part.strip() for part in setting.partition("="))
        try:
            values[name.replace("-", "_")] = float(text)
        except ValueError:
            sign = ""
        if not sign:
            raise SocialmindError(f"--set {setting}: expected NAME=NUMBER, a setting of optimisers")
    return values


@contextmanager
def _told(quiet: bool, kind: str = "learn") -> Iterator[dict[str, Any]]:
    """Say what happens: a line that changes on a terminal, and a line for each lesson."""
    from socialmind.learning.training.execution import TrainingInterrupted

    try:
        yield {"progress": options.seen(quiet), "on_lesson": None if quiet else _say_result}
    except TrainingInterrupted as stop:
        there = "" if stop.asker is None else ", or from where it was paused"
        command = f"socialmind learn --resume {quoted(stop.folder)}"
        typer.echo(f"socialmind: {stop.where}; go on with `{command}`{there}", err=True)
        raise typer.Exit(128 + stop.signal_number) from None


def _say_result(attempt: int, lesson: Lesson, result: Result) -> None:
    typer.echo(
        f"attempt {attempt}, {lesson.name}: {result.score:.4g} ± {result.deviation:.2g} on "
        f"{lesson.finals} worlds, from generation {result.winner.generation:,} of "
        f"{len(result.rows):,}, {result.ticks:,} ticks",
        err=True,
    )


def conclude(folder: Path, quiet: bool) -> None:
    """Say what was learned, and where the minds are."""
    if quiet:
        return
    from socialmind.learning.training.result import Training
    from socialmind.learning.training.telling import clock

    training = Training(folder)
    results = training.lessons
    for lesson in dict.fromkeys(results["lesson"]):
        scores = results.loc[results["lesson"] == lesson].groupby("attempt")["score"].last()
        told = f"{scores.iloc[0]:.4g}"
        if len(scores) > 1:
            told = f"{scores.mean():.4g} in {len(scores)} attempts, the best {scores.max():.4g}"
            told += f" (attempt {scores.idxmax()})"
        typer.echo(f"{lesson}: {told}", err=True)
    seconds = float(training.manifest.timings["seconds"])
    ticks = int(results["ticks"].sum())
    typer.echo(f"{ticks:,} ticks in {clock(seconds)}; minds in {training.folder}", err=True)
