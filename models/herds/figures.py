"""The figure of the herds: where they are, and how many and how large over time."""

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
LARGEST = (
    (paper.BLUE, "o"),
    (paper.RED, "s"),
    (paper.GOLD, "^"),
    (paper.PURPLE, "D"),
)  # colours and marks of the largest herds
MAPS = 3


def draw(run: Run) -> dict[str, Figure]:
    """Draw the figure of a run.

    Args:
        run: a recorded run of this model.

    Returns:
        The figure `herds`.
    """
    with paper.style():
        return {"herds": herds(run.series, run.agents)}


def herds(series: pd.DataFrame, agents: pd.DataFrame) -> Figure:
    """Draw three maps of the cows, and below them the herds and their sizes over time.

    Args:
        series: one row a recorded tick.
        agents: one row an agent and recorded tick.

    Returns:
        A figure of three maps and one panel.
    """
    figure = paper.figure(paper.PAGE, 115)
    panels = figure.subplot_mosaic([["0", "1", "2"], ["time"] * MAPS], height_ratios=(1.5, 1))
    ticks = np.sort(series["tick"].unique())
    for place, at in enumerate(np.linspace(0, len(ticks) - 1, MAPS)):
        tick = ticks[round(at)]
        map_of_cows(panels[str(place)], agents[agents["tick"] == tick])
        paper.panel_title(
            panels[str(place)], "abc"[place], f"Tick {tick:,}" + (place == 0) * "; stars lead"
        )
    axes = panels["time"]
    scale = paper.time_axis(axes, list(series["tick"]))
    for column, colour, label in (
        ("in_herds", paper.INK, "cows in a herd"), ("largest", paper.BLUE, "cows of the largest"),
        ("herds", paper.RED, "herds"),
    ):  # fmt: skip
        axes.plot(
            series["tick"] / scale, series[column], color=colour, linewidth=0.9, label=label,
            drawstyle="steps-post",
        )  # fmt: skip
    axes.set_ylim(bottom=0)
    axes.yaxis.set_major_locator(MaxNLocator(5, integer=True))
    axes.set_ylabel("number")
    axes.legend(loc="center right", bbox_to_anchor=(1, 0.3), ncols=3)
    paper.panel_title(axes, "d", "Herds and their sizes")
    return figure


def map_of_cows(axes: Axes, cows: pd.DataFrame) -> None:
    """Draw cows where they are: colours and marks for the four largest herds; stars lead.

    Args:
        axes: to draw on.
        cows: one row a cow, of one tick.
    """
    low = -(SIZE // 2) - 0.5
    largest = cows.loc[cows["herd"] >= 0, "herd"].value_counts(sort=True).index.tolist()
    looks = dict(zip(largest, LARGEST, strict=False))
    for (herd, leading), some in cows.groupby(["herd", "leading"]):
        colour, mark = looks.get(herd, (paper.GREY if herd >= 0 else "white", "o"))
        axes.scatter(
            some["x"].to_numpy(float), some["y"].to_numpy(float), marker="*" if leading else mark,
            s=50 if leading else 12, c=colour, edgecolors=paper.INK, linewidths=0.4, zorder=3,
        )  # fmt: skip
    axes.spines[["top", "right"]].set_visible(True)
    axes.set(xlim=(low, low + SIZE), ylim=(low, low + SIZE), aspect="equal")
    axes.set_xlabel("x (patches)")
    axes.set_ylabel("y (patches)")
