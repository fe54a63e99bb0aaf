"""Runs as capsules: one folder each, that can be stopped, gone on with, replayed and read.

- `run`, `resume`: run a model into a folder, go on with one;
- `replay`: run a capsule again and compare;
- `Run`: read a capsule's tables, parameters and scheme;
- `draw_figures`: draw a run's figures into its folder;
- `score`: measure minds on a plane in many worlds.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from socialmind.experiments.scoring import Score, score
    from socialmind.runs.execution import Interrupted, resume, run
    from socialmind.runs.figures import draw_figures
    from socialmind.runs.result import Run
    from socialmind.runs.verification import Replay, replay

__all__ = [
    "Interrupted",
    "Replay",
    "Run",
    "Score",
    "draw_figures",
    "replay",
    "resume",
    "run",
    "score",
]

_HOME = {
    "Interrupted": "runs.execution",
    "Replay": "runs.verification",
    "Run": "runs.result",
    "Score": "experiments.scoring",
    "draw_figures": "runs.figures",
    "replay": "runs.verification",
    "resume": "runs.execution",
    "run": "runs.execution",
    "score": "experiments.scoring",
}


def __getattr__(name: str) -> Any:
    """Import a public name when it is first used: starting a run needs few of them."""
    import importlib

    if name not in _HOME:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return getattr(importlib.import_module(f"socialmind.{_HOME[name]}"), name)
