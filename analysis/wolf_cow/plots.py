"""The figure of the study."""

from __future__ import annotations

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from socialmind.drawing import style as paper
from socialmind.experiments.measures.intervals import interval_of

from .pastures import BULLS, EARLY, SETTINGS

COLOURS = dict(zip(SETTINGS, (paper.RED, paper.PURPLE, paper.BLUE), strict=True))
DASHES = dict(zip(SETTINGS, ("-", ":", "--"), strict=True))
MARKERS = dict(zip(SETTINGS, ("o", "^", "s"), strict=True))
SHOWN = 3
"""Bulls in the panel of cows over time."""


def draw(pastures: pd.DataFrame, looks: pd.DataFrame) -> Figure:
    """Draw what the study found.

    Args:
        pastures: a row for each.
        looks: a row for each tick looked at.

    Returns:
        A figure of three panels, as wide as a column.
    """
    with paper.style():
        figure = paper.figure(paper.COLUMN, 165, gap=1.5)
        panels = figure.subplots(3, 1, height_ratios=(1.2, 1, 1))
        _cows(panels[0], looks)
        _by_bulls(panels[1], pastures, "early_killed")
        panels[1].set_xlabel("bulls (number)")
        panels[1].set_ylabel("cows eaten")
        paper.panel_title(panels[1], "b", f"Eaten in the first {EARLY} ticks")
        _by_bulls(panels[2], pastures, "cows")
        panels[2].set_xlabel("bulls (number)")
        panels[2].set_ylabel("cows")
        paper.panel_title(panels[2], "c", "Cows, mean of the second half")
    return figure


def _cows(axes: Axes, looks: pd.DataFrame) -> None:
    own = looks[looks["bulls"] == SHOWN]
    scale = paper.time_axis(axes, list(own["tick"].unique()))
    for setting, colour in COLOURS.items():
        some = own[own["setting"] == setting]
        seeds = some.pivot_table(index="tick", columns="seed", values="cows")
        low, high = np.quantile(seeds, (0.1, 0.9), axis=1)
        axes.fill_between(seeds.index / scale, low, high, color=colour, alpha=0.18, linewidth=0)
        axes.plot(
            seeds.index / scale, seeds.mean(axis=1), color=colour, linestyle=DASHES[setting],
            linewidth=0.9, marker=MARKERS[setting], markersize=2.6, markevery=5, label=setting,
        )  # fmt: skip
    axes.set_ylim(0, 1.4 * axes.get_ylim()[1])  # room for the legend
    axes.set_ylabel("cows")
    axes.xaxis.set_major_formatter("{x:,.0f}")
    axes.legend(loc="upper right")
    paper.panel_title(axes, "a", f"{SHOWN} bulls; bands: 10 to 90 % of seeds")


def _by_bulls(axes: Axes, pastures: pd.DataFrame, measure: str) -> None:
    """Draw a measure by the number of bulls: means with intervals."""
    for setting, colour in COLOURS.items():
        if measure == "early_killed" and setting == "no wolves":
            continue
        own = pastures[pastures["setting"] == setting]
        found = [interval_of(own.loc[own["bulls"] == bulls, measure].to_numpy()) for bulls in BULLS]
        means = np.array([one.mean for one in found])
        ends = np.array([[one.low, one.high] if np.isfinite(one.low) else [one.mean] * 2
                         for one in found]).T  # fmt: skip
        spans = np.abs(ends - means)
        axes.errorbar(
            BULLS, means, yerr=spans, color=colour, linewidth=0.9, linestyle=DASHES[setting],
            marker=MARKERS[setting], markersize=2.6, elinewidth=0.8, capsize=1.5, label=setting,
        )  # fmt: skip
    axes.set_ylim(bottom=0)
