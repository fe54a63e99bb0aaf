"""Routes of the room of the first hour: its tutorials, what is missing at a step, what minds do."""

from __future__ import annotations

import json
from collections.abc import Callable
from threading import Lock
from typing import Any

from starlette.concurrency import run_in_threadpool
from starlette.requests import Request
from starlette.responses import JSONResponse
from starlette.routing import Route

from coglogo_py import CogLogoError
from socialmind.errors import SocialmindError
from socialmind.studio.tutorials.step import Tutorial
from socialmind.studio.tutorials.turtle import TURTLE
from socialmind.studio.tutorials.two_minds import TWO_MINDS
from socialmind.studio.tutorials.vehicle import VEHICLE

TUTORIALS = {one.word: one for one in (TURTLE, VEHICLE, TWO_MINDS)}
_loading = Lock()


def routes() -> list[Route]:
    """Return the routes of the room."""
    return [
        Route("/api/first-hour", _list),
        Route("/api/first-hour/check", _answering(missing), methods=["POST"]),
        Route("/api/first-hour/show", _answering(shown), methods=["POST"]),
    ]


async def _list(request: Request) -> JSONResponse:
    return JSONResponse([one.to_json() for one in TUTORIALS.values()])


def _answering(do: Callable[[dict[str, Any]], dict[str, Any]]) -> Callable[[Request], Any]:
    async def answer(request: Request) -> JSONResponse:
        try:
            asked = json.loads(await request.body() or b"{}")
            if not isinstance(asked, dict):
                raise SocialmindError("asked for nothing that is known")
            return JSONResponse(await run_in_threadpool(do, asked))
        except (KeyError, TypeError):
            return JSONResponse({"error": "the page and the program are not of one version"}, 400)
        except (SocialmindError, CogLogoError, ValueError) as error:
            return JSONResponse({"error": str(error)}, 400)

    return answer


def missing(asked: dict[str, Any]) -> dict[str, Any]:
    """Say what is missing at a step of a tutorial.

    Args:
        asked: `tutorial`, `step` and the `document` as it is.
    """
    return {"missing": _tutorial(asked).missing(asked["document"], int(asked["step"]))}


def shown(asked: dict[str, Any]) -> dict[str, Any]:
    """Say what a mind does: the measure of its tutorial over time, beside what it is compared with.

    Args:
        asked: `tutorial` and the `document` as it is.
    """
    with _loading:
        return dict(_tutorial(asked).courses(asked["document"]))


def _tutorial(asked: dict[str, Any]) -> Tutorial:
    if asked.get("tutorial") not in TUTORIALS:
        raise SocialmindError(f"no tutorial {asked.get('tutorial')!r}; {', '.join(TUTORIALS)}")
    return TUTORIALS[asked["tutorial"]]
