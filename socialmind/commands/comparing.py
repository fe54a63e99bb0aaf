"""`socialmind compare`: futures side by side, and how they differ."""

from __future__ import annotations

import math
import os
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from socialmind.commands.console import options
from socialmind.errors import SocialmindError
from socialmind.text_table import aligned

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from socialmind.experiments.comparing.futures import Futures

NAME = "comparison"
"""What the files are called that are written."""


def compare(
    folders: Annotated[
        list[Path], typer.Argument(metavar="DIR...", help="Folders of runs.", show_default=False)
    ],
    against: Annotated[
        list[Path] | None,
        typer.Option(metavar="DIR", help="Run of the group to compare with; may be repeated."),
    ] = None,
    column: Annotated[
        list[str] | None,
        typer.Option(metavar="NAME", help="Column of the series (all that hold numbers)."),
    ] = None,
    unit: Annotated[
        list[str] | None,
        typer.Option(metavar="NAME=UNIT", help="Unit of a column, for the axes."),
    ] = None,
    out: Annotated[
        Path, typer.Option(metavar="DIR", help="Folder for the table and the figure.")
    ] = Path("comparison"),
    quiet: options.Quiet = False,
) -> None:
    """Draw runs side by side, with their differences from the first, or from a group of runs."""
    os.environ["MPLBACKEND"] = "Agg"
    from socialmind.experiments.comparing.figure import figure_of
    from socialmind.experiments.comparing.futures import futures, named
    from socialmind.society.settings import pair

    if len(folders) + len(against or ()) < 2:
        raise SocialmindError("one run alone; give another to compare it with")
    found = futures(named(folders, against or ()), column)
    figure = figure_of(found, dict(pair(one) for one in unit or ()))
    written = write(found, figure, out)
    if not quiet:
        typer.echo("\n".join(last_rows(found)))
    for path in written:
        typer.echo(path)


def write(found: Futures, figure: Figure, out: Path) -> list[Path]:
    """Write the table as CSV and the figure as PDF, PNG and SVG; gives the files."""
    from socialmind.drawing import style as paper
    from socialmind.work.files import replace_file

    written = paper.save({NAME: figure}, out)
    table, vector = out / f"{NAME}.csv", out / f"{NAME}.svg"
    with paper.style():
        paper.write_figure(figure, vector, metadata={"Date": None})
    replace_file(table, found.table.to_csv(index=False).encode())
    return [table, *written, vector]


def last_rows(found: Futures) -> list[str]:
    """Return the last tick that all recorded, as lines: each column of each group."""
    tick = found.table["tick"].max()
    rows = [("column", "runs of", "mean", "difference", "95 % interval")]
    for name in found.columns:
        for group in found.groups:
            row = found.of(name, group).iloc[-1]
            first = group == found.groups[0]
            low, high = row["difference_low"], row["difference_high"]
            known = not first and math.isfinite(low) and math.isfinite(high)
            apart = "" if first else f"{row['difference']:+.6g}"
            bounds = f"{low:.6g} … {high:.6g}" if known else ""
            rows.append((name, group, f"{row['mean']:.6g}", apart, bounds))
    pairs = "in pairs of equal seeds" if found.paired else "of all runs"
    return [f"at tick {tick:,}, differences {pairs}:", *aligned(rows, right=[2, 3])]
