"""A figure of futures: each column of the series, and below it how far they are apart."""

from __future__ import annotations

from collections.abc import Mapping
from string import ascii_lowercase
from typing import Any

import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from socialmind.drawing import style as paper
from socialmind.errors import SocialmindError
from socialmind.experiments.comparing.futures import Futures
from socialmind.experiments.figures.axis_text import wrapped
from socialmind.experiments.figures.labels import with_unit

COLOURS = (paper.GREY, paper.BLUE, paper.RED, paper.GOLD, paper.PURPLE)
"""Of the reference and of the others; the colour-blind tell them apart, in grey their dashes do."""
PANEL = 46.0
"""Height of a panel of a column, with its difference below, in mm."""


def draw_futures(axes: Axes, futures: Futures, column: str, unit: str = "") -> Axes:
    """Draw a column of the series of each group over time: its mean, and the interval as a band.

    Args:
        axes: the panel.
        futures: the groups.
        column: of the series.
        unit: of its values, for the axis.

    Returns:
        The panel.
    """
    for place, group in enumerate(futures.groups):
        rows = futures.of(column, group)
        _line(axes, rows["tick"], rows["mean"], rows["low"], rows["high"], place, group)
    return _dressed(axes, futures, with_unit(_said(column), unit))


def draw_difference(axes: Axes, futures: Futures, column: str, unit: str = "") -> Axes:
    """Draw how far the other groups are from the reference, with the interval as a band.

    Args:
        axes: the panel.
        futures: the groups.
        column: of the series.
        unit: of its values, for the axis.

    Returns:
        The panel.
    """
    axes.axhline(0.0, color=COLOURS[0], linestyle=_dashes(0), linewidth=0.8)
    for place, group in enumerate(futures.groups[1:], 1):
        rows = futures.of(column, group)
        low, high = rows["difference_low"], rows["difference_high"]
        _line(axes, rows["tick"], rows["difference"], low, high, place, group)
    return _dressed(axes, futures, with_unit("difference", unit))


def figure_of(futures: Futures, units: Mapping[str, str] | None = None) -> Figure:
    """Return a figure of a page's width: a column a panel, with the differences below each.

    Args:
        futures: the groups, at most five.
        units: of the values of columns, by name.

    Raises:
        SocialmindError: there are more groups than colours that all can tell apart.
    """
    if len(futures.groups) > len(COLOURS):
        raise SocialmindError(
            f"{len(futures.groups)} groups in one figure; expected {len(COLOURS)} at most: "
            "compare fewer, or runs as one group, with --against"
        )
    count = len(futures.columns)
    across = min(3, count)
    down = -(-count // across)
    with paper.style():
        width = paper.PAGE if across > 1 else paper.COLUMN
        figure = paper.figure(width, 1.6 * PANEL * down + 8)
        heights = [1.0, 0.6] * down
        panels = figure.subplots(
            2 * down, across, squeeze=False, gridspec_kw={"height_ratios": heights}
        )
        for place in range(down * across):
            row, column = divmod(place, across)
            above, below = panels[2 * row][column], panels[2 * row + 1][column]
            if place >= count:
                above.set_visible(False)
                below.set_visible(False)
                continue
            name = futures.columns[place]
            unit = (units or {}).get(name, "")
            draw_futures(above, futures, name, unit).set_xlabel("")
            above.tick_params(labelbottom=False)
            draw_difference(below, futures, name, unit)
        shown = [axes for axes in panels.flat if axes.get_visible()]
        differences = set(panels[1::2].flat)
        for axes, letter in zip(shown, ascii_lowercase, strict=False):
            title = f"difference from {_said(futures.groups[0])}" if axes in differences else ""
            paper.panel_title(axes, letter, wrapped(title, axes))
        lines, names = panels[0][0].get_legend_handles_labels()
        figure.legend(lines, names, loc="outside upper left", ncols=len(names))
    return figure


def _line(
    axes: Axes,
    ticks: pd.Series,
    middle: pd.Series,
    low: pd.Series,
    high: pd.Series,
    place: int,
    group: str,
) -> None:
    """Draw a group's line and band; time is in thousand ticks where the axis will be."""
    time = ticks / (1000.0 if ticks.max() >= 10_000 else 1.0)
    axes.plot(time, middle, color=COLOURS[place], linestyle=_dashes(place), label=_said(group))
    axes.fill_between(time, low, high, color=COLOURS[place], alpha=0.25, linewidth=0)


def _dressed(axes: Axes, futures: Futures, label: str) -> Axes:
    """Label the axes, and mark where the futures part."""
    ticks = sorted(set(futures.table["tick"]))
    scale = paper.time_axis(axes, ticks)
    axes.set_ylabel(label)
    if futures.branched is not None:
        axes.axvline(futures.branched / scale, color=paper.INK, linewidth=0.6, linestyle=":")
    return axes


def _dashes(place: int) -> Any:
    return paper.DASHES.get(COLOURS[place], "-")


def _said(name: str) -> str:
    return name.replace("_", " ")
