"""The figure of wolves and sheep: how many there are, and how much grass is grown, over time.

Blue stands for sheep, red for wolves, gold for grass.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import pandas as pd
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

from socialmind.drawing import style as paper

if TYPE_CHECKING:
    from socialmind.experiments import Run

PANELS = (
    ("a", "Animals", "animals (number)", {"sheep": paper.BLUE, "wolves": paper.RED}),
    ("b", "Grown grass", "patches (number)", {"grass": paper.GOLD}),
)


def draw(run: Run) -> dict[str, Figure]:
    """Draw the figure of a run.

    Args:
        run: a recorded run of this model.

    Returns:
        The figure `numbers`.
    """
    with paper.style():
        return {"numbers": numbers(run.series)}


def numbers(series: pd.DataFrame) -> Figure:
    """Draw the numbers of sheep and wolves, and the patches of grown grass, over time.

    Args:
        series: one row a recorded tick.

    Returns:
        A figure of two panels.
    """
    figure = paper.figure(paper.PAGE, 90)
    panels = figure.subplots(2, 1, sharex=True, height_ratios=(3, 2))
    for axes, (letter, title, unit, columns) in zip(panels, PANELS, strict=True):
        scale = paper.time_axis(axes, list(series["tick"]))
        for name, colour in columns.items():
            axes.plot(series["tick"] / scale, series[name], color=colour, linewidth=0.8)
        axes.set_ylim(*paper.limits_with_zero(series[list(columns)].to_numpy().ravel()))
        axes.set_ylabel(unit)
        axes.yaxis.set_major_locator(MaxNLocator(5, integer=True))
        paper.panel_title(axes, letter, title)
        if len(columns) > 1:
            ends = [(float(series[name].iloc[-1]), name, one) for name, one in columns.items()]
            paper.label_ends(axes, ends)
    panels[0].set_xlabel("")
    return figure
