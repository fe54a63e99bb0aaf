"""Whole figures of sweeps: panels put together, with a key, at a journal's width."""

from __future__ import annotations

import math
from collections.abc import Sequence
from textwrap import fill
from typing import Any

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from socialmind.drawing import style as paper
from socialmind.errors import SocialmindError
from socialmind.experiments.figures.design import Design, Varying
from socialmind.experiments.figures.estimates import Effects, Estimates
from socialmind.experiments.figures.labels import Labels, value_name
from socialmind.experiments.figures.palette import MOST_LINES
from socialmind.experiments.figures.panels import (
    draw_bands,
    draw_effects,
    draw_response,
    draw_scatter,
    draw_surface,
)

NARROWEST_PANEL = 40.0
"""Width of a panel among several, in mm."""
IN_A_ROW, ROW = 3, 11.5
"""Lines in a row of a panel's own key, and the height of a row, in points."""
LINE = 1.36
"""Width of a letter of 7 points, in mm, about."""


def put_caption(figure: Figure, caption: str) -> None:
    """Write a line below a figure that says how it was made, in grey."""
    letters = int(figure.get_figwidth() * 25.4 / LINE)
    figure.supxlabel(
        fill(caption, letters), x=0.01, ha="left", fontsize=7, color=paper.GREY
    )  # fmt: skip


def response_figure(found: Estimates, design: Design, labels: Labels, width: float) -> Figure:
    """Return the figure of an outcome over up to four columns whose values are crossed.

    One number: a curve. One of names: dots. Two of numbers: a map of cells, and curves with
    intervals. Three or four: panels for each value of the third and fourth.

    Args:
        found: the outcome, by what varies.
        design: the design, crossed.
        labels: names and units.
        width: in mm.
    """
    columns = design.columns
    if len(columns) == 1:
        figure = paper.figure(width, min(0.7 * width, 75))
        draw_response(figure.subplots(), found, columns[0].name, labels=labels)
        return figure
    first, second, *others = columns
    as_lines = len(second.values) <= MOST_LINES
    if not others:
        if as_lines and not (first.numeric and second.numeric):
            figure = paper.figure(width, min(0.8 * width, 85))
            draw_response(figure.subplots(), found, first.name, second.name, labels)
            _key(figure, [figure.axes[0]], second, labels, width)
            return figure
        return _two_views(found, first, second, as_lines, labels, width)
    figure, panels = _small_multiples(columns[2:], labels, width, 46.0)
    known = found.table[["low", "high", "middle"]].to_numpy(float)
    limits = (float(np.nanmin(known[:, 2])), float(np.nanmax(known[:, 2])))
    for axes, values in panels:
        own = found.only(values)
        if as_lines:
            draw_response(axes, own, first.name, second.name, labels, second)
            axes.set_ylim(*_with_air(known))
        else:
            draw_surface(axes, own, first.name, second.name, labels, limits, bar=False)
    drawn = [axes for axes, _ in panels]
    if as_lines:
        _key(figure, drawn, second, labels, width)
    else:
        bar = figure.colorbar(drawn[0].collections[0], ax=drawn, pad=0.02, aspect=30)
        bar.outline.set_visible(False)
        bar.set_label(labels.axis(found.of))
    _inner_labels(drawn, figure)
    return figure


