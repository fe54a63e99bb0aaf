"""The figures of a collecting robot: where it went, and what it brought home when.

The tables of a run hold neither obstacles nor every tick, so the run is repeated. Blue is the way
to an object, red the way home with one. The models that build on `collect` draw the same.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.ticker import MaxNLocator

from socialmind.drawing import style as paper
from socialmind.drawing.look import PAPER
from socialmind.drawing.plane import Picture
from socialmind.runs.capsule import Capsule
from socialmind.runs.sources import model_of
from socialmind.worlds.plane.scene import scene_of

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.typing import ColorType
    from numpy.typing import NDArray

    from socialmind.experiments import Run
    from socialmind.worlds.plane.scene import Scene

EVERY = 5  # ticks between two points of the path, in which a robot goes less than its own length
SEARCHES, CARRIES = paper.BLUE, paper.RED
MAP = 90.0  # mm, the width of the map
LEGEND = 15.0  # mm below the map
ZONES = {"drop_zones": "drop zone", "supplies": "power supply"}


@dataclass(frozen=True)
class Course:
    """What the robot did.

    Attributes:
        tick: of each moment, ascending.
        x, y: where the robot was.
        carrying: whether it held an object.
        delivered: objects brought home so far.
        battery: its charge.
        end: the world at the end.
    """

    tick: NDArray[np.int64]
    x: NDArray[np.float64]
    y: NDArray[np.float64]
    carrying: NDArray[np.bool_]
    delivered: NDArray[np.int64]
    battery: NDArray[np.float64]
    end: Scene


def draw(run: Run) -> dict[str, Figure]:
    """Draw every figure of a run.

    Args:
        run: a recorded run of this model, or of one that builds on it.

    Returns:
        The figures `path` and `deliveries` by name.
    """
    course = course_of(run)
    with paper.style():
        return {"path": path(course), "deliveries": deliveries(course)}


def course_of(run: Run) -> Course:
    """Repeat a run, and note what its first robot does.

    Args:
        run: a recorded run.
    """
    model = model_of(Capsule(run.folder))
    robots = model.tables["robots"]
    names = ("x", "y", "carrying", "delivered", "battery")
    rows = [[0, *(robots.columns[name].item(0) for name in names)]]
    while model.tick < run.ticks and model.over is None:
        model.advance(min(EVERY, run.ticks - model.tick))
        rows.append([model.tick, *(robots.columns[name].item(0) for name in names)])
    tick, x, y, carrying, delivered, battery = np.array(rows, float).T
    return Course(
        tick.astype(int), x, y, carrying >= 0, delivered.astype(int), battery, scene_of(model)
    )


def path(course: Course) -> Figure:
    """Draw where the robot went, on the map of its world.

    Args:
        course: what it did.

    Returns:
        A figure of one map.
    """
    high = MAP + LEGEND
    figure = Figure(figsize=(MAP / 25.4, high / 25.4))
    axes = figure.add_axes((0.02, (LEGEND + 0.02 * MAP) / high, 0.96, 0.96 * MAP / high))
    Picture(axes, course.end)
    draw_way(axes, course.x, course.y, course.carrying, SEARCHES, CARRIES)
    marks = [
        Line2D([], [], color=SEARCHES, label="looking for an object"),
        Line2D([], [], color=CARRIES, marker="o", markersize=2.4, label="carrying one home"),
    ]
    for name, colour in zip(course.end.zones, PAPER.zones, strict=False):
        label = ZONES.get(name, name)
        marks.append(
            Line2D([], [], marker="s", linewidth=0, markersize=5, markeredgecolor=colour,
                   markerfacecolor=(colour, 0.3), label=label)
        )  # fmt: skip
    figure.legend(handles=marks, loc="lower center", ncols=2, handlelength=1.4)
    return figure


def draw_way(
    axes: Axes,
    x: NDArray[np.float64],
    y: NDArray[np.float64],
    carrying: NDArray[np.bool_],
    free: ColorType,
    loaded: ColorType,
) -> None:
    """Draw where a robot went, and a dot where it gripped an object.

    Args:
        axes: with the map.
        x: where it was, moment by moment.
        y: likewise.
        carrying: whether it held an object then.
        free: the colour of the way without an object.
        loaded: of the way with one.
    """
    for colour, held in ((free, False), (loaded, True)):
        # A step belongs to what the robot did at its beginning.
        step = np.append(carrying[:-1] == held, False)
        drawn = step | np.insert(step[:-1], 0, False)
        part_x, part_y = (np.where(drawn, one, np.nan) for one in (x, y))
        axes.plot(part_x, part_y, color=colour, linewidth=0.8, zorder=2.5, scalex=False,
                  scaley=False)  # fmt: skip
    gripped = np.flatnonzero(carrying[1:] & ~carrying[:-1]) + 1
    axes.plot(x[gripped], y[gripped], "o", color=loaded, markersize=2.5, zorder=2.6, scalex=False,
              scaley=False)  # fmt: skip


def deliveries(course: Course) -> Figure:
    """Draw objects delivered over time, and the battery where it runs down.

    Args:
        course: what the robot did.

    Returns:
        A figure of one or two panels.
    """
    drains = bool((course.battery < 1.0).any())
    figure = paper.figure(paper.COLUMN, 85 if drains else 50)
    panels = figure.subplots(1 + drains, 1, sharex=True, squeeze=False)[:, 0]
    scale = 1.0
    for axes in panels:
        scale = paper.time_axis(axes, list(course.tick))
    panels[0].step(course.tick / scale, course.delivered, where="post", color=paper.INK)
    panels[0].set_ylim(0, max(1, int(course.delivered[-1])) * 1.06)
    panels[0].yaxis.set_major_locator(MaxNLocator(5, integer=True))
    panels[0].set_ylabel("objects delivered (number)")
    if course.end.over:
        panels[0].set_title(f"ended by: {course.end.over}, at tick {course.end.tick:,}")
    if drains:
        panels[0].set_xlabel("")
        panels[1].plot(course.tick / scale, course.battery, color=paper.BLUE, linewidth=0.8)
        panels[1].set_ylim(0, 1.03)
        panels[1].set_ylabel("battery (0 … 1)")
    return figure
