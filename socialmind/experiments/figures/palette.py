"""Colours, markers and dashes of lines that the colour-blind, and those who print grey, tell apart.

What has an order gets colours of one scale from dark to light (cividis: Nuñez, Anderton & Renslow,
2018, made for those who confuse red and green); what has none gets colours of the house. Both have
markers and dashes of their own as well, since in grey some colours are alike.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import matplotlib as mpl

from socialmind.drawing import style as paper

SURFACE = "cividis"
"""The colour map of surfaces: ever lighter with the value, also in grey."""
UNORDERED = (paper.BLUE, paper.GOLD, paper.RED, paper.INK, paper.PURPLE, paper.GREY)
MARKERS = ("o", "s", "^", "D", "v", "P")
DASHES = ("-", "--", "-.", ":", (0, (5, 1, 1, 1, 1, 1)), (0, (1, 2)))
MOST_LINES = len(MARKERS)
"""So many lines of a panel are told apart."""
LIGHTEST = 0.8
"""Where on the scale the last of ordered colours is: further on it is too pale for a line."""


@dataclass(frozen=True)
class Line:
    """How one of several lines looks."""

    colour: str
    marker: str
    dashes: Any


def lines(count: int, ordered: bool) -> list[Line]:
    """Return how lines look, at most `MOST_LINES`.

    Args:
        count: how many.
        ordered: whether they stand for values that have an order.

    >>> [line.colour for line in lines(2, ordered=False)]
    ['#2564ae', '#d99a00']
    """
    if count == 1:
        colours = [paper.BLUE]
    elif ordered:
        scale = mpl.colormaps[SURFACE]
        colours = [
            mpl.colors.to_hex(scale(LIGHTEST * place / (count - 1))) for place in range(count)
        ]
    else:
        colours = list(UNORDERED[:count])
    return [Line(*one) for one in zip(colours, MARKERS[:count], DASHES[:count], strict=True)]
