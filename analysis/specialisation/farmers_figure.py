"""The figure of farmers and artisans: societies over time, and measure by measure."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import pandas as pd
from matplotlib.lines import Line2D

from socialmind.drawing import style as paper

from . import farmers
from .plots import across, dot, legend
from .societies import Size

if TYPE_CHECKING:
    from matplotlib.figure import Figure

FARMERS = {
    "written": paper.RED,
    "learned": paper.BLUE,
    "distilled": paper.PURPLE,
    "shipped": paper.GREY,
}
FARMERS_TITLES = {**dict(zip(FARMERS, FARMERS, strict=True)), "shipped": "the model's"}
SHORT = {"prosperity": "Wheat", "last_distance": "Distance"}
"""Titles of narrow panels."""


def villagers(
    over_time: pd.DataFrame, table: pd.DataFrame, worlds: pd.DataFrame, size: Size
) -> Figure:
    """Draw the societies of farmers and artisans: over time, and measure by measure.

    Args:
        over_time: `society`, `measure` (`artisans`, `specialised`), `tick`, `mean`, `low`, `high`.
        table: `society`, `measure`, `mean`, `low`, `high`.
        worlds: `society`, `attempt` and measures, a row for each run.
        size: of the study.
    """
    each = worlds.groupby(["society", "attempt"]).mean(numeric_only=True)
    figure = paper.figure(paper.PAGE, 104)
    panels = figure.subplots(2, 4)
    for letter, axes, (name, title, label) in zip(
        "ae", panels[:, 0],
        (("artisans", "Artisans", "of 25 agents"),
         ("specialised", "Specialised", "share of agents")),
        strict=False,
    ):  # fmt: skip
        unit = paper.time_axis(axes, [0, size.farmers_ticks])
        for society, colour in FARMERS.items():
            own = over_time[(over_time["society"] == society) & (over_time["measure"] == name)]
            x = own["tick"].to_numpy() / unit
            axes.fill_between(x, own["low"], own["high"], color=colour, alpha=0.2, linewidth=0)
            axes.plot(x, own["mean"], color=colour, linestyle=paper.DASHES.get(colour, "-"))
        axes.set_ylim(0, None)
        axes.set_ylabel(label)
        paper.panel_title(axes, letter, title)
    for letter, axes, measured in zip(
        "bcdfgh", panels[:, 1:].flat, farmers.MEASURED.values(), strict=True
    ):
        own = table[table["measure"] == measured.name].set_index("society")
        dots: list[float] = []
        for row, (society, colour) in enumerate(FARMERS.items()):
            found = own.loc[society]
            if np.isfinite(found["mean"]):
                dot(axes, row, found, colour)
                attempts = each.loc[society][measured.name].tolist()
                dots += attempts
                if len(attempts) > 1:
                    axes.plot(
                        attempts,
                        [row + 0.3] * len(attempts),
                        "o",
                        color=colour,
                        markersize=2.2,
                        mfc="white",
                        mew=0.6,
                    )
            else:
                axes.annotate(
                    "not settled" if own.loc[society, "attempts"] == 1 else "not settled in all",
                    (0.03, row), xycoords=("axes fraction", "data"), va="center", fontsize=7,
                    style="italic", color=colour,
                )  # fmt: skip
        if measured.name == "agents_to_tasks":
            luck = table[table["measure"] == "agents_to_tasks_by_chance"].set_index("society")
            for row, society in enumerate(FARMERS):
                axes.plot([luck.loc[society, "mean"]] * 2, [row - 0.2, row + 0.2], color=paper.GREY)
        axes.set_ylim(len(FARMERS) - 0.5, -0.5)
        axes.set_yticks([])
        axes.spines["left"].set_visible(False)
        across(axes, own.loc[list(FARMERS)], dots)
        axes.set_xlabel(measured.unit)
        paper.panel_title(axes, letter, SHORT.get(measured.name, measured.title))
    for axes in panels[:, 1]:
        axes.set_yticks(range(len(FARMERS)), list(FARMERS_TITLES.values()))
        axes.tick_params(axis="y", length=0)
    legend(figure, [
        *(Line2D([], [], color=colour, linestyle=paper.DASHES.get(colour, "-"), marker="o",
                 markersize=3, label=FARMERS_TITLES[one]) for one, colour in FARMERS.items()),
        Line2D([], [], color=paper.INK, linestyle="", marker="o", markersize=2.2, mfc="white",
               mew=0.6, label="an attempt"),
    ])  # fmt: skip
    return figure
