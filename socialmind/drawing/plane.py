"""Drawing a plane, in the manner of figure 5.5 of the thesis, moment after moment.

A robot is a circle with a line to its front; the lines around it are its range finders, each as
long as it sees; the long ones lead to the targets of its orientation sensors. The path is blue. Two
rings are around a robot that emits a signal.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from itertools import cycle
from typing import Any

import numpy as np
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.collections import EllipseCollection, LineCollection, PatchCollection
from matplotlib.lines import Line2D
from matplotlib.patches import Circle, Patch, Rectangle
from numpy.typing import NDArray

from socialmind.drawing.look import PAPER, Look
from socialmind.worlds.plane.scene import Scene

Floats = NDArray[np.float64]
Paths = Mapping[tuple[str, int], Floats]
"""Where robots have been, by population and identity: (places, 2), a NaN where a path breaks."""

MARGIN = 0.02
"""Room around what is shown, as a share of its half-width."""
BORDER = 0.015
"""How thick the border is, as a share of the arena's half-width."""
SMALLEST = 2.2
"""Points of the smallest radius that a robot or an object is drawn with."""
RINGS = (1.8, 2.6)
"""The radii of the rings around a robot that emits a signal, over its own."""
CORNERS = 24
"""Corners of a ring."""
BESIDE = 10.0
"""Points from a robot to the middle of its name, and from that to another robot at least."""
FOOT = 13.0
"""Points of room that the line below the Axes needs: the tick, and the scale."""


