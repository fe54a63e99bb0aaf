"""The figures of robots that find their roles, after figures 8.6 and 8.7 of the thesis.

Gold stands for A, purple for B. The tables of a run hold neither obstacles nor objects, so for the
pictures of the arena the run is repeated.
"""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np
from matplotlib.colors import LinearSegmentedColormap
from matplotlib.lines import Line2D
from matplotlib.ticker import MaxNLocator

from socialmind.drawing import style as paper
from socialmind.drawing.plane import Picture, key_of
from socialmind.runs.capsule import Capsule
from socialmind.runs.sources import model_of
from socialmind.worlds.plane.scene import scene_of

if TYPE_CHECKING:
    import pandas as pd
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from socialmind import Model
    from socialmind.experiments import Run

A, B = paper.GOLD, paper.PURPLE
ROLES = LinearSegmentedColormap.from_list("A to B", (A, "#f2ead9", "#e4dcec", B))
UNDECIDED = "#ebe3e2"
MOMENTS = 8  # pictures of the arena, as many as the thesis has steps
ON_TIME = 1.1  # how far the pictures go beyond the last change of roles
SHORT = 4000  # ticks that they cover at least


def draw(run: Run) -> dict[str, Figure]:
    """Draw every figure of a run.

    Args:
        run: a recorded run of this model, or of one that builds on it.

    Returns:
        The figures `roles` and `steps` by name.
    """
    with paper.style():
        return {"roles": roles(run.series, run.agents), "steps": steps(run)}


def roles(series: pd.DataFrame, agents: pd.DataFrame) -> Figure:
    """Draw each robot's role, the split of roles and what it led to, over time.

    Args:
        series: one row a recorded tick.
        agents: one row a robot and recorded tick.

    Returns:
        A figure of three panels.
    """
    figure = paper.figure(paper.COLUMN, 120)
    each, split, counts = figure.subplots(3, 1, sharex=True, height_ratios=(4, 4, 3))
    ticks = series["tick"].to_numpy()
    scales = [paper.time_axis(axes, ticks.tolist()) for axes in (each, split, counts)]
    time = ticks / scales[0]
    _roles_of_each(each, agents, scales[0])
    split.step(time, series["wanted_in_b"], where="post", color=paper.INK, linestyle="--")
    split.fill_between(
        time, series["wanted_in_b"] - 1, series["wanted_in_b"] + 1, step="post",
        color=paper.GREY, alpha=0.25, linewidth=0,
    )  # fmt: skip
    split.step(time, series["in_b"], where="post", color=B)
    split.set_ylim(0, 1.04 * max(1, int(series["robots"].max())))
    split.set_ylabel("robots (number)")
    share = series["count_b"] / (series["count_a"] + series["count_b"])
    counts.plot(time, share, color=B, linewidth=0.8)
    wanted = series["wanted_in_b"] / series["robots"]
    counts.step(time, wanted, where="post", color=paper.INK, linestyle="--")
    counts.set_ylim(0, 1)
    counts.set_ylabel("share of B (0 … 1)")
    for axes in (each, split):
        axes.set_xlabel("")
    for axes in (each, split):
        axes.yaxis.set_major_locator(MaxNLocator(5, integer=True))
    for axes, letter, title in (
        (each, "a", "ROLE of each robot"),
        (split, "b", "Robots in B; dashed: wanted, ± 1"),
        (counts, "c", "B among the objects counted; dashed: wanted"),
    ):
        paper.panel_title(axes, letter, title)
    return figure


def _roles_of_each(axes: Axes, agents: pd.DataFrame, scale: float) -> None:
    """Draw a line for each robot, its colour that of the role."""
    table = agents.pivot(index="agent", columns="tick", values="role").sort_index()
    ticks = table.columns.to_numpy(float)
    step = ticks[-1] - ticks[-2] if len(ticks) > 1 else 1.0
    edges = np.append(ticks, ticks[-1] + step) / scale
    rows = np.arange(len(table) + 1) + 0.5
    shown = np.ma.masked_invalid(table.to_numpy(float))
    mesh = axes.pcolormesh(edges, rows, shown, cmap=ROLES, vmin=0, vmax=1, rasterized=True)
    bar = axes.figure.colorbar(mesh, ax=axes, location="top", fraction=0.06, pad=0.02, aspect=40)
    bar.set_ticks([0, 0.5, 1], labels=["0: A", "between", "1: B"])
    bar.outline.set_visible(False)
    axes.set_ylim(rows[0], rows[-1])
    axes.set_ylabel("robot")


def steps(run: Run) -> Figure:
    """Draw the arena at moments from the start until the roles have settled.

    Args:
        run: a recorded run.

    Returns:
        A figure of eight pictures, or fewer of a shorter run.
    """
    changes = run.series.loc[run.series["changes"].diff() > 0, "tick"]
    last = max(SHORT, int(ON_TIME * changes.max()) if len(changes) else 0)
    moments = np.unique(np.linspace(0, min(last, run.ticks), MOMENTS).astype(int))
    figure = paper.figure(paper.PAGE, 112)
    panels = figure.subplots(2, MOMENTS // 2, squeeze=False).flat
    model = model_of(Capsule(run.folder))
    for letter, tick, axes in zip("abcdefgh", moments.tolist(), panels, strict=False):
        model.advance(tick - model.tick)
        scene = scene_of(model)
        Picture(axes, replace(scene, robots=()), sensing=False)  # triangles stand for them
        paper.panel_title(axes, letter, _colour_by_role(axes, model))
    for axes in list(panels):
        axes.set_visible(False)
    marks = [
        Line2D([], [], marker="^", linewidth=0, color=colour, markersize=4.6,
               markeredgecolor=paper.INK, markeredgewidth=0.7, label=f"robots: {name}")
        for name, colour in (("A", A), ("undecided", UNDECIDED), ("B", B))
    ]  # fmt: skip
    marks += key_of(scene, robots=False)
    figure.legend(handles=marks, loc="outside lower center", ncols=len(marks))
    return figure


def _colour_by_role(axes: Axes, model: Model) -> str:
    """Draw the robots as triangles in the colours of their roles, and larger than they are.

    Returns:
        How many have which role.
    """
    robots = list(model.robots)
    ways = {
        "A": (A, [one for one in robots if one.role < 0.5]),
        "B": (B, [one for one in robots if one.role > 0.5]),
        "undecided": (UNDECIDED, [one for one in robots if one.role == 0.5]),
    }
    for colour, own in ways.values():
        axes.plot([one.x for one in own], [one.y for one in own], "^", color=colour, markersize=4.6,
                  mec=paper.INK, mew=0.7, zorder=5.1, scalex=False, scaley=False)  # fmt: skip
    said = [f"{len(own)} {name}" for name, (_, own) in ways.items() if own or name != "undecided"]
    return ", ".join(said)
