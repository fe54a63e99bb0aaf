"""The figure of a run: each robot along the arena, with items or without, and what is home."""

from __future__ import annotations

from itertools import pairwise
from typing import TYPE_CHECKING

import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from socialmind.catalogue import load_file, model_folder
from socialmind.drawing import style as paper

if TYPE_CHECKING:
    from socialmind.experiments import Run

PLACES = load_file(model_folder("task_partitioning") / "places.py")
NAMES = ("nest", "cache", "slope", "source")
SHADES = ("#ffffff", "#eef1f5", "#dde3ea", "#eef1f5")
MOST_DRAWN = 8  # robots whose ways are shown
LADEN = paper.GOLD


def draw(run: Run) -> dict[str, Figure]:
    """Draw the figure of a run.

    Args:
        run: a recorded run of this model.

    Returns:
        The figure `partitioning`.
    """
    with paper.style():
        return {"partitioning": partitioning(run.series, run.agents)}


def partitioning(series: pd.DataFrame, agents: pd.DataFrame) -> Figure:
    """Draw the way of each robot along the arena, and below what the group has brought home.

    Args:
        series: one row a recorded tick.
        agents: one row a robot and recorded tick.

    Returns:
        A figure of a panel for each of the first robots, and one for the items.
    """
    robots = list(agents.groupby("agent"))[:MOST_DRAWN]
    figure = paper.figure(paper.PAGE, 20 * len(robots) + 45)
    ratios = [*[2] * len(robots), 3]
    panels = figure.subplots(len(robots) + 1, 1, sharex=True, height_ratios=ratios)
    scale = paper.time_axis(panels[-1], list(series["tick"]))
    for letter, axes, (agent, rows) in zip("abcdefgh", panels, robots, strict=False):
        _way(axes, rows, scale)
        last = rows.iloc[-1]
        paper.panel_title(
            axes, letter,
            f"Robot {agent} ({last['strategy']}): took {last['fetched']} from the source, "
            f"brought {last['delivered']} home",
        )  # fmt: skip
    panels[0].plot([], [], "o", color=LADEN, markersize=3, label="with an item when recorded")
    figure.legend(loc="outside upper right")
    _items(panels[-1], series, scale)
    paper.panel_title(panels[-1], "abcdefghi"[len(robots)], "Items of the group, so far")
    return figure


def _way(axes: Axes, rows: pd.DataFrame, scale: float) -> None:
    borders = PLACES.BORDERS
    for (low, high), shade in zip(pairwise(borders), SHADES, strict=True):
        axes.axhspan(low, high, color=shade, linewidth=0)
    ticks, heights = (rows["tick"] / scale).to_numpy(float), rows["y"].to_numpy(float)
    axes.plot(ticks, heights, color=paper.INK, linewidth=0.7)
    laden = rows["laden"].to_numpy(bool)
    axes.plot(ticks[laden], heights[laden], "o", color=LADEN, markersize=3, mew=0)
    axes.set_ylim(borders[0], borders[-1])
    middles = [(low + high) / 2 for low, high in pairwise(borders)]
    axes.set_yticks(middles, NAMES)
    axes.tick_params(axis="y", length=0)


def _items(axes: Axes, series: pd.DataFrame, scale: float) -> None:
    columns = {
        "fetched": ("from the source", paper.GREY), "delivered": ("home", paper.INK),
        "shared": ("home, by two or more", paper.BLUE),
    }  # fmt: skip
    for column, (_, colour) in columns.items():
        width = 2.4 if column == "delivered" else 1.0  # the last one may lie upon it
        axes.plot(series["tick"] / scale, series[column], color=colour, linewidth=width)
    axes.set_ylim(*paper.limits_with_zero(series[list(columns)].to_numpy().ravel()))
    axes.set_ylabel("items")
    ends = [(float(series[name].iloc[-1]), *text) for name, text in columns.items()]
    paper.label_ends(axes, ends)
