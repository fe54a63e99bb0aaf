"""The ways of the trained robot, as figures 7.2 and 7.3 of the thesis show them.

Each object has two panels: the robot on its way to it, when it grips it, and on its way home, when
it lets it go in the drop zone.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.lines import Line2D

from socialmind.catalogue import load_model
from socialmind.drawing import style as paper
from socialmind.drawing.plane import FOOT, Picture, key_of
from socialmind.errors import SocialmindError
from socialmind.experiments.studies import write_figure
from socialmind.worlds.plane.scene import scene_of

if TYPE_CHECKING:
    from matplotlib.figure import Figure
    from numpy.typing import NDArray

    from socialmind.worlds.plane.scene import Scene

SEEDS = range(73, 93)
"""Of the runs that are tried, one after another, until the robot brings all objects home."""
COLOURS = {False: paper.BLUE, True: paper.RED}
"""Of the way, by whether the robot carries an object."""
WIDTH = paper.COLUMN
"""Of the figure, in mm."""
HEAD = 20.0
"""Points above a panel, for its title."""
KEY = 30.0
"""Points below all panels, for the key."""


@dataclass(frozen=True)
class Leg:
    """The way to an object, or home with it.

    Attributes:
        number: of the object: 1 for the first that is brought home.
        carrying: whether it is the way home.
        ticks: from the first to the last, (moments,).
        places: where the robot was, (moments, 2).
        end: the world at its end.
    """

    number: int
    carrying: bool
    ticks: NDArray[np.int64]
    places: NDArray[np.float64]
    end: Scene

    @property
    def length(self) -> float:
        """How far the robot went, in units."""
        return float(np.hypot(*np.diff(self.places, axis=0).T).sum())

    @property
    def straight(self) -> float:
        """How far the end is from the beginning, in units."""
        return math.dist(self.places[0], self.places[-1])


def legs(number: int, seed: int) -> list[Leg]:
    """Return the ways of a run until as many objects are delivered as there are at a time.

    Args:
        number: of objects in the arena.
        seed: of the run.

    Returns:
        Two for each object; fewer where the run ends before.
    """
    model: Any = load_model("target_variable")(seed=seed, number=number)
    robot = model.tables["robots"][0]
    rows = [(0, robot.x, robot.y)]
    found: list[Leg] = []
    begin, grip, gripped, carried = 0, 0, None, None
    held, delivered = False, 0

    def leg(carrying: bool, first: int, last: int, end: Scene) -> Leg:
        part = np.array(rows[first : last + 1])
        return Leg(delivered, carrying, part[:, 0].astype(int), part[:, 1:], end)

    while model.tick < model.ticks and model.over is None and delivered < number:
        if held:
            carried = scene_of(model)
        model.advance(1)
        rows.append((model.tick, robot.x, robot.y))
        if robot.carrying >= 0 and not held:
            # The way with an object that is lost belongs to the way to the one brought home.
            grip, gripped = len(rows) - 1, scene_of(model)
        if robot.delivered > delivered and gripped is not None and carried is not None:
            # As it was just before: an object that is let go in the drop zone is elsewhere at once.
            delivered, last = robot.delivered, len(rows) - 2
            found += [leg(False, begin, grip, gripped), leg(True, grip, last, carried)]
            begin = last
        held = robot.carrying >= 0
    return found


def write_trajectory(name: str, number: int, out: Path) -> list[Path]:
    """Draw the ways of the first run in which the robot brings all objects home.

    Args:
        name: of the study.
        number: of objects in the arena.
        out: the folder.

    Returns:
        The figure as PDF and PNG, and the places as CSV.

    Raises:
        SocialmindError: it does so in no run.
    """
    for seed in SEEDS:
        found = legs(number, seed)
        if len(found) == 2 * number:
            break
    else:
        raise SocialmindError(f"in none of {len(SEEDS)} runs the robot brought {number} home")
    rows = [
        {"seed": seed, "object": leg.number, "carrying": int(leg.carrying), "tick": int(tick),
         "x": round(float(x), 2), "y": round(float(y), 2)}
        for leg in found
        for tick, (x, y) in zip(leg.ticks, leg.places, strict=True)
        if tick % 5 == 0 or tick == leg.ticks[-1]
    ]  # fmt: skip
    with paper.style():
        return write_figure(name, draw(found), rows, out)


def draw(found: list[Leg]) -> Figure:
    """Draw a row for each object: on the left the way to it, on the right the way home.

    Args:
        found: two for each object.
    """
    wide = WIDTH / 25.4 * 72.0
    gap = 5.0
    side = (wide - 3 * gap) / 2
    step = HEAD + side + FOOT + gap
    high = len(found) // 2 * step + gap + KEY
    figure = paper.figure(wide * 25.4 / 72.0, high * 25.4 / 72.0)
    figure.set_layout_engine("none")
    for place, leg in enumerate(found):
        row, column = divmod(place, 2)
        left, top = gap + column * (side + gap), high - gap - row * step - HEAD
        axes = figure.add_axes((left / wide, (top - side) / high, side / wide, side / high))
        Picture(axes, leg.end, sensing=False)
        axes.plot(*leg.places.T, color=COLOURS[leg.carrying], linewidth=1.2, zorder=2.5,
                  scalex=False, scaley=False)  # fmt: skip
        what = f"home with object {leg.number}" if leg.carrying else f"to object {leg.number}"
        axes.set_title(f"{what}: {leg.length:.0f} units\n({leg.straight:.0f} straight)", pad=3)
    ways = [
        Line2D([], [], color=COLOURS[carrying], label=name)
        for carrying, name in ((False, "way to the object"), (True, "way home with it"))
    ]
    figure.legend(handles=[*ways, *key_of(found[0].end)], loc="lower center", ncols=3,
                  columnspacing=1.0, handletextpad=0.4)  # fmt: skip
    return figure
