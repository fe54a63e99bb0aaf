"""What answers of sweeps: which there are, how far one came, its figures, one of its runs."""

from __future__ import annotations

from pathlib import Path
from tempfile import mkdtemp
from typing import Any

from starlette.routing import Route

from socialmind.errors import SocialmindError
from socialmind.studio.server.answering import Asked, answering
from socialmind.studio.server.folders import Folders
from socialmind.studio.server.made import folders_of


def routes(folders: Folders, copies: Path) -> list[Route]:
    """Return what answers of sweeps.

    Args:
        folders: where pages may read.
        copies: a folder for runs of sweeps that are made again to be looked at.
    """

    def sweeps(asked: Asked) -> list[dict[str, Any]]:
        return folders_of(folders, "sweep")

    def progress(asked: Asked) -> Asked:
        from socialmind.studio.sweeps.progress import told

        return told(folders.to_read(asked.get("folder")))

    def figures(asked: Asked) -> Asked:
        from socialmind.studio.sweeps.figures import drawn

        return drawn(folders.to_read(asked.get("folder")), asked.get("outcome") or None)

    def run(asked: Asked) -> Asked:
        folder = folders.to_read(asked.get("folder"))
        return {"folder": str(_made(folder, str(asked.get("run", "")), copies))}

    return [
        Route("/api/sweeps", answering(sweeps)),
        Route("/api/sweeps/progress", answering(progress), methods=["POST"]),
        Route("/api/sweeps/figures", answering(figures), methods=["POST"]),
        Route("/api/sweeps/run", answering(run), methods=["POST"]),
    ]


def _made(folder: Path, number: str, copies: Path) -> Path:
    """Make a run of a sweep again, in a folder that ends with the program."""
    from socialmind.experiments.sweeps.remaking import remake_run

    if not number.isdecimal():
        raise SocialmindError(f"run {number!r}; expected the number of a run")
    return remake_run(folder, int(number), Path(mkdtemp(dir=copies)) / f"run-{number}")
