"""Societies are begun, and runs opened and kept."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

from socialmind.catalogue import load_model
from socialmind.runs.capsule import Capsule
from socialmind.studio.learning.acting import best_so_far
from socialmind.studio.running.live_run import LiveRun
from socialmind.studio.running.stage import Stage
from socialmind.studio.schemes.checking import Bearers, runnable_of


def setup(
    stage: Stage,
    model: str,
    seed: int | str = 0,
    parameters: Mapping[str, Any] | None = None,
    scheme: Any = None,
    documents: Mapping[str, Any] | None = None,
) -> None:
    """Begin a society, before its first tick; `documents` are edited schemes by population."""
    stage.stand()
    stage.say("busy", text=f"making {model}")
    model_class = load_model(model)
    stage.source = model
    stage.say_model(model_class)
    if documents:
        scheme = {
            name: runnable_of(one, Bearers.of(model_class, name)) for name, one in documents.items()
        }
    stage.begin(LiveRun(model_class(seed=int(seed), scheme=scheme, **(parameters or {}))))


def open_run(stage: Stage, folder: str, tick: int = 0, source: str | None = None) -> None:
    """Show the run that a folder holds, to be gone through.

    Args:
        stage: that shows it.
        folder: the run's.
        tick: to go to first.
        source: the name by which the model is set up again; that of the run's by default.
    """
    stage.stand()
    stage.say("busy", text="opening the run")
    capsule = Capsule(folder)
    run = LiveRun.of_folder(folder)
    stage.source = source or str(capsule.manifest.model["name"])
    stage.say_model(type(run.society))
    if tick:
        stage.prepare(run)
        run.go_to(tick)
    stage.begin(run, capsule.manifest.ticks_done)


def reset(stage: Stage) -> None:
    """Go back to the start, with the same seed and parameters and nothing done by hand."""
    stage.stand()
    stage.run.reset()
    stage.begin(stage.run)


def act(stage: Stage, folder: str, attempt: int, seed: int = 0) -> None:
    """Let the best that a training has found so far act in a world of its lesson."""
    stage.stand()
    stage.say("busy", text="loading what was learned")
    best = best_so_far(folder, attempt)
    society = best.society(seed)
    stage.source = type(society).name
    stage.say_model(type(society))
    stage.begin(LiveRun(society))
    said = {name: getattr(best, name) for name in ("attempt", "lesson", "generation", "score")}
    stage.say("acting", **said, ticks=best.ticks, seed=seed)


def save(stage: Stage, folder: str | None = None, every: int | None = None) -> None:
    """Make the run up to here as a folder."""
    made, home = stage.run.save(folder, every, _telling(stage, "busy", "saving")), Path.cwd()
    shown = made.relative_to(home) if made.is_relative_to(home) else made
    stage.say("saved", folder=str(shown))


def copy(stage: Stage, folder: str) -> None:
    """Make the run up to here as a folder, for another stage to open."""
    try:
        stage.run.save(folder, told=_telling(stage, "preparing", "repeating the run"))
    finally:
        stage.say("preparing", text="")
    stage.say("copied", folder=folder, tick=stage.run.tick, source=stage.source)


def _telling(stage: Stage, what: str, doing: str) -> Callable[[int, int], None]:
    """Return what says how far a run is that is repeated: it may take a while."""
    stage.say(what, text=doing)
    return lambda done, of: stage.say(what, text=f"{doing}: tick {done:,} of {of:,}")
