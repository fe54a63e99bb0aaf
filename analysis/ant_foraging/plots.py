"""The figure of the study."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.colors import LogNorm
from matplotlib.figure import Figure, SubFigure

from socialmind.catalogue import load_figures, load_model
from socialmind.drawing import style as paper
from socialmind.experiments.measures.intervals import interval_of

from .colonies import ALL, BRIDGES, FIELDS

MAP_SEED = 100
MAP_TICKS = (100, 2_000)
HOMEWARD, BARE = "marked homeward only", "no pheromone"
MARKING = {HOMEWARD: paper.RED, BARE: paper.GREY}
"""The colours of what is laid where, blue where both ways are marked."""
LINES = {
    "one pile": (paper.PURPLE, "o"),
    "three piles": (paper.TEAL, "s"),
    "a hundred crumbs": (paper.GOLD, "^"),
}
MARKS_EVERY = 10
"""Looks from one mark on a line to the next."""
FIELD_TICKS = 1_000
"""Ticks of a field that are drawn."""


def draw(tables: Mapping[str, pd.DataFrame]) -> Figure:
    """Draw what the study found.

    Args:
        tables: `bridges`, `drops` and `looks`.

    Returns:
        A figure as wide as a column.
    """
    with paper.style():
        figure = paper.figure(paper.COLUMN, 215, gap=1.0)
        maps, shares, rest = figure.subfigures(3, 1, height_ratios=(1.2, 1.3, 2))
        _maps(maps)
        _shares(shares.subplots(), tables["bridges"])
        panels = rest.subplots(2, 1)
        _drops(panels[0], tables["drops"])
        _fields(panels[1], tables["looks"])
    return figure


def _maps(figure: SubFigure) -> None:
    """Draw the pheromone on the bridge, early and late."""
    model = load_model("ant_foraging")
    figures = load_figures(model.folder())
    colony = model(MAP_SEED, **BRIDGES["20 and 40 steps"])
    norm = LogNorm(figures.FAINTEST, 1_000.0, clip=True)
    panels = figure.subplots(1, 2, sharey=True)
    for letter, axes, tick in zip("ab", panels, MAP_TICKS, strict=True):
        colony.advance(tick - colony.tick)
        marks = np.where(colony.world.pheromone >= figures.FAINTEST, colony.world.pheromone, np.nan)
        shown = axes.imshow(
            marks.T, norm=norm, cmap=figures.MARKED, origin="lower", interpolation="none",
            extent=(figures.LOW, figures.HIGH) * 2,
        )  # fmt: skip
        figures.frame(axes)
        axes.set(xlim=(-19, 19), ylim=(-18, 9))
        axes.text(-10, 0, "nest", ha="right", va="center", fontsize=7)
        axes.text(10, 0, "food", ha="left", va="center", fontsize=7)
        paper.panel_title(axes, letter, f"Tick {tick:,}")
    panels[1].set_ylabel("")
    bar = figure.colorbar(shown, ax=panels, location="bottom", fraction=0.08, aspect=40)
    bar.set_label("pheromone on a patch")
    bar.outline.set_visible(False)


def _shares(axes: Axes, bridges: pd.DataFrame) -> None:
    rng = np.random.default_rng(0)  # spreads the dots, no more
    for place, setting in enumerate(BRIDGES):
        values = bridges.loc[bridges["setting"] == setting, "north"].to_numpy()
        spread = place + rng.uniform(-0.2, 0.2, len(values))
        colour = MARKING.get(setting, paper.BLUE)
        axes.plot(values, spread, "o", color=colour, markersize=2.2, alpha=0.7, mew=0)
        mean = interval_of(values)
        axes.plot([mean.low, mean.high], [place, place], color=paper.INK, linewidth=0.8)
        axes.plot(mean.mean, place, "|", color=paper.INK, markersize=6)
        axes.text(0.1, place - 0.36, setting, fontsize=7, va="center")
    axes.axvline(0.5, color=paper.GREY, linewidth=0.6, linestyle=":")
    axes.set_yticks([])
    axes.set_ylim(len(BRIDGES) - 0.6, -0.7)
    axes.set_xlim(-0.02, 1.02)
    axes.set_xlabel("share of traffic on the northern way")
    paper.panel_title(axes, "c", "Each seed; bars: the mean")


def _drops(axes: Axes, drops: pd.DataFrame) -> None:
    for setting, name, colour, mark in (
        ("20 and 40 steps", "marked both ways", paper.BLUE, "o"),
        (HOMEWARD, "homeward only", MARKING[HOMEWARD], "s"),
    ):
        rows = drops[drops["setting"] == setting].groupby("drop")["wins"]
        bars = [interval_of(values) for _, values in rows]
        means = np.array([one.mean for one in bars])
        ends = np.array([[one.mean - one.low, one.high - one.mean] for one in bars]).T
        axes.errorbar(
            [drop for drop, _ in rows], means, np.maximum(ends, 0), fmt=f"{mark}-", color=colour,
            markersize=3, linewidth=0.8, label=name,
        )  # fmt: skip
    axes.axhline(0.5, color=paper.GREY, linewidth=0.6, linestyle=":")
    axes.set_xscale("log")
    axes.xaxis.set_major_formatter("{x:g}")
    axes.set_ylim(0, 1.04)
    axes.set_xlabel("pheromone laid a step")
    axes.set_ylabel("share of seeds")
    axes.legend(loc="lower left")
    paper.panel_title(axes, "d", "The shorter way has more traffic")


def _fields(axes: Axes, looks: pd.DataFrame) -> None:
    for field in FIELDS:
        colour, mark = LINES[field]
        for marks, dashes in ((True, "-"), (False, (0, (3, 2)))):
            rows = looks[(looks["field"] == field) & (looks["marks"] == marks)]
            mean = rows.groupby("tick")["brought"].mean()
            axes.plot(
                mean.index, mean, color=colour, linestyle=dashes, marker=mark, markersize=2.5,
                markevery=MARKS_EVERY, label=field if marks else None,
            )  # fmt: skip
    axes.set_xlim(0, FIELD_TICKS)
    axes.xaxis.set_major_formatter("{x:,.0f}")
    axes.set_ylim(0, 1.02 * ALL)
    axes.set_xlabel("time (ticks)")
    axes.set_ylabel("pieces brought home")
    axes.legend(loc="lower right", borderaxespad=0.1)
    paper.panel_title(axes, "e", "Food in a field; dashes: nobody marks")
