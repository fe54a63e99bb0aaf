"""The figures of fields and flocks: maps of who is where, and what becomes of it over time.

Gold stands for fields and harvest, blue for sheep, purple for shepherds, red for loss and chase.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Circle, Rectangle

from socialmind.drawing import style as paper

if TYPE_CHECKING:
    from socialmind.experiments import Run

SIZE = 33  # of the world, in patches
PASTURE = 8.0  # its radius, in patches
FIELD = 3  # side of a field, in patches
MAPS = 3


def draw(run: Run) -> dict[str, Figure]:
    """Draw every figure of a run.

    Args:
        run: a recorded run of this model.

    Returns:
        The figures `maps` and `outcome` by name.
    """
    with paper.style():
        return {"maps": maps(run.agents), "outcome": outcome(run.series)}


def maps(agents: pd.DataFrame) -> Figure:
    """Draw everybody at the first recorded tick, in the middle of the run and at its end.

    Args:
        agents: one row an agent and recorded tick.

    Returns:
        A figure of three maps.
    """
    figure = paper.figure(paper.PAGE, 78)
    panels = figure.subplots(1, MAPS, sharey=True)
    ticks = np.sort(agents["tick"].unique())
    low = -(SIZE // 2) - 0.5
    for axes, place in zip(panels, np.linspace(0, len(ticks) - 1, MAPS), strict=True):
        tick = ticks[round(place)]
        _map(axes, agents[agents["tick"] == tick])
        axes.spines[["top", "right"]].set_visible(True)
        axes.set(xlim=(low, low + SIZE), ylim=(low, low + SIZE), aspect="equal")
        axes.set_title(f"tick {tick:,}")
        axes.set_xlabel("x (patches)")
    panels[0].set_ylabel("y (patches)")
    marks = [
        _mark("o", paper.BLUE, "sheep"),
        _mark("o", paper.RED, "sheep, afraid"),
        _mark("s", paper.GOLD, "farmer at work"),
        _mark("s", paper.RED, "farmer, chasing"),
        _mark("D", paper.PURPLE, "shepherd, herding"),
        _mark("D", "white", "shepherd at rest"),
    ]
    figure.legend(handles=marks, loc="outside lower center", ncols=6, handletextpad=0.1)
    return figure


def _mark(marker: str, colour: str, label: str) -> Line2D:
    return Line2D(
        [], [], marker=marker, linewidth=0, markersize=3.5, markerfacecolor=colour,
        markeredgecolor=paper.INK, markeredgewidth=0.4, label=label,
    )  # fmt: skip


def _map(axes: Axes, now: pd.DataFrame) -> None:
    """Draw one tick: pasture, fields, sheep and people."""
    axes.add_patch(Circle((0, 0), PASTURE, facecolor="#e9f0e4", edgecolor="none"))
    farmers, sheep, shepherds = (
        now[now["population"] == name] for name in ("farmers", "sheep", "shepherds")
    )
    fields = farmers[["field_x", "field_y"]].to_numpy(float) - FIELD / 2
    for x, y in fields:
        # A field on the edge of the torus goes on at the other side.
        for over_x in (-SIZE, 0, SIZE):
            for over_y in (-SIZE, 0, SIZE):
                place = (x + over_x, y + over_y)
                axes.add_patch(Rectangle(place, FIELD, FIELD, facecolor="#f3dfae"))
    afraid = sheep["fear"].to_numpy(float) > 0
    chasing = (farmers["plan"] == "Chase").to_numpy(bool)
    herding = (shepherds["plan"] == "Herd").to_numpy(bool)
    for people, marker, colours in (
        (sheep, "o", np.where(afraid, paper.RED, paper.BLUE)),
        (farmers, "s", np.where(chasing, paper.RED, paper.GOLD)),
        (shepherds, "D", np.where(herding, paper.PURPLE, "white")),
    ):
        axes.scatter(
            people["x"].to_numpy(float), people["y"].to_numpy(float), c=list(colours),
            marker=marker, s=10, edgecolors=paper.INK, linewidths=0.4, zorder=3,
        )  # fmt: skip


def outcome(series: pd.DataFrame) -> Figure:
    """Draw strays, people's plans, harvest and food, and loss over time.

    Args:
        series: one row a recorded tick.

    Returns:
        A figure of four panels.
    """
    figure = paper.figure(paper.PAGE, 95)
    panels = figure.subplots(2, 2, sharex=True)
    shown = (
        ("Where the sheep are", "sheep (number, smoothed)", {
            "strays": ("off the pasture", paper.BLUE), "on_fields": ("on fields", paper.GOLD),
        }),
        ("What people do", "people (number, smoothed)", {
            "herding": ("herding", paper.PURPLE), "chasing": ("chasing", paper.RED),
        }),
        ("Harvest, and food of the sheep, so far", "crop, grass (units)", {
            "harvest": ("harvest", paper.GOLD), "food": ("eaten by sheep", paper.BLUE),
        }),
        ("Crop lost to sheep, so far", "crop (units)", {"loss": ("", paper.RED)}),
    )  # fmt: skip
    for axes, letter, (title, unit, columns) in zip(panels.flat, "abcd", shown, strict=True):
        scale = paper.time_axis(axes, list(series["tick"]))
        ends: list[tuple[float, str, str]] = []
        drawn: list[float] = []
        for column, (name, colour) in columns.items():
            values = series[column].astype(float)
            if letter in "ab":  # they jump from tick to tick: the mean of their surroundings
                values = values.rolling(25, center=True, min_periods=1).mean()
            axes.plot(series["tick"] / scale, values, color=colour)
            drawn += values.tolist()
            if name and len(values):
                ends.append((float(values.iloc[-1]), name, colour))
        axes.set_ylim(*paper.limits_with_zero(drawn))
        axes.set_ylabel(unit)
        axes.yaxis.set_major_formatter("{x:,g}" if letter in "ab" else "{x:,.0f}")
        paper.panel_title(axes, letter, title)
        paper.label_ends(axes, ends)
        if letter in "ab":
            axes.set_xlabel("")
    return figure
