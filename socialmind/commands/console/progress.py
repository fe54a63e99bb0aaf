"""Bars and lines on stderr that say how far a command has come, where that is a terminal."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from rich.progress import Progress

Told = Callable[[int, int], None]
"""Is given what is done, and how much there is."""


@contextmanager
def progress_bar(quiet: bool, kind: str = "run", unit: str = "ticks") -> Iterator[Told | None]:
    """A bar with what is done a second and the time left.

    Args:
        quiet: show none.
        kind: what runs, by which the time that compiling takes is remembered.
        unit: what is counted.
    """
    with _on_terminal(quiet, kind, _columns(unit), total=1, pace="", start=False) as bar:
        if bar is None:
            yield None
            return
        (task,) = bar.tasks

        def tell(done: int, length: int) -> None:
            if not task.started:
                bar.start_task(task.id)
                bar.update(task.id, completed=done)
            speed = task.finished_speed or task.speed
            pace = f"{speed:,.0f} {unit}/s" if speed else ""
            bar.update(task.id, total=length, completed=done, pace=pace, refresh=True)

        yield tell


@contextmanager
def progress_line(quiet: bool, kind: str, idle: str) -> Iterator[Callable[[str], None] | None]:
    """A line of words that change.

    Args:
        quiet: show none.
        kind: what runs, by which the time that compiling takes is remembered.
        idle: the words while there is no news after compiling.
    """
    with _on_terminal(quiet, kind, _words, idle) as bar:
        if bar is None:
            yield None
        else:
            yield lambda words: bar.update(bar.tasks[0].id, description=words, refresh=True)


def _columns(unit: str) -> Callable[[Any], list[Any]]:
    return lambda progress: [
        progress.TextColumn(f"{{task.completed:,.0f}} of {{task.total:,.0f}} {unit}"),
        progress.BarColumn(),
        progress.TaskProgressColumn(),
        progress.TextColumn("{task.fields[pace]}"),
        progress.TimeRemainingColumn(),
        progress.TextColumn("{task.description}"),
    ]


def _words(progress: Any) -> list[Any]:
    from rich.table import Column

    # It wraps where the terminal is narrow: what stands at its end is seen as well.
    return [progress.TextColumn("{task.description}", markup=False, table_column=Column())]


@contextmanager
def _on_terminal(
    quiet: bool, kind: str, columns: Callable[[Any], list[Any]], idle: str = "", **task: Any
) -> Iterator[Progress | None]:
    """Show one task, and whenever something is compiled; None where nobody looks."""
    if quiet or not sys.stderr.isatty():
        yield None
        return
    from rich import progress
    from rich.console import Console

    from socialmind.commands.console.compiling import told_of_compiling

    with progress.Progress(
        *columns(progress), console=Console(stderr=True), transient=True, auto_refresh=False
    ) as bar:
        shown = bar.add_task("", **task)

        def say(what: str) -> None:
            bar.update(shown, description=what or idle, refresh=True)

        with told_of_compiling(kind, say):
            yield bar