class Picture:
    """A plane drawn on Axes, which `show` moves on.

    Args:
        ax: square Axes to draw in, with `FOOT` points of room below.
        scene: the first moment.
        look: the colours.
        around: half the side of the part shown around a robot, in units of the plane; the whole
            plane by default. Of a plane without borders, as much as was ever in use.
        robot: its population and identity; the first one by default.
        named: whether this robot's identity stands beside it.
        sensing: whether what robots sense is drawn.

    Attributes:
        ax: the Axes.
    """

    def __init__(
        self,
        ax: Axes,
        scene: Scene,
        look: Look = PAPER,
        around: float | None = None,
        robot: tuple[str, int] | None = None,
        named: bool = False,
        sensing: bool = True,
    ) -> None:
        self.ax = ax
        self.look = look
        self._around = around
        self._robot = robot
        self._view = (math.nan, math.nan, math.nan)
        self._unmoved: list[tuple[Floats, PatchCollection]] = []
        ax.set(xticks=[], yticks=[], aspect="equal", anchor="N")
        ax.spines[:].set(
            visible=around is not None, color=look.ink, linewidth=0.6, zorder=6, alpha=0.7
        )
        ax.set_facecolor(look.page if scene.half_width > 0 else look.ground)
        self._hair = min(max(self._width() / 360.0, 0.45), 1.2)
        self._draw_ground(scene.half_width)
        self._rays = self._lines(look.ray, 0.8, 3.0)
        self._targets = self._lines(look.line, 0.9, 2.8)
        self._targets.set_linestyle(look.line_style)
        self._fronts = self._lines(look.heading, 1.8, 4.5)
        self._fronts.set_capstyle("butt")
        self._rings = self._lines(look.path, 0.9, 3.9)
        self._discs: dict[str, EllipseCollection] = {}
        self._colours = {"robots": cycle(look.robots), "objects": cycle(look.objects)}
        self._trails: dict[tuple[str, int], Line2D] = {}
        self._tick = ax.text(
            0.0, -6.0 / self._width(), "", size=7.5, color=look.ink, va="top",
            transform=ax.transAxes, zorder=7,
        )  # fmt: skip
        self._scale = self._new_scale()
        self._name = ax.annotate(
            "", (0.0, 0.0), xytext=(0.0, BESIDE), textcoords="offset points", size=8, weight="bold",
            color=look.ink, ha="center", va="center", zorder=7, annotation_clip=True,
            bbox={"boxstyle": "round,pad=0.1", "facecolor": look.ground, "linewidth": 0},
        )  # fmt: skip
        self._named = named
        self._sensing = sensing
        self.show(scene)

    @property
    def view(self) -> tuple[float, float, float]:
        """The middle of what is in view, and half its width."""
        return self._view

    def show(self, scene: Scene, paths: Paths | None = None) -> None:
        """Show another moment of the same plane.

        Args:
            scene: the moment.
            paths: where robots have been up to it.
        """
        self._look_at(scene)
        self._draw_unmoved(scene)
        robots = scene.robots
        if self._sensing:
            self._rays.set_segments([ray for one in robots for ray in one.rays])
            self._targets.set_segments([line for one in robots for line in one.lines])
        teams: dict[str, list[tuple[float, float, float]]] = {}
        fronts = []
        for one in robots:
            radius = self._visible(one.radius)
            teams.setdefault(one.team, []).append((one.x, one.y, radius))
            front = one.x + radius * math.cos(one.angle), one.y + radius * math.sin(one.angle)
            fronts.append([(one.x, one.y), front])
        self._fronts.set_segments(fronts)
        self._rings.set_segments(
            [
                _ring(one.x, one.y, times * self._visible(one.radius))
                for one in robots
                if one.emits
                for times in RINGS
            ]
        )
        for name, discs in scene.objects.items():
            self._put("objects", name, discs, 3.5)
        for name, several in teams.items():
            self._put("robots", name, np.array(several), 4.0)
        unit = self._width() / (2.0 * self._view[2])
        thin = min((one.radius for one in robots), default=1.0) * unit
        self._fronts.set_linewidth(min(max(0.3 * thin, 0.7), 2.0))
        for name in self._discs.keys() - scene.objects.keys() - teams.keys():
            self._put("robots", name, np.zeros((0, 3)), 4.0)
        for key, path in (paths or {}).items():
            self._trail(key).set_data(path[:, 0], path[:, 1])
        self._put_name(scene)
        ended = f" · {scene.over}" if scene.over else ""
        self._tick.set_text(f"tick {scene.tick:,}{ended}")

    # What moves -------------------------------------------------------------------------------

    def _lines(self, colour: str, width: float, depth: float) -> LineCollection:
        lines = LineCollection([], colors=colour, linewidths=width * self._hair, zorder=depth)
        lines.set_capstyle("round")
        self.ax.add_collection(lines, autolim=False)
        return lines

    def _put(self, sort: str, name: str, discs: Floats, depth: float) -> None:
        """Draw the robots or objects of a population where they are: x, y and radius of each."""
        if name not in self._discs:
            self._discs[name] = EllipseCollection(
                [], [], [], units="xy", offsets=np.zeros((0, 2)),
                offset_transform=self.ax.transData, facecolors=next(self._colours[sort]),
                edgecolors=self.look.rim, linewidths=0.6 * self._hair, zorder=depth,
            )  # fmt: skip
            self.ax.add_collection(self._discs[name], autolim=False)
        widths = [2 * self._visible(radius) for radius in discs[:, 2].tolist()]
        drawn: Any = self._discs[name]
        # Small ones are not to drown in their rims.
        points = discs[:, 2].max(initial=0.0) * self._width() / (2.0 * self._view[2])
        drawn.set_linewidth(min(0.15 * max(points, SMALLEST), 0.6 * self._hair))
        drawn.set(offsets=discs[:, :2], widths=widths, heights=widths, angles=[0.0] * len(widths))

    def _put_name(self, scene: Scene) -> None:
        """Write the identity of the robot that is looked at beside it, where it is wanted.

        It stands above the robot, or on another side where another robot is in the way.
        """
        team, identity = self._robot or (None, None)
        robot = scene.robot(identity, team) if self._named else None
        self._name.set_text("" if robot is None else str(robot.identity))
        if robot is None:
            return
        self._name.xy = robot.x, robot.y
        unit = self._width() / (2.0 * self._view[2])
        others = [
            (unit * (one.x - robot.x), unit * (one.y - robot.y))
            for one in scene.robots
            if one is not robot
        ]
        sides = [(0.0, BESIDE), (0.0, -BESIDE), (-BESIDE, 0.0), (BESIDE, 0.0)]
        room = [min((math.dist(side, other) for other in others), default=BESIDE) for side in sides]
        # The first side with room enough, or the one with most.
        free = next((at for at, most in enumerate(room) if most >= BESIDE), int(np.argmax(room)))
        self._name.set_position(sides[free])

    def _visible(self, radius: float) -> float:
        """Return a radius that can be seen, in units of the plane."""
        return max(radius, SMALLEST * 2.0 * self._view[2] / self._width())

    def _trail(self, key: tuple[str, int]) -> Line2D:
        if key not in self._trails:
            (line,) = self.ax.plot(
                [], [], color=self.look.path, linewidth=1.2 * self._hair, zorder=2.5,
                scalex=False, scaley=False, solid_joinstyle="round",
            )  # fmt: skip
            self._trails[key] = line
        return self._trails[key]

    # What stands ------------------------------------------------------------------------------

    def _draw_ground(self, half: float) -> None:
        """Draw the arena and its border, which lies outside it."""
        if half > 0:
            for reach, colour in (
                (half * (1 + BORDER), self.look.border),
                (half, self.look.ground),
            ):
                ground = Rectangle((-reach, -reach), 2 * reach, 2 * reach, color=colour, zorder=0)
                ground.set_linewidth(0)
                self.ax.add_patch(ground)

    def _draw_unmoved(self, scene: Scene) -> None:
        """Draw zones and obstacles, anew where they are not as they were."""
        look = self.look
        squares = [*scene.zones.values(), scene.obstacles]
        if len(squares) == len(self._unmoved) and all(
            np.array_equal(one, was) for one, (was, _) in zip(squares, self._unmoved, strict=True)
        ):
            return
        for _, drawn in self._unmoved:
            drawn.remove()
        self._unmoved = []
        styles: list[dict[str, Any]] = [
            {
                "facecolor": (colour, 0.3),
                "edgecolor": colour,
                "linewidth": 1.2 * self._hair,
                "hatch": hatch,
            }
            for colour, hatch, _ in zip(
                cycle(look.zones), cycle(look.zone_hatches), scene.zones, strict=False
            )
        ]
        styles.append({"facecolor": look.obstacle, "edgecolor": look.obstacle_edge,
                       "linewidth": 0.6 * self._hair})  # fmt: skip
        for number, (places, style) in enumerate(zip(squares, styles, strict=True)):
            patches = [_standing(*place) for place in places.tolist()]
            drawn = PatchCollection(patches, zorder=1.0 + number / len(squares), **style)
            self.ax.add_collection(drawn, autolim=False)
            self._unmoved.append((places, drawn))

    # What is seen -----------------------------------------------------------------------------

    def _look_at(self, scene: Scene) -> None:
        """Set the limits of the Axes."""
        x, y, half = self._view
        team, identity = self._robot or (None, None)
        robot = None if self._around is None else scene.robot(identity, team)
        if robot is not None and self._around is not None:
            view = robot.x, robot.y, self._around
        elif self._around is not None and not math.isnan(half):
            view = self._view  # the robot is no more
        elif scene.half_width > 0:
            view = 0.0, 0.0, scene.half_width * (1 + MARGIN)
        else:
            view = self._in_use(scene)
        if view == self._view:
            return
        self._view = x, y, half = view
        self.ax.set(xlim=(x - half, x + half), ylim=(y - half, y + half))
        bar, text = self._scale
        length = _round_length(half / 3)
        share = length / (2 * half)
        bar.set_xdata([1.0 - share, 1.0])
        text.set(
            text=f"{length:g} {'unit' if length == 1 else 'units'}",
            x=1.0 - share - 3.0 / self._width(),
        )

    def _in_use(self, scene: Scene) -> tuple[float, float, float]:
        """Return the middle and half-width of what holds all bodies, and what was shown before."""
        discs = [*scene.objects.values(), *([[one.x, one.y, one.radius]] for one in scene.robots)]
        wide = [places[:, [0, 1, -1]] for places in scene.zones.values()]
        wide.append(scene.obstacles[:, [0, 1, 3]])
        corners = [places * (1, 1, math.sqrt(2)) for places in wide]
        all_of_them = np.concatenate([np.zeros((0, 3)), *discs, *corners])
        if not len(all_of_them):
            return 0.0, 0.0, 10.0
        place, size = all_of_them[:, :2], all_of_them[:, 2:]
        low, high = (place - size).min(axis=0), (place + size).max(axis=0)
        x, y, half = self._view
        if not math.isnan(half):
            if np.all(low >= (x - half, y - half)) and np.all(high <= (x + half, y + half)):
                return self._view
            low, high = (
                np.minimum(low, (x - half, y - half)),
                np.maximum(high, (x + half, y + half)),
            )
        middle = (low + high) / 2
        # Some room, so that the view need not change soon again.
        return float(middle[0]), float(middle[1]), float((high - low).max() / 2 * 1.25)

    def _new_scale(self) -> tuple[Line2D, Any]:
        ax, ink, width = self.ax, self.look.ink, self._width()
        bar = Line2D([0, 1], [-9.0 / width] * 2, color=ink, linewidth=1.2, transform=ax.transAxes)
        bar.set(clip_on=False, solid_capstyle="butt")
        ax.add_artist(bar)
        text = ax.text(
            1.0, -9.0 / width, "", size=7, color=ink, ha="right", va="center",
            transform=ax.transAxes,
        )  # fmt: skip
        return bar, text

    def _width(self) -> float:
        """Return the width of the Axes in points."""
        root: Any = self.ax.figure.canvas.figure
        return float(self.ax.get_window_extent().width) * 72.0 / root.dpi


