"""A panel of the page as a figure for print."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from io import BytesIO
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.ticker import MaxNLocator

from socialmind.drawing import style as paper
from socialmind.experiments.figures.axis_text import wrapped
from socialmind.experiments.figures.labels import Labels
from socialmind.experiments.figures.palette import UNORDERED

HEIGHT = 58.0
"""Of a figure, in mm."""
DASHES = ("-", (0, (5, 2)), (0, (1, 1.5)), (0, (5, 1.5, 1, 1.5)))
"""Of the lines of several societies; those of one are solid."""


@dataclass(frozen=True)
class Drawn:
    """What one society shows in a panel.

    Attributes:
        columns: by name; of series ``tick`` first.
        name: what tells it from others.
        units: of columns, as far as they are known.
    """

    columns: Mapping[str, Sequence[Any]]
    name: str
    units: Mapping[str, str] = field(default_factory=dict)


def figure_of(kind: str, societies: Sequence[Drawn], form: str) -> bytes:
    """Return a panel as a file.

    Args:
        kind: "series", "histogram" or "scatter".
        societies: what each shows; of the latter two the first is drawn.
        form: "pdf" or "svg".
    """
    with paper.style():
        figure = paper.figure(paper.COLUMN, HEIGHT)
        axes = figure.subplots()
        labels = Labels(units=societies[0].units)
        if kind == "series":
            _draw_series(axes, societies, labels)
        elif kind == "histogram":
            _draw_histogram(axes, societies[0], labels)
        else:
            _draw_scatter(axes, societies[0], labels)
        content = BytesIO()
        figure.savefig(content, format=form, **paper.FORMS[form])
    return content.getvalue()


def _draw_series(axes: Axes, societies: Sequence[Drawn], labels: Labels) -> None:
    ticks = sorted({tick for one in societies for tick in one.columns["tick"]})
    scale = paper.time_axis(axes, ticks)
    names = list(dict.fromkeys(n for one in societies for n in one.columns if n != "tick"))
    for one, dashes in zip(societies, DASHES, strict=False):
        for name in (name for name in names if name in one.columns):
            said = labels.name(name) + (f", {one.name}" if len(societies) > 1 else "")
            colour = UNORDERED[names.index(name) % len(UNORDERED)]
            at = np.asarray(one.columns["tick"], float) / scale
            values = np.array([np.nan if v is None else v for v in one.columns[name]], float)
            axes.plot(at, values, color=colour, linestyle=dashes, label=said)
    if len(names) == 1:
        axes.set_ylabel(wrapped(labels.axis(names[0]), axes, "height"))
    if len(names) * len(societies) > 1:
        axes.figure.legend(loc="outside upper left", ncols=2)


def _draw_histogram(axes: Axes, society: Drawn, labels: Labels) -> None:
    name = next(one for one in society.columns if one != "agent")
    values = [one for one in society.columns[name] if one is not None]
    if values and isinstance(values[0], str):
        words, counts = np.unique(values, return_counts=True)
        axes.barh(words[::-1], counts[::-1], color=paper.BLUE, height=0.7)  # names have room
        axes.xaxis.set_major_locator(MaxNLocator(5, integer=True))
        axes.set_xlabel("agents")
        axes.set_ylabel(labels.axis(name))
        return
    axes.hist(values, bins=24, color=paper.BLUE, rwidth=0.95)
    axes.yaxis.set_major_locator(MaxNLocator(5, integer=True))
    axes.set_xlabel(labels.axis(name))
    axes.set_ylabel("agents")


def _draw_scatter(axes: Axes, society: Drawn, labels: Labels) -> None:
    names = [one for one in society.columns if one != "agent"]
    x, y = (names[0], names[-1])
    axes.plot(
        society.columns[x], society.columns[y], "o", ms=2.6, alpha=0.6, color=paper.BLUE, mew=0
    )
    axes.set_xlabel(labels.axis(x))
    axes.set_ylabel(wrapped(labels.axis(y), axes, "height"))
