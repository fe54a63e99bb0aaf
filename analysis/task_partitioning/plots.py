"""The figure of the study: what groups bring home, how they divide the way, how they evolved."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING

import numpy as np
import pandas as pd

from socialmind.drawing import style as paper
from socialmind.experiments.measures.crossed import crossed_interval
from socialmind.experiments.measures.intervals import Interval, interval_of

from .groups import (
    BLOCKS,
    EVOLVED,
    GENERALISTS,
    GROUNDS,
    HALVES,
    NAMES,
    PRIMITIVES,
    evolved_there,
)

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

COLOURS = {"slope": paper.RED, "flat": paper.BLUE}
MARKS = {"slope": "s", "flat": "o"}
PROGRAMMED = {GENERALISTS.name: "generalists", HALVES.name: "half droppers,\nhalf collectors"}
"""The programmed groups that are shown, and their names on the axis."""
STARTS = {BLOCKS: "evolved from\nblocks", PRIMITIVES: "evolved from\nprimitives"}
"""What evolved groups began with, and their names on the axis."""
SMOOTHED = 10
"""Generations over which the mean of curves is taken."""
SPREAD = 0.1
"""How far dots of attempts lie from the middle, of the distance of two groups."""


def draw(table: pd.DataFrame, curves: Mapping[str, pd.DataFrame]) -> Figure:
    """Draw the study.

    Args:
        table: of `groups.judge_all`.
        curves: of the trainings, by name.

    Returns:
        A figure of four panels, two by two.
    """
    with paper.style():
        figure = paper.figure(paper.PAGE, 130, gap=2.0)
        panels = figure.subplots(2, 2)
        _groups(panels[0, 0], table, "delivered")
        panels[0, 0].set_ylabel("items brought home in 1,000 ticks")
        paper.panel_title(panels[0, 0], "a", "What groups of four bring home")
        _groups(panels[0, 1], table, "shared")
        panels[0, 1].set_ylabel("share of items brought home")
        paper.panel_title(panels[0, 1], "b", "Items that more than one robot had")
        _groups(panels[1, 0], table, "division")
        _luck(panels[1, 0], table)
        panels[1, 0].set_ylabel("I / H(tasks)")
        paper.panel_title(panels[1, 0], "c", "Division of labour; dotted: by luck alone")
        _curves(panels[1, 1], curves)
        _legend(figure)
    return figure


def over_attempts(rows: pd.DataFrame, measure: str) -> Interval:
    """Return a measure's mean over attempts and worlds, with its interval over both.

    Worlds in which an attempt brought nothing home, where the measure says nothing, are left out
    of that attempt's mean; the interval is then over attempts alone. NaN where none did.
    """
    square = rows.pivot_table(index="attempt", columns="world", values=measure, dropna=False)
    if square.isna().to_numpy().any():
        means = square.mean(axis=1).dropna()
        return interval_of(means) if len(means) else Interval(np.nan, np.nan, np.nan)
    return crossed_interval(square.to_numpy())


def shown(table: pd.DataFrame, ground: str) -> Iterator[tuple[int, bool, pd.DataFrame]]:
    """Yield the place of each group that is shown, whether it evolved, and its rows."""
    for place, name in enumerate(PROGRAMMED):
        yield place, False, table[(table["group"] == name) & (table["ground"] == ground)]
    for place, start in enumerate(STARTS, len(PROGRAMMED)):
        yield place, True, evolved_there(table, start, ground)


def _groups(axes: Axes, table: pd.DataFrame, measure: str) -> None:
    """Draw a measure of the groups on either ground: every attempt, means, intervals."""
    for side, ground in ((-1, "slope"), (1, "flat")):
        colour, mark = COLOURS[ground], MARKS[ground]
        for place, has_evolved, rows in shown(table, ground):
            known = rows.dropna(subset=[measure])
            if known.empty:
                continue
            if not has_evolved:
                _bar(axes, place + 0.12 * side, interval_of(known[measure]), colour, mark)
                continue
            means = known.groupby("attempt")[measure].mean().to_numpy()
            beside = place + 0.28 * side + np.linspace(-SPREAD, SPREAD, len(means))
            axes.plot(
                beside, means, mark, color=colour, markersize=3, alpha=0.55, mew=0, clip_on=False
            )
            _bar(axes, place + 0.08 * side, over_attempts(rows, measure), colour, mark)
    names = [*PROGRAMMED.values(), *STARTS.values()]
    axes.set_xticks(range(len(names)), names)
    axes.set_xlim(-0.5, len(names) - 0.5)
    if measure == "delivered":
        axes.set_ylim(bottom=0)
    else:
        axes.set_ylim(-0.03, 1.03)


def _bar(axes: Axes, x: float, found: Interval, colour: str, mark: str) -> None:
    if not np.isnan(found.low):
        axes.plot([x, x], [found.low, found.high], color=colour, linewidth=1.2)
    axes.plot(x, found.mean, mark, color=colour, markersize=4.5, mec="white", mew=0.5)


def _luck(axes: Axes, table: pd.DataFrame) -> None:
    for side, ground in ((-1, "slope"), (1, "flat")):
        for place, _, rows in shown(table, ground):
            if rows["by_chance"].notna().any():
                ends = sorted((place + 0.03 * side, place + 0.43 * side))
                chance = [rows["by_chance"].mean()] * 2
                axes.plot(ends, chance, color=paper.INK, linewidth=1.0, linestyle=":")


def _curves(axes: Axes, curves: Mapping[str, pd.DataFrame]) -> None:
    for name, curve in curves.items():
        start, ground = EVOLVED[name]
        if start != PRIMITIVES:
            continue
        for _, rows in curve.groupby("attempt"):
            smooth = rows["mean"].rolling(SMOOTHED, min_periods=1).mean()
            axes.plot(
                rows["episodes"], smooth, color=COLOURS[ground], linewidth=0.7, alpha=0.8,
                linestyle="-" if ground == "slope" else (0, (4, 1.5)),
            )  # fmt: skip
    axes.set_ylim(bottom=0)
    axes.set_xlabel("episodes of 1,000 ticks so far")
    axes.set_ylabel(f"items, mean of {SMOOTHED} generations")
    axes.xaxis.set_major_formatter("{x:,.0f}")
    paper.panel_title(axes, "d", "Every attempt from primitives, while it evolves")


def _legend(figure: Figure) -> None:
    from matplotlib.lines import Line2D

    marks = [
        Line2D([], [], color=COLOURS[ground], marker=MARKS[ground], markersize=4,
               linestyle="-" if ground == "slope" else "--", label=f"on {NAMES[ground]}")
        for ground in GROUNDS
    ]  # fmt: skip
    figure.legend(handles=marks, loc="outside lower center", ncols=2)
