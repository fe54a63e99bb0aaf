"""Text on panels that have little room: labels broken, names turned, numbers in cells."""

from __future__ import annotations

import math
from textwrap import fill
from typing import Any

import matplotlib as mpl
import numpy as np
from matplotlib.axes import Axes

from socialmind.drawing import style as paper
from socialmind.experiments.figures.design import Varying
from socialmind.experiments.figures.labels import value_name
from socialmind.experiments.figures.palette import SURFACE

LETTER = 1.45
"""Width of a letter of 7.5 points, in mm, about."""
DIGIT = 1.5
"""Width of a digit of 7 points, in mm, about."""


def wrapped(text: str, axes: Axes, side: str = "width", room: float = 0.72) -> str:
    """Return a label in as many lines as the side of its panel asks for.

    Args:
        text: the label; where it is too long, its unit gets a line of its own.
        axes: the panel.
        side: `width` or `height`.
        room: share of the panel's part of the figure that the label may take.
    """
    letters = max(12, int(room * _room(axes, side) / LETTER))
    name, bracket, unit = text.rpartition(" (")
    if len(text) <= letters or not bracket:
        return _evenly(text, letters)
    return f"{_evenly(name, letters)}\n{_evenly(f'({unit}', letters)}"


def _evenly(text: str, letters: int) -> str:
    """Return a text in as few lines as it needs, about as long as each other."""
    count = len(fill(text, letters).splitlines())
    while letters > 12 and len(fill(text, letters - 1).splitlines()) == count:
        letters -= 1
    return fill(text, letters)


def turn_if_crowded(axes: Axes, along: Varying) -> None:
    """Turn the names of values where they would meet."""
    longest = max(len(value_name(value)) for value in along.values)
    room = 0.68 * _room(axes) / len(along.values)
    if (longest + 1) * DIGIT > room:
        axes.tick_params(axis="x", labelrotation=90 if longest <= 6 else 30)


def number_cells(axes: Axes, cells: dict[str, Any], low: float, high: float) -> None:
    """Write the numbers into the cells, as much of them as the narrowest has room for."""
    middle = cells["middle"]
    known = np.abs(middle[np.isfinite(middle)])
    if not known.size:
        return
    digits = _digits(cells)
    width = 0.68 * _room(axes) / middle.shape[1]
    height = 0.7 * _room(axes, "height") / middle.shape[0]

    def said(number: float) -> str:
        return f"{number:,.{digits}f}".replace("-", "−") if math.isfinite(number) else ""

    alone = np.vectorize(said)(middle)
    bounds = np.array([[f"{said(a)}–{said(b)}" if math.isfinite(a) else ""
                        for a, b in zip(*rows, strict=True)]
                       for rows in zip(cells["low"], cells["high"], strict=True)])  # fmt: skip
    room = width / DIGIT
    if max(map(len, alone.flat)) > room or height < 3.5:
        return
    both = max(map(len, bounds.flat)) <= room and height > 7.0
    scale = mpl.colormaps[SURFACE]
    for (row, column), text in np.ndenumerate(alone):
        if not text:
            continue
        share = 0.5 if high == low else (middle[row, column] - low) / (high - low)
        red, green, blue, _ = scale(float(np.clip(share, 0, 1)))
        ink = "white" if 0.3 * red + 0.59 * green + 0.11 * blue < 0.5 else paper.INK
        told = f"{text}\n{bounds[row, column]}" if both and bounds[row, column] else text
        axes.text(column + 0.5, row + 0.5, told, ha="center", va="center", color=ink, fontsize=7,
                  linespacing=1.15)  # fmt: skip


def _digits(cells: dict[str, Any]) -> int:
    """Return the digits behind the point: as many as intervals leave meaning to."""
    half = (cells["high"] - cells["low"]) / 2
    half = half[np.isfinite(half) & (half > 0)]
    known = np.abs(cells["middle"][np.isfinite(cells["middle"])])
    scale = float(np.median(half)) if half.size else float(np.median(known)) / 10
    # Half a unit of the last digit is to be little beside the interval.
    return min(4, max(0, math.ceil(-math.log10(scale / 3)))) if scale > 0 else 1


def _room(axes: Axes, side: str = "width") -> float:
    """Return the mm that a panel and what belongs to it have of its figure."""
    figure = axes.get_figure(root=True)
    assert figure is not None
    inches = figure.get_figwidth() if side == "width" else figure.get_figheight()
    place = axes.get_subplotspec()
    if place is None:
        return inches * 25.4
    grid = place.get_gridspec()
    count, span = (grid.ncols, place.colspan) if side == "width" else (grid.nrows, place.rowspan)
    return inches * 25.4 * len(span) / count
