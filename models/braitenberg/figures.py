"""The figures of the vehicles: where they went round the lights, and how near they came.

Blue stands for those that seek light, red for those that flee it, gold for light.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from socialmind.drawing import style as paper

if TYPE_CHECKING:
    from socialmind.experiments import Run

COLOURS = {
    "fear": paper.RED,
    "aggression": paper.BLUE,
    "love": paper.BLUE,
    "exploration": paper.RED,
}
PATHS_DRAWN = 12  # of each panel; more hide one another
PANELS = (
    ("Wirings that turn to light", ("aggression", "love")),
    ("Wirings that turn away", ("fear", "exploration")),
)


def draw(run: Run) -> dict[str, Figure]:
    """Draw every figure of a run.

    Args:
        run: a recorded run of this model.

    Returns:
        The figures `paths` and `distance` by name.
    """
    with paper.style():
        return {
            "paths": paths(run.agents, int(run.parameters["world_size"])),
            "distance": distance(run.series),
        }


def paths(agents: pd.DataFrame, size: int) -> Figure:
    """Draw the ways of some vehicles, a panel for seekers and one for those that flee.

    Args:
        agents: one row a vehicle and recorded tick.
        size: patches along a side of the world.

    Returns:
        A figure of two maps.
    """
    figure = paper.figure(paper.PAGE, 92)
    panels = figure.subplots(1, 2, sharey=True)
    low = -(size // 2) - 0.5
    lights = agents[["light_x", "light_y"]].drop_duplicates().to_numpy(float)
    for axes, letter, (title, kinds) in zip(panels, "ab", PANELS, strict=True):
        axes.scatter(
            lights[:, 0], lights[:, 1], marker="*", s=110, color=paper.GOLD, edgecolors=paper.INK,
            linewidths=0.5, zorder=4,
        )  # fmt: skip
        shown = agents[agents["kind"].isin(kinds)]
        for agent in sorted(shown["agent"].unique())[:PATHS_DRAWN]:
            _path(axes, shown[shown["agent"] == agent].sort_values("tick"), size)
        axes.spines[["top", "right"]].set_visible(True)
        axes.set(xlim=(low, low + size), ylim=(low, low + size), aspect="equal")
        axes.set_xlabel("x (patches)")
        paper.panel_title(axes, letter, title)
    panels[0].set_ylabel("y (patches)")
    _key(figure)
    return figure


def _path(axes: Axes, rows: pd.DataFrame, size: int) -> None:
    """Draw the way of one vehicle; a step over an edge of the torus at both edges."""
    places = rows[["x", "y"]].to_numpy(float)
    step = np.diff(places, axis=0)
    step -= size * np.round(step / size)
    leaving = np.stack([places[:-1], places[:-1] + step], axis=1)
    coming = np.stack([places[1:] - step, places[1:]], axis=1)
    over = ~np.isclose(leaving, coming).all(axis=(1, 2))
    colour = COLOURS[rows["kind"].iloc[0]]
    lines = np.concatenate([leaving, coming[over]])
    axes.add_collection(LineCollection(lines, colors=colour, linewidths=0.6, alpha=0.7))
    axes.plot(*places[0], "o", markersize=2.6, markerfacecolor="white", color=colour, zorder=5)
    axes.plot(*places[-1], "o", markersize=3.2, color=colour, zorder=5)


def _key(figure: Figure) -> None:
    """Say what the marks mean, under the maps."""
    marks = [
        Line2D([], [], marker="*", color="none", markerfacecolor=paper.GOLD, markersize=9,
               markeredgecolor=paper.INK, markeredgewidth=0.5, label="light"),
        Line2D([], [], marker="o", color=paper.GREY, markerfacecolor="white", markersize=3,
               linewidth=0, label="start"),
        Line2D([], [], marker="o", color=paper.GREY, markersize=3.4, linewidth=0, label="end"),
    ]  # fmt: skip
    figure.legend(handles=marks, loc="outside lower center", ncols=3)


def distance(series: pd.DataFrame) -> Figure:
    """Draw the mean distance to the nearest light, and the mean speed, over time.

    Args:
        series: one row a recorded tick.

    Returns:
        A figure of two panels.
    """
    figure = paper.figure(paper.COLUMN, 95)
    panels = figure.subplots(2, 1, sharex=True)
    scale = paper.time_axis(panels[1], list(series["tick"]))
    shown = (
        ("distance", "Distance to the nearest light", "mean (patches)"),
        ("speed", "Speed", "mean (patches a tick)"),
    )
    for axes, letter, (column, title, unit) in zip(panels, "ab", shown, strict=True):
        ends, drawn = [], []
        for name, colour in (("seekers", paper.BLUE), ("avoiders", paper.RED)):
            values = series[f"{name}_{column}"].astype(float)
            axes.plot(series["tick"] / scale, values, color=colour)
            drawn += values.tolist()
            if len(values) and np.isfinite(values.iloc[-1]):
                ends.append((float(values.iloc[-1]), name, colour))
        axes.set_ylim(*paper.limits_with_zero(drawn))
        axes.set_ylabel(unit)
        paper.panel_title(axes, letter, title)
        paper.label_ends(axes, ends)
    panels[0].tick_params(labelbottom=False)
    return figure