def _two_views(
    found: Estimates, first: Varying, second: Varying, as_lines: bool, labels: Labels, width: float
) -> Figure:
    """Return a map of cells, and beside or below it the curves with their intervals.

    Of too many lines the second is a map of how wide the intervals are.
    """
    beside = width >= 2 * 75
    figure = paper.figure(width, 72 if beside else 126)
    panels = figure.subplots(1, 2) if beside else figure.subplots(2, 1)
    draw_surface(panels[0], found, first.name, second.name, labels)
    paper.panel_title(panels[0], "a", "")
    if as_lines:
        draw_response(panels[1], found, first.name, second.name, labels)
        rows = -(-len(second.values) // IN_A_ROW)
        panels[1].legend(
            ncols=IN_A_ROW, loc="lower left", bbox_to_anchor=(0.0, 1.0), borderaxespad=0.2,
            columnspacing=1.2, handlelength=2.6,
        ).set_in_layout(False)  # fmt: skip  # wider than the panel, it would narrow all panels
        title = rf"$\bf{{b}}$   {labels.axis(second.name)}"
        panels[1].set_title(title, pad=5 + ROW * rows)
    elif found.has_intervals:
        half = found.table.assign(middle=(found.table["high"] - found.table["low"]) / 2)
        half = half.assign(low=math.nan, high=math.nan)
        widths = Estimates(half, found.by, "half", found.summary)
        unit = labels.units.get(found.of, "")
        called = labels.also({"half": "half the width of the interval"}, {"half": unit})
        draw_surface(panels[1], widths, first.name, second.name, called)
        paper.panel_title(panels[1], "b", "")
    else:
        panels[1].set_visible(False)
    return figure


def partial_figure(
    found: Estimates, design: Design, labels: Labels, width: float
) -> tuple[Figure, str]:
    """Return the figure of an outcome at points that fill a space: against each column in turn.

    Args:
        found: the outcome, by what varies.
        design: the design.
        labels: names and units.
        width: in mm.

    Returns:
        The figure, and what a caption says of its lines.
    """
    columns = design.columns
    across = max(1, min(len(columns), int(width // NARROWEST_PANEL)))
    down = -(-len(columns) // across)
    figure = paper.figure(width, 12 + 44 * down)
    panels = figure.subplots(down, across, squeeze=False, sharey=True)
    for axes, one in zip(panels.flat, columns, strict=False):
        draw_scatter(axes, found, one.name, labels)
    for axes in panels.flat[len(columns) :]:
        axes.set_visible(False)
    _inner_labels(list(panels.flat[: len(columns)]), figure)
    splined = any(one.numeric and len(one.values) >= 10 for one in columns)
    lines = "smoothing splines" if splined else "means at each value"
    if splined and not any(
        np.size(axes.lines[0].get_xdata()) for axes in figure.axes if axes.lines
    ):
        lines = 'none, for want of scipy (pip install "socialmind[analysis]")'
    return figure, f"; a dot a point, whatever the other parameters are; lines: {lines}"


def bands_figure(
    found: Estimates, columns: Sequence[Varying], labels: Labels, width: float
) -> Figure:
    """Return the figure of a column of the series over time: lines with bands, panels beyond.

    Args:
        found: the column, by what varies and `tick`.
        columns: what varies, at most three: as lines, as columns of panels, as rows of panels.
        labels: names and units.
        width: in mm.
    """
    if len(columns) < 2:
        figure = paper.figure(width, min(0.75 * width, 75))
        by = columns[0] if columns else None
        draw_bands(figure.subplots(), found, by.name if by else None, labels, by)
        panels: list[tuple[Axes, dict[str, Any]]] = [(figure.axes[0], {})]
    else:
        figure, panels = _small_multiples(columns[1:], labels, width, 40.0)
        known = found.table[["low", "high", "middle"]].to_numpy(float)
        for axes, values in panels:
            draw_bands(axes, found.only(values), columns[0].name, labels, columns[0])
            axes.set_ylim(*_with_air(known))
    drawn = [axes for axes, _ in panels]
    if columns:
        _key(figure, drawn, columns[0], labels, width)
    _inner_labels(drawn, figure)
    return figure


def effects_figure(found: Effects, labels: Labels, width: float) -> Figure:
    """Return the figure of effects beside a baseline, a row a point.

    Args:
        found: the differences.
        labels: names and units.
        width: in mm.
    """
    figure = paper.figure(width, 28 + 4.6 * max(3, len(found.table)))
    names = None
    if len(found.by) > 1:
        names = [_changes(row, found, labels) for _, row in found.table.iterrows()]
    draw_effects(figure.subplots(), found, labels, names)
    return figure


def _changes(row: pd.Series, found: Effects, labels: Labels) -> str:
    """Return what differs from the baseline at a point."""
    return ", ".join(
        f"{labels.name(name)} {value_name(row[name])}"
        for name in found.by
        if row[name] != found.baseline[name]
    )


def _small_multiples(
    columns: Sequence[Varying], labels: Labels, width: float, height: float
) -> tuple[Figure, list[tuple[Axes, dict[str, Any]]]]:
    """Return a figure with a panel for each value of one column, or each pair of two."""
    most = max(1, int(width // NARROWEST_PANEL))
    if len(columns) == 1:
        places = [{columns[0].name: value} for value in columns[0].values]
        across = min(most, len(places))
        down = -(-len(places) // across)
    else:
        places = [{columns[1].name: b, columns[0].name: a}
                  for b in columns[1].values for a in columns[0].values]  # fmt: skip
        across, down = len(columns[0].values), len(columns[1].values)
        if across > 1.6 * most:
            raise SocialmindError(
                f"{across} columns of panels, a value of {columns[0].name} each, in {width:g} mm; "
                "give more room: --width double"
            )
    figure = paper.figure(width, 16 + height * down)
    panels = figure.subplots(down, across, squeeze=False, sharex=True, sharey=True)
    for axes, values in zip(panels.flat, places, strict=False):
        said = [f"{labels.name(name)} {value_name(value)}" for name, value in values.items()]
        letters = int(width / across / LINE * 0.8)
        axes.set_title("\n".join(fill(one, letters) for one in said), fontsize=7)
    for axes in panels.flat[len(places) :]:
        axes.set_visible(False)
    return figure, list(zip(panels.flat, places, strict=False))


def _inner_labels(panels: Sequence[Axes], figure: Figure) -> None:
    """Leave labels of axes out where the panel beside or below has the same."""
    places = {}
    for axes in panels:
        spec = axes.get_subplotspec()
        if spec is not None:
            places[spec.rowspan.start, spec.colspan.start] = axes
    for (row, column), axes in places.items():
        left, below = places.get((row, column - 1)), places.get((row + 1, column))
        if left is not None and left.get_ylabel() == axes.get_ylabel():
            axes.set_ylabel("")
        if below is not None and below.get_xlabel() == axes.get_xlabel():
            axes.set_xlabel("")
        elif below is None:
            axes.tick_params(labelbottom=True)


def _key(
    figure: Figure, panels: Sequence[Axes], one: Varying, labels: Labels, width: float
) -> None:
    """Put the key of lines above the panels."""
    handles, names = panels[0].get_legend_handles_labels()
    longest = max(map(len, names)) if names else 1
    room = max(1, int(width / (12 + longest * LINE)))
    figure.legend(
        handles, names, title=labels.axis(one.name), title_fontsize=7, alignment="left",
        loc="outside upper left", ncols=min(len(names), room), columnspacing=1.2, handlelength=2.6,
    )  # fmt: skip


def _with_air(known: np.ndarray[Any, Any]) -> tuple[float, float]:
    low, high = float(np.nanmin(known)), float(np.nanmax(known))
    air = 0.05 * (high - low) or 0.5
    return low - air, high + air
