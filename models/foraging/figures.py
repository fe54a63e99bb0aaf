"""The figures of foraging robots: where they went, and what they brought home and saw when.

The tables of a run hold neither obstacles nor every tick, so the run is repeated. Each robot has a
colour; its way is dark while it carries something, and a dot stands where it gripped an object.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.ticker import MaxNLocator

from socialmind.catalogue import load_file, model_folder
from socialmind.drawing import style as paper
from socialmind.drawing.look import PAPER
from socialmind.drawing.plane import Picture
from socialmind.runs.capsule import Capsule
from socialmind.runs.sources import model_of
from socialmind.worlds.plane.scene import scene_of

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from socialmind.experiments import Run
    from socialmind.worlds.plane.scene import Scene

COLLECT = load_file(model_folder("collect") / "figures.py")
EVERY = 10  # ticks between two points of a path
MAP, LEGEND = 120.0, 15.0  # mm: the width of the map, and what is below it
FAINT = 0.45  # of the paths of robots that carry nothing
SHOWN = 6  # robots that a legend names at most


@dataclass(frozen=True)
class Course:
    """What the robots did; (moments,) or (moments, robots).

    Attributes:
        tick: of each moment, ascending.
        x, y: where the robots were.
        carrying: which of them held an object.
        signalling: which of them emitted a signal.
        delivered: objects that each has brought home so far.
        covered: squares of the map that some robot has seen so far.
        squares: of the map.
        end: the world at the end.
    """

    tick: NDArray[np.int64]
    x: NDArray[np.float64]
    y: NDArray[np.float64]
    carrying: NDArray[np.bool_]
    signalling: NDArray[np.bool_]
    delivered: NDArray[np.int64]
    covered: NDArray[np.int64]
    squares: int
    end: Scene


def draw(run: Run) -> dict[str, Figure]:
    """Draw every figure of a run.

    Args:
        run: a recorded run of this model.

    Returns:
        The figures `paths` and `progress` by name.
    """
    course = course_of(run)
    with paper.style():
        return {"paths": paths(course), "progress": progress(course)}


def course_of(run: Run) -> Course:
    """Repeat a run, and note what its robots do.

    Args:
        run: a recorded run.
    """
    model = model_of(Capsule(run.folder))
    robots, chart = model.tables["robots"], model.tables["charts"]
    ticks, rows, covered = [], [], []
    while True:
        columns = robots.columns
        ticks.append(model.tick)
        covered.append(int(model.covered))
        rows.append(
            [
                columns["x"].copy(),
                columns["y"].copy(),
                columns["carrying"] >= 0,
                columns["signal"].max(axis=1) > 0.5,
                columns["delivered"].copy(),
            ]
        )
        if model.tick >= run.ticks or model.over is not None:
            break
        model.advance(min(EVERY, run.ticks - model.tick))
    x, y, carrying, signalling, delivered = (np.array(one) for one in zip(*rows, strict=True))
    return Course(
        tick=np.array(ticks),
        x=x,
        y=y,
        carrying=carrying,
        signalling=signalling,
        delivered=delivered,
        covered=np.array(covered),
        squares=chart.columns["seen"].shape[1],
        end=scene_of(model),
    )


def colours(robots: int) -> list[str]:
    """Return a colour for each robot."""
    known = (paper.BLUE, paper.RED, paper.PURPLE, paper.GOLD)
    return [known[number % len(known)] for number in range(robots)]


def paths(course: Course) -> Figure:
    """Draw where the robots went, on the map of their world.

    Args:
        course: what they did.

    Returns:
        A figure of one map.
    """
    high = MAP + LEGEND
    figure = Figure(figsize=(MAP / 25.4, high / 25.4))
    axes = figure.add_axes((0.02, (LEGEND + 0.02 * MAP) / high, 0.96, 0.96 * MAP / high))
    Picture(axes, course.end)
    for number, colour in enumerate(colours(course.x.shape[1])):
        COLLECT.draw_way(
            axes, course.x[:, number], course.y[:, number], course.carrying[:, number],
            (colour, FAINT), colour,
        )  # fmt: skip
    robots = course.x.shape[1]
    marks = [
        Line2D([], [], color=colour, label=f"robot {number}")
        for number, colour in enumerate(colours(robots)[:SHOWN])
    ]
    marks.append(Line2D([], [], color=paper.INK, marker="o", linewidth=0, markersize=3,
                        label="an object gripped"))  # fmt: skip
    for name, colour in zip(course.end.zones, PAPER.zones, strict=False):
        marks.append(
            Line2D([], [], marker="s", linewidth=0, markersize=5, markeredgecolor=colour,
                   markerfacecolor=(colour, 0.3), label=name.replace("_", " ").rstrip("s"))
        )  # fmt: skip
    figure.legend(handles=marks, loc="lower center", ncols=3, handlelength=1.4)
    return figure


def progress(course: Course) -> Figure:
    """Draw objects delivered, the area seen, and who signals, over time.

    Args:
        course: what the robots did.

    Returns:
        A figure of three panels.
    """
    figure = paper.figure(paper.COLUMN, 105)
    objects, area, signals = figure.subplots(3, 1, sharex=True)
    scale = 1.0
    for axes in (objects, area, signals):
        scale = paper.time_axis(axes, list(course.tick))
    time = course.tick / scale
    whole = course.delivered.sum(axis=1)
    objects.step(time, whole, where="post", color=paper.INK)
    objects.set_ylim(0, max(1, int(whole[-1])) * 1.06)
    objects.yaxis.set_major_locator(MaxNLocator(5, integer=True))
    objects.set_ylabel("objects (number)")
    area.plot(time, 100 * course.covered / course.squares, color=paper.INK)
    area.set_ylim(0, 103)
    area.set_ylabel("area seen (%)")
    robots = course.x.shape[1]
    for number, colour in enumerate(colours(robots)):
        on = np.where(course.signalling[:, number], number, np.nan)
        signals.plot(time, on, color=colour, linewidth=3, solid_capstyle="butt")
    signals.set_ylim(-0.6, robots - 0.4)
    signals.set_yticks(range(min(robots, SHOWN)))
    signals.set_ylabel("signal of robot")
    for axes in (objects, area):
        axes.set_xlabel("")
    return figure
