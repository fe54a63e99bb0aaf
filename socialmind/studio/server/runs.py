"""The runs below the folders of the studio, for pages to open one."""

from __future__ import annotations

from starlette.routing import Route

from socialmind.studio.server.answering import answering
from socialmind.studio.server.folders import Folders
from socialmind.studio.server.made import folders_of


def routes(folders: Folders) -> list[Route]:
    """Return what answers of runs.

    Args:
        folders: where pages may read.
    """
    return [Route("/api/runs", answering(lambda _: folders_of(folders, "run")))]
