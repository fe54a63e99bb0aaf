"""The figure of the study."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import pandas as pd
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.ticker import MaxNLocator

from socialmind.catalogue import load_figures, load_model
from socialmind.drawing import style as paper

from .survival import curve_of

SHOWN = "participation 4"
LINES = {
    SHOWN: (paper.PURPLE, "-"),
    "participation 0": (paper.INK, (0, (4, 2))),
    "participation 40": (paper.TEAL, "-."),
}
MAP_SEED = 0
HERDS = ("largest herd", "second", "third")


def draw(looks: pd.DataFrame, herds: pd.DataFrame) -> Figure:
    """Draw what the study found.

    Args:
        looks: a row for each tick looked at.
        herds: a row for each herd.

    Returns:
        A figure of three panels, as wide as a column.
    """
    with paper.style():
        figure = paper.figure(paper.COLUMN, 200, gap=1.5)
        panels = figure.subplots(3, 1, height_ratios=(1.75, 1, 1))
        _map(panels[0], looks)
        _sizes(panels[1], looks)
        _lives(panels[2], herds, float(looks["tick"].max()))
    return figure


def _map(axes: Axes, looks: pd.DataFrame) -> None:
    """Draw the pasture of one seed when three herds, or the most there were, lived side by side."""
    own = looks[(looks["setting"] == SHOWN) & (looks["seed"] == MAP_SEED)]
    tick = int(own.loc[own["herds"].idxmax(), "tick"])
    model = load_model("herds")
    figures = load_figures(model.folder())
    pasture = model(MAP_SEED)
    pasture.advance(tick)
    figures.map_of_cows(axes, pd.DataFrame(pasture.agents()))
    looked = [*zip(HERDS, figures.LARGEST, strict=False), ("in none", ("white", "o"))]
    key = [_mark(label, colour, mark, 4) for label, (colour, mark) in looked]
    key.append(_mark("leads", paper.PALE, "*", 7))
    _key_above(axes, "a", f"Herds at tick {tick:,} of a run; edges meet", key, 1.0)


def _key_above(axes: Axes, letter: str, title: str, key: Sequence[Artist], long: float) -> None:
    """Head a panel, with a key between title and panel that may be wider than the panel."""
    paper.panel_title(axes, letter, title)
    axes.set_title(axes.get_title("left"), pad=17)
    axes.legend(
        handles=key, loc="lower left", bbox_to_anchor=(-0.1, 1), ncols=len(key),
        borderaxespad=0.2, columnspacing=1.2, handlelength=long, handletextpad=0.4,
    ).set_in_layout(False)  # fmt: skip


def _mark(label: str, colour: str, mark: str, size: float) -> Line2D:
    return Line2D(
        [], [], color=colour, marker=mark, markersize=size, linestyle="none", label=label,
        markeredgecolor=paper.INK, markeredgewidth=0.4,
    )  # fmt: skip


def _sizes(axes: Axes, looks: pd.DataFrame) -> None:
    own = looks[looks["setting"] == SHOWN]
    scale = paper.time_axis(axes, list(own["tick"].unique()))
    # A hatched band is told from one below it, in print without colours as well.
    for column, colour, dashes, hatch, label in (
        ("in_herds", paper.INK, "-", None, "cows in a herd"),
        ("largest", paper.BLUE, "--", "//////", "cows in the largest"),
        ("herds", paper.GREY, "-.", None, "herds"),
    ):
        seeds = own.pivot_table(index="tick", columns="seed", values=column)
        low, high = np.quantile(seeds, (0.1, 0.9), axis=1)
        look = {"color": colour, "alpha": 0.16, "linewidth": 0}
        if hatch:
            look = {"facecolor": "none", "edgecolor": colour, "alpha": 0.45, "linewidth": 0}
        axes.fill_between(seeds.index / scale, low, high, hatch=hatch, **look)
        axes.plot(
            seeds.index / scale, seeds.mean(axis=1), color=colour, linewidth=0.9, linestyle=dashes,
            label=label,
        )  # fmt: skip
    axes.set_ylim(0, 17)
    axes.yaxis.set_major_locator(MaxNLocator(5, integer=True))
    axes.xaxis.set_major_formatter("{x:,.0f}")
    axes.set_ylabel("number")
    _key_above(axes, "b", "Mean over seeds; bands: 10 to 90 % of them", axes.lines, 2.2)


def _lives(axes: Axes, herds: pd.DataFrame, ticks: float) -> None:
    """Draw the shares of herds that outlive each age, with bands.

    Args:
        axes: the panel.
        herds: a row for each.
        ticks: of a run, so of the longest life that there can be.
    """
    for setting, (colour, dashes) in LINES.items():
        found = curve_of(herds[herds["setting"] == setting])
        axes.fill_between(
            found.ages, found.low, found.high, step="post", color=colour, alpha=0.14, linewidth=0
        )
        axes.step(
            found.ages, found.shares, where="post", color=colour, linewidth=1, linestyle=dashes,
            label=setting,
        )  # fmt: skip
        axes.plot(
            found.seen_last, found.share(found.seen_last), "|", color=colour, markersize=5,
            markeredgewidth=0.7, clip_on=False,
        )  # fmt: skip
    key, labels = axes.get_legend_handles_labels()
    stroke = Line2D([], [], color=paper.GREY, marker="|", linestyle="none", markersize=5)
    axes.legend([*key, stroke], [*labels, "still lived at the end"], loc="upper right")
    axes.set_xlim(0, ticks)
    axes.xaxis.set_major_formatter("{x:,.0f}")
    axes.set_ylim(0, 1.02)
    axes.set_xlabel("age of a herd (ticks)")
    axes.set_ylabel("share of herds that outlive it")
    paper.panel_title(axes, "c", "How long herds live; bands: 95 %")
