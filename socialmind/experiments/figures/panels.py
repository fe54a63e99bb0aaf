"""Panels of figures of sweeps: each takes a table of estimates and Axes, and returns the Axes.

>>> import pandas as pd
>>> from socialmind.drawing import style
>>> from socialmind.experiments.figures.estimates import estimates
>>> runs = pd.DataFrame({"price": [1.0, 1.0, 2.0, 2.0, 4.0, 4.0], "sold": [3, 4, 5, 6, 7, 9]})
>>> axes = style.figure(style.COLUMN, 60).subplots()
>>> draw_response(axes, estimates(runs, ["price"], "sold"), "price").get_ylabel()
'sold'
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.ticker import FixedLocator, MaxNLocator, NullLocator
from matplotlib.transforms import ScaledTranslation

from socialmind.drawing import style as paper
from socialmind.experiments.figures.axis_text import number_cells, turn_if_crowded, wrapped
from socialmind.experiments.figures.design import Varying
from socialmind.experiments.figures.estimates import Effects, Estimates
from socialmind.experiments.figures.labels import Labels, value_name
from socialmind.experiments.figures.palette import SURFACE, lines
from socialmind.experiments.measures.intervals import Interval

TICK = "tick"
APART = 1.6
"""Points between the intervals of two lines at one place."""
FEW = 8
"""Values that all stand at an axis."""
NO_LABELS = Labels()


def draw_response(
    axes: Axes, found: Estimates, x: str, by: str | None = None, labels: Labels = NO_LABELS,
    of_lines: Varying | None = None,
) -> Axes:  # fmt: skip
    """Draw an outcome against a parameter, with its intervals.

    Args:
        axes: the panel.
        found: the outcome, by `x` and perhaps another column.
        x: what goes along the axis: numbers, or names, which get places of their own.
        by: the other column, a line for each of its values; at most six.
        labels: names and units.
        of_lines: all values of `by`, where the panel is one of several.

    Returns:
        The panel.
    """
    along = varying(found.table, x)
    many = [None] if by is None else list((of_lines or varying(found.table, by)).values)
    ordered = by is not None and (of_lines or varying(found.table, by)).numeric
    places = {value: place for place, value in enumerate(along.values)}
    for place, (value, look) in enumerate(zip(many, lines(len(many), ordered), strict=True)):
        rows = found.table if by is None else found.table[found.table[by] == value]
        rows = rows.sort_values(x) if along.numeric else rows
        at = rows[x] if along.numeric else rows[x].map(places)
        # Side by side, so that no interval hides another; the numbers stay what they are.
        away = APART * (place - (len(many) - 1) / 2)
        axes.errorbar(
            at, rows["middle"], yerr=_reach(rows), color=look.colour, marker=look.marker,
            markersize=3.2, linestyle=look.dashes if along.numeric else "none", linewidth=1.0,
            elinewidth=0.9, capsize=1.6, capthick=0.9,
            label=None if by is None else value_name(value), transform=_moved(axes, away),
        )  # fmt: skip
        for name in ("low", "middle", "high"):
            axes.update_datalim(np.column_stack([at, rows[name].fillna(rows["middle"])]))
    axes.autoscale_view()
    _fit(axes, found.table, along)
    axes.set_xlabel(wrapped(labels.axis(x), axes))
    axes.set_ylabel(wrapped(labels.axis(found.of), axes, "height"))
    return axes


def draw_bands(
    axes: Axes, found: Estimates, by: str | None = None, labels: Labels = NO_LABELS,
    of_lines: Varying | None = None,
) -> Axes:  # fmt: skip
    """Draw a column of the series over time, with its intervals as bands.

    Args:
        axes: the panel.
        found: the column, by `tick` and perhaps another column.
        by: the other column, a line and a band for each of its values; at most six.
        labels: names and units.
        of_lines: all values of `by`, where the panel is one of several.

    Returns:
        The panel.
    """
    many = [None] if by is None else list((of_lines or varying(found.table, by)).values)
    ordered = by is not None and (of_lines or varying(found.table, by)).numeric
    scale = paper.time_axis(axes, sorted(set(found.table[TICK])))
    for value, look in zip(many, lines(len(many), ordered), strict=True):
        rows = found.table if by is None else found.table[found.table[by] == value]
        rows = rows.sort_values(TICK)
        axes.plot(
            rows[TICK] / scale, rows["middle"], color=look.colour, linestyle=look.dashes,
            marker=look.marker, markersize=2.8, markevery=max(1, len(rows) // 6),
            label=None if by is None else value_name(value),
        )  # fmt: skip
        if rows["low"].notna().any():
            axes.fill_between(
                rows[TICK] / scale, rows["low"], rows["high"], color=look.colour, alpha=0.22,
                linewidth=0,
            )  # fmt: skip
    axes.set_ylabel(wrapped(labels.axis(found.of), axes, "height"))
    return axes


def draw_surface(
    axes: Axes, found: Estimates, x: str, y: str, labels: Labels = NO_LABELS,
    limits: tuple[float, float] | None = None, bar: bool = True,
) -> Axes:  # fmt: skip
    """Draw an outcome over two columns as a map of cells, with its numbers where there is room.

    Cells are equally large, whatever the distances of the values. In each stands the middle, and
    below it the interval, where all cells have room for it.

    Args:
        axes: the panel.
        found: the outcome, by `x` and `y`.
        x: what goes along the axis below.
        y: what goes along the axis at the left.
        labels: names and units.
        limits: of the colours, where several panels share them.
        bar: whether a bar of the colours stands beside the panel.

    Returns:
        The panel.
    """
    across, up = varying(found.table, x), varying(found.table, y)
    cells = {
        name: np.array([[_at(found.table, name, x, a, y, b) for a in across.values]
                        for b in up.values])
        for name in ("middle", "low", "high")
    }  # fmt: skip
    known = cells["middle"][np.isfinite(cells["middle"])]
    low, high = limits or ((float(known.min()), float(known.max())) if len(known) else (0.0, 1.0))
    mesh = axes.pcolormesh(
        np.ma.masked_invalid(cells["middle"]), cmap=SURFACE, vmin=low, vmax=high,
        edgecolors="white", linewidth=0.4,
    )  # fmt: skip
    axes.set_xticks(np.arange(len(across.values)) + 0.5, [value_name(v) for v in across.values])
    axes.set_yticks(np.arange(len(up.values)) + 0.5, [value_name(v) for v in up.values])
    turn_if_crowded(axes, across)
    axes.tick_params(length=0)
    for side in axes.spines.values():
        side.set_visible(False)
    number_cells(axes, cells, low, high)
    if bar:
        beside = axes.figure.colorbar(mesh, ax=axes, pad=0.02, aspect=25)
        beside.outline.set_visible(False)
        beside.set_label(wrapped(labels.axis(found.of), axes, "height"))
    axes.set_xlabel(wrapped(labels.axis(x), axes))
    axes.set_ylabel(wrapped(labels.axis(y), axes, "height"))
    return axes


def draw_scatter(axes: Axes, found: Estimates, x: str, labels: Labels = NO_LABELS) -> Axes:
    """Draw an outcome at points that fill a space against one column, whatever the others are.

    The line is a smoothing spline whose smoothness generalised cross-validation chooses
    (`scipy.interpolate.make_smoothing_spline`); where fewer than ten different values are, it joins
    the means at each. Names get dots and the mean at each.

    Args:
        axes: the panel.
        found: the outcome, by what varies.
        x: the column.
        labels: names and units.

    Returns:
        The panel.
    """
    along = varying(found.table, x)
    places = {value: place for place, value in enumerate(along.values)}
    at = found.table[x] if along.numeric else found.table[x].map(places)
    axes.scatter(
        at, found.table["middle"], s=5, color=paper.GREY, alpha=0.6, linewidths=0,
        rasterized=len(at) > 2000,
    )  # fmt: skip
    line_x, line_y = smooth(at.to_numpy(float), found.table["middle"].to_numpy(float))
    axes.plot(
        line_x, line_y, color=paper.BLUE, linewidth=1.4,
        linestyle="-" if along.numeric else "none", marker="" if len(line_x) > FEW else "D",
        markersize=3.4,
    )  # fmt: skip
    if not along.numeric or len(along.values) <= FEW:
        _fit(axes, found.table, along)
    axes.set_xlabel(wrapped(labels.axis(x), axes))
    axes.set_ylabel(wrapped(labels.axis(found.of), axes, "height"))
    return axes


def draw_effects(
    axes: Axes, found: Effects, labels: Labels = NO_LABELS, names: Sequence[str] | None = None
) -> Axes:
    """Draw how far an outcome is from that of a baseline, a row a point, with its interval.

    Args:
        axes: the panel.
        found: the differences.
        labels: names and units.
        names: what points are called; their values by default.

    Returns:
        The panel.
    """
    rows = found.table
    called = names or [", ".join(value_name(row[one]) for one in found.by)
                       for _, row in rows.iterrows()]  # fmt: skip
    axes.axvline(0.0, color=paper.INK, linewidth=0.6)
    reach = np.abs(rows[["low", "high"]].to_numpy(float).T - rows["difference"].to_numpy(float))
    ends = rows[["difference", "low", "high"]].to_numpy(float)
    apart = [Interval(*one).beyond() != 0 for one in ends.tolist()]
    axes.errorbar(
        rows["difference"], range(len(rows)), xerr=np.nan_to_num(reach), color=paper.BLUE,
        linestyle="none", elinewidth=0.9, capsize=1.6, capthick=0.9,
    )  # fmt: skip
    faces = [paper.BLUE if one else "white" for one in apart]
    axes.scatter(rows["difference"], range(len(rows)), s=13, c=faces, edgecolors=paper.BLUE,
                 linewidths=0.9, zorder=3)  # fmt: skip
    axes.set_yticks(range(len(rows)), called)
    axes.set_ylim(len(rows) - 0.5, -0.5)
    axes.tick_params(axis="y", length=0)
    axes.grid(axis="y", color=paper.PALE, linewidth=0.3)
    axes.xaxis.set_major_locator(MaxNLocator(5, steps=(1, 2, 5, 10)))
    axes.set_xlabel(wrapped(labels.axis(found.of, "difference of "), axes, room=0.5))
    if names is None:
        axes.set_ylabel(wrapped(", ".join(labels.axis(one) for one in found.by), axes, "height"))
    return axes


def smooth(x: np.ndarray[Any, Any], y: np.ndarray[Any, Any]) -> tuple[Any, Any]:
    """Return a smooth line through points: its x and y.

    Args:
        x: (n,), in any order.
        y: (n,); where there is no number, the point is left out.

    >>> at, line = smooth(np.array([1.0, 2.0, 1.0]), np.array([1.0, 5.0, 3.0]))
    >>> at.tolist(), line.tolist()
    ([1.0, 2.0], [2.0, 5.0])
    """
    own = pd.DataFrame({"x": x, "y": y}).dropna().groupby("x")["y"].agg(["mean", "size"])
    at, means = own.index.to_numpy(float), own["mean"].to_numpy(float)
    if len(at) < 10:
        return at, means
    try:
        from scipy.interpolate import make_smoothing_spline
    except ImportError:  # an extra: `pip install "socialmind[analysis]"`
        return at[:0], means[:0]
    reach = at[-1] - at[0]
    fitted = make_smoothing_spline((at - at[0]) / reach, means, own["size"].to_numpy(float))
    places = np.linspace(0.0, 1.0, 200)
    return at[0] + reach * places, fitted(places)


def varying(table: pd.DataFrame, name: str) -> Varying:
    """Return the values of a column of estimates."""
    own = table[name]
    numeric = pd.api.types.is_numeric_dtype(own) and not pd.api.types.is_bool_dtype(own)
    values = own.drop_duplicates().tolist()
    return Varying(name, tuple(sorted(values) if numeric else values), numeric)


def _reach(rows: pd.DataFrame) -> Any:
    """Return how far intervals reach below and above, for bars; 0 where there is none."""
    ends = [rows["middle"] - rows["low"], rows["high"] - rows["middle"]]
    return np.nan_to_num(np.abs(np.array(ends, float)))


def _moved(axes: Axes, points: float) -> Any:
    return axes.transData + ScaledTranslation(points / 72.0, 0.0, axes.figure.dpi_scale_trans)


def _fit(axes: Axes, table: pd.DataFrame, along: Varying) -> None:
    """Put the places of values along the axis below; names with air at both ends."""
    if not along.numeric:
        axes.set_xticks(range(len(along.values)), [value_name(value) for value in along.values])
        turn_if_crowded(axes, along)
        axes.set_xlim(-0.5, len(along.values) - 0.5)
        return
    if along.logarithmic:
        axes.set_xscale("log")
        axes.xaxis.set_minor_locator(NullLocator())
    if len(along.values) <= FEW:
        axes.xaxis.set_major_locator(FixedLocator(list(along.values)))
        axes.set_xticks(list(along.values), [value_name(value) for value in along.values])
    elif not along.logarithmic and all(float(value).is_integer() for value in along.values):
        axes.xaxis.set_major_locator(MaxNLocator("auto", integer=True, steps=(1, 2, 5, 10)))


def _at(table: pd.DataFrame, column: str, x: str, a: Any, y: str, b: Any) -> float:
    found = table.loc[(table[x] == a) & (table[y] == b), column]
    return float(found.iloc[0]) if len(found) else math.nan
