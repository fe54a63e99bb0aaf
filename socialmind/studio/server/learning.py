"""What the room of trainings asks: which there are, how one goes; to begin, pause, resume."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from starlette.routing import Route

from socialmind.catalogue import catalogue
from socialmind.errors import SocialmindError
from socialmind.learning.training.course import can_be_taught
from socialmind.studio.learning.following import Follower
from socialmind.studio.learning.listing import summary, trainings_below
from socialmind.studio.learning.processes import OPTIONS, LearningProcesses
from socialmind.studio.server.answering import Asked, answering
from socialmind.studio.server.folders import Folders

FOLLOWED = 16
"""Trainings whose curves are remembered at most; one looked at again is read again."""
LARGEST = {"attempts": 10_000, "seed": 2**64 - 1, "generations": 10**9}


def routes(folders: Folders, learning: LearningProcesses) -> list[Route]:
    """Return the routes of the room.

    Args:
        folders: where trainings are looked for.
        learning: who lets trainings go on.
    """
    followers: dict[Path, Follower] = {}

    def known(folder: Path) -> Follower:
        found = followers.pop(folder, None) or Follower(folder)
        followers[folder] = found
        while len(followers) > FOLLOWED:
            del followers[next(iter(followers))]
        return found

    def listed(asked: Asked) -> Asked:
        found = trainings_below(folders.home)
        waiting = [one for one in learning.begun() if one not in found]
        return {
            "home": str(folders.home),
            "trainings": [
                *({"folder": folders.shown(one), **_waiting(one, learning)} for one in waiting),
                *(
                    {"folder": folders.shown(one), **summary(one), **learning.told(one)}
                    for one in found
                ),
            ],
            "models": [name for name, one in catalogue().items() if can_be_taught(one)],
        }

    def followed(asked: Asked) -> Asked:
        folder = folders.to_read(asked.get("folder"))
        rows = asked.get("known", "")
        if not all(one.isdecimal() and len(one) < 10 for one in filter(None, rows.split(","))):
            raise SocialmindError(f"known={rows}; expected whole numbers with commas between them")
        counts = [int(one) for one in rows.split(",") if one]
        told = learning.told(folder)
        if not folder.is_dir() and folder in learning.begun():
            return {"folder": folders.shown(folder), **_waiting(folder, learning)}
        return {"folder": folders.shown(folder), **known(folder).told(counts), **told}

    def begin(asked: Asked) -> Asked:
        model = asked.get("model")
        if model not in catalogue():
            raise SocialmindError(f"no model {model!r}")
        options = {name: _option(name, asked.get(name)) for name in OPTIONS}
        return {"folder": folders.shown(learning.begin(model, options))}

    def pause(asked: Asked) -> Asked:
        learning.pause(folders.to_write(asked.get("folder")))
        return {}

    def resume(asked: Asked) -> Asked:
        learning.resume(folders.to_write(asked.get("folder")))
        return {}

    return [
        Route("/api/learning", answering(listed)),
        Route("/api/learning/training", answering(followed)),
        Route("/api/learning/begin", answering(begin), methods=["POST"]),
        Route("/api/learning/pause", answering(pause), methods=["POST"]),
        Route("/api/learning/resume", answering(resume), methods=["POST"]),
    ]


def _waiting(folder: Path, learning: LearningProcesses) -> dict[str, Any]:
    """Return what is said of a training that was begun and has no folder yet."""
    told = learning.told(folder)
    status = "broken" if told["failure"] else "running"
    return {
        "status": status, "error": told["failure"], "model": folder.name[:-4],
        "held": False, "process": None, "pausing": False, "resumable": False, **told,
    }  # fmt: skip


def _option(name: str, value: object) -> object:
    """Return an option of a training as the command line takes it."""
    if value in (None, ""):
        return None
    if name == "lesson":
        if isinstance(value, str) and value.isprintable() and not value.endswith(".simbatch"):
            return value
        raise SocialmindError("lesson: expected the name of one of the model's lessons")
    least = 0 if name == "seed" else 1
    if isinstance(value, bool) or not isinstance(value, int):
        raise SocialmindError(f"{name}: expected a whole number")
    if not least <= value <= LARGEST[name]:
        raise SocialmindError(f"{name}: expected {least} to {LARGEST[name]:,}")
    return value
