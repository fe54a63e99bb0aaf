"""The runs below the folders of the studio, for pages to open one."""

from __future__ import annotations

from starlette.requests import Request
from starlette.responses import JSONResponse
from starlette.routing import Route

from socialmind.studio.server.folders import Folders
from socialmind.studio.server.made import folders_of


def routes(folders: Folders) -> list[Route]:
    """Return what answers of runs.

    Args:
        folders: where pages may read.
    """

    def runs(request: Request) -> JSONResponse:
        return JSONResponse(folders_of(folders, "run"))

    return [Route("/api/runs", runs)]
