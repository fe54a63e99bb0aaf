"""A figure of a sweep's sensitivity: indices of the parameters with their intervals."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from string import ascii_lowercase
from textwrap import fill

import numpy as np
import pandas as pd
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.ticker import MaxNLocator

from socialmind.drawing import style as paper
from socialmind.experiments.figures.labels import Labels
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
    effects.MU_STAR: ("μ*", paper.RED, "s"),
    effects.MU: ("μ", paper.BLUE, "o"),
    effects.SIGMA: ("σ", paper.GOLD, "^"),
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
AXES = {MORRIS: "change over a parameter's range", REGRESSION: "coefficient, correlation"}
"""What stands at the axes of a method; shares of the variance at those of others."""
PAIRS = 10
"""So many pairs at most have room in a panel."""
ACROSS = 3
"""Panels beside one another, at most."""
ROW, PAIR, AROUND = 5.0, 8.0, 17.0
"""Height of a parameter and of a pair in a panel, and of what stands around it, in mm."""
LETTER = 1.5
"""Width of a letter of a title, in mm, about."""


def draw_indices(
    axes: Axes, found: Sensitivity, output: str, labels: Labels | None = None,
    order: Sequence[str] | None = None,
) -> Axes:  # fmt: skip
    """Draw the indices of all parameters, those of most effect above, with their intervals.

    A grey band is the total order, or μ*, that a parameter without any effect has by luck.

    Args:
        axes: the panel.
        found: the sensitivity of a sweep.
        output: one of its outputs.
        labels: what parameters are called, and the unit of the output for Morris's effects.
        order: of the parameters, from above; by default as this output has it.

    Returns:
        The panel.
    """
    labels = labels or Labels()
    names = list(order or _order(found, [output]))
    shown = [one for one in SHOWN[found.method] if len(found.of(output, one))]
    places = {name: float(place) for place, name in enumerate(names)}
    for number, index in enumerate(shown):
        rows = found.of(output, index)
        shift = 0.0 if index == regression.RATIO else 0.26 * (number - (len(shown) - 1) / 2)
        _dots(axes, rows, [places[one] + shift for one in rows["parameter"]], index)
    floor = float(found.luck.loc[found.luck["output"] == output, "floor"].iloc[0])
    if math.isfinite(floor) and floor > 0:
        label = f"{LOOKS[MAIN[found.method]][0]} by luck alone"
        axes.axvspan(0.0, floor, color=paper.GREY, alpha=0.18, linewidth=0, label=label)
    text = AXES.get(found.method, "share of the variance")
    unit = labels.units.get(output, "") if found.method == MORRIS else ""
    return _dressed(axes, map(labels.name, names), f"{text} ({unit})" if unit else text)


def draw_pairs(
    axes: Axes, found: Sensitivity, output: str, labels: Labels | None = None,
    order: Sequence[tuple[str, str]] | None = None,
) -> Axes:  # fmt: skip
    """Draw what pairs of parameters do together, beyond each alone, with intervals.

    Args:
        axes: the panel.
        found: Sobol indices.
        output: one of the outputs.
        labels: what parameters are called.
        order: the pairs, from above; by default those that are largest for this output.

    Returns:
        The panel.
    """
    labels = labels or Labels()
    pairs = list(order or _order_of_pairs(found, [output]))
    rows = found.of(output, variance.SECOND).set_index(["parameter", "other"]).loc[pairs]
    _dots(axes, rows, [float(place) for place in range(len(rows))], variance.SECOND)
    names = (f"{labels.name(a)} ×\n{labels.name(b)}" for a, b in pairs)
    return _dressed(axes, names, "share of the variance")


def figure_of(found: Sensitivity, labels: Labels | None = None) -> Figure:
    """Return a figure of all outputs: a panel each, for Sobol indices with the pairs below it.

    Panels side by side share their parameters, ordered by what they do to all outputs, and panels
    of one measure their x axis.

    Args:
        found: the sensitivity of a sweep.
        labels: what parameters and outputs are called, and the units of outputs.
    """
    labels = labels or Labels()
    outputs = found.outputs
    across = min(ACROSS, len(outputs))
    width = paper.PAGE if across > 1 else paper.COLUMN
    order, pairs = _order(found, outputs), _order_of_pairs(found, outputs)
    kinds = [(ROW * len(order) + AROUND, False)]
    if pairs:
        kinds.append((PAIR * len(pairs) + AROUND, True))
    groups = [outputs[at : at + across] for at in range(0, len(outputs), across)]
    rows = [(group, height, paired) for group in groups for height, paired in kinds]
    heights = [height for _, height, _ in rows]
    with paper.style():
        figure = paper.figure(width, sum(heights) + 6, gap=1.5)
        panels = figure.subplots(len(rows), across, squeeze=False, height_ratios=heights)
        drawn: list[Axes] = []
        for line, (group, _, paired) in zip(panels, rows, strict=True):
            for axes, output in zip(line, group, strict=False):
                if paired:
                    draw_pairs(axes, found, output, labels, pairs)
                else:
                    draw_indices(axes, found, output, labels, order)
                if axes is not line[0]:
                    axes.tick_params(axis="y", labelleft=False)
                name = labels.name(output) + (": pairs" if paired else "")
                letters = int((0.62 if across > 1 else 0.5) * width / across / LETTER)
                letter = ascii_lowercase[len(drawn) % len(ascii_lowercase)]
                paper.panel_title(axes, letter, fill(name, letters))
                axes.set_xlabel(fill(axes.get_xlabel(), letters + 4))
                drawn.append(axes)
            for axes in line[len(group) :]:
                axes.set_visible(False)
        if found.method != MORRIS:  # whose effects are in units of the outputs
            _share(drawn)
        _legend(figure, drawn, found.level, 4 if across > 1 else 2)
    return figure


def _order(found: Sensitivity, outputs: Sequence[str]) -> list[str]:
    """Return the parameters by what they do to outputs, names without an order below numbers."""
    sizes = []
    for output in outputs:
        rows = found.of(output, MAIN[found.method])
        size = rows.set_index("parameter")["value"].abs()
        sizes.append(size / size.max())
    together = pd.concat(sizes, axis=1).fillna(-1.0).sum(axis=1)
    numbers = together.sort_values(ascending=False, kind="stable").index.tolist()
    texts = found.table.loc[found.table["index"] == regression.RATIO, "parameter"]
    return [*numbers, *texts.drop_duplicates()]


def _order_of_pairs(found: Sensitivity, outputs: Sequence[str]) -> list[tuple[str, str]]:
    """Return the pairs that share most of the variance of outputs, the most first."""
    rows = pd.concat([found.of(output, variance.SECOND) for output in outputs])
    together = rows.groupby(["parameter", "other"], sort=False)["value"].mean()
    return together.sort_values(ascending=False, kind="stable").head(PAIRS).index.tolist()


def _share(panels: Sequence[Axes]) -> None:
    limits = np.array([axes.get_xlim() for axes in panels])
    for axes in panels:
        axes.set_xlim(limits[:, 0].min(), limits[:, 1].max())


def _legend(figure: Figure, panels: Sequence[Axes], level: float, columns: int) -> None:
    """Name what any panel shows, and the lines beside the marks."""
    known: dict[str, Artist] = {}
    for axes in panels:
        for handle, label in zip(*axes.get_legend_handles_labels(), strict=True):
            known.setdefault(label, handle)
    known[f"interval of {100 * level:g} %"] = Line2D([], [], color=paper.GREY, linewidth=1.0)
    figure.legend(
        known.values(), known, loc="outside upper left", ncols=min(len(known), columns + 1)
    )


def _dots(axes: Axes, rows: pd.DataFrame, places: Sequence[float], index: str) -> None:
    label, colour, mark = LOOKS[index]
    value, low, high = (rows[name].to_numpy(float) for name in ("value", "low", "high"))
    axes.hlines(places, low, high, color=colour, linewidth=1.0)
    axes.plot(value, places, mark, color=colour, markersize=3.2, linestyle="none", label=label)


def _dressed(axes: Axes, names: Iterable[str], label: str) -> Axes:
    named = list(names)
    axes.axvline(0.0, color=paper.INK, linewidth=0.6, zorder=0)
    axes.xaxis.set_major_locator(MaxNLocator(5, steps=(1, 2, 5, 10)))
    axes.set_ylim(len(named) - 0.4, -0.6)
    axes.set_yticks(range(len(named)), named)
    axes.tick_params(axis="y", length=0)
    axes.spines["left"].set_visible(False)
    axes.set_xlabel(label)
    return axes
