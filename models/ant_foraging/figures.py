"""The figure of the ants: where they are and what is marked there, and food brought home.

An ant has the colour of the pheromone on its patch, the darker the more; rings carry food. Marks
where no ant stands are not drawn: a run records ants, not patches.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.cm import ScalarMappable
from matplotlib.colors import LinearSegmentedColormap, LogNorm
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

from socialmind.drawing import style as paper

if TYPE_CHECKING:
    from socialmind.experiments import Run

LOW, HIGH = -20.5, 20.5  # borders of the world
MAPS = 3
FAINTEST = 0.1  # pheromone that is still drawn
MARKED = LinearSegmentedColormap.from_list("marked", ["#e3e9f2", paper.BLUE, "#0b1f3a"])


def draw(run: Run) -> dict[str, Figure]:
    """Draw the figure of a run.

    Args:
        run: a recorded run of this model.

    Returns:
        The figure `ants`.
    """
    with paper.style():
        return {"ants": ants(run.series, run.agents, bool(run.parameters["bridge"]))}


def ants(series: pd.DataFrame, agents: pd.DataFrame, bridge: bool) -> Figure:
    """Draw maps of the ants at three ticks, and below them what went on over time.

    Args:
        series: one row a recorded tick.
        agents: one row an ant and recorded tick.
        bridge: whether who passed either way is drawn, or food brought home.

    Returns:
        A figure of three maps with a scale of colours, and one panel.
    """
    figure = paper.figure(paper.PAGE, 115)
    panels = figure.subplot_mosaic([["0", "1", "2"], ["time"] * MAPS], height_ratios=(1.5, 1))
    maps = [panels[str(place)] for place in range(MAPS)]
    shades = shades_for(agents["pheromone"].to_numpy(float))
    ticks = np.sort(agents["tick"].unique())
    for letter, axes, at in zip(
        "abc", maps, np.linspace(0, len(ticks) - 1, MAPS + 1)[1:], strict=True
    ):
        tick = ticks[round(at)]
        map_of_ants(axes, agents[agents["tick"] == tick], shades)
        paper.panel_title(axes, letter, f"Tick {tick:,}" + (letter == "a") * "; rings carry food")
    scale_of(figure, maps[-1], shades)
    _course(panels["time"], series, bridge)
    return figure


def shades_for(pheromone: np.ndarray) -> ScalarMappable:
    """Return a logarithmic scale of colours up to the most pheromone that there is."""
    most = max(float(pheromone.max(initial=0.0)), 10 * FAINTEST)
    return ScalarMappable(LogNorm(FAINTEST, most, clip=True), MARKED)


def scale_of(figure: Figure, axes: Axes, shades: ScalarMappable) -> None:
    """Draw the scale of colours to the right of a map."""
    bar = figure.colorbar(shades, cax=axes.inset_axes((1.06, 0.0, 0.05, 1.0)))
    bar.set_label("pheromone on a patch")
    bar.minorticks_off()
    bar.outline.set_visible(False)  # type: ignore[operator]


def map_of_ants(axes: Axes, ants: pd.DataFrame, shades: ScalarMappable) -> None:
    """Draw the ants that are out where they are, in the colours of their patches.

    Args:
        axes: to draw on.
        ants: one row an ant, of one tick.
        shades: from pheromone to a colour.
    """
    out = ants[~ants["inside"].astype(bool)]
    laden = out["laden"].astype(bool)
    for some, edge, size in ((out[~laden], "none", 5), (out[laden], paper.GOLD, 9)):
        axes.scatter(
            some["x"].to_numpy(float), some["y"].to_numpy(float), s=size, linewidths=0.7,
            c=shades.to_rgba(some["pheromone"].to_numpy(float)), edgecolors=edge, rasterized=True,
        )  # fmt: skip
    frame(axes)


def frame(axes: Axes) -> None:
    """Set the borders and labels of a map."""
    axes.spines[["top", "right"]].set_visible(True)
    axes.set(xlim=(LOW, HIGH), ylim=(LOW, HIGH), aspect="equal")
    axes.set_xlabel("x (patches)")
    axes.set_ylabel("y (patches)")


def _course(axes: Axes, series: pd.DataFrame, bridge: bool) -> None:
    scale = paper.time_axis(axes, list(series["tick"]))
    columns = {"brought": ("brought home", paper.INK), "food": ("left", paper.GREY)}
    if bridge:
        columns = {
            "passed_north": ("northern way", paper.BLUE), "passed_south": ("southern", paper.RED),
        }  # fmt: skip
    for column, (_, colour) in columns.items():
        axes.plot(series["tick"] / scale, series[column], color=colour)
    axes.set_ylim(*paper.limits_with_zero(series[list(columns)].to_numpy().ravel()))
    axes.yaxis.set_major_locator(MaxNLocator(5, integer=True))
    axes.yaxis.set_major_formatter("{x:,.0f}")
    axes.set_ylabel("ants that passed" if bridge else "pieces of food")
    paper.panel_title(axes, "d", "Either way, so far" if bridge else "Food")
    ends = [(float(series[name].iloc[-1]), *text) for name, text in columns.items()]
    paper.label_ends(axes, ends)
