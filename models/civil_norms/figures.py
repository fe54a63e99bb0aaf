"""The figures of two civilisations: who lives, eats, obeys and goes over, and a map of the end.

Blue stands for sharers, red for keepers.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from socialmind.drawing import style as paper

if TYPE_CHECKING:
    from socialmind.experiments import Run

COLOURS = {"sharers": paper.BLUE, "keepers": paper.RED}


def draw(run: Run) -> dict[str, Figure]:
    """Draw every figure of a run.

    Args:
        run: a recorded run of this model.

    Returns:
        The figures `outcome` and `region` by name.
    """
    with paper.style():
        return {
            "outcome": outcome(run.series),
            "region": region(run.agents, int(run.parameters.get("world_size", 25))),
        }


def outcome(series: pd.DataFrame) -> Figure:
    """Draw the living, their stores, their obedience and the starved over time.

    Args:
        series: one row a recorded tick.

    Returns:
        A figure of four panels.
    """
    figure = paper.figure(paper.PAGE, 95)
    panels = figure.subplots(2, 2, sharex=True)
    shown = (
        ("Alive", "gatherers", ""),
        ("In store", "food (mean)", "_store"),
        ("How far the norm binds", "obedience (mean)", "_obedience"),
        ("Starved so far", "gatherers", "_starved"),
    )
    for axes, letter, (title, unit, column) in zip(panels.flat, "abcd", shown, strict=True):
        scale = paper.time_axis(axes, list(series["tick"]))
        ends: list[tuple[float, str, str]] = []
        drawn: list[float] = []
        for name, colour in COLOURS.items():
            values = series[f"{name}{column}"].astype(float)
            if column in ("_store", "_obedience"):  # of nobody there is no mean
                values = values.where(series[name] > 0)
            axes.plot(series["tick"] / scale, values, color=colour)
            known = values.dropna()
            drawn += known.tolist()
            if len(known) and known.index[-1] == series.index[-1]:
                ends.append((float(known.iloc[-1]), name, colour))
        axes.set_ylim(*paper.limits_with_zero(drawn or [0.0]))
        axes.set_ylabel(unit)
        paper.panel_title(axes, letter, title)
        paper.label_ends(axes, ends)
        if letter in "ab":
            axes.set_xlabel("")
    return figure


def region(agents: pd.DataFrame, size: int) -> Figure:
    """Draw everybody at the first and the last recorded tick, larger with more in store.

    Args:
        agents: one row an agent and recorded tick.
        size: of the region, in patches.

    Returns:
        A figure of two maps.
    """
    figure = paper.figure(paper.PAGE, 88)
    panels = figure.subplots(1, 2, sharey=True)
    ticks = np.sort(agents["tick"].unique())[[0, -1]] if len(agents) else []
    for axes, tick in zip(panels, ticks, strict=False):
        _map(axes, agents[agents["tick"] == tick], size)
        axes.set_title(f"tick {tick:,}")
    panels[0].set_ylabel("y (patches)")
    marks = [
        panels[0].scatter([], [], s=10, color=colour, label=name)
        for name, colour in COLOURS.items()
    ]
    figure.legend(handles=marks, loc="outside lower center", ncols=2)
    return figure


def _map(axes: Axes, now: pd.DataFrame, size: int) -> None:
    """Draw one tick."""
    low = -(size // 2) - 0.5
    for number, colour in enumerate(COLOURS.values()):
        some = now[now["civilisation"] == number]
        axes.scatter(
            some["x"], some["y"], s=2 + some["store"].clip(0, 60), color=colour, alpha=0.6,
            linewidths=0,
        )  # fmt: skip
    axes.spines[["top", "right"]].set_visible(True)
    axes.set(xlim=(low, low + size), ylim=(low, low + size), aspect="equal")
    axes.set_xlabel("x (patches)")
