"""The figures of the boids: where they fly, how ordered, how near, and which skills are in charge.

Blue stands for cohesion, red for separation, gold for alignment.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.ticker import MaxNLocator

from socialmind.drawing import style as paper

if TYPE_CHECKING:
    from socialmind.experiments import Run

SKILLS = {"cohesion": paper.BLUE, "separation": paper.RED, "alignment": paper.GOLD}
SHARES_OF_RUN = (0.0, 0.04, 0.12, 1.0)  # when the snapshots are taken


def draw(run: Run) -> dict[str, Figure]:
    """Draw every figure of a run.

    Args:
        run: a recorded run of this model.

    Returns:
        The figures `snapshots` and `order` by name.
    """
    with paper.style():
        return {
            "snapshots": snapshots(run.agents, int(run.parameters["world_size"])),
            "order": order(run.series),
        }


def snapshots(agents: pd.DataFrame, size: int) -> Figure:
    """Draw the boids as arrows, at four ticks.

    Args:
        agents: one row a boid and recorded tick.
        size: patches along a side of the world.

    Returns:
        A figure of four maps.
    """
    figure = paper.figure(paper.PAGE, 64)
    panels = figure.subplots(1, 4, sharey=True)
    low = -(size // 2) - 0.5
    for axes, tick in zip(panels, chosen_ticks(agents["tick"].unique()), strict=True):
        _arrows(axes, agents[agents["tick"] == tick], size)
        axes.spines[["top", "right"]].set_visible(True)
        axes.set(xlim=(low, low + size), ylim=(low, low + size), aspect="equal")
        axes.set_title(f"tick {tick:,}")
        axes.set_xlabel("x (patches)")
    panels[0].set_ylabel("y (patches)")
    marks = [
        Line2D([], [], marker=">", linewidth=0, markersize=4, color=colour, label=name)
        for name, colour in (*SKILLS.items(), ("none, or alone", paper.GREY))
    ]
    figure.legend(
        handles=marks, loc="outside lower center", ncols=4, title="skill of most influence",
        handletextpad=0.1, title_fontsize=7,
    )  # fmt: skip
    return figure


def chosen_ticks(recorded: np.ndarray) -> list[int]:
    """The four recorded ticks to draw: the first, two early ones and the last.

    >>> chosen_ticks(np.arange(0, 501, 10))
    [0, 20, 60, 500]
    >>> chosen_ticks(np.array([7]))
    [7, 7, 7, 7]
    """
    ticks = np.sort(recorded)
    wanted = ticks[0] + (ticks[-1] - ticks[0]) * np.array(SHARES_OF_RUN)
    return [int(ticks[np.abs(ticks - one).argmin()]) for one in wanted]


def _arrows(axes: Axes, now: pd.DataFrame, size: int) -> None:
    """Draw each boid as a triangle along its heading, in the colour of its leading skill."""
    influence = now[[f"{name}_influence" for name in SKILLS]].to_numpy(float)
    colours = np.array(list(SKILLS.values()))[influence.argmax(axis=1)]
    colours[influence.sum(axis=1) == 0] = paper.GREY
    angle = np.radians(now["heading"].to_numpy(float))
    axes.quiver(
        now["x"], now["y"], np.sin(angle), np.cos(angle), color=colours, pivot="mid",
        scale_units="width", scale=20, width=0.016, headwidth=3.4, headlength=5,
        headaxislength=4.5, minlength=0,
    )  # fmt: skip


def order(series: pd.DataFrame) -> Figure:
    """Draw order, nearness, flocks and influence over time.

    Args:
        series: one row a recorded tick.

    Returns:
        A figure of four panels.
    """
    figure = paper.figure(paper.PAGE, 95)
    panels = figure.subplots(2, 2, sharex=True)
    ticks = list(series["tick"])
    lines: tuple[tuple[Axes, str, str, str, dict[str, tuple[str, str]]], ...] = (
        (panels[0, 0], "a", "Polarisation", "length of mean heading", {
            "of all": ("polarisation", paper.INK), "in flocks": ("flock_polarisation", paper.GREY),
        }),
        (panels[0, 1], "b", "Distance to the nearest flockmate", "mean (patches)", {
            "": ("nearest_distance", paper.INK),
        }),
        (panels[1, 0], "c", "Flocks of three or more", "number", {
            "flocks": ("flocks", paper.INK),
        }),
        (panels[1, 1], "d", "Influence of the base skills", "mean (0 … 1)", {
            name: (f"{name}_influence", colour) for name, colour in SKILLS.items()
        }),
    )  # fmt: skip
    for axes, letter, title, unit, columns in lines:
        scale = paper.time_axis(axes, ticks)
        ends, drawn = [], []
        for name, (column, colour) in columns.items():
            values = series[column].astype(float)
            axes.plot(series["tick"] / scale, values, color=colour, linewidth=0.8)
            drawn += values.tolist()
            if name and len(values) and np.isfinite(values.iloc[-1]):
                ends.append((float(values.iloc[-1]), name, colour))
        axes.set_ylim(*paper.limits_with_zero(drawn))
        axes.set_ylabel(unit)
        paper.panel_title(axes, letter, title)
        if len(columns) > 1:
            paper.label_ends(axes, ends)
        if letter == "c":
            axes.yaxis.set_major_locator(MaxNLocator(5, integer=True))
        if letter in "ab":
            axes.set_xlabel("")
    return figure
