"""The page on which moments of a run are drawn: the plane, and a robot's hierarchy beside it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Rectangle

from socialmind.drawing.look import LOOKS
from socialmind.drawing.plane import FOOT, Picture, key_of, sensed_key
from socialmind.drawing.style import COLUMN, PAGE, write_figure
from socialmind.experiments.pictures.film import Frame
from socialmind.experiments.pictures.repeating import Name, Repeated
from socialmind.mind.views.drawing import HierarchyPicture, influence_key
from socialmind.mind.views.plan import planned
from socialmind.worlds.plane.scene import Scene

PIXELS = {".mp4": 720, ".gif": 480}
"""Width of a film, by default; with a hierarchy beside it twice that."""
DOTS = {".mp4": 144, ".gif": 120, ".png": 300}
"""Dots an inch, which say how large type and lines are for the width in pixels."""
MOTION = tuple(PIXELS)
GAP = 5.0
"""Points between panels, and around them."""
CAPTION = 11.0
"""Points of room above a moment for what is said of it."""
MARK, KEY_LINE = 78.0, 11.0
"""Points that a mark of the key takes along a line, and that a line of the key takes."""
HIGHEST = 234.0
"""Of a page of several moments without a width of its own, in mm."""
SLENDEREST, WIDEST = 0.6, 1.7
"""Width of a hierarchy's panel over that of the plane's."""


@dataclass(frozen=True)
class Style:
    """How a run is drawn.

    Attributes:
        look: "thesis", on black, or "paper", on white; by default films have the first, pictures
            the other.
        mind: whether the hierarchy of a robot stands beside the plane.
        robot: whose that is, and whom `around` is about; the first robot by default.
        around: half the side of the part shown around the robot; the whole plane by default.
        trail: how many ticks of the path are drawn; all by default.
        width: of the page: pixels, but millimetres for SVG and PDF.
        inputs: whether sensors, and variables that are only read, stand in the hierarchy; without
            them its type is larger.
        plane_first: whether the plane stands at the left of the hierarchy, as in figures 7.5 and
            8.3 of the thesis, in place of its right, as in figure 6.6.
        rows: moments that a page is to have room for, which says how high each is at most; as many
            as are on it by default.
    """

    look: str | None = None
    mind: bool = False
    robot: Name | None = None
    around: float | None = None
    trail: int | None = None
    width: int | None = None
    inputs: bool = True
    plane_first: bool = False
    rows: int | None = None


class Page:
    """A page with a row for each moment.

    Args:
        repeated: the run, at the first moment.
        style: how it is drawn.
        suffix: how the file ends, such as ".pdf".
        rows: how many moments.
        captions: what is said of each moment; nothing by default.
    """

    def __init__(
        self,
        repeated: Repeated,
        style: Style,
        suffix: str,
        rows: int = 1,
        captions: Sequence[str] = (),
    ) -> None:
        self._repeated = repeated
        self._style = style
        self._rows = rows
        self._captions = captions
        self._head = CAPTION if captions else 0.0
        self._look = LOOKS[style.look or ("thesis" if suffix in MOTION else "paper")]
        self._dots = DOTS.get(suffix, 72)
        width = self._points(suffix)
        self._film = suffix in MOTION
        self._ratio = 0.0
        self._reads_variables = False
        if repeated.mind is not None:
            plan = planned(repeated.mind, key=self._film, known=True, inputs=style.inputs)
            self._ratio = min(max(plan.width / plan.height, SLENDEREST), WIDEST)
            self._reads_variables = any(name.startswith("VA:") for name, _ in plan.readings)
        gaps = (3 if self._ratio else 2) * GAP
        # The hierarchy's panel is as high as the plane's with the line below it.
        self._side = (width - gaps - self._ratio * FOOT) / (1.0 + self._ratio)
        around = self._head + FOOT + GAP
        self._columns = max(2, int(width / MARK))
        self._foot = 0.0 if self._film else self._key_height()
        if style.width is None and not self._film:
            highest = (HIGHEST / 25.4 * 72 - self._foot - GAP) / (style.rows or rows) - around
            if self._side > highest:
                self._side = highest
                width = self._side + self._ratio * (self._side + FOOT) + gaps
                self._columns = max(2, int(width / MARK))
        self._step = self._side + around
        height = rows * self._step + GAP + self._foot
        if self._film:
            # Films have even numbers of pixels.
            width, height = (2 * round(one * self._dots / 144) * 72 / self._dots
                             for one in (width, height))  # fmt: skip
        self._size = width, height
        self.figure = Figure(
            figsize=(width / 72, height / 72), dpi=self._dots, facecolor=self._look.page
        )
        self._canvas = FigureCanvasAgg(self.figure)
        self._pictures: list[tuple[Picture, HierarchyPicture | None]] = []
        self._scenes: list[Scene] = []

    def _points(self, suffix: str) -> float:
        """Return the width of the page in points."""
        width, several = self._style.width, 2 if self._repeated.mind is not None else 1
        if suffix in MOTION:
            return (width or several * PIXELS[suffix]) * 72 / DOTS[suffix]
        if suffix in DOTS and width is not None:
            return width * 72 / DOTS[suffix]
        return (width or (PAGE if several > 1 else COLUMN)) / 25.4 * 72

    def draw(self) -> None:
        """Draw the moment that the run is at in the next row."""
        row, repeated, style = len(self._pictures), self._repeated, self._style
        top = self._size[1] - GAP - row * self._step
        if self._captions:
            across, down = self._size
            self.figure.text(GAP / across, top / down, self._captions[row], size=7.5, va="top",
                             color=self._look.ink)  # fmt: skip
            top -= self._head
        wide = self._ratio * (self._side + FOOT)
        beside = None
        if repeated.mind is not None:
            left = GAP + (self._side + GAP if style.plane_first else 0.0)
            high = self._side + FOOT
            ground = Rectangle((0, 0), 1, 1, facecolor="white", edgecolor="none", zorder=-1)
            panel = self._panel(left, top - high, wide, high)
            ground.set(transform=panel.transAxes, figure=self.figure)
            self.figure.patches.append(ground)
            beside = HierarchyPicture(
                repeated.mind, panel, key=self._film, known=True, inputs=style.inputs
            )
        left = GAP if beside is None or style.plane_first else GAP + wide + GAP
        panel = self._panel(left, top - self._side, self._side, self._side)
        picture = Picture(
            panel, repeated.scene, self._look, style.around, repeated.robot,
            named=beside is not None and len(repeated.scene.robots) > 1,
        )  # fmt: skip
        picture.show(repeated.scene, repeated.paths(style.trail))
        self._pictures.append((picture, beside))
        self._scenes.append(repeated.scene)

    def redraw(self) -> Frame:
        """Show the moment that the run is at in the first row, and return the page's pixels."""
        picture, beside = self._pictures[0]
        picture.show(self._repeated.scene, self._repeated.paths(self._style.trail))
        if beside is not None and self._repeated.mind is not None:
            beside.show(self._repeated.mind)
        self._canvas.draw()
        return np.asarray(self._canvas.buffer_rgba())

    def save(self, path: Path) -> None:
        """Write the page, with a key of its marks below the moments."""
        if not self._film:
            self._draw_key()
        # Without its date a file of the same run is the same file.
        metadata = {".pdf": {"CreationDate": None}, ".svg": {"Date": None}}
        write_figure(
            self.figure, path, dpi=self._dots, metadata=metadata.get(path.suffix.lower()),
            facecolor=self._look.page,
        )  # fmt: skip

    def _key_height(self) -> float:
        """Return the points of room that the key takes at most."""
        scene = self._repeated.scene
        # What robots sense and emit may begin later, and there is the path.
        most = len(key_of(scene, self._look)) + 4
        lines = -(-most // self._columns) + (self._repeated.mind is not None)
        return lines * KEY_LINE + GAP

    def _draw_key(self) -> None:
        """Say below the moments what their marks, and the hierarchy's colours, are."""
        path = Line2D([], [], color=self._look.path, linewidth=1.2, label="path")
        in_view = {
            mark.get_label()
            for (picture, _), scene in zip(self._pictures, self._scenes, strict=True)
            for mark in key_of(scene, self._look, view=picture.view)
        }
        marks = [one for one in key_of(self._scenes[0], self._look) if one.get_label() in in_view]
        marks += [path, *sensed_key(self._scenes, self._look)]
        several: list[Sequence[Artist]] = [marks]
        if self._repeated.mind is not None:
            several.insert(0, influence_key(self._reads_variables))
        across, down = self._size
        for row, handles in enumerate(several):
            self.figure.legend(
                handles=handles, ncols=self._columns, loc="upper left",
                borderpad=0.0, borderaxespad=0.0,
                bbox_to_anchor=(GAP / across, (self._foot - row * KEY_LINE) / down),
                columnspacing=1.2, handletextpad=0.5, handlelength=1.6, labelspacing=0.3,
                labelcolor=self._look.ink,
            )  # fmt: skip

    def _panel(self, left: float, bottom: float, width: float, height: float) -> Axes:
        across, down = self._size
        return self.figure.add_axes((left / across, bottom / down, width / across, height / down))
