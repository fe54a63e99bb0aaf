"""`socialmind learn`: teaching a mind, with progress, and what came of it."""

from __future__ import annotations

import sys
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import typer

from socialmind.commands.terminal import quoted
from socialmind.errors import SocialmindError
from socialmind.learning.lessons.lesson import Lesson
from socialmind.learning.training.attempt import News
from socialmind.learning.training.execution import OnGeneration, TrainingInterrupted, learn, resume
from socialmind.learning.training.result import Training
from socialmind.learning.training.teaching import Result


def start(model: str, settings: Sequence[str], quiet: bool, **options: Any) -> Path:
    """Teach a model's mind; the options of `socialmind learn`."""
    with _told(quiet, f"learn {model}") as (on_generation, on_lesson):
        folder = learn(
            model,
            settings=read_settings(settings),
            on_generation=on_generation,
            on_lesson=on_lesson,
            **options,
        )
    conclude(folder, quiet)
    return folder


def go_on(folder: Path, quiet: bool, **options: Any) -> Path:
    """Go on with a training; `socialmind learn --resume`."""
    with _told(quiet) as (on_generation, on_lesson):
        resume(folder, on_generation=on_generation, on_lesson=on_lesson, **options)
    conclude(folder, quiet)
    return Training(folder).folder


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
def _told(quiet: bool, kind: str = "learn") -> Iterator[tuple[OnGeneration | None, Any]]:
    """Say what happens: a line that changes on a terminal, and a line for each lesson."""
    try:
        with _progress_line(quiet, kind) as on_generation:
            yield on_generation, None if quiet else _say_result
    except TrainingInterrupted as stop:
        typer.echo(
            f"socialmind: stopped in attempt {stop.attempt}, {stop.lesson}, after generation "
            f"{stop.generation:,}; go on with `socialmind learn --resume {quoted(stop.folder)}`",
            err=True,
        )
        raise typer.Exit(128 + stop.signal_number) from None


def _say_result(attempt: int, lesson: Lesson, result: Result) -> None:
    typer.echo(
        f"attempt {attempt}, {lesson.name}: {result.score:.4g} ± {result.deviation:.2g} on "
        f"{lesson.finals} worlds, from generation {result.winner.generation:,} of "
        f"{len(result.rows):,}, {result.ticks:,} ticks",
        err=True,
    )


@contextmanager
def _progress_line(quiet: bool, kind: str) -> Iterator[OnGeneration | None]:
    """A line on stderr with scores, ticks a second and the time left, on a terminal."""
    if quiet or not sys.stderr.isatty():
        yield None
        return
    from rich import progress
    from rich.console import Console
    from rich.table import Column

    from socialmind.commands.compiling import told_of_compiling

    with progress.Progress(
        # It wraps where the terminal is narrow: the time left stands at its end.
        progress.TextColumn("{task.description}", markup=False, table_column=Column()),
        console=Console(stderr=True),
        transient=True,
        auto_refresh=False,
    ) as bar:
        task = bar.add_task("")

        def on_generation(news: News, left: float | None) -> None:
            bar.update(task, description=line_of(news, left), refresh=True)

        def say(what: str) -> None:
            bar.update(task, description=what or "learning", refresh=True)

        with told_of_compiling(kind, say):
            yield on_generation


def line_of(news: News, left: float | None) -> str:
    """Return what is said of a generation.

    Args:
        news: of the generation.
        left: the seconds left; None where nobody knows.
    """
    speed = news.ticks / max(news.seconds, 1e-9)
    parts = [
        f"attempt {news.attempt}, {news.lesson.name}",
        f"generation {news.generation:,} of {news.lesson.generations:,}",
        f"best {news.best:.4g}",
        f"mean {news.mean:.4g}",
        f"{speed:,.0f} ticks/s",
    ]
    if left is not None:
        parts.append(f"{clock(left)} left")
    return "  ".join(parts)


def clock(seconds: float) -> str:
    """Return a time as hours, minutes and seconds.

    >>> clock(3725.2)
    '1:02:05'
    """
    minutes, rest = divmod(round(seconds), 60)
    return f"{minutes // 60}:{minutes % 60:02d}:{rest:02d}"


def conclude(folder: Path, quiet: bool) -> None:
    """Say what was learned, and where the minds are."""
    if quiet:
        return
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
