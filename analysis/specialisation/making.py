"""From worlds to files: runs all, or goes on with what is kept, and writes what comes of it."""

from __future__ import annotations

import sys
from pathlib import Path

from socialmind.drawing import style as paper

from . import farmers
from .report import made
from .runs import cells_of, run
from .societies import Size

NAME = "specialisation"


def make(out: Path, size: Size, command: str, workers: int | None = None) -> list[Path]:
    """Make the report.

    Args:
        out: the folder, made where it is missing.
        size: of the study.
        command: that makes it, for the page.
        workers: processes; one for each processor by default.

    Returns:
        The files written.

    Raises:
        SocialmindError: a lesson of which no attempt is kept.
    """
    cells = cells_of(size)
    home = out / NAME
    records = run(cells, size, out / f"{NAME}-worlds", workers)
    print("farmers and artisans", file=sys.stderr, flush=True)
    village = farmers.found(size, home, workers)
    report = made(records, village, size, command)
    written = [home / "distilled.yaml", *paper.save(report.figures, home)]
    for name, table in report.tables.items():
        path = home / f"{name}.csv"
        table.to_csv(path, index=False, float_format="%.6g")
        written.append(path)
    page = out / f"{NAME}.html"
    page.write_text(report.page, encoding="utf-8")
    return [page, *written]
