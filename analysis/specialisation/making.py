"""From worlds to tables, and from tables to the page and its figures.

What is shown is read from the tables as they stand beside it, so that it can be made anew of those
that are kept.
"""

from __future__ import annotations

import shutil
import sys
from pathlib import Path

import pandas as pd

from coglogo_py import CognitiveScheme
from socialmind.drawing import style as paper

from . import farmers
from .report import made, tables_of
from .runs import cells_of, run
from .societies import FULL, Size

NAME = "specialisation"
KEPT = Path(__file__).parent / "results" / NAME


def make(out: Path, size: Size, command: str, workers: int | None = None) -> list[Path]:
    """Run all worlds, or go on with what is kept of them, and write what comes of it.

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
    for name, table in tables_of(records, village, size).items():
        table.to_csv(home / f"{name}.csv", index=False, float_format="%.6g", lineterminator="\n")
    return show(out, size, command)


def make_of_kept(out: Path, command: str) -> list[Path]:
    """Write the page and its figures of the tables that are kept, and the tables.

    Args:
        out: the folder, made where it is missing.
        command: that makes it, for the page.

    Returns:
        The files written.
    """
    home = out / NAME
    home.mkdir(parents=True, exist_ok=True)
    for one in (*KEPT.glob("*.csv"), KEPT / farmers.DISTILLED):
        if one.resolve() != (home / one.name).resolve():
            shutil.copyfile(one, home / one.name)
    return show(out, FULL, command)


def show(out: Path, size: Size, command: str) -> list[Path]:
    """Write the page and its figures of the tables beside it.

    Args:
        out: the folder.
        size: of the study that they are of.
        command: that makes it, for the page.

    Returns:
        All files of the study.
    """
    home = out / NAME
    files = [home / farmers.DISTILLED, *sorted(home.glob("*.csv"))]
    tables = {one.stem: pd.read_csv(one) for one in files[1:]}
    report = made(tables, CognitiveScheme.load(files[0]), size, command)
    page = out / f"{NAME}.html"
    page.write_text(report.page, encoding="utf-8")
    return [page, *files, *paper.save(report.figures, home)]
