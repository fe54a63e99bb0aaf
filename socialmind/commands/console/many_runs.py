"""What a command says that makes many runs: how many are done, and how it goes on when stopped."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import typer

from socialmind.commands.console.options import seen
from socialmind.commands.console.terminal import quoted
from socialmind.work.progress import Told, progress_bar


@contextmanager
def runs_told(command: str, quiet: bool, kind: str, stopped: type[Any]) -> Iterator[Told | None]:
    """Show how many runs are done, and say how to go on with what is stopped.

    Args:
        command: that goes on with `--resume`.
        quiet: show nothing.
        kind: what runs, by which the time that compiling takes is remembered.
        stopped: what is raised, with `done`, `total`, `folder` and `signal_number`.
    """
    try:
        with progress_bar(seen(quiet), "runs", kind) as on_progress:
            yield on_progress
    except stopped as stop:
        typer.echo(
            f"socialmind: stopped after {stop.done:,} of {stop.total:,} runs; go on with "
            f"`socialmind {command} --resume {quoted(stop.folder)}`",
            err=True,
        )
        raise typer.Exit(128 + stop.signal_number) from None
