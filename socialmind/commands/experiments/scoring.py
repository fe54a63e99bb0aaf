"""`socialmind score`: how well minds do in worlds that no training has seen."""

from __future__ import annotations

import json
import sys
from typing import TYPE_CHECKING, Annotated

import typer

from socialmind.commands.console import options
from socialmind.commands.running import by_population, read_settings
from socialmind.work.progress import progress_bar

if TYPE_CHECKING:
    from socialmind.experiments.scoring import Score


def score(
    model: options.Model,
    mind: options.Minds = None,
    episodes: Annotated[
        int, typer.Option(**options.FROM_1, help="How many, each in its own world.")
    ] = 100,
    seed: Annotated[int, typer.Option(**options.SEED, help="Seed of the worlds.")] = 0,
    engine: Annotated[
        str, typer.Option(metavar="ENGINE", help="compiled or pymunk, the reference.")
    ] = "compiled",
    on_collision: Annotated[
        str | None,
        typer.Option(metavar="end|continue", help="Whether a collision ends a run (the model's)."),
    ] = None,
    ticks: Annotated[
        int | None, typer.Option(**options.FROM_1, help="Limit of an episode (the model's).")
    ] = None,
    settings: options.Parameters = None,
    workers: options.Workers = None,
    as_json: Annotated[bool, typer.Option("--json", help="Print JSON instead of a table.")] = False,
    quiet: options.Quiet = False,
) -> None:
    """Measure a model's minds in worlds that no training has seen, with intervals of 95 %."""
    from socialmind.catalogue import load_model
    from socialmind.experiments import scoring

    model_class = load_model(model)
    parameters = read_settings(model_class, settings or [])
    minds = by_population(mind or [], "--mind")
    with progress_bar(options.seen(quiet), "episodes", f"score {model}") as on_progress:
        found = scoring.score(
            model_class, minds, episodes, seed, engine, on_collision, ticks, parameters, workers,
            on_progress,
        )  # fmt: skip
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
