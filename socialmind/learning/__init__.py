"""Learning: how the genomes of a mind's skills come about.

- `Lesson`, `Curriculum`, `Cycle`: what is learned, in which order;
- `learn`, `resume`: teach a mind, into a folder that can be gone on with;
- `Training`: read such a folder.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from socialmind.learning.lessons.curriculum import Curriculum, Cycle
    from socialmind.learning.lessons.lesson import Lesson
    from socialmind.learning.training.execution import TrainingInterrupted, learn, resume
    from socialmind.learning.training.result import Training

__all__ = ["Curriculum", "Cycle", "Lesson", "Training", "TrainingInterrupted", "learn", "resume"]

_HOME = {
    "Curriculum": "lessons.curriculum",
    "Cycle": "lessons.curriculum",
    "Lesson": "lessons.lesson",
    "Training": "training.result",
    "TrainingInterrupted": "training.execution",
    "learn": "training.execution",
    "resume": "training.execution",
}


def __getattr__(name: str) -> Any:
    """Import a public name when it is first used: imprinting alone needs none of them."""
    import importlib

    if name not in _HOME:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return getattr(importlib.import_module(f"{__name__}.{_HOME[name]}"), name)
