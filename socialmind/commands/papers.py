"""`socialmind odd, methods, export, draw`: what a paper takes of models, runs and minds."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from socialmind.commands.console import options
from socialmind.errors import SocialmindError

if TYPE_CHECKING:
    from matplotlib.figure import Figure

PICTURES = (".pdf", ".svg", ".png")
NARROWEST, WIDEST = 60, 400
"""Millimetres, of a drawing of a scheme."""


def odd(
    model: Annotated[str, typer.Argument(metavar="MODEL", help="A model's name, or its folder.")],
    out: Annotated[
        Path | None,
        typer.Option(metavar="FILE", help="File to write, .md or .html (ODD.md of the model)."),
    ] = None,
    check: Annotated[
        bool, typer.Option("--check", help="Write nothing: exit code 1 when ODD.md is stale.")
    ] = False,
) -> None:
    """Write a model's ODD document from its declarations, docstrings and odd_words.md."""
    from socialmind.catalogue import load_model
    from socialmind.documents.odd import document

    model_class = load_model(model)
    made = document.odd(model_class)
    path = out or model_class.folder() / document.ODD_FILE
    if check:
        odd_ones = [*made.stale(path), *(f"{made.words.file}: missing {gap}" for gap in made.gaps)]
        for one in odd_ones:
            typer.echo(one)
        if odd_ones:
            raise typer.Exit(1)
        typer.echo(f"{path}: up to date")
        return
    for gap in made.gaps:
        typer.echo(f"missing: {gap}", err=True)
    if out is None and not made.words.file.exists():
        document.begin_words(model_class, made.words)
        typer.echo(f"{made.words.file}: fill this in, and call the command again", err=True)
    for written in made.write(path):
        typer.echo(written)


def methods(folder: options.Folder, trust: options.Trust = False) -> None:
    """Print what a paper says of a run or a sweep under "Methods"."""
    from socialmind.documents.methods import methods as paragraph

    typer.echo(paragraph(folder, trust))


def export(
    folder: options.Folder,
    to: Annotated[str, typer.Option(metavar="csv|xlsx|dta|latex", help="What to write.")],
    table: Annotated[
        list[str] | None,
        typer.Option(metavar="NAME", help="A table to write; again for further ones (all)."),
    ] = None,
    out: Annotated[
        Path | None, typer.Option(metavar="DIR", help="Folder to write into (export/ in DIR).")
    ] = None,
) -> None:
    """Write the tables of a run or a sweep for Excel, Stata, LaTeX, or as CSV."""
    from socialmind.documents.tables import export as written

    made = written(folder, to, out, table or ())
    for name, renamed in made.renamed.items():
        for old, new in renamed.items():
            typer.echo(f"{name}: {old} is called {new} in Stata", err=True)
    for path in made.files:
        typer.echo(path)


def draw(
    file: Annotated[
        Path,
        typer.Argument(
            metavar="FILE", help="A scheme (.yaml, .cogscheme), or a mind's folder or YAML file."
        ),
    ],
    out: Annotated[
        Path | None,
        typer.Option(
            metavar="FILE", help="Picture to write, .pdf, .svg or .png (FILE's name, .pdf)."
        ),
    ] = None,
    width: Annotated[
        float | None,
        typer.Option(metavar="MM", help="Width of a scheme's drawing (90, a column of a journal)."),
    ] = None,
    master: Annotated[
        str | None, typer.Option(metavar="SKILL", help="Skill at the top of a mind's drawing.")
    ] = None,
) -> None:
    """Draw a cognitive scheme, or a mind of skills, for a page of print."""
    from socialmind.commands.checking_minds import is_mind
    from socialmind.drawing import style

    path = out or Path(f"{file.name.rpartition('.')[0] or file.name}.pdf")
    if path.suffix.lower() not in PICTURES:
        expected = f"expected {', '.join(PICTURES)}"
        raise SocialmindError(f"{path}: found {path.suffix or 'no suffix'}; {expected}")
    if is_mind(file):
        if width is not None:
            raise SocialmindError("--width is for schemes: a mind's drawing is as wide as it needs")
        figure = _mind(file, master)
    elif not file.is_file():
        found = "a folder that is no mind" if file.is_dir() else "no such file"
        expected = "a scheme's file, or a mind's folder or YAML file, as in a model's folder"
        raise SocialmindError(f"{file}: {found}; expected {expected}")
    else:
        from coglogo_py import CognitiveScheme
        from socialmind.drawing.scheme import scheme_figure

        if master is not None:
            raise SocialmindError("--master is for minds of skills; a scheme has none")
        if width is not None and not NARROWEST <= width <= WIDEST:
            raise SocialmindError(f"--width {width:g}: expected {NARROWEST} … {WIDEST} mm")
        figure = scheme_figure(CognitiveScheme.load(file), width)
    with style.style():
        style.write_figure(figure, path, dpi=300)
    typer.echo(path)


def _mind(path: Path, master: str | None) -> Figure:
    """Return the drawing of a mind; its programs are not run."""
    from socialmind.mind.description import MindDescription
    from socialmind.mind.files.python_file import programs_unrun
    from socialmind.mind.hierarchy import Hierarchy
    from socialmind.mind.views.drawing import draw_hierarchy

    with programs_unrun():
        figure: Any = draw_hierarchy(Hierarchy(MindDescription.load(path), master)).figure
    return figure
