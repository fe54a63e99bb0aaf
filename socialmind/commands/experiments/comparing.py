"""`socialmind compare`: futures side by side, and how they differ."""

from __future__ import annotations

import math
import os
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from socialmind.commands.console import options
from socialmind.errors import SocialmindError
from socialmind.text_table import aligned

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from socialmind.experiments.comparing.futures import Futures
    from socialmind.experiments.comparing.sweeps import SweepsCompared

NAME = "comparison"
"""What the files are called that are written."""
ROWS = 40
"""Rows of differences that are printed; the table has all."""


def compare(
    folders: Annotated[
        list[Path],
        typer.Argument(metavar="DIR...", help="Of runs, or of sweeps.", show_default=False),
    ],
    against: Annotated[
        list[Path] | None,
        typer.Option(metavar="DIR", help="Run of the group to compare with; may be repeated."),
    ] = None,
    column: Annotated[
        list[str] | None,
        typer.Option(
            metavar="NAME",
            help="Column of the series, measure of sweeps (all).",
        ),
    ] = None,
    unit: Annotated[
        list[str] | None,
        typer.Option(metavar="NAME=UNIT", help="Unit of a column, for the axes."),
    ] = None,
    out: Annotated[
        Path, typer.Option(metavar="DIR", help="Folder for the table and the figure.")
    ] = Path("comparison"),
    trust: options.Trust = False,
    quiet: options.Quiet = False,
) -> None:
    """Draw runs or sweeps side by side, with differences from the first, or a group of runs."""
    os.environ["MPLBACKEND"] = "Agg"
    from socialmind.runs.folders import kind_of
    from socialmind.society.settings import pair

    kinds = {kind_of(one) for one in [*folders, *(against or ())]}
    if "sweep" in kinds:
        if len(kinds) > 1 or against:
            raise SocialmindError(
                "sweeps are compared with sweeps, the first the reference; leave out "
                f"{'--against' if against else 'what is none'}"
            )
        _compare_sweeps(folders, column or (), dict(pair(one) for one in unit or ()), out, quiet,
                        trust)  # fmt: skip
        return
    from socialmind.experiments.comparing.figure import figure_of
    from socialmind.experiments.comparing.futures import futures, named

    if len(folders) + len(against or ()) < 2:
        raise SocialmindError("one run alone; give another to compare it with")
    found = futures(named(folders, against or ()), column)
    figure = figure_of(found, dict(pair(one) for one in unit or ()))
    written = write(found, figure, out)
    if not quiet:
        typer.echo("\n".join(last_rows(found)))
    for path in written:
        typer.echo(path)


def _compare_sweeps(
    folders: Sequence[Path],
    outcomes: Sequence[str],
    units: Mapping[str, str],
    out: Path,
    quiet: bool,
    trust: bool,
) -> None:
    """Write the table and the figures of sweeps side by side."""
    from socialmind.commands.plotting import model_of
    from socialmind.documents.labels import labels_of_sweep
    from socialmind.drawing import style as paper
    from socialmind.experiments.comparing.sweep_figures import comparison_figure
    from socialmind.experiments.comparing.sweeps import compare_sweeps, named
    from socialmind.work.files import replace_file

    sweeps = named(folders)
    found = compare_sweeps(sweeps, outcomes)
    first = next(iter(sweeps.values()))
    labels = labels_of_sweep(first.manifest, model_of(first, trust)).also({}, units)
    width = paper.PAGE if len(found.design.columns) > 1 else paper.COLUMN
    figures = {
        f"{NAME}-{one}": comparison_figure(found, one, labels, width) for one in found.outcomes
    }
    written = paper.save(figures, out, ("pdf", "png", "svg"))
    table = out / f"{NAME}.csv"
    replace_file(table, found.table.to_csv(index=False).encode())
    for note in found.notes:
        typer.echo(f"note: {note}", err=True)
    if not quiet:
        typer.echo("\n".join(differences(found)))
    for path in (table, *written):
        typer.echo(path)


def differences(found: SweepsCompared) -> list[str]:
    """Return how far sweeps are apart as lines, the first points of many."""
    from socialmind.experiments.figures.labels import value_name

    rows = [("outcome", "sweep", *found.by, "mean", "difference", "95 % interval")]
    table = found.table[found.table["sweep"] != found.sweeps[0]]
    for one in table.head(ROWS).to_dict("records"):
        low, high = one["difference_low"], one["difference_high"]
        bounds = f"{low:.6g} … {high:.6g}" if math.isfinite(low) else ""
        values = [value_name(one[name]) for name in found.by]
        rows.append((one["outcome"], one["sweep"], *values, f"{one['mean']:.6g}",
                     f"{one['difference']:+.6g}", bounds))  # fmt: skip
    right = [2 + len(found.by), 3 + len(found.by)]
    more = [f"… {len(table) - ROWS} more in {NAME}.csv"] if len(table) > ROWS else []
    head = f"differences {found.paired} from {found.sweeps[0]}:"
    return [head, *aligned(rows, right=right), *more]


def write(found: Futures, figure: Figure, out: Path) -> list[Path]:
    """Write the table as CSV and the figure as PDF, PNG and SVG; gives the files."""
    from socialmind.drawing import style as paper
    from socialmind.work.files import replace_file

    written = paper.save({NAME: figure}, out, ("pdf", "png", "svg"))
    table = out / f"{NAME}.csv"
    replace_file(table, found.table.to_csv(index=False).encode())
    return [table, *written]


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
