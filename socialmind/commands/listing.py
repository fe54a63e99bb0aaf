"""`socialmind list`."""

from __future__ import annotations

import inspect
from collections.abc import Sequence
from typing import TYPE_CHECKING

import typer

from socialmind.catalogue import catalogue, load_model
from socialmind.errors import SocialmindError

if TYPE_CHECKING:
    from socialmind.model import Model


def print_models() -> bool:
    """Print every model with its parameters; False when one of them cannot be loaded."""
    good = True
    for position, name in enumerate(catalogue()):
        if position:
            typer.echo()
        try:
            typer.echo(description(name, load_model(name)))
        except SocialmindError as error:
            typer.echo(f"socialmind: {error}", err=True)
            good = False
    return good


def description(name: str, model_class: type[Model]) -> str:
    """A model's name, what it is, and its parameters with default, unit and range."""
    about = (inspect.getdoc(model_class) or "").partition("\n")[0]
    lines = [f"{name}: {about}" if about else name]
    rows = [
        (p.name, _written(p.default), p.unit, p.range, p.doc)
        for p in model_class.parameters.values()
    ]
    if rows:
        lines += aligned([("parameter", "default", "unit", "range", ""), *rows])
    return "\n".join(lines)


def aligned(rows: Sequence[Sequence[str]]) -> list[str]:
    """Rows of a table as lines with straight columns."""
    widths = [max(map(len, column)) for column in zip(*rows, strict=True)]
    return [
        "  "
        + "  ".join(cell.ljust(width) for cell, width in zip(row, widths, strict=True)).rstrip()
        for row in rows
    ]


def _written(value: float | int | bool | str) -> str:
    if isinstance(value, str):
        return value
    return str(value).lower() if isinstance(value, bool) else f"{value:.10g}"
