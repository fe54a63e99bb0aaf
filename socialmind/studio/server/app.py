"""The studio's web application: the built page, the list of models, and a socket for each page."""

from __future__ import annotations

import asyncio
import json
from collections.abc import AsyncIterator
from contextlib import asynccontextmanager
from pathlib import Path
from typing import Any

from starlette.applications import Starlette
from starlette.requests import Request
from starlette.responses import JSONResponse
from starlette.routing import Mount, Route, WebSocketRoute
from starlette.staticfiles import StaticFiles
from starlette.websockets import WebSocket, WebSocketDisconnect

from socialmind.catalogue import catalogue
from socialmind.errors import SocialmindError
from socialmind.studio.server import first_hour, schemes
from socialmind.studio.server.access import App, Guarded
from socialmind.studio.server.folders import Folders
from socialmind.studio.server.stages import StageProcess, Viewer

PAGE = Path(__file__).parents[1] / "built"
COMMANDS = frozenset(
    (
        "setup",
        "go",
        "pause",
        "step",
        "pace",
        "go_to",
        "show",
        "watch",
        "set",
        "edit",
        "rescheme",
        "save",
    )
)
"""What a page may ask of a stage."""


class Studio:
    """All that runs for the pages of one program.

    Args:
        first: what the first page shows: a command that sets a society up, or None.
        folders: where pages may read and write.
    """

    def __init__(self, first: dict[str, Any] | None, folders: Folders) -> None:
        self._first = first
        self._folders = folders
        self._stages: dict[str, StageProcess] = {}

    def application(self, hosts: tuple[str, ...], token: str | None = None) -> App:
        """Return the application, guarded.

        Args:
            hosts: names under which it may be asked.
            token: what must be shown, or None.
        """
        routes = [
            Route("/api/models", self._models),
            *schemes.routes(self._folders, self._known),
            *first_hour.routes(),
            WebSocketRoute("/live/{name}", self._live),
            Mount("/", StaticFiles(directory=PAGE, html=True)),
        ]
        return Guarded(Starlette(routes=routes, lifespan=self._lifespan), hosts, token)

    @asynccontextmanager
    async def _lifespan(self, app: Starlette) -> AsyncIterator[None]:
        self._stages["first"] = first = StageProcess()
        if self._first is not None:
            first.command(self._first)
        yield
        for stage in self._stages.values():
            stage.end()

    def _known(self) -> set[str]:
        """The models that pages may load: those of the catalogue, and the first one."""
        first = (self._first or {}).get("model")
        return {*catalogue()} | ({first} if first else set())

    async def _models(self, request: Request) -> JSONResponse:
        return JSONResponse(list(catalogue()))

    def _refusal(self, command: dict[str, Any]) -> str | None:
        """Say why a page may not ask that: no path leaves the folders that the program was given.

        Models are those of the catalogue and the one that the program was started with; runs are
        saved in the folder where it was started, or below.
        """
        do, model, folder = (command.get(name) for name in ("do", "model", "folder"))
        if do not in COMMANDS:
            return f"no command {do!r}"
        if do == "setup" and model not in self._known():
            return f"no model {model!r}; start the studio with its folder"
        if do == "save" and folder:
            try:
                self._folders.to_write(folder)
            except SocialmindError as error:
                return str(error)
        return None

    def _with_scheme(self, command: dict[str, Any]) -> dict[str, Any]:
        """Give the scheme of the command line to the model that it was given for, and no other."""
        first = self._first or {}
        if command["do"] != "setup":
            return command
        own = command["model"] == first.get("model")
        return {**command, "scheme": first.get("scheme") if own else None}

    async def _live(self, socket: WebSocket) -> None:
        """Let a page look at a society, command it, and go."""
        await socket.accept()
        name = socket.path_params["name"]
        stage = self._stages.get(name)
        if stage is None or not stage.alive:
            stage = self._stages[name] = StageProcess()
        viewer = Viewer()
        stage.join(viewer)
        telling = asyncio.create_task(_tell(socket, viewer))
        try:
            while True:
                command = json.loads(await socket.receive_text())
                if command.get("do") == "seen":
                    viewer.ready = True
                    viewer.news.set()
                    stage.want_frame()
                elif (refusal := self._refusal(command)) is not None:
                    viewer.tell(json.dumps({"said": "error", "of": "page", "text": refusal}))
                else:
                    stage.command(self._with_scheme(command))
        except (WebSocketDisconnect, json.JSONDecodeError):
            pass
        finally:
            telling.cancel()
            stage.viewers.remove(viewer)


async def _tell(socket: WebSocket, viewer: Viewer) -> None:
    """Send a page what is said, and the last frame whenever it is ready for one."""
    while True:
        await viewer.news.wait()
        viewer.news.clear()
        while not viewer.said.empty():
            await socket.send_text(viewer.said.get_nowait())
        if viewer.frame is not None and viewer.ready:
            frame, viewer.frame, viewer.ready = viewer.frame, None, False
            await socket.send_bytes(frame)
