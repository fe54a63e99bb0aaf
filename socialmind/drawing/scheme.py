"""Drawing a cognitive scheme: cognitons at the left, plans at the right, links between them.

It shows what figures 3.3 and 3.7 of the thesis show, on one drawing. Each link leaves its cogniton
at a place of its own, beside its weight, so that a scheme can be read off the page. What is
negative is dashed; what opens a plan is dotted and ends in a ring; what a plan reinforces has an
arrow back to the cogniton. Below stand the groups: each role is a box with the culturons that its
players are under, whose links begin with a diamond, since they act on those alone.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import FancyBboxPatch, PathPatch
from matplotlib.path import Path

from coglogo_py.parts import TYPES
from socialmind.drawing import style as paper

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from coglogo_py import CognitiveScheme, Cogniton, Culturon, Group

INFLUENCE, CONDITION, REINFORCEMENT = "influence", "condition", "reinforcement"
POSITIVE, NEGATIVE, FEEDBACK = paper.BLUE, paper.RED, paper.GOLD
COGNITONS, PLANS, WEIGHTS = 0.27, 0.67, 0.39
"""Of the width: where the boxes of cognitons end, those of plans begin, and links leave weights."""
GAP = 0.7
"""Of a line, between two cognitons."""
HEADING = 1.1
"""Lines, for the name of a group, and for that of a role."""
INSET = 0.02
"""Of the width, between a role's box and those of its culturons."""
BAR = 0.024
"""Of the width, for the colour of a cogniton, and the mark of its type."""
LETTER = 0.62
"""How wide a letter is, of the size of its font."""
THIN, THICK = 0.5, 2.2
DASHED = (0, (3.5, 1.6))
LARGEST, SMALLEST = 7.0, 5.0
"""Points of type: of names, and of those that need it to fit, where the page is a column wide."""
FOR, AGAINST, OPENS = "speaks for a plan", "speaks against a plan", "opens a plan"
STRENGTHENED, WEAKENED = "is strengthened by a plan", "is weakened by a plan"
LOOKS: dict[str, dict[str, Any]] = {
    FOR: {"color": POSITIVE, "linewidth": 1.6},
    AGAINST: {"color": NEGATIVE, "linewidth": 1.6, "linestyle": DASHED},
    OPENS: {"color": paper.GREY, "linewidth": 0.8, "linestyle": ":"},
    STRENGTHENED: {"color": FEEDBACK, "linewidth": 1.0},
    WEAKENED: {"color": FEEDBACK, "linewidth": 1.0, "linestyle": DASHED},
}
"""How links look in the legend, by what they mean."""
LINE, EDGE = 3.5, 1.0
"""Millimetres, of a line of type in a figure, and of white around it."""
KEY_COLUMNS = 2
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

    @property
    def style(self) -> Any:
        if self.kind == CONDITION:
            return ":"
        return DASHED if self.weight < 0 else "-"

    @property
    def look(self) -> str:
        """What it means, as the legend explains it."""
        if self.kind == CONDITION:
            return OPENS
        if self.kind == REINFORCEMENT:
            return STRENGTHENED if self.weight > 0 else WEAKENED
        return FOR if self.weight > 0 else AGAINST


