"""From worlds to files: runs all, or goes on with what is kept, and writes what comes of it."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import TYPE_CHECKING, Any

from socialmind.catalogue import load_file
from socialmind.drawing import style as paper
from socialmind.experiments.studies import topics

from . import farmers
from .report import made
from .runs import cells_of, run
from .societies import Size

if TYPE_CHECKING:
    from collections.abc import Sequence

NAME = "specialisation"
THESIS = "thesis"


def thesis_weights(out: Path, train_small: bool) -> Sequence[float]:
    """Return the weights of the mind that was learned as in the thesis.

    Args:
        out: the folder of the study, in which a training would be made.
        train_small: whether a small one will do where none is kept.

    Raises:
        SocialmindError: none is kept, and a small one will not do; it says what makes it.
    """
    folder = topics()["foraging_roles"]
    trainings: Any = load_file(folder / "trainings.py")
    results: Any = load_file(folder / "results.py")
    small = train_small and THESIS not in trainings.kept()
    found = results.genomes([THESIS], out, quick=small, from_kept=not small)
    weights: list[float] = found[THESIS][0].tolist()
    return weights


def make(
    out: Path, size: Size, command: str, train_small: bool = False, workers: int | None = None
) -> list[Path]:
    """Make the report.

    Args:
        out: the folder, made where it is missing.
        size: of the study.
        command: that makes it, for the page.
        train_small: whether a small training of the thesis's mind will do where none is kept.
        workers: processes; one for each processor by default.

    Returns:
        The files written.
    """
    cells = cells_of(size, thesis_weights(out, train_small))
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
