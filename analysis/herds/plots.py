"""The figure of the study."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

from socialmind.catalogue import load_figures, load_model
from socialmind.drawing import style as paper

SHOWN = "participation 4"
LINES = {
    SHOWN: (paper.BLUE, "-"),
    "participation 0": (paper.GREY, (0, (4, 2))),
    "participation 40": (paper.RED, "-."),
}
MAP_SEED = 0
LONGEST = 1_200
"""Ticks of a herd's life that are drawn."""


def draw(looks: pd.DataFrame, curves: Mapping[str, tuple[list[float], list[float]]]) -> Figure:
    """Draw what the study found.

    Args:
        looks: a row for each tick looked at.
        curves: for each setting the ages of herds and the shares that outlive them.

    Returns:
        A figure of three panels, as wide as a column.
    """
    with paper.style():
        figure = paper.figure(paper.COLUMN, 185, gap=1.5)
        panels = figure.subplots(3, 1, height_ratios=(1.7, 1, 1))
        _map(panels[0], looks)
        _sizes(panels[1], looks)
        _lives(panels[2], curves)
    return figure


def _map(axes: Axes, looks: pd.DataFrame) -> None:
    """Draw the pasture of one seed when three herds, or the most there were, lived side by side."""
    own = looks[(looks["setting"] == SHOWN) & (looks["seed"] == MAP_SEED)]
    tick = int(own.loc[own["herds"].idxmax(), "tick"])
    model = load_model("herds")
    pasture = model(MAP_SEED)
    pasture.advance(tick)
    cows = pd.DataFrame(pasture.agents())
    load_figures(model.folder()).map_of_cows(axes, cows)
    paper.panel_title(axes, "a", f"Herds at tick {tick:,} of a run; stars lead")


def _sizes(axes: Axes, looks: pd.DataFrame) -> None:
    own = looks[looks["setting"] == SHOWN]
    scale = paper.time_axis(axes, list(own["tick"].unique()))
    for column, colour, dashes, label in (
        ("in_herds", paper.INK, "-", "in a herd"), ("largest", paper.BLUE, "--", "in the largest"),
        ("herds", paper.RED, "-.", "herds"),
    ):  # fmt: skip
        seeds = own.pivot_table(index="tick", columns="seed", values=column)
        low, high = np.quantile(seeds, (0.1, 0.9), axis=1)
        axes.fill_between(seeds.index / scale, low, high, color=colour, alpha=0.15, linewidth=0)
        axes.plot(
            seeds.index / scale, seeds.mean(axis=1), color=colour, linewidth=0.9, linestyle=dashes,
            label=label,
        )  # fmt: skip
    axes.set_ylim(0, 17)
    axes.yaxis.set_major_locator(MaxNLocator(5, integer=True))
    axes.set_ylabel("cows; herds (number)")
    axes.legend(loc="center right", bbox_to_anchor=(1, 0.3), ncols=3)
    paper.panel_title(axes, "b", "Mean over seeds; bands: 10 to 90 % of them")


def _lives(axes: Axes, curves: Mapping[str, tuple[list[float], list[float]]]) -> None:
    for setting, (colour, dashes) in LINES.items():
        ages, shares = curves[setting]
        axes.step(
            ages, shares, where="post", color=colour, linewidth=1, linestyle=dashes, label=setting
        )
    axes.set_xlim(0, LONGEST)
    axes.set_ylim(0, 1.02)
    axes.set_xlabel("age of a herd (ticks)")
    axes.set_ylabel("share of herds that outlive it")
    axes.legend(loc="upper right")
    paper.panel_title(axes, "c", "How long herds live")
