"""The figure of wolves, cows and bulls: where they are, how many, and what became of the cows."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

from socialmind.drawing import style as paper

if TYPE_CHECKING:
    from socialmind.experiments import Run

SIZE = 33  # of the world, in patches
LOOKS = (
    ("cows", "o", paper.BLUE, 10), ("wolves", "D", paper.RED, 14), ("bulls", "s", paper.INK, 22),
)  # fmt: skip
FATES = (("born", paper.BLUE), ("killed", paper.RED), ("starved", paper.GREY))


def draw(run: Run) -> dict[str, Figure]:
    """Draw the figure of a run.

    Args:
        run: a recorded run of this model.

    Returns:
        The figure `wolf_cow`.
    """
    with paper.style():
        return {"wolf_cow": wolf_cow(run.series, run.agents)}


def wolf_cow(series: pd.DataFrame, agents: pd.DataFrame) -> Figure:
    """Draw the animals in the middle of a run, and their numbers and fates over time.

    Args:
        series: one row a recorded tick.
        agents: one row an animal and recorded tick.

    Returns:
        A figure of a map and two panels.
    """
    figure = paper.figure(paper.PAGE, 85)
    panels = figure.subplot_mosaic([["map", "cows"], ["map", "fates"]], width_ratios=(1.1, 1))
    ticks = np.sort(series["tick"].unique())
    tick = ticks[len(ticks) // 2]
    _map(panels["map"], agents[agents["tick"] == tick])
    paper.panel_title(panels["map"], "a", f"Tick {tick:,}")
    for name, lines in (("cows", (("cows", paper.BLUE),)), ("fates", FATES)):
        axes = panels[name]
        scale = paper.time_axis(axes, list(series["tick"]))
        for column, colour in lines:
            axes.plot(
                series["tick"] / scale, series[column], color=colour, linewidth=0.9, label=column,
                linestyle=paper.DASHES.get(colour, "-"),
            )  # fmt: skip
        axes.set_ylim(bottom=0)
        axes.yaxis.set_major_locator(MaxNLocator(5, integer=True))
        axes.set_ylabel("cows")
    panels["cows"].set_xlabel("")
    panels["fates"].legend(loc="upper left")
    paper.panel_title(panels["cows"], "b", "The living")
    paper.panel_title(panels["fates"], "c", "What became of them, so far")
    return figure


def _map(axes: Axes, animals: pd.DataFrame) -> None:
    low = -(SIZE // 2) - 0.5
    for name, marker, colour, size in LOOKS:
        some = animals[animals["population"] == name]
        axes.scatter(
            some["x"].to_numpy(float), some["y"].to_numpy(float), marker=marker, s=size, c=colour,
            edgecolors="white", linewidths=0.3, zorder=3, label=name,
        )  # fmt: skip
    axes.spines[["top", "right"]].set_visible(True)
    axes.set(xlim=(low, low + SIZE), ylim=(low, low + SIZE), aspect="equal")
    axes.set_xlabel("x (patches)")
    axes.set_ylabel("y (patches)")
    axes.legend(loc="upper center", bbox_to_anchor=(0.5, -0.14), ncols=3, handletextpad=0.1)
