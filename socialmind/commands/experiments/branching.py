"""`socialmind branch`: another future of a run."""

from __future__ import annotations

import os
from typing import Annotated

import typer

from socialmind.commands.console import options
from socialmind.commands.running import by_population, conclude, draw
from socialmind.work.progress import progress_bar


def branch(
    folder: options.Folder,
    at: Annotated[
        int, typer.Option(**options.FROM_0, help="Tick to go back to.", show_default=False)
    ],
    settings: Annotated[
        list[str] | None,
        typer.Option(
            "--set",
            metavar="NAME=VALUE",
            help="A parameter, or of a scheme: [POPULATION.]influence.COGNITON.PLAN=2.",
        ),
    ] = None,
    scheme: Annotated[
        list[str] | None,
        typer.Option(metavar="[POPULATION=]FILE", help="Cognitive scheme from then on."),
    ] = None,
    do: Annotated[
        list[str] | None,
        typer.Option(metavar="FILE.py:FUNCTION", help="Function that changes the society then."),
    ] = None,
    ticks: Annotated[
        int | None, typer.Option(**options.FROM_0, help="Length in all (as the run's).")
    ] = None,
    out: options.Out = None,
    figures: Annotated[bool, typer.Option("--figures", help="Draw the figures as well.")] = False,
    interpreted: Annotated[
        bool, typer.Option("--interpreted", help="Run in plain Python; slow, for debugging.")
    ] = False,
    source: options.Source = None,
    trust: options.Trust = False,
    quiet: options.Quiet = False,
) -> None:
    """Go back to a moment of a run, change something, and go on as a run of its own."""
    from socialmind.interventions.shock import function_in
    from socialmind.runs.branching.branch import branch as make
    from socialmind.society.settings import pair

    os.environ.setdefault("ARROW_DEFAULT_MEMORY_POOL", "system")
    with progress_bar(options.seen(quiet), "ticks", "run") as on_progress:
        made = make(
            folder, at, [pair(one) for one in settings or ()],
            by_population(scheme or [], "--scheme"), [function_in(one) for one in do or ()], ticks,
            out, False if interpreted else None, on_progress=on_progress,
            kept=options.is_kept(source), trust=trust,
        )  # fmt: skip
    conclude(made, quiet)
    if figures:
        draw(made, trust)
    typer.echo(made)