def key_of(
    scene: Scene,
    look: Look = PAPER,
    robots: bool = True,
    view: tuple[float, float, float] | None = None,
) -> list[Artist]:
    """Return marks for a legend: what the discs and squares of a scene are.

    Args:
        scene: what is drawn.
        look: in which colours.
        robots: whether robots are told of, where nobody else does.
        view: the middle of what is in view, and half its width; what is outside it is left out.
    """
    dot: dict[str, Any] = {"linestyle": "none", "marker": "o", "markersize": 4.5}
    square = {**dot, "marker": "s", "markersize": 5.5}
    teams: dict[str, list[list[float]]] = {}
    for one in scene.robots if robots else ():
        teams.setdefault(one.team, []).append([one.x, one.y, one.radius])
    marks: list[Artist] = [
        Line2D([], [], label=_said(name), color=colour, markeredgecolor=look.rim,
               markeredgewidth=0.5, **dot)
        for groups, colours in ((teams, look.robots), (scene.objects, look.objects))
        for (name, discs), colour in zip(groups.items(), cycle(colours), strict=False)
        if _in_view(np.asarray(discs), 2, view)
    ]  # fmt: skip
    marks += [
        Patch(label=_said(name), facecolor=(colour, 0.3), edgecolor=colour, hatch=hatch)
        for (name, squares), colour, hatch in zip(
            scene.zones.items(), cycle(look.zones), cycle(look.zone_hatches), strict=False
        )
        if _in_view(squares, 3, view)
    ]
    if len(scene.obstacles) and _in_view(scene.obstacles, 3, view):
        marks.append(
            Line2D([], [], label="obstacles", color=look.obstacle,
                   markeredgecolor=look.obstacle_edge, **square)
        )  # fmt: skip
    return marks


