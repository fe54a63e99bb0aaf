"""The figure of the study."""

from __future__ import annotations

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from socialmind.drawing import style as paper
from socialmind.experiments.measures.intervals import interval_of

from .colonies import MAJORS, MINORS, absence_told, expected, works

SIZE = 5
"""Workers of the colony that is shown."""
TOLD = {"away": 1_000, "seed": 0, "before": 500, "after": 2_500, "every": 20}
"""The colony whose thresholds are shown over time."""
CASTES = (
    (0, "major_work", MAJORS, "majors, θ = 8", paper.RED, "s", "--"),
    (1, "minor_work", MINORS, "minors, θ = 1", paper.BLUE, "o", "-"),
)


def draw(tables: dict[str, pd.DataFrame]) -> Figure:
    """Draw what the study found.

    Args:
        tables: `answers`, `castes`, `specialists` and `absences`.

    Returns:
        A figure of five panels, as wide as a column.
    """
    with paper.style():
        figure = paper.figure(paper.COLUMN, 230, gap=1.5)
        panels = figure.subplots(5, 1, height_ratios=(4, 4, 4, 3, 4))
        _answers(panels[0], tables["answers"])
        _castes(panels[1], tables["castes"])
        _told(panels[2], absence_told(**TOLD))
        _division(panels[3], tables["specialists"])
        _absences(panels[4], tables["absences"])
    return figure


def _answers(axes: Axes, answers: pd.DataFrame) -> None:
    stimuli = np.geomspace(answers["stimulus"].min(), answers["stimulus"].max(), 101)
    for _, _, threshold, name, colour, mark, dashes in CASTES:
        ideal = [works(stimulus, threshold) for stimulus in stimuli]
        axes.plot(stimuli, ideal, color=colour, linestyle=dashes)
        known = answers[answers["threshold"] == threshold].groupby("stimulus")["work"]
        bars = [interval_of(values) for _, values in known]
        _with_bars(axes, [stimulus for stimulus, _ in known], bars, colour, mark, name)
    axes.set_xscale("log")
    axes.xaxis.set_major_formatter("{x:g}")
    axes.set_ylim(0, 1)
    axes.set_xlabel("stimulus, held as it is")
    axes.set_ylabel("share of time at work")
    axes.legend(loc="lower right")
    paper.panel_title(axes, "a", "Who works, by the stimulus")


def _castes(axes: Axes, castes: pd.DataFrame) -> None:
    shares = np.linspace(0, 1, 101)
    ideal = np.array([expected(share) for share in shares])
    for place, column, _, name, colour, mark, dashes in CASTES:
        some = shares > 0 if place == 0 else shares < 1
        axes.plot(100 * shares[some], ideal[some, place], color=colour, linestyle=dashes)
        known = castes.dropna(subset=[column]).groupby("majors")[column]
        bars = [interval_of(values) for _, values in known]
        _with_bars(axes, [majors for majors, _ in known], bars, colour, mark, name)
    axes.set_ylim(0, 1)
    axes.set_xlabel("majors of 100 workers")
    axes.set_ylabel("share of time at work")
    axes.legend(loc="upper left")
    paper.panel_title(axes, "b", "Castes with fixed thresholds, one task")


def _told(axes: Axes, told: pd.DataFrame) -> None:
    axes.axvspan(0, TOLD["away"], color=paper.GREY, alpha=0.18, linewidth=0)
    axes.text(TOLD["away"] / 2, 1_060, "away", ha="center", va="center", fontsize=7)
    for (removed, _), rows in told.groupby(["removed", "agent"]):
        colour, dashes = (paper.INK, "--") if removed else (paper.TEAL, "-")
        axes.plot(rows["since"], rows["threshold"], color=colour, linestyle=dashes, linewidth=0.9)
    axes.set_xlim(-TOLD["before"], TOLD["away"] + TOLD["after"])
    axes.set_ylim(0, 1_120)
    for axis in (axes.xaxis, axes.yaxis):
        axis.set_major_formatter("{x:,.0f}")
    axes.set_xlabel("ticks since the removal")
    axes.set_ylabel("θ for the task")
    paper.panel_title(axes, "c", "Five workers; dashes: specialists taken away")


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
    paper.panel_title(axes, "d", "Division of labour; lines: by luck alone")


def _absences(axes: Axes, away: pd.DataFrame) -> None:
    shown = away[(away["workers"] == SIZE) & (away["away"] > 0)]
    # A little apart, since up to 500 ticks both are the same.
    for forgets, name, colour, mark, dashes, aside in (
        (True, "those away forget", paper.GOLD, "s", "-", 0.95),
        (False, "those away forget nothing", paper.INK, "o", "--", 1.05),
    ):
        rows = shown[shown["forgets"] == forgets].groupby("away")["other_role"]
        bars = [interval_of(values) for _, values in rows]
        ticks = [aside * ticks for ticks, _ in rows]
        axes.plot(ticks, [one.mean for one in bars], color=colour, linestyle=dashes)
        _with_bars(axes, ticks, bars, colour, mark, name)
    axes.set_xscale("log")
    axes.xaxis.set_major_formatter("{x:,.0f}")
    axes.set_ylim(0, 1)
    axes.set_xlabel("ticks away")
    axes.set_ylabel("share of workers\nwith another role")
    axes.legend(loc="upper left")
    paper.panel_title(axes, "e", "5,000 ticks after the specialists' return")


def _with_bars(
    axes: Axes, places: list, bars: list, colour: str, mark: str, name: str | None = None
) -> None:
    means = np.array([one.mean for one in bars])
    ends = np.array([[one.mean - one.low, one.high - one.mean] for one in bars]).T
    axes.errorbar(
        places, means, np.maximum(ends, 0), fmt=mark, color=colour, markersize=3, linewidth=0.8,
        label=name,
    )  # fmt: skip
