"""Colours of pictures of a plane: the thesis's dark viewer, and light ones for papers."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from socialmind.drawing.style import BLUE, GOLD, GREY, INK, PURPLE, RED


@dataclass(frozen=True)
class Look:
    """The colours of a picture.

    Populations take the colours of a tuple in turn.

    Attributes:
        page: around the arena.
        ground: of the arena.
        ink: of writing, and of the scale.
        border: of the arena.
        robots, objects, zones: for each population.
        rim: around robots and objects.
        heading: the line from a robot's centre to its front.
        obstacle: of obstacles; `obstacle_edge` around them.
        ray: what range finders see.
        line: from a robot to the target of an orientation sensor; `line_style` its dashes.
        path: where robots have been.
        zone_hatches: of zones, by which they are told apart in print without colours.
    """

    page: str
    ground: str
    ink: str
    border: str
    robots: tuple[str, ...]
    objects: tuple[str, ...]
    zones: tuple[str, ...]
    rim: str
    heading: str
    obstacle: str
    obstacle_edge: str
    ray: str
    line: str
    path: str
    line_style: Any = "-"
    zone_hatches: tuple[str | None, ...] = (None,)


THESIS = Look(
    page="#101214",
    ground="#000000",
    ink="#d8d8d8",
    border="#1fa53a",
    robots=("#f0281e", "#ff9d2e", "#e36ae0"),
    objects=("#ffd83d", "#c7a0ff", "#7fe3d8"),
    zones=("#b8b8b8", "#ffd83d", "#7fe3d8"),
    rim="#000000",
    heading="#ffffff",
    obstacle="#1fa53a",
    obstacle_edge="#0f6b22",
    ray="#ffffff",
    line="#e6e6e6",
    path="#4a8df8",
)
"""As in figures 5.5 and 5.8 of the thesis."""

PAPER = Look(
    page="#ffffff",
    ground="#ffffff",
    ink=INK,
    border=INK,
    robots=(RED, INK, GREY),
    objects=(GOLD, PURPLE, "#7fb7d6"),
    zones=("#4f9ac6", "#c25a8e", GREY),
    rim=INK,
    heading="#ffffff",
    obstacle="#c4c8cc",
    obstacle_edge="#84898e",
    ray="#a8a8a8",
    line="#8a8a8a",
    path=BLUE,
    line_style=(0, (4, 3)),
    zone_hatches=(None, "//////", "......"),
)
"""On white; told apart by the colour-blind, and by lightness in print. No zone has the colour of an
object, and what robots sense is paler than what there is."""

LOOKS: Mapping[str, Look] = {"thesis": THESIS, "paper": PAPER}
