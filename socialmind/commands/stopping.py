"""What a stopped command says."""

from __future__ import annotations

import typer

from socialmind.commands.terminal import quoted

CTRL_C = 130


def exit_code_of_stop(stop: KeyboardInterrupt) -> int:
    """Say how to go on with a stopped run, and give the exit code of a program stopped so."""
    from socialmind.experiments.execution import Interrupted

    if not isinstance(stop, Interrupted):
        typer.echo("socialmind: stopped", err=True)
        return CTRL_C
    typer.echo(
        f"socialmind: stopped at tick {stop.tick:,}; go on with "
        f"`socialmind run --resume {quoted(stop.folder)}`",
        err=True,
    )
    return 128 + stop.signal_number
