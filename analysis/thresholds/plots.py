"""The figure of the study."""

from __future__ import annotations

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from socialmind.drawing import style as paper
from socialmind.experiments.measures.intervals import interval_of

from .colonies import expected

SIZE = 5
"""Workers of the colony that is shown."""


def draw(tables: dict[str, pd.DataFrame]) -> Figure:
    """Draw what the study found.

    Args:
        tables: `castes`, `specialists` and `absences`.

    Returns:
        A figure of three panels, as wide as a column.
    """
    with paper.style():
        figure = paper.figure(paper.COLUMN, 150, gap=1.5)
        panels = figure.subplots(3, 1, height_ratios=(5, 3, 5))
        _castes(panels[0], tables["castes"])
        _division(panels[1], tables["specialists"])
        _absences(panels[2], tables["absences"])
    return figure


def _castes(axes: Axes, castes: pd.DataFrame) -> None:
    shares = np.linspace(0, 1, 101)
    ideal = np.array([expected(share) for share in shares])
    for column, place, name, colour in (
        ("major_work", 0, "majors, θ = 8", paper.RED),
        ("minor_work", 1, "minors, θ = 1", paper.BLUE),
    ):
        some = shares > 0 if place == 0 else shares < 1
        axes.plot(100 * shares[some], ideal[some, place], color=colour, label=name)
        known = castes.dropna(subset=[column]).groupby("majors")[column]
        bars = [interval_of(values) for _, values in known]
        _with_bars(axes, [majors for majors, _ in known], bars, colour)
    axes.set_ylim(0, 1)
    axes.set_xlabel("majors of 100 workers")
    axes.set_ylabel("share of time at work")
    axes.legend(loc="upper left")
    paper.panel_title(axes, "a", "Castes with fixed thresholds, one task")


def _division(axes: Axes, special: pd.DataFrame) -> None:
    rng = np.random.default_rng(0)  # spreads the dots, no more
    groups = list(special.groupby(["workers", "learns"], sort=False))
    for place, ((_, learns), rows) in enumerate(groups):
        values = rows["agents_to_tasks"].to_numpy()
        spread = place + rng.uniform(-0.2, 0.2, len(values))
        colour = paper.PURPLE if learns else paper.GREY
        axes.plot(spread, values, "o", color=colour, markersize=2, alpha=0.6, mew=0)
        luck = rows["agents_to_tasks_by_chance"].mean()
        axes.plot([place - 0.3, place + 0.3], [luck] * 2, color=paper.INK, linewidth=0.8)
    names = [f"{n} workers,\n{'learned' if learns else 'fixed'}" for (n, learns), _ in groups]
    axes.set_xticks(range(len(groups)), names)
    axes.set_ylim(-0.02, 1.02)
    axes.set_ylabel("I / H(tasks)")
    paper.panel_title(axes, "b", "Division of labour; lines: by luck alone")


def _absences(axes: Axes, away: pd.DataFrame) -> None:
    shown = away[(away["workers"] == SIZE) & (away["away"] > 0)]
    for forgets, name, colour in (
        (True, "those away forget", paper.RED),
        (False, "those away forget nothing", paper.BLUE),
    ):
        rows = shown[shown["forgets"] == forgets].groupby("away")["other_role"]
        bars = [interval_of(values) for _, values in rows]
        ticks = [ticks for ticks, _ in rows]
        axes.plot(ticks, [one.mean for one in bars], color=colour, label=name)
        _with_bars(axes, ticks, bars, colour)
    axes.set_xscale("log")
    axes.xaxis.set_major_formatter("{x:,.0f}")
    axes.set_ylim(0, 1)
    axes.set_xlabel("ticks away")
    axes.set_ylabel("workers with another role")
    axes.legend(loc="upper left")
    paper.panel_title(axes, "c", "5,000 ticks after the specialists' return")


def _with_bars(axes: Axes, places: list, bars: list, colour: str) -> None:
    means = np.array([one.mean for one in bars])
    ends = np.array([[one.mean - one.low, one.high - one.mean] for one in bars]).T
    axes.errorbar(
        places, means, np.maximum(ends, 0), fmt="o", color=colour, markersize=3, linewidth=0.8
    )
