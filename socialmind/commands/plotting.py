"""`socialmind plot`: the figures of a run, or those that a sweep's design calls for."""

from __future__ import annotations

import os
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from socialmind.commands.console import options
from socialmind.errors import SocialmindError

if TYPE_CHECKING:
    from socialmind.experiments.figures.labels import Labels
    from socialmind.experiments.sweeps.result import Sweep
    from socialmind.model import Model

NARROWEST, WIDEST = 60, 400
"""Millimetres, of a figure."""
SEVERAL = "may be repeated"
OF_ALL = ("folder", "trust")


def plot(
    context: typer.Context,
    folder: Annotated[
        Path,
        typer.Argument(metavar="DIR", help="A run's or a sweep's folder.", show_default=False),
    ],
    of: Annotated[
        list[str] | None,
        typer.Option(
            metavar="MEASURE",
            help=f"Of a sweep: a measure, or a column of runs.parquet; {SEVERAL} (all measures).",
        ),
    ] = None,
    baseline: Annotated[
        list[str] | None,
        typer.Option(
            metavar="NAME=VALUE",
            help=f"Of a sweep: the point to compare with; {SEVERAL} (the model's defaults).",
        ),
    ] = None,
    statistic: Annotated[
        str | None,
        typer.Option(
            metavar="mean|median",
            help="Mean with its interval, or median with quantiles of the runs (mean).",
        ),
    ] = None,
    interval: Annotated[
        float | None, typer.Option(metavar="SHARE", help="Level of intervals (0.95).")
    ] = None,
    label: Annotated[
        list[str] | None,
        typer.Option(metavar="NAME=TEXT", help=f"What a column is called; {SEVERAL}."),
    ] = None,
    unit: Annotated[
        list[str] | None,
        typer.Option(metavar="NAME=UNIT", help=f"Unit of a column; {SEVERAL}."),
    ] = None,
    width: Annotated[
        str | None,
        typer.Option(metavar="column|double|MM", help="85 mm, 180 mm, or another (column)."),
    ] = None,
    form: Annotated[
        str | None,
        typer.Option("--format", metavar="pdf,svg,png", help="Files of each figure (pdf,png)."),
    ] = None,
    no_captions: Annotated[
        bool, typer.Option("--no-captions", help="Leave the lines below figures of a sweep out.")
    ] = False,
    out: Annotated[
        Path | None, typer.Option(metavar="DIR", help="Folder for a sweep's figures (DIR/figures).")
    ] = None,
    trust: options.Trust = False,
) -> None:
    """Draw the figures of a run or a sweep, under figures/ in its folder."""
    from socialmind.commands.running import draw
    from socialmind.runs.folders import kind_of

    if kind_of(folder) != "sweep":
        given = [
            str(one.opts[0])
            for one in context.command.params
            if one.name not in OF_ALL and context.params[str(one.name)]
        ]
        if given:
            raise SocialmindError(
                f"{', '.join(given)}: for sweeps; a run's figures are those of its model, see "
                "docs/drawing.md"
            )
        for path in draw(folder, trust):
            typer.echo(path)
        return
    os.environ["MPLBACKEND"] = "Agg"
    from socialmind.documents.labels import defaults_of, labels_of_sweep
    from socialmind.drawing import style
    from socialmind.experiments.figures.estimates import Summary
    from socialmind.experiments.figures.of_sweeps import Wanted, draw_sweep
    from socialmind.experiments.sweeps.result import Sweep

    forms = read_forms(form or "pdf,png")
    wanted = Wanted(
        tuple(of or ()),
        Summary(statistic or "mean", 0.95 if interval is None else interval),
        dict(_pair("--baseline", one) for one in baseline or ()),
        read_width(width or "column"),
        not no_captions,
    )
    sweep = Sweep(folder)
    model_class = model_of(sweep, trust)
    names, units = (dict(_pair(o, one) for one in several or ())
                    for o, several in (("--label", label), ("--unit", unit)))  # fmt: skip
    labels = labels_of_sweep(sweep.manifest, model_class).also(names, units)
    drawn = draw_sweep(sweep, wanted, labels, defaults_of(model_class))
    for name, caption in drawn.captions.items():
        typer.echo(f"{name}: {caption}", err=True)
    for note in [*drawn.notes, *without_units(sweep, drawn.figures, labels)]:
        typer.echo(f"note: {note}", err=True)
    for path in style.save(drawn.figures, out or folder / "figures", forms):
        typer.echo(path)


def model_of(sweep: Sweep, trust: bool) -> type[Model] | None:
    """Return the model of a sweep, which has units; None, and a line, where it is not at hand."""
    from socialmind.runs.sources import recorded_class

    try:
        return recorded_class(sweep.capsule, trust=trust)
    except SocialmindError as error:
        typer.echo(f"note: axes lack the model's units: {error}", err=True)
        return None


def without_units(sweep: Sweep, figures: Any, labels: Labels) -> list[str]:
    """Return a line on what stands at an axis without a unit, if anything does."""
    shown = [one.partition("-")[2] for one in figures]
    bare = [
        one
        for one in dict.fromkeys([*sweep.varied, *shown])
        if not labels.units.get(one) and (one in shown or _is_number(sweep, one))
    ]
    if not bare:
        return []
    first = bare[0]
    return [f"no unit is known of {', '.join(bare)}; --unit {first}=UNIT gives one"]


def _is_number(sweep: Sweep, column: str) -> bool:
    own = sweep.design.get(column)
    return own is not None and own.dtype.kind in "if" and own.nunique() > 1


def read_width(text: str) -> float:
    """Return a width in mm.

    Raises:
        SocialmindError: neither a journal's, nor a number that can be one.

    >>> read_width("double"), read_width("120")
    (180.0, 120.0)
    """
    from socialmind.drawing import style

    known = {"column": style.COLUMN, "double": style.PAGE}
    if text in known:
        return known[text]
    try:
        found = float(text)
    except ValueError:
        found = 0.0
    if not NARROWEST <= found <= WIDEST:
        raise SocialmindError(
            f"--width {text}: expected column (85 mm), double (180 mm) or {NARROWEST} … {WIDEST}"
        )
    return found


def read_forms(text: str) -> list[str]:
    """Return the forms of files.

    Raises:
        SocialmindError: one is none.

    >>> read_forms("pdf,svg")
    ['pdf', 'svg']
    """
    from socialmind.drawing import style

    found = list(dict.fromkeys(one.strip().lstrip(".").lower() for one in text.split(",")))
    odd: Sequence[str] = [one for one in found if one not in style.FORMS]
    if odd:
        raise SocialmindError(f"--format {text}: expected some of {','.join(style.FORMS)}")
    return found


def _pair(option: str, text: str) -> tuple[str, str]:
    name, equals, said = (part.strip() for part in text.partition("="))
    if not equals or not name:
        raise SocialmindError(f"{option} {text}: expected NAME=…")
    return name, said
