"""What a stopped command says."""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING, Any

import typer

from socialmind.commands.console.terminal import quoted

if TYPE_CHECKING:
    from socialmind.learning.training.execution import TrainingInterrupted
    from socialmind.runs.execution import Interrupted

CTRL_C = 130


def exit_code_of_stop(stop: KeyboardInterrupt) -> int:
    """Say how to go on with a stopped run, and give the exit code of a program stopped so."""
    # Nothing is imported here: what was stopped may be an import, which cannot be done again.
    if _is(stop, "socialmind.learning.training.execution", "TrainingInterrupted"):
        training: TrainingInterrupted = stop  # type: ignore[assignment]
        typer.echo(f"socialmind: {training.where}; the same command goes on", err=True)
        return 128 + training.signal_number
    if not _is(stop, "socialmind.runs.execution", "Interrupted"):
        typer.echo("socialmind: stopped", err=True)
        return CTRL_C
    run: Interrupted = stop  # type: ignore[assignment]
    typer.echo(
        f"socialmind: stopped at tick {run.tick:,}; go on with "
        f"`socialmind run --resume {quoted(run.folder)}`",
        err=True,
    )
    return 128 + run.signal_number


def _is(stop: KeyboardInterrupt, module: str, name: str) -> bool:
    kind: Any = getattr(sys.modules.get(module), name, None)
    return kind is not None and isinstance(stop, kind)


def what_memory_lacked(error: MemoryError) -> str:
    """Say that there was too little memory, and what is known of how much was needed."""
    needed = f": {error}" if str(error) else ""
    return (
        f"not enough memory{needed}{_held()}; take fewer agents, patches or workers, or a machine "
        "with more memory"
    )


def _held() -> str:
    """Say how much memory this program held at most, as far as somebody tells."""
    try:
        import resource
    except ImportError:  # Windows
        return ""
    unit = 1 if sys.platform == "darwin" else 1024
    most = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * unit
    held = f"; this program had {most // 10**6:,} MB"
    limit = resource.getrlimit(resource.RLIMIT_AS)[0]
    if limit != resource.RLIM_INFINITY:
        held += f" and may have addresses for {limit // 10**6:,} MB (`ulimit -v`)"
    return held
