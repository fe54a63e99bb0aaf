"""Routes of the room of the first hour: its tutorials, what is missing at a step, what minds do."""

from __future__ import annotations

from threading import Lock
from typing import Any

from starlette.routing import Route

from socialmind.errors import SocialmindError
from socialmind.studio.server.answering import Asked, answering
from socialmind.studio.tutorials.step import Tutorial
from socialmind.studio.tutorials.turtle import TURTLE
from socialmind.studio.tutorials.two_minds import TWO_MINDS
from socialmind.studio.tutorials.vehicle import VEHICLE

TUTORIALS = {one.word: one for one in (TURTLE, VEHICLE, TWO_MINDS)}
_loading = Lock()


def routes() -> list[Route]:
    """Return the routes of the room."""
    return [
        Route("/api/first-hour", answering(_listed)),
        Route("/api/first-hour/check", answering(missing), methods=["POST"]),
        Route("/api/first-hour/show", answering(shown), methods=["POST"]),
    ]


def _listed(asked: Asked) -> list[dict[str, Any]]:
    return [one.to_json() for one in TUTORIALS.values()]


def missing(asked: Asked) -> Asked:
    """Say what is missing at a step of a tutorial.

    Args:
        asked: `tutorial`, `step` and the `document` as it is.
    """
    return {"missing": _tutorial(asked).missing(asked["document"], int(asked["step"]))}


def shown(asked: Asked) -> Asked:
    """Say what a mind does: the measure of its tutorial over time, beside what it is compared with.

    Args:
        asked: `tutorial` and the `document` as it is.
    """
    with _loading:
        return dict(_tutorial(asked).courses(asked["document"]))


def _tutorial(asked: Asked) -> Tutorial:
    if asked.get("tutorial") not in TUTORIALS:
        raise SocialmindError(f"no tutorial {asked.get('tutorial')!r}; {', '.join(TUTORIALS)}")
    return TUTORIALS[asked["tutorial"]]
