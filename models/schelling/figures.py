"""The figure of segregation: where both kinds live, first and last, and how many are happy.

Blue stands for kind 0, red for kind 1; free places are white.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.colors import ListedColormap
from matplotlib.figure import Figure

from socialmind.drawing import style as paper

if TYPE_CHECKING:
    from socialmind.experiments import Run

FREE = 2
COLOURS = ListedColormap([paper.BLUE, paper.GOLD, "white"])


def draw(run: Run) -> dict[str, Figure]:
    """Draw the figure of a run.

    Args:
        run: a recorded run of this model.

    Returns:
        The figure `segregation`.
    """
    size = int(run.parameters["world_size"])
    with paper.style():
        return {"segregation": segregation(run.agents, run.series, size)}


def segregation(agents: pd.DataFrame, series: pd.DataFrame, size: int) -> Figure:
    """Draw both kinds at the first and the last recorded tick, and the share of happy over time.

    Args:
        agents: one row a person and recorded tick.
        series: one row a recorded tick.
        size: patches along a side of the world.

    Returns:
        A figure of three panels.
    """
    figure = paper.figure(paper.PAGE, 62)
    first, last, course = figure.subplots(1, 3)
    for axes, letter, tick in zip((first, last), "ab", series["tick"].iloc[[0, -1]], strict=True):
        _kinds(axes, agents[agents["tick"] == tick], size)
        paper.panel_title(axes, letter, f"Tick {tick:,}")
    scale = paper.time_axis(course, list(series["tick"]))
    share = series["happy"] / series["people"].clip(lower=1)
    course.plot(series["tick"] / scale, share, color=paper.INK)
    course.set(ylim=(0, 1.04), ylabel="happy (share of persons)")
    paper.panel_title(course, "c", "Who stays where it is")
    return figure


def _kinds(axes: Axes, now: pd.DataFrame, size: int) -> None:
    """Draw each person's patch in the colour of its kind."""
    low = -(size // 2)
    places = np.full((size, size), FREE)
    places[now["y"].to_numpy(int) - low, now["x"].to_numpy(int) - low] = now["kind"]
    span = (low - 0.5, low + size - 0.5)
    axes.imshow(
        places, cmap=COLOURS, vmin=0, vmax=FREE, origin="lower", extent=(*span, *span),
        interpolation="none",
    )  # fmt: skip
    axes.spines[["top", "right"]].set_visible(True)
    axes.set(xlabel="x (patches)", ylabel="y (patches)")
