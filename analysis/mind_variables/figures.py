"""Figures 4.6 to 4.8, drawn."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from socialmind.drawing import style as paper
from socialmind.mind import Counter

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from .records import Row


def draw_simple_variable(rows: Sequence[Row]) -> Figure:
    """Commands, influences and the value of a variable, below each other."""
    with paper.style():
        figure = paper.figure(paper.COLUMN, 96)
        panels = _panels(figure, 3, rows)
        skills = [("A", paper.BLUE, "-"), ("B", paper.RED, "--")]
        for panel, quantity in zip(panels, ("command", "influence"), strict=False):
            for skill, colour, style in skills:
                _curve(panel, rows, f"{quantity}_{skill}", colour, style)
            lasts = [
                (rows[-1][f"{quantity}_{skill}"], skill, colour) for skill, colour, _ in skills
            ]
            paper.label_ends(panel, lasts)
        _curve(panels[2], rows, "value", paper.INK)
        for panel, letter, title in zip(
            panels, "abc", ("Commands", "Influences", "Value"), strict=True
        ):
            paper.panel_title(panel, letter, title)
    return figure


def draw_counter(rows: Sequence[Row], counter: Counter) -> Figure:
    """The input with the two thresholds, and the counter's value."""
    with paper.style():
        figure = paper.figure(paper.COLUMN, 68)
        upper, lower = _panels(figure, 2, rows)
        for height, name in ((counter.increment, "increment"), (counter.reset, "reset")):
            upper.axhline(height, color=paper.GREY, linewidth=0.6, linestyle=(0, (3, 2)))
            paper.label_ends(upper, [(height, name, paper.GREY)])
        _curve(upper, rows, "input", paper.BLUE)
        _curve(lower, rows, "value", paper.INK)
        lower.set_ylim(-0.02, 0.42)
        paper.panel_title(upper, "a", "Input and thresholds")
        paper.panel_title(lower, "b", "Value")
    return figure


def draw_wave_generator(rows: Sequence[Row]) -> Figure:
    """The input and the wave."""
    with paper.style():
        figure = paper.figure(paper.COLUMN, 68)
        upper, lower = _panels(figure, 2, rows)
        _curve(upper, rows, "input", paper.BLUE)
        upper.set_ylim(-0.01, 0.25)
        lower.plot(
            *_points(rows, "value"), color=paper.INK, marker=".", markersize=2, linewidth=0.8
        )
        paper.panel_title(upper, "a", "Input")
        paper.panel_title(lower, "b", "Value")
    return figure


def _panels(figure: Figure, count: int, rows: Sequence[Row]) -> list[Axes]:
    panels = list(figure.subplots(count, 1, sharex=True))
    for panel in panels:
        panel.set_ylim(-0.04, 1.04)
    panels[-1].set_xlim(0, rows[-1]["evaluation"])
    panels[-1].set_xlabel("evaluation")
    return panels


def _curve(axes: Axes, rows: Sequence[Row], name: str, colour: str, style: str = "-") -> None:
    # A value holds from one evaluation to the next.
    axes.step(*_points(rows, name), where="post", color=colour, linestyle=style)


def _points(rows: Sequence[Row], name: str) -> tuple[list[float], list[float]]:
    return [row["evaluation"] for row in rows], [row[name] for row in rows]
