"""The figure of the flock: where the birds fly, first and last, and how much they fly one way."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from socialmind.drawing import style as paper

if TYPE_CHECKING:
    from socialmind.experiments import Run


def draw(run: Run) -> dict[str, Figure]:
    """Draw the figure of a run.

    Args:
        run: a recorded run of this model.

    Returns:
        The figure `flocking`.
    """
    with paper.style():
        return {"flocking": flocking(run.agents, run.series, int(run.parameters["world_size"]))}


def flocking(agents: pd.DataFrame, series: pd.DataFrame, size: int) -> Figure:
    """Draw the birds at the first and the last recorded tick, and the polarisation over time.

    Args:
        agents: one row a bird and recorded tick.
        series: one row a recorded tick.
        size: patches along a side of the world.

    Returns:
        A figure of three panels.
    """
    figure = paper.figure(paper.PAGE, 62)
    first, last, course = figure.subplots(1, 3)
    for axes, letter, tick in zip((first, last), "ab", series["tick"].iloc[[0, -1]], strict=True):
        _birds(axes, agents[agents["tick"] == tick], size)
        paper.panel_title(axes, letter, f"Tick {tick:,}")
    scale = paper.time_axis(course, list(series["tick"]))
    course.plot(series["tick"] / scale, series["polarisation"], color=paper.INK)
    course.set(ylim=(0, 1.04), ylabel="polarisation (0 … 1)")
    paper.panel_title(course, "c", "How much they fly one way")
    return figure


def _birds(axes: Axes, now: pd.DataFrame, size: int) -> None:
    """Draw each bird as a triangle along its heading."""
    low = -(size // 2) - 0.5
    axes.quiver(
        now["x"], now["y"], now["east"], now["north"], color=paper.BLUE, pivot="mid",
        scale_units="width", scale=28, width=0.012, headwidth=3.4, headlength=5,
        headaxislength=4.5, minlength=0,
    )  # fmt: skip
    axes.spines[["top", "right"]].set_visible(True)
    axes.set(xlim=(low, low + size), ylim=(low, low + size), aspect="equal")
    axes.set(xlabel="x (patches)", ylabel="y (patches)")
