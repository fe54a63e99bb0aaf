"""Drawing a cognitive scheme: cognitons at the left, plans at the right, links between them.

Each link leaves its cogniton at a place of its own, beside its weight, so that a scheme can be read
off the page. Groups and culturons are not drawn.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from matplotlib.lines import Line2D
from matplotlib.patches import FancyBboxPatch, PathPatch
from matplotlib.path import Path

from coglogo_py.parts import TYPES
from socialmind.drawing import style as paper

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from coglogo_py import CognitiveScheme, Cogniton

INFLUENCE, CONDITION, REINFORCEMENT = "influence", "condition", "reinforcement"
POSITIVE, NEGATIVE, FEEDBACK = paper.BLUE, paper.RED, paper.GOLD
COGNITONS, PLANS, WEIGHTS = 0.27, 0.67, 0.39
"""Of the width: where the boxes of cognitons end, those of plans begin, and links leave weights."""
GAP = 0.7
"""Of a line, between two cognitons."""
THIN, THICK = 0.5, 2.2
MARKS = dict(zip(TYPES, "osvD^P", strict=True))
"""How boxes are marked by the type of their cogniton."""


@dataclass(frozen=True)
class _Link:
    kind: str
    plan: str
    weight: float

    @property
    def label(self) -> str:
        if self.kind == CONDITION:
            return "opens"
        return f"{self.weight:+g}".replace("-", "−")

    @property
    def colour(self) -> str:
        if self.kind == CONDITION:
            return paper.GREY
        if self.kind == REINFORCEMENT:
            return FEEDBACK
        return POSITIVE if self.weight > 0 else NEGATIVE


def draw_scheme(scheme: CognitiveScheme, axes: Axes, lines: float | None = None) -> None:
    """Draw a scheme's cognitons, plans and links.

    Args:
        scheme: what is drawn.
        axes: where; they lose their own lines and marks.
        lines: the height of the axes, in lines of type; as many as the scheme takes by default.
            Two schemes beside each other that are given one number are drawn to one scale.
    """
    links = {one.name: list(_links(one, scheme)) for one in scheme.cognitons}
    height = lines or lines_of(scheme)
    axes.set_axis_off()
    axes.set_xlim(0, 1)
    axes.set_ylim(height, 0)
    used = lines_of(scheme)
    plans = {
        plan: used * (place + 0.5) / len(scheme.plans) for place, plan in enumerate(scheme.plans)
    }
    largest = max((abs(link.weight) for several in links.values() for link in several
                   if link.kind == INFLUENCE), default=1.0)  # fmt: skip
    top = 0.0
    for one in scheme.cognitons:
        high = max(1, len(links[one.name]))
        _box(axes, 0.0, COGNITONS, top, high, one.name, tuple(c / 255 for c in one.colour))
        if one.type is not None:
            axes.plot(0.034, top + high / 2, MARKS[one.type], **MARKED)
        for place, link in enumerate(links[one.name]):
            y = top + place + 0.5
            axes.text(
                WEIGHTS - 0.01, y, link.label, fontsize=7, color=link.colour, ha="right",
                va="center",
            )  # fmt: skip
            _curve(axes, link, y, plans[link.plan], largest)
        top += high + GAP
    for plan, y in plans.items():
        _box(axes, PLANS, 1.0, y - 0.6, 1.2, plan, None)


def lines_of(scheme: CognitiveScheme) -> float:
    """Return how many lines of type a drawing of a scheme takes."""
    high = [max(1, len(list(_links(one, scheme)))) + GAP for one in scheme.cognitons]
    return max(sum(high), 1.6 * len(scheme.plans))


MARKED: dict[str, Any] = {"color": paper.INK, "markersize": 3.0, "markeredgewidth": 0.0}


def key(*schemes: CognitiveScheme) -> list[Line2D]:
    """Return marks for a legend, which say what the lines are, and of which type cognitons.

    Args:
        schemes: those that are drawn, as far as their types are to be explained.
    """
    there = {one.type for scheme in schemes for one in scheme.cognitons}
    return [
        *(
            Line2D([], [], marker=mark, linestyle="", label=name, **MARKED)
            for name, mark in MARKS.items()
            if name in there
        ),
        Line2D([], [], color=POSITIVE, linewidth=1.6, label="speaks for a plan"),
        Line2D([], [], color=NEGATIVE, linewidth=1.6, label="speaks against it"),
        Line2D([], [], color=paper.GREY, linewidth=0.8, linestyle=":", label="opens a plan"),
        Line2D([], [], color=FEEDBACK, linewidth=1.0, linestyle="--", label="is reinforced by it"),
    ]


def _links(cogniton: Cogniton, scheme: CognitiveScheme) -> Iterator[_Link]:
    """The links of a cogniton, those to upper plans first within each kind."""
    for kind, weights in (
        (INFLUENCE, dict(cogniton.influence)),
        (CONDITION, dict.fromkeys(cogniton.conditional, 0.0)),
        (REINFORCEMENT, dict(cogniton.reinforcement)),
    ):
        for plan in scheme.plans:
            if plan in weights and (kind == CONDITION or weights[plan] != 0):
                yield _Link(kind, plan, weights[plan])


def _box(
    axes: Axes, left: float, right: float, top: float, high: float, name: str,
    colour: tuple[float, ...] | None,
) -> None:  # fmt: skip
    box = FancyBboxPatch(
        (left + 0.005, top + 0.06), right - left - 0.01, high - 0.12,
        boxstyle="round,pad=0,rounding_size=0.012", mutation_aspect=20,
        facecolor="#f4f4f4", edgecolor=paper.INK if colour is None else paper.GREY, linewidth=0.6,
    )  # fmt: skip
    axes.add_patch(box)
    if colour is not None:
        axes.plot([left + 0.016] * 2, [top + 0.25, top + high - 0.25], color=colour, linewidth=2.0)
    middle = (left + right) / 2 + (0.012 if colour is not None else 0)
    axes.text(middle, top + high / 2, name, fontsize=7, ha="center", va="center")


def _curve(axes: Axes, link: _Link, begin: float, end: float, largest: float) -> None:
    """Draw a link from the weight beside its cogniton to its plan."""
    middle = (WEIGHTS + PLANS) / 2
    path = Path(
        [(WEIGHTS, begin), (middle, begin), (middle, end), (PLANS, end)],
        [Path.MOVETO, Path.CURVE4, Path.CURVE4, Path.CURVE4],
    )
    width, style = 0.8, "-"
    if link.kind == INFLUENCE:
        # From the largest weight on, each tenth of it takes a third of the width.
        share = 1 + math.log10(abs(link.weight) / largest) / 3
        width = THIN + (THICK - THIN) * max(share, 0.0)
    elif link.kind == CONDITION:
        style = ":"
    else:
        style = "--"
    axes.add_patch(
        PathPatch(path, facecolor="none", edgecolor=link.colour, linewidth=width, linestyle=style)
    )
