"""Figure 6.6, drawn: a hierarchy for each step, and the wheels over the steps."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from matplotlib.figure import Figure

from socialmind.drawing import style as paper
from socialmind.mind import Hierarchy
from socialmind.mind.views.drawing import draw_hierarchy
from socialmind.mind.views.plan import KEY

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from .robot import Step

WIDTH, HEIGHT = paper.PAGE, 232.0
"""Of the figure, in mm."""
ACROSS, DOWN = 2, 3


def draw_steps(hierarchies: Sequence[Hierarchy], steps: Sequence[Step]) -> Figure:
    """A panel for each step, and one for the wheels' commands.

    Args:
        hierarchies: as they are in each step.
        steps: what happens.
    """
    with paper.style():
        figure = Figure(figsize=(WIDTH / 25.4, HEIGHT / 25.4))
        for number, (hierarchy, step) in enumerate(zip(hierarchies, steps, strict=True)):
            panel = figure.add_axes(_place(number))
            draw_hierarchy(hierarchy, panel, key=False)
            title = f"Step {number + 1}: {step.title[0].lower()}{step.title[1:]}"
            paper.panel_title(panel, "abcde"[number], title)
        left, bottom, width, height = _place(len(steps))
        wheels = figure.add_axes((left + 0.06, bottom + 0.05, width - 0.14, height - 0.06))
        _draw_wheels(wheels, hierarchies)
        figure.text(0.01, 0.006, f"{KEY[0].upper()}{KEY[1:]}; black is 0, green is 1.", fontsize=7)
    return figure


def _place(number: int) -> tuple[float, float, float, float]:
    """Left, bottom, width and height of a panel, as shares of the figure."""
    width, height = 1.0 / ACROSS, 0.98 / DOWN
    row, column = divmod(number, ACROSS)
    bottom = 0.02 + (DOWN - 1 - row) * height
    return column * width + 0.01, bottom + 0.005, width - 0.02, height - 0.03


def _draw_wheels(axes: Axes, hierarchies: Sequence[Hierarchy]) -> None:
    numbers = range(1, len(hierarchies) + 1)
    axes.axhline(0.5, color=paper.GREY, linewidth=0.6, linestyle=(0, (3, 2)))
    axes.set_ylim(-0.04, 1.04)
    axes.set_xlim(0.8, len(hierarchies) + 0.2)
    ends = []
    for name, what, colour, mark in (
        ("MotL", "left", paper.BLUE, "o"),
        ("MotR", "right", paper.RED, "s"),
    ):
        values = [hierarchy.actuators()[name] for hierarchy in hierarchies]
        axes.plot(numbers, values, color=colour, marker=mark, markersize=3.5)
        ends.append((values[-1], what, colour))
    paper.label_ends(axes, ends)
    axes.set_xticks(numbers)
    axes.set_yticks((0, 0.5, 1), ("0, back", "0.5, stop", "1, forward"))
    axes.set_xlabel("step")
    paper.panel_title(axes, "f", "Commands of the wheels")