def sensed_key(scenes: Sequence[Scene], look: Look = PAPER) -> list[Line2D]:
    """Return marks for a legend: what the lines and rings around robots are.

    Args:
        scenes: what is drawn; of what none of them has nothing is told.
        look: in which colours.
    """
    robots = [one for scene in scenes for one in scene.robots]
    ring: dict[str, Any] = {"marker": "o", "markersize": 5.5, "markerfacecolor": "none"}
    marks = []
    if any(len(one.rays) for one in robots):
        marks.append(Line2D([], [], color=look.ray, linewidth=0.8, label="range finders"))
    if any(len(one.lines) for one in robots):
        line = Line2D([], [], color=look.line, linewidth=0.9, label="sensed targets")
        line.set_linestyle(look.line_style)
        marks.append(line)
    if any(one.emits for one in robots):
        marks.append(Line2D([], [], color=look.path, linestyle="none", label="emits a signal",
                            **ring))  # fmt: skip
    return marks


def _in_view(places: Floats, size: int, view: tuple[float, float, float] | None) -> bool:
    """Say whether any of some bodies, whose half-widths stand in column `size`, is in view.

    Without a view all are, also where there are none yet.
    """
    if view is None:
        return True
    if not len(places):
        return False
    x, y, half = view
    away = np.abs(places[:, :2] - (x, y)).max(axis=1)
    return bool((away < half + places[:, size]).any())


def _said(name: str) -> str:
    """Return a population's name as one says it.

    >>> _said("drop_zones"), _said("a_objects")
    ('drop zones', 'a objects')
    """
    return name.replace("_", " ")


def _standing(
    x: float, y: float, angle: float, half_width: float, is_round: float = 0.0
) -> Circle | Rectangle:
    """Return a square or a cylinder as a patch."""
    if is_round:
        return Circle((x, y), half_width)
    corner, side = (x - half_width, y - half_width), 2 * half_width
    return Rectangle(corner, side, side, angle=math.degrees(angle), rotation_point="center")


def _ring(x: float, y: float, radius: float) -> Floats:
    """Return a circle as a line of many corners."""
    round_about = np.linspace(0.0, math.tau, CORNERS + 1)
    return np.stack([x + radius * np.cos(round_about), y + radius * np.sin(round_about)], axis=1)


def _round_length(most: float) -> float:
    """Return the largest of 1, 2, 5, 10, 20 … and 0.5, 0.2 … that is at most so long.

    >>> _round_length(24.0), _round_length(0.7)
    (20.0, 0.5)
    """
    ten = 10.0 ** math.floor(math.log10(most))
    return max(step * ten for step in (1.0, 2.0, 5.0) if step * ten <= most * (1 + 1e-9))
