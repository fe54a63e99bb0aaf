"""A figure of a sweep's sensitivity: indices of the parameters with their intervals."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence

import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

from socialmind.drawing import style as paper
from socialmind.experiments.sensitivity import effects, regression, variance
from socialmind.experiments.sensitivity.indices import (
    FAST,
    MAIN,
    MORRIS,
    REGRESSION,
    SOBOL,
    Sensitivity,
)

LOOKS = {
    variance.FIRST: ("first order", paper.BLUE, "o"),
    variance.TOTAL: ("total order", paper.RED, "s"),
    variance.SECOND: ("second order", paper.PURPLE, "D"),
    effects.MU_STAR: ("mu*", paper.RED, "s"),
    effects.MU: ("mu", paper.BLUE, "o"),
    effects.SIGMA: ("sigma", paper.GOLD, "^"),
    regression.SRC: ("regression coefficient", paper.BLUE, "o"),
    regression.PARTIAL_RANK: ("partial rank correlation", paper.RED, "s"),
    regression.RATIO: ("correlation ratio", paper.PURPLE, "D"),
}
"""Of each index: what it is called, its colour and its mark."""
SHOWN = {
    SOBOL: (variance.FIRST, variance.TOTAL),
    FAST: (variance.FIRST, variance.TOTAL),
    MORRIS: (effects.MU_STAR, effects.MU, effects.SIGMA),
    REGRESSION: (regression.SRC, regression.PARTIAL_RANK, regression.RATIO),
}
PAIRS = 10
"""So many pairs at most have room in a panel."""
ROW, AROUND = 5.0, 22.0
"""Height of a parameter in a panel, and of what stands around it, in mm."""


def draw_indices(axes: Axes, found: Sensitivity, output: str, unit: str = "") -> Axes:
    """Draw the indices of all parameters, those of most effect above, with their intervals.

    A grey band is the total order, or mu*, that a parameter without any effect has by luck.

    Args:
        axes: the panel.
        found: the sensitivity of a sweep.
        output: one of its outputs.
        unit: of the output, for the effects of Morris's design.

    Returns:
        The panel.
    """
    names = found.ordered(output)
    texts = found.of(output, regression.RATIO)["parameter"].tolist()
    shown = [one for one in SHOWN[found.method] if len(found.of(output, one))]
    places = {name: float(place) for place, name in enumerate([*names, *texts])}
    for number, index in enumerate(shown):
        rows = found.of(output, index)
        shift = 0.0 if index == regression.RATIO else 0.22 * (number - (len(shown) - 1) / 2)
        _dots(axes, rows, [places[one] + shift for one in rows["parameter"]], index)
    floor = float(found.luck.loc[found.luck["output"] == output, "floor"].iloc[0])
    if math.isfinite(floor) and floor > 0:
        label = f"{LOOKS[MAIN[found.method]][0]} by luck alone"
        axes.axvspan(0.0, floor, color=paper.GREY, alpha=0.18, linewidth=0, label=label)
    label = {
        MORRIS: "change over a parameter's range" + (f" ({unit})" if unit else ""),
        REGRESSION: "coefficient, correlation",
    }.get(found.method, "share of the variance")
    return _dressed(axes, list(places), label)


def draw_pairs(axes: Axes, found: Sensitivity, output: str) -> Axes:
    """Draw what pairs of parameters do together, beyond each alone: the largest, with intervals.

    Args:
        axes: the panel.
        found: Sobol indices.
        output: one of the outputs.

    Returns:
        The panel.
    """
    rows = found.of(output, variance.SECOND)
    rows = rows.sort_values("value", ascending=False, kind="stable").head(PAIRS)
    _dots(axes, rows, [float(place) for place in range(len(rows))], variance.SECOND)
    names = [f"{a} × {b}" for a, b in zip(rows["parameter"], rows["other"], strict=True)]
    return _dressed(axes, names, "share of the variance")


def figure_of(found: Sensitivity, units: Mapping[str, str] | None = None) -> Figure:
    """Return a figure of all outputs: a panel each, for Sobol indices with the pairs beside it.

    Args:
        found: the sensitivity of a sweep.
        units: of outputs, by name.
    """
    pairs = len(found.of(found.outputs[0], variance.SECOND)) > 0
    across = 2 if pairs or len(found.outputs) > 1 else 1
    count = len(found.outputs) * (2 if pairs else 1)
    down = -(-count // across)
    most = min(len(found.of(found.outputs[0], variance.SECOND)), PAIRS)
    height = ROW * max(len(found.parameters), most) + AROUND
    with paper.style():
        figure = paper.figure(paper.PAGE if across > 1 else paper.COLUMN, height * down + 6, gap=2)
        panels = list(figure.subplots(down, across, squeeze=False).flat)
        for place, output in enumerate(found.outputs):
            axes = panels[2 * place if pairs else place]
            draw_indices(axes, found, output, (units or {}).get(output, ""))
            title = output.replace("_", " ")
            axes.set_title(title)
            if pairs:
                draw_pairs(panels[2 * place + 1], found, output)
                panels[2 * place + 1].set_title(f"{title}: pairs")
        for axes in panels[count:]:
            axes.set_visible(False)
        marks, names = panels[0].get_legend_handles_labels()
        columns = len(names) if across > 1 else 2
        figure.legend(marks, names, loc="outside upper left", ncols=columns)
    return figure


def _dots(axes: Axes, rows: pd.DataFrame, places: Sequence[float], index: str) -> None:
    label, colour, mark = LOOKS[index]
    value, low, high = (rows[name].to_numpy(float) for name in ("value", "low", "high"))
    axes.hlines(places, low, high, color=colour, linewidth=1.0)
    axes.plot(value, places, mark, color=colour, markersize=3.2, label=label)


def _dressed(axes: Axes, names: Sequence[str], label: str) -> Axes:
    axes.axvline(0.0, color=paper.INK, linewidth=0.6, zorder=0)
    axes.xaxis.set_major_locator(MaxNLocator(5, steps=(1, 2, 5, 10)))
    axes.set_ylim(len(names) - 0.4, -0.6)
    axes.set_yticks(range(len(names)), [name.replace("_", " ") for name in names])
    axes.tick_params(axis="y", length=0)
    axes.spines["left"].set_visible(False)
    axes.set_xlabel(label)
    return axes
