"""The past of a branch: the rows that the run it leaves recorded up to a tick."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Any

from socialmind.runs import folders
from socialmind.runs.checkpoint import Checkpoint
from socialmind.runs.tables.files import merge, part_name, seal
from socialmind.runs.tables.names import EVENTS
from socialmind.work.files import make_room

if TYPE_CHECKING:
    from pathlib import Path

    from socialmind.model import Model
    from socialmind.runs.capsule import Capsule


def rows_before(
    origin: Capsule, checkpoint: Checkpoint | None, tick: int, parts: Path
) -> Checkpoint | None:
    """Write what a run recorded up to a tick as the first parts of another run's tables.

    A row off the grid of recorded ticks was there because the run ended; the branch, which goes on,
    does not have it.

    Args:
        origin: the run.
        checkpoint: its checkpoint, if it has one.
        tick: at most the ticks that it has done.
        parts: the other run's folder for parts.

    Returns:
        A checkpoint that lists them, still without a state; None where nothing is recorded yet.

    Raises:
        SocialmindError: a table cannot be read.
    """
    sources = _tables(origin, checkpoint)
    if not sources:
        return None
    parts.mkdir(exist_ok=True)
    steps = origin.manifest.steps(sources)
    names: dict[str, list[str]] = {}
    sums: dict[str, list[Any]] = {}
    recorded = {}
    for name, files in sources.items():
        part = part_name(name, 0)
        last = tick - tick % steps[name]
        merge(files, make_room(parts / part), name, last_tick=last)
        sums[part] = seal(parts / part)
        names[name], recorded[name] = [part], last
    return Checkpoint(
        tick=tick,
        recorded=recorded,
        parts=names,
        idle={},
        loop_seconds=0.0,
        seconds=0.0,
        state={},
        sums=sums,
    )


def with_society(past: Checkpoint, model: Model, run: str) -> Checkpoint:
    """Return a checkpoint with the society that goes on from it.

    Args:
        past: what is recorded.
        model: the society.
        run: what decides the result of the run, as a hash.
    """
    idle = model.idle
    said = {"count": idle.count, "first_agent": idle.first_agent, "first_tick": idle.first_tick}
    return replace(past, idle=said, state=model.state(), run=run)


def _tables(origin: Capsule, checkpoint: Checkpoint | None) -> dict[str, list[Path]]:
    """Return the files of each table of a run, in order."""
    if origin.manifest.status == folders.FINISHED:
        return {name: [origin.table(name)] for name in origin.manifest.tables}
    if checkpoint is None:
        return {}
    return {
        name: [origin.parts / part for part in parts]
        for name, parts in checkpoint.parts.items()
        if parts or name == EVENTS
    }