def draw_scheme(scheme: CognitiveScheme, axes: Axes, lines: float | None = None) -> None:
    """Draw a scheme's cognitons, plans and links, and its groups.

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
    holders = _holders(scheme)
    largest = max((abs(weight) for one in holders for weight in one.influence.values()
                   if weight), default=1.0)  # fmt: skip
    top = 0.0
    for one in scheme.cognitons:
        high = max(1, len(links[one.name]))
        _box(axes, 0.0, COGNITONS, top, high, one.name, tuple(c / 255 for c in one.colour))
        if one.type is not None:
            axes.plot(0.034, top + high / 2, MARKS[one.type], **MARKED)
        _lines(axes, links[one.name], top, plans, largest)
        top += high + GAP
    for group in scheme.groups:
        top = _draw_group(axes, group, scheme, top, plans, largest)
    for plan, y in plans.items():
        _box(axes, PLANS, 1.0, y - 0.6, 1.2, plan, None)


def scheme_figure(scheme: CognitiveScheme, width: float | None = None) -> Figure:
    """Return a figure of a scheme with its legend, as high as the scheme takes.

    Args:
        scheme: what is drawn.
        width: in mm; as wide as a column unless given, or as a page where names are too long.
    """
    if width is None:
        named = [one.name for one in _holders(scheme)]
        room = (COGNITONS - BAR - 2 * INSET) * paper.COLUMN / 25.4 * 72
        crowded = any(LETTER * SMALLEST * len(name) > room for name in named)
        room = (1 - PLANS - INSET) * paper.COLUMN / 25.4 * 72
        crowded |= any(LETTER * SMALLEST * len(name) > room for name in scheme.plans)
        width = paper.PAGE if crowded else paper.COLUMN
    with paper.style():
        marks = key(scheme)
        rows = -(-len(marks) // KEY_COLUMNS)
        high, below = LINE * lines_of(scheme), LINE * (rows + 0.5)
        figure = Figure(figsize=(width / 25.4, (high + below + 2 * EDGE) / 25.4))
        whole = high + below + 2 * EDGE
        axes = figure.add_axes(
            (EDGE / width, (below + EDGE) / whole, 1 - 2 * EDGE / width, high / whole)
        )
        draw_scheme(scheme, axes)
        figure.legend(
            handles=marks, loc="lower center", ncols=KEY_COLUMNS, bbox_to_anchor=(0.5, 0.0),
            borderaxespad=0.4, handlelength=2.2, columnspacing=1.2, labelspacing=0.35,
        )  # fmt: skip
    return figure


def _lines(
    axes: Axes, links: list[_Link], top: float, plans: dict[str, float], largest: float,
    by_role: bool = False,
) -> None:  # fmt: skip
    """Draw the links of a cogniton or culturon, each beside its weight."""
    for place, link in enumerate(links):
        y = top + place + 0.5
        size = _size(axes, link.label, WEIGHTS - COGNITONS - INSET / 4)
        axes.text(
            WEIGHTS - 0.01, y, link.label, fontsize=size, color=link.colour, ha="right", va="center"
        )
        end = plans[link.plan]
        _curve(axes, link, y, end, largest)
        if link.kind == CONDITION:
            axes.plot(PLANS - 0.008, end, "o", color=link.colour, **HOLLOW)
        if link.kind == REINFORCEMENT:
            axes.plot(WEIGHTS + 0.008, y, "<", color=link.colour, markersize=3.4)
        elif by_role:
            axes.plot(WEIGHTS + 0.008, y, "D", color=link.colour, **HOLLOW)


def _draw_group(
    axes: Axes, group: Group, scheme: CognitiveScheme, top: float, plans: dict[str, float],
    largest: float,
) -> float:  # fmt: skip
    """Draw a group below a height, and what it lies in; return where it ends."""
    around = "" if group.within is None else f" in a {group.within[0]}, as {group.within[1]}"
    title = axes.text(
        0.005, top + HEADING / 2, group.name, fontsize=7, fontweight="bold", va="center"
    )
    axes.annotate(
        around, (1, 0), xycoords=title, fontsize=7, color=paper.GREY, va="bottom", ha="left"
    )
    top += HEADING
    for role in group.roles:
        held = [(one, list(_links(one, scheme))) for one in role.culturons]
        high = HEADING + sum(max(1, len(links)) + GAP / 2 for _, links in held)
        _box(axes, 0.0, COGNITONS, top, high, "", None)
        size = _size(axes, role.name, COGNITONS - INSET)
        axes.text(
            INSET, top + HEADING / 2, role.name, fontsize=size, fontstyle="italic", va="center"
        )
        inner = top + HEADING
        for one, links in held:
            lines = max(1, len(links))
            colour = tuple(part / 255 for part in one.colour)
            _box(axes, INSET / 2, COGNITONS - INSET / 4, inner, lines, one.name, colour)
            _lines(axes, links, inner, plans, largest, by_role=True)
            inner += lines + GAP / 2
        top += high + GAP / 2
    return top + GAP / 2


def lines_of(scheme: CognitiveScheme) -> float:
    """Return how many lines of type a drawing of a scheme takes."""
    high = [max(1, len(list(_links(one, scheme)))) + GAP for one in scheme.cognitons]
    for group in scheme.groups:
        high.append(HEADING + GAP / 2)
        for role in group.roles:
            links = [max(1, len(list(_links(one, scheme)))) + GAP / 2 for one in role.culturons]
            high.append(HEADING + sum(links) + GAP / 2)
    return max(sum(high), 1.6 * len(scheme.plans))


HOLLOW: dict[str, Any] = {
    "markersize": 3.0, "markerfacecolor": "white", "markeredgewidth": 0.7, "zorder": 4,
}  # fmt: skip
MARKED: dict[str, Any] = {"color": paper.INK, "markersize": 3.0, "markeredgewidth": 0.0}


def key(*schemes: CognitiveScheme) -> list[Line2D]:
    """Return marks for a legend, which say what the lines are, and of which type cognitons.

    Args:
        schemes: those that are drawn: only what they have is explained; all links without any.
    """
    types = {one.type for scheme in schemes for one in scheme.cognitons}
    culturons = [one for scheme in schemes for one in _culturons(scheme)]
    looks = {
        link.look for scheme in schemes for one in _holders(scheme) for link in _links(one, scheme)
    }
    by_role = Line2D([], [], marker="D", linestyle="", color=paper.INK, label="of a role", **HOLLOW)
    return [
        *(
            Line2D([], [], marker=mark, linestyle="", label=name, **MARKED)
            for name, mark in MARKS.items()
            if name in types
        ),
        *([by_role] if culturons else []),
        *(
            Line2D([], [], label=name, **look)
            for name, look in LOOKS.items()
            if name in looks or not schemes
        ),
    ]


def _holders(scheme: CognitiveScheme) -> list[Cogniton | Culturon]:
    """Return all that links come from."""
    return [*scheme.cognitons, *_culturons(scheme)]


def _culturons(scheme: CognitiveScheme) -> list[Culturon]:
    return [one for group in scheme.groups for role in group.roles for one in role.culturons]


def _links(cogniton: Cogniton | Culturon, scheme: CognitiveScheme) -> Iterator[_Link]:
    """The links of a cogniton or culturon, those to upper plans first within each kind."""
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
    edge = BAR if colour is not None else 0.0
    size = _size(axes, name, right - left - edge - INSET)
    axes.text((left + right + edge) / 2, top + high / 2, name, fontsize=size, ha="center",
              va="center", parse_math=False)  # fmt: skip


def _size(axes: Axes, name: str, room: float) -> float:
    """Return the points of type in which a name fits into a share of the width."""
    width = axes.bbox.width / axes.figure.dpi * 72
    return min(LARGEST, room * width / (LETTER * max(len(name), 1)))


def _curve(axes: Axes, link: _Link, begin: float, end: float, largest: float) -> None:
    """Draw a link from the weight beside its cogniton to its plan."""
    middle = (WEIGHTS + PLANS) / 2
    path = Path(
        [(WEIGHTS, begin), (middle, begin), (middle, end), (PLANS, end)],
        [Path.MOVETO, Path.CURVE4, Path.CURVE4, Path.CURVE4],
    )
    width = 0.8
    if link.kind == INFLUENCE:
        # From the largest weight on, each tenth of it takes a third of the width.
        share = 1 + math.log10(abs(link.weight) / largest) / 3
        width = THIN + (THICK - THIN) * max(share, 0.0)
    axes.add_patch(
        PathPatch(
            path, facecolor="none", edgecolor=link.colour, linewidth=width, linestyle=link.style
        )
    )
