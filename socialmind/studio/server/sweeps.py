"""What answers of sweeps: which there are, how far one came, its figures, one of its runs."""

from __future__ import annotations

import asyncio
from collections.abc import Callable
from pathlib import Path
from tempfile import mkdtemp
from typing import Any

from starlette.requests import Request
from starlette.responses import JSONResponse
from starlette.routing import Route

from socialmind.errors import SocialmindError
from socialmind.studio.server.folders import Folders
from socialmind.studio.server.made import folders_of


def routes(folders: Folders, copies: Path) -> list[Route]:
    """Return what answers of sweeps.

    Args:
        folders: where pages may read.
        copies: a folder for runs of sweeps that are made again to be looked at.
    """

    async def answered(work: Callable[[], Any]) -> JSONResponse:
        try:
            return JSONResponse(await asyncio.to_thread(work))
        except SocialmindError as error:
            return JSONResponse({"error": str(error)}, 400)

    async def sweeps(request: Request) -> JSONResponse:
        return await answered(lambda: folders_of(folders, "sweep"))

    async def sweep(request: Request) -> JSONResponse:
        from socialmind.studio.sweeps.progress import told

        return await answered(lambda: told(_folder(folders, request)))

    async def figures(request: Request) -> JSONResponse:
        from socialmind.studio.sweeps.figures import drawn

        outcome = request.query_params.get("outcome") or None
        return await answered(lambda: drawn(_folder(folders, request), outcome))

    async def run(request: Request) -> JSONResponse:
        return await answered(
            lambda: {"folder": str(_made(_folder(folders, request), request, copies))}
        )

    return [
        Route("/api/sweeps", sweeps),
        Route("/api/sweep", sweep),
        Route("/api/sweep/figures", figures),
        Route("/api/sweep/run", run, methods=["POST"]),
    ]


def _folder(folders: Folders, request: Request) -> Path:
    return folders.to_read(request.query_params.get("folder"))


def _made(folder: Path, request: Request, copies: Path) -> Path:
    """Make a run of a sweep again, in a folder that ends with the program."""
    from socialmind.experiments.sweeps.remaking import remake_run

    number = request.query_params.get("run", "")
    if not number.isdecimal():
        raise SocialmindError(f"run {number!r}; expected the number of a run")
    return remake_run(folder, int(number), Path(mkdtemp(dir=copies)) / f"run-{number}")
