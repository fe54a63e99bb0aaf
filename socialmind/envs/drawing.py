"""Pictures of a running model on a plane, as pixels."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from numpy.typing import NDArray

from socialmind.drawing import style as paper
from socialmind.drawing.look import LOOKS
from socialmind.drawing.plane import FOOT, Picture
from socialmind.worlds.plane.scene import scene_of

if TYPE_CHECKING:
    from socialmind.model import Model

SIDE = 480
"""Pixels of the arena's side."""
DOTS = 120
"""Dots an inch."""
GAP = 6.0
"""Points around the arena."""


class Drawing:
    """The picture of a world, with the paths of its robots.

    Args:
        robots: the populations whose paths are drawn.
    """

    def __init__(self, robots: Sequence[str]) -> None:
        self._robots = tuple(robots)
        self._paths: dict[tuple[str, int], list[tuple[float, float]]] = {}
        self._picture: Picture | None = None
        self._canvas: Any = None

    def __getstate__(self) -> dict[str, Any]:
        """A copy has the paths, and begins a picture of its own."""
        return {**vars(self), "_picture": None, "_canvas": None}

    def note(self, model: Model) -> None:
        """Note where the robots are."""
        for name in self._robots:
            table = model.tables[name]
            for row in table.rows[table.slots]:
                place = float(row["x"]), float(row["y"])
                self._paths.setdefault((name, int(row["_id"])), []).append(place)

    def pixels(self, model: Model) -> NDArray[np.uint8]:
        """Return the moment that the model is at, (height, width, 3)."""
        scene = scene_of(model)
        with paper.style():
            if self._picture is None:
                self._picture = self._begun(scene)
            paths = {robot: np.array(path) for robot, path in self._paths.items()}
            self._picture.show(scene, paths)
            self._canvas.draw()
        return np.asarray(self._canvas.buffer_rgba())[..., :3].copy()

    def _begun(self, scene: Any) -> Picture:
        look = LOOKS["thesis"]
        side = SIDE / DOTS * 72
        width, height = side + 2 * GAP, side + 2 * GAP + FOOT
        figure = Figure(figsize=(width / 72, height / 72), dpi=DOTS, facecolor=look.page)
        self._canvas = FigureCanvasAgg(figure)
        place = (GAP / width, (GAP + FOOT) / height, side / width, side / height)
        axes = figure.add_axes(place)
        return Picture(axes, scene, look)
