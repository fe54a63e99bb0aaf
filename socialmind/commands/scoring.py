"""`socialmind score`: how well minds do in worlds that no training has seen."""

from __future__ import annotations

import json
import sys
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from typing import Any

import typer

from socialmind.catalogue import load_model
from socialmind.commands.running import by_population, read_settings
from socialmind.experiments.scoring import Progress, Score, score


def print_score(
    model: str,
    minds: Sequence[str],
    settings: Sequence[str],
    as_json: bool,
    quiet: bool,
    **options: Any,
) -> None:
    """Score a model and print it; the options of `socialmind score`.

    Args:
        model: its name or folder.
        minds: minds in place of the model's own, as `--mind` gives them.
        settings: values of parameters, as `--set` gives them.
        as_json: print JSON, and nothing else, in place of a table.
        quiet: show no progress.
        options: of `socialmind.experiments.score`.
    """
    model_class = load_model(model)
    parameters = read_settings(model_class, settings)
    mind = by_population(minds, "--mind")
    with _progress_bar(quiet, f"score {model}") as on_progress:
        found = score(model_class, mind, parameters=parameters, on_progress=on_progress, **options)
    if as_json:
        typer.echo(json.dumps(found.record()))
    else:
        _print_table(found)


def _print_table(found: Score) -> None:
    from rich.box import SIMPLE_HEAD
    from rich.console import Console
    from rich.table import Table

    table = Table(box=SIMPLE_HEAD, title=f"{found.model}, {found.episodes:,} episodes")
    table.add_column("measure")
    for column in ("mean", "95 % interval"):
        table.add_column(column, justify="right")
    for name, one in found.intervals.items():
        # NaN is unlike itself: one episode has no interval.
        between = f"{_number(one.low)} … {_number(one.high)}" if one.low == one.low else "–"
        table.add_row(name, _number(one.mean), between)
    table.caption = f"{found.ticks:,} ticks"
    console = Console(file=sys.stdout)
    with console.capture() as shown:  # written by itself it would end the program where a pipe does
        console.print(table)
    typer.echo(shown.get(), nl=False)


def _number(value: float) -> str:
    """Return a number as a table shows it; NaN where there is none.

    >>> _number(8.256), _number(0.9), _number(1234.5), _number(float("nan"))
    ('8.26', '0.90', '1,234.50', '–')
    """
    return f"{value:,.2f}" if value == value else "–"


@contextmanager
def _progress_bar(quiet: bool, kind: str) -> Iterator[Progress | None]:
    """A bar on stderr, where that is a terminal."""
    if quiet or not sys.stderr.isatty():
        yield None
        return
    from rich import progress
    from rich.console import Console

    from socialmind.commands.compiling import told_of_compiling

    with progress.Progress(
        progress.TextColumn("{task.completed:,.0f} of {task.total:,.0f} episodes"),
        progress.BarColumn(),
        progress.TimeRemainingColumn(),
        progress.TextColumn("{task.description}"),
        console=Console(stderr=True),
        transient=True,
    ) as bar:
        task = bar.add_task("", total=None)

        def say(what: str) -> None:
            bar.update(task, description=what, refresh=True)

        with told_of_compiling(kind, say):
            yield lambda done, count: bar.update(task, completed=done, total=count)
