"""The studio's web application: the built page, the list of models, and a socket for each page."""

from __future__ import annotations

import asyncio
import json
from collections.abc import AsyncIterator
from contextlib import asynccontextmanager
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from starlette.applications import Starlette
from starlette.requests import Request
from starlette.responses import JSONResponse
from starlette.routing import Mount, Route, WebSocketRoute
from starlette.staticfiles import StaticFiles
from starlette.websockets import WebSocket, WebSocketDisconnect

from socialmind.catalogue import catalogue
from socialmind.errors import SocialmindError
from socialmind.studio.learning.processes import LearningProcesses
from socialmind.studio.server import (
    first_hour,
    learning,
    plots,
    runs,
    schemes,
    skills,
    sweeps,
)
from socialmind.studio.server.access import App, Guarded
from socialmind.studio.server.clock import Clock
from socialmind.studio.server.folders import Folders
from socialmind.studio.server.stages import StageProcess, Viewer

PAGE = Path(__file__).parents[1] / "built"
FIRST = "first"
"""The name of the society that the program begins with."""
COMMANDS = frozenset(
    (
        "setup", "open", "reset", "save", "branch", "end", "act",
        "go", "pause", "step", "turn", "pace", "go_to",
        "show", "watch", "trace", "plots", "suppose",
        "set", "edit", "rescheme", "press", "steer", "imprint",
    )
)  # fmt: skip
"""What a page may ask of a stage."""
STANDING = frozenset(
    (
        "pause", "step", "turn", "go_to",
        "setup", "open", "reset", "branch", "save", "act", "imprint",
    )
)  # fmt: skip
"""What ends the common going on of societies."""
MOST_STAGES = 12


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
        self._learning = LearningProcesses(folders.home)
        self._clocks: list[Clock] = []
        self._tasks: set[asyncio.Task[None]] = set()
        self._copies = TemporaryDirectory(prefix="socialmind-studio-")

    def application(
        self, hosts: tuple[str, ...], token: str | None = None, alone: bool = False
    ) -> App:
        """Return the application, guarded.

        Args:
            hosts: names under which it may be asked.
            token: what must be shown, or None.
            alone: whether this machine alone reaches it: then only to save programs.
        """
        routes = [
            Route("/api/models", self._models),
            *learning.routes(self._folders, self._learning),
            Route("/api/running", self._running),
            *runs.routes(self._folders),
            *skills.routes(self._folders),
            *plots.routes(self._stages),
            *schemes.routes(self._folders, self._known),
            *sweeps.routes(self._folders, Path(self._copies.name)),
            *first_hour.routes(),
            WebSocketRoute("/live/{name}", self._live),
            Mount("/", StaticFiles(directory=PAGE, html=True)),
        ]
        only = (skills.WITH_PROGRAMS,) if alone else None
        return Guarded(Starlette(routes=routes, lifespan=self._lifespan), hosts, token, only)

    @asynccontextmanager
    async def _lifespan(self, app: Starlette) -> AsyncIterator[None]:
        self._stages[FIRST] = first = StageProcess()
        if self._first is not None:
            first.command(self._first)
        yield
        for stage in self._stages.values():
            stage.end()
        self._learning.end()
        self._copies.cleanup()

    def _known(self) -> set[str]:
        """The models that pages may load: those of the catalogue, and the first one."""
        first = (self._first or {}).get("model")
        return {*catalogue()} | ({first} if first else set())

    async def _models(self, request: Request) -> JSONResponse:
        return JSONResponse(list(catalogue()))

    async def _running(self, request: Request) -> JSONResponse:
        """Return the societies that run, for a page that looks for one."""
        found = []
        for name, stage in self._stages.items():
            model, society = stage.said.get("model"), stage.said.get("society")
            if stage.alive and model and society:
                said = {"name": name, "model": model["name"], "seed": society["seed"]}
                found.append({**said, "pages": len(stage.viewers)})
        return JSONResponse(found)

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
        try:
            if (do == "save" and folder) or do == "imprint":
                self._folders.to_write(folder)
            if do == "act" or (do == "open" and not self._is_copy(folder)):
                self._folders.to_read(folder)
        except SocialmindError as error:
            return str(error)
        into = command.get("into")
        if do == "branch" and (not isinstance(into, str) or into in self._stages):
            return f"a society called {into!r} is there, or can be none"
        return None

    def _is_copy(self, folder: Any) -> bool:
        """Whether a run was made again by this program, to be looked at."""
        copies = Path(self._copies.name).resolve()
        return isinstance(folder, str) and Path(folder).resolve().is_relative_to(copies)

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
        stage = self._stage(socket.path_params["name"])
        if stage is None:
            text = f"{MOST_STAGES} societies run already; close one"
            await socket.send_text(json.dumps({"said": "error", "of": "page", "text": text}))
            await socket.close(1013)
            return
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
                    self._do(stage, self._with_scheme(command))
        except (WebSocketDisconnect, json.JSONDecodeError):
            pass
        finally:
            telling.cancel()
            stage.viewers.remove(viewer)

    def _stage(self, name: str) -> StageProcess | None:
        """Return the process of a name, begun if there is none; None where there are too many."""
        stage = self._stages.get(name)
        if stage is not None and stage.alive:
            return stage
        for other in [n for n, one in self._stages.items() if not one.alive]:
            del self._stages[other]
        if len(self._stages) >= MOST_STAGES:
            return None
        stage = self._stages[name] = StageProcess()
        return stage

    def _do(self, stage: StageProcess, command: dict[str, Any]) -> None:
        """Let a stage do what a page asks; what concerns several societies is done here."""
        do = command["do"]
        clock = next((one for one in self._clocks if one.running and stage in one.stages), None)
        if clock is not None and do in STANDING:
            clock.stop()
        if clock is not None and do == "pace":
            clock.pace = command.get("ticks")
        if do == "go" and command.get("together"):
            stages = [self._stages[one] for one in command["together"] if one in self._stages]
            self._clocks = [one for one in self._clocks if one.running]
            self._clocks.append(Clock(stages, command.get("pace")))
        elif do == "branch":
            self._branch(stage, command["into"])
        elif do == "end":
            self._end(stage)
        else:
            stage.command(command)

    def _branch(self, stage: StageProcess, into: str) -> None:
        """Let another stage show the run of a stage up to its tick, to go on with it."""
        other = self._stage(into)
        if other is None:
            return

        async def copying() -> None:
            folder = str(Path(self._copies.name) / into)
            try:
                copied = await stage.answer({"do": "copy", "folder": folder}, "copied")
            except SocialmindError as error:
                text = f"not set beside it: {error}"
                other.tell(json.dumps({"said": "error", "of": "branch", "text": text}))
                return
            said = {key: copied[key] for key in ("folder", "tick", "source")}
            other.command({"do": "open", **said})

        self._tasks.add(task := asyncio.create_task(copying()))
        task.add_done_callback(self._tasks.discard)

    def _end(self, stage: StageProcess) -> None:
        """End a stage at which no other page looks."""
        if len(stage.viewers) > 1:
            return
        for name in [n for n, one in self._stages.items() if one is stage and n != FIRST]:
            self._stages.pop(name).end()


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
