"""The figure of the study."""

from __future__ import annotations

import pandas as pd
from matplotlib.axes import Axes
from matplotlib.colors import ListedColormap
from matplotlib.figure import Figure, SubFigure
from matplotlib.ticker import MultipleLocator

from socialmind.catalogue import load_figures, load_model
from socialmind.drawing import style as paper

from .mounds import MOMENTS, SETTINGS

MAP_SEED = 0
MAPS = ("one kind", "four kinds")
KINDS = ListedColormap(["white", "#173f39", "#f0cf7a", paper.TEAL, paper.PURPLE])
"""Of no chip, and of the kinds of chips: other tints than those of the settings; in grey too each
has a shade of its own."""
LINES = {
    "one kind": (paper.INK, "o"),
    "two kinds": (paper.BLUE, "s"),
    "four kinds": (paper.RED, "^"),
    "nobody goes away": (paper.GREY, "D"),
}


def draw(table: pd.DataFrame) -> Figure:
    """Draw what the study found.

    Args:
        table: a row for each society and moment.

    Returns:
        A figure as wide as a column.
    """
    with paper.style():
        figure = paper.figure(paper.COLUMN, 165, gap=1.0)
        maps, lines = figure.subfigures(2, 1, height_ratios=(1, 2.2))
        _maps(maps)
        panels = lines.subplots(2, 1, sharex=True)
        _lines(panels[0], table, "piles")
        _lines(panels[1], table, "together")
        panels[0].set(yscale="log", ylabel="piles")
        panels[0].yaxis.set_major_formatter("{x:g}")
        panels[1].set(ylim=(0, 1.02), ylabel="share of patches around")
        panels[1].set_xlabel("time (thousand ticks)")
        paper.panel_title(panels[0], "c", "Piles; open marks: scattered anew")
        paper.panel_title(panels[1], "d", "Chips beside their kind; open: by chance")
        panels[1].legend(loc="upper left", bbox_to_anchor=(0, -0.28), ncols=2)
    return figure


def _maps(figure: SubFigure) -> None:
    """Draw the chips of one seed at the last moment."""
    model = load_model("termites")
    for letter, axes, setting in zip("ab", figure.subplots(1, 2, sharey=True), MAPS, strict=True):
        society = model(MAP_SEED, **SETTINGS[setting])
        society.advance(MOMENTS[-1])
        load_figures(model.folder()).map_of_chips(axes, society.world)
        axes.images[0].set_cmap(KINDS)
        axes.set_ylabel("y (patches)" if letter == "a" else "")
        paper.panel_title(axes, letter, setting.capitalize())
    figure.suptitle(f"Chips at tick {MOMENTS[-1]:,}; edges meet", x=0.02, ha="left", fontsize=8)


def _lines(axes: Axes, table: pd.DataFrame, column: str) -> None:
    """Draw means over time, and what chance does at the right, each setting a little aside."""
    chance = {"piles": "scattered_piles", "together": "by_chance"}[column]
    for place, (setting, (colour, mark)) in enumerate(LINES.items()):
        rows = table[table["setting"] == setting]
        mean = rows.groupby("tick")[column].mean()
        axes.plot(
            mean.index / 1000, mean, color=colour, marker=mark, markersize=3, linewidth=0.9,
            label=setting, clip_on=False,
        )  # fmt: skip
        last = rows.loc[rows["tick"] == MOMENTS[-1], chance].mean()
        axes.plot(
            1.03 + 0.025 * place, last, marker=mark, color=colour, markersize=3.2, clip_on=False,
            markerfacecolor="white", markeredgewidth=0.8, transform=axes.get_yaxis_transform(),
        )  # fmt: skip
    axes.set_xlim(0, MOMENTS[-1] / 1000)
    axes.xaxis.set_major_locator(MultipleLocator(5))
