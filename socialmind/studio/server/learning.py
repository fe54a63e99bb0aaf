"""What the room of trainings asks: which there are, how one goes; to begin, pause, resume."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

from starlette.concurrency import run_in_threadpool
from starlette.requests import Request
from starlette.responses import JSONResponse, Response
from starlette.routing import Route

from socialmind.catalogue import catalogue
from socialmind.errors import SocialmindError
from socialmind.learning.training.course import LESSONS_FILE
from socialmind.studio.learning.following import Follower
from socialmind.studio.learning.listing import summary, trainings_below
from socialmind.studio.learning.processes import OPTIONS, LearningProcesses
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

    def listed(request: Request) -> Response:
        found = trainings_below(folders.home)
        waiting = [one for one in learning.begun() if one not in found]
        return JSONResponse(
            {
                "home": str(folders.home),
                "trainings": [
                    *({"folder": folders.shown(one), **_waiting(one, learning)} for one in waiting),
                    *(
                        {"folder": folders.shown(one), **summary(one), **learning.told(one)}
                        for one in found
                    ),
                ],
                "models": [
                    name for name, one in catalogue().items() if (one / LESSONS_FILE).is_file()
                ],
            }
        )

    def followed(request: Request) -> Response:
        folder = folders.to_read(request.query_params.get("folder"))
        rows = request.query_params.get("known", "")
        if not all(one.isdecimal() and len(one) < 10 for one in filter(None, rows.split(","))):
            raise SocialmindError(f"known={rows}; expected whole numbers with commas between them")
        counts = [int(one) for one in rows.split(",") if one]
        told = learning.told(folder)
        if not folder.is_dir() and folder in learning.begun():
            return JSONResponse({"folder": folders.shown(folder), **_waiting(folder, learning)})
        said = known(folder).told(counts)
        return JSONResponse({"folder": folders.shown(folder), **said, **told})

    def begin(asked: dict[str, Any]) -> dict[str, Any]:
        model = asked.get("model")
        if model not in catalogue():
            raise SocialmindError(f"no model {model!r}")
        options = {name: _option(name, asked.get(name)) for name in OPTIONS}
        return {"folder": folders.shown(learning.begin(model, options))}

    def pause(asked: dict[str, Any]) -> dict[str, Any]:
        learning.pause(folders.to_read(asked.get("folder")))
        return {}

    def resume(asked: dict[str, Any]) -> dict[str, Any]:
        learning.resume(folders.to_write(asked.get("folder")))
        return {}

    return [
        Route("/api/learning", _answering(listed)),
        Route("/api/learning/training", _answering(followed)),
        Route("/api/learning/begin", _asked(begin), methods=["POST"]),
        Route("/api/learning/pause", _asked(pause), methods=["POST"]),
        Route("/api/learning/resume", _asked(resume), methods=["POST"]),
    ]


def _waiting(folder: Path, learning: LearningProcesses) -> dict[str, Any]:
    """Return what is said of a training that was begun and has no folder yet."""
    told = learning.told(folder)
    status = "broken" if told["failure"] else "running"
    return {"status": status, "error": told["failure"], "model": folder.name[:-4], **told}


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


def _answering(answer: Callable[[Request], Response]) -> Callable[[Request], Response]:
    """Return an endpoint that says what is wrong as a page shows it; it runs in a thread."""

    def answered(request: Request) -> Response:
        try:
            return answer(request)
        except (SocialmindError, OSError) as error:
            return JSONResponse({"error": str(error)}, 400)

    return answered


def _asked(do: Callable[[dict[str, Any]], dict[str, Any]]) -> Callable[[Request], Any]:
    """Return an endpoint that reads a JSON object, and does what it asks for in a thread."""

    async def answered(request: Request) -> Response:
        try:
            asked = await request.json()
            if not isinstance(asked, dict):
                raise ValueError
        except ValueError:
            return JSONResponse({"error": "expected a JSON object"}, 400)
        try:
            return JSONResponse(await run_in_threadpool(do, asked))
        except (SocialmindError, OSError) as error:
            return JSONResponse({"error": str(error)}, 400)

    return answered
