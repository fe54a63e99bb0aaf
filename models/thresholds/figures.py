"""The figure of the threshold model: each worker's thresholds, and how loud the tasks call."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from socialmind.drawing import style as paper

if TYPE_CHECKING:
    from socialmind.experiments import Run

COLOURS = (
    paper.BLUE,
    paper.RED,
    paper.GOLD,
    paper.PURPLE,
)  # of tasks; they come again from five on
MOST_DRAWN = 4  # tasks whose thresholds are shown
LINES_DRAWN = 100  # workers in a panel


def draw(run: Run) -> dict[str, Figure]:
    """Draw the figure of a run.

    Args:
        run: a recorded run of this model.

    Returns:
        The figure `thresholds`.
    """
    with paper.style():
        return {"thresholds": thresholds(run)}


def thresholds(run: Run) -> Figure:
    """Draw the thresholds of workers for each task over time, and below the stimuli.

    A line has the colour of the task that its worker is a specialist of in the end.

    Args:
        run: a recorded run of this model.

    Returns:
        A figure of a panel for each of the first tasks, and one for the stimuli.
    """
    tasks = int(run.parameters["n_tasks"])
    drawn = min(tasks, MOST_DRAWN)
    figure = paper.figure(paper.COLUMN, 32 * (drawn + 1))
    panels = figure.subplots(drawn + 1, 1, sharex=True)
    scale = paper.time_axis(panels[-1], list(run.series["tick"]))
    for task, axes in enumerate(panels[:-1]):
        _thresholds_of(axes, run.agents, task, scale)
        axes.set_ylabel("threshold")
        paper.panel_title(axes, "abcd"[task], f"Task {task}, each worker")
    for task in range(tasks):
        column = run.series[f"stimulus_{task}"]
        colour = COLOURS[task % len(COLOURS)]
        panels[-1].plot(
            run.series["tick"] / scale, column, color=colour, linewidth=0.8,
            linestyle=paper.DASHES.get(colour, "-"), label=f"task {task}",
        )  # fmt: skip
    panels[-1].set_ylim(bottom=0)
    panels[-1].set_ylabel("stimulus")
    panels[-1].legend(ncols=4, loc="best")
    paper.panel_title(panels[-1], "abcde"[drawn], "What the tasks give off")
    return figure


def _thresholds_of(axes: Axes, agents: pd.DataFrame, task: int, scale: float) -> None:
    highest = 1.0
    for _, rows in list(agents.groupby("agent"))[:LINES_DRAWN]:
        role = rows["role"].iloc[-1]
        colour = paper.GREY if pd.isna(role) else COLOURS[int(role) % len(COLOURS)]
        values = rows[f"threshold_{task}"].astype(float)
        axes.plot(
            rows["tick"] / scale, values, color=colour, linewidth=1.0, alpha=0.8,
            linestyle=paper.DASHES.get(colour, "-"),
        )  # fmt: skip
        highest = max(highest, float(values.max()))
    axes.set_ylim(0, 1.05 * highest)
