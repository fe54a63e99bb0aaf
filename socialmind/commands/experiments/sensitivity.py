"""`socialmind sensitivity`: what the outputs of a sweep depend on."""

from __future__ import annotations

import os
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from socialmind.commands.console import options
from socialmind.errors import SocialmindError, nearest

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from socialmind.experiments.sensitivity.indices import Sensitivity

NAME = "sensitivity"
"""What the folder, the figure and the text are called that are written."""


def sensitivity(
    folder: Annotated[
        Path, typer.Argument(metavar="DIR", help="A sweep's folder.", show_default=False)
    ],
    of: Annotated[
        list[str] | None,
        typer.Option(
            metavar="OUTPUT",
            help="A measure, or the end of a series; may be repeated (all measures).",
        ),
    ] = None,
    regress: Annotated[
        bool,
        typer.Option("--regression", help="Regression and rank correlation, whatever the design."),
    ] = False,
    level: Annotated[float, typer.Option(metavar="SHARE", help="Level of the intervals.")] = 0.95,
    seed: Annotated[
        int, typer.Option(**options.FROM_0, help="Seed of the draws behind the intervals.")
    ] = 0,
    unit: Annotated[
        list[str] | None,
        typer.Option(metavar="OUTPUT=UNIT", help="Unit of an output, for the figure."),
    ] = None,
    out: Annotated[
        Path | None,
        typer.Option(metavar="DIR", help="Folder for tables and figure (sensitivity/ in DIR)."),
    ] = None,
    trust: options.Trust = False,
    quiet: options.Quiet = False,
) -> None:
    """Say what the outputs of a sweep depend on, by the method that its design is made for."""
    os.environ["MPLBACKEND"] = "Agg"
    from socialmind.commands.plotting import model_of
    from socialmind.documents.labels import labels_of_sweep
    from socialmind.experiments.sensitivity.figure import figure_of
    from socialmind.experiments.sensitivity.indices import sensitivity_of
    from socialmind.experiments.sensitivity.words import report
    from socialmind.experiments.sweeps.result import Sweep
    from socialmind.society.settings import pair

    units = dict(pair(one) for one in unit or ())
    found = sensitivity_of(folder, of or None, level, seed, regress)
    for name in units:
        if name not in found.outputs:
            raise SocialmindError(f"--unit: unit of {name}; {nearest(name, found.outputs)}")
    lines = report(found)
    if not quiet:
        typer.echo("\n".join(lines))
    sweep = Sweep(folder)
    labels = labels_of_sweep(sweep.manifest, model_of(sweep, trust)).also({}, units)
    for path in write(found, lines, figure_of(found, labels), out or folder / NAME):
        typer.echo(path)


def write(found: Sensitivity, lines: list[str], figure: Figure, out: Path) -> list[Path]:
    """Write tables as CSV, the report as text, the figure as PDF and PNG; gives the files."""
    from socialmind.drawing import style as paper
    from socialmind.work.files import replace_file

    pictures = paper.save({NAME: figure}, out)
    contents = {
        "indices.csv": found.table.to_csv(index=False),
        "luck.csv": found.luck.to_csv(index=False),
        f"{NAME}.txt": "\n".join(lines) + "\n",
    }
    for name, content in contents.items():
        replace_file(out / name, content.encode())
    return [*(out / name for name in contents), *pictures]
