"""Drawing a hierarchy with its state, in the manner of figure 5.5 of the thesis.

Skills are grey, with the influence they received under their names; sensors blue, variables
yellow, actuators red. A link of influence is black for 0 and green for 1: its central line is what
the skill itself gives, its edge what was transmitted. All values are written as well.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from matplotlib.axes import Axes
from matplotlib.colors import LinearSegmentedColormap
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Ellipse, FancyBboxPatch, PathPatch
from matplotlib.path import Path
from matplotlib.text import Text

from socialmind.mind.evaluation.agent_state import Readings
from socialmind.mind.views.layering import Box
from socialmind.mind.views.plan import (
    MARGIN,
    Curve,
    Plan,
    Point,
    planned,
    text_width,
    values_of,
)

INFLUENCE = LinearSegmentedColormap.from_list("influence", ["#000000", "#10b830"])
"""From black for 0 to green for 1, lighter with every step."""
FILL = {"SK": "#dcdcdc", "SE": "#a9cdf2", "VA": "#ffe070", "MO": "#f2a196"}
"""Of skills, sensors, variables and actuators."""
EDGE = {"SK": "#6e6e6e", "SE": "#2564ae", "VA": "#b88a00", "MO": "#b22b19"}
"""Their outlines, and the lines of what skills read."""
UNKNOWN = "#8c8c8c"
"""Links before the first evaluation."""
VARIABLE_STYLE = (0, (4, 2))
"""Of the lines to what reads a variable."""
INK = "#222222"

COMFORTABLE, SMALLEST, LARGEST = 7.0, 5.0, 9.0
"""Points of type: of fresh axes; where a page is too narrow for that; in given axes at most."""
PAGE = 510.0
"""Width of a page in points."""


def draw_hierarchy(hierarchy: Readings, ax: Axes | None = None, key: bool = True) -> Axes:
    """Draw a hierarchy with the state of its last evaluation.

    Before the first evaluation there are no values: the structure is drawn alone. Sensors,
    variables and actuators without a link to a drawn skill are left out.

    Args:
        hierarchy: what to draw.
        ax: Axes to draw in, at the size that they have; fresh ones, in a figure of their own that
            belongs to no window, unless given.
        key: whether the colours are explained at the bottom.

    Returns:
        The Axes.

    >>> from socialmind.mind import Hierarchy, MindDescription, Programmed, Skill
    >>> def stop(): return 0.5
    >>> still = Skill("Still", (), ["MO:Mot"], Programmed(stop))
    >>> ax = draw_hierarchy(Hierarchy(MindDescription("m", (), ["Mot"], skills=[still])))
    >>> [text.get_text() for text in ax.texts]
    ['Still', 'Mot']
    """
    return HierarchyPicture(hierarchy, ax, key).ax


class HierarchyPicture:
    """A drawing of a hierarchy that follows its state, evaluation by evaluation.

    Args:
        hierarchy: what to draw, and in which state at first.
        ax: Axes to draw in, as for `draw_hierarchy`.
        key: whether the colours are explained at the bottom.
        known: whether values are shown; those of an evaluated hierarchy unless said.
        inputs: whether sensors, and variables that are only read, are shown.

    Attributes:
        ax: the Axes.
    """

    def __init__(
        self,
        hierarchy: Readings,
        ax: Axes | None = None,
        key: bool = True,
        known: bool | None = None,
        inputs: bool = True,
    ) -> None:
        self._known = hierarchy.tick > 0 if known is None else known
        plan = planned(hierarchy, key and self._known, self._known, inputs)
        if ax is None:
            size = max(min(COMFORTABLE, PAGE / plan.width), SMALLEST)
            figure = Figure(figsize=(plan.width * size / 72, plan.height * size / 72))
            ax = figure.add_axes((0.0, 0.0, 1.0, 1.0))
        self.ax = ax
        self._size = size = _fitted(ax, plan)
        # Smaller than the names, but to be read.
        self._number = min(max(0.8 * size, SMALLEST), size)
        for (module, _), curve in plan.readings.items():
            look: dict[str, Any] = {"alpha": 0.45}
            if module.startswith("VA:"):
                look = {"alpha": 0.9, "linestyle": VARIABLE_STYLE}
            _line(ax, _path(curve), EDGE[module[:2]], 0.07 * size, 1.0, **look)
        self._links: dict[tuple[str, str], tuple[PathPatch, PathPatch]] = {}
        for link, curve in plan.routes.items():
            width = (0.46 if link[1].startswith("SK:") else 0.22) * size
            edge = _line(ax, _path(curve), UNKNOWN, width, 2.0)
            self._links[link] = edge, _line(ax, _path(curve), UNKNOWN, 0.4 * width, 2.01)
            self._links[link][1].set_visible(self._known)
        values = values_of(hierarchy)
        self._names: dict[str, tuple[Text, str]] = {}
        for name, box in plan.boxes.items():
            text = _node(ax, name, box, plan.lines[name], size)
            self._names[name] = text, text.get_text().removesuffix(values[name])
        self._labels: dict[tuple[str, str], Text] = {}
        self._taken = [(box.x, box.y, box.width / 2, box.height / 2) for box in plan.boxes.values()]
        self._places = {
            link: list(_between_layers(curve))
            for link, curve in plan.routes.items()
            if link[1].startswith("SK:")
        }
        if plan.key:
            _draw_key(ax, plan, size)
        if self._known:
            self.show(hierarchy)

    def show(self, hierarchy: Readings) -> None:
        """Show the state of the last evaluation.

        Args:
            hierarchy: the same structure as at first.
        """
        transmitted = {_link(link): value for link, value in hierarchy.links().items()}
        given = {_link(link): value for link, value in hierarchy.outputs().items()}
        for link, (edge, centre) in self._links.items():
            sent = min(transmitted[link], 1.0)
            # Where links cross, the stronger one lies above.
            depth = (3.0 if link[1].startswith("SK:") else 2.0) + 0.5 * sent
            edge.set(edgecolor=INFLUENCE(sent), zorder=depth)
            centre.set(edgecolor=INFLUENCE(given[link]), zorder=depth + 0.01)
        for name, value in values_of(hierarchy).items():
            if name in self._names:
                text, beginning = self._names[name]
                text.set_text(beginning + value)
        self._write_influences(transmitted)

    def _write_influences(self, transmitted: Mapping[tuple[str, str], float]) -> None:
        """Write on links of influence what they transmit, where there is room; not the zeros.

        A place that covers no other link comes first. Once found it is the link's for good.
        """
        for link, own in self._places.items():
            text = f"{transmitted[link]:.2f}"
            if link in self._labels:
                self._labels[link].set(text=text, visible=text != "0.00")
                continue
            if text == "0.00":
                continue
            ems = self._number / self._size
            half = ems * text_width(text) / 2 + 0.1, 0.56 * ems
            free = [
                (x, y)
                for x, y in own
                if not any(
                    abs(x - other_x) < half[0] + width and abs(y - other_y) < half[1] + height
                    for other_x, other_y, width, height in self._taken
                )
            ]
            covered = {
                (x, y): sum(
                    any(
                        abs(x - at) < half[0] + 0.2 and abs(y - height) < half[1]
                        for at, height in some
                    )
                    for other, some in self._places.items()
                    if other != link
                )
                for x, y in free
            }
            if free:
                x, y = min(free, key=covered.__getitem__)
                self._taken.append((x, y, *half))
                self._labels[link] = self.ax.text(
                    x, y, text, size=self._number, color=INK, ha="center", va="center",
                    zorder=4,
                    bbox={"boxstyle": "square,pad=0.08", "facecolor": "white", "edgecolor": "none"},
                )  # fmt: skip


def influence_key(variables: bool = False) -> list[Line2D]:
    """Return marks for a legend of several hierarchies: what the colours of links say.

    Args:
        variables: whether lines to what reads a variable are told of.
    """
    marks: list[Line2D] = [
        Line2D([], [], color=INFLUENCE(sent), linewidth=2.0, label=label)
        for sent, label in ((0.0, "influence 0"), (1.0, "influence 1 or more"))
    ]
    if variables:
        marks.append(
            Line2D([], [], color=EDGE["VA"], linestyle=VARIABLE_STYLE, label="reads a variable")
        )
    told = "centre of a link: given; edge: transmitted"
    return [*marks, Line2D([], [], linestyle="none", label=told)]


def _link(link: tuple[str, str]) -> tuple[str, str]:
    return f"SK:{link[0]}", link[1]


def _fitted(ax: Axes, plan: Plan) -> float:
    """Set the Axes' limits so that all fits, and return the points of an em."""
    root: Any = ax.figure.canvas.figure
    if root.get_layout_engine() is not None:  # which gives the Axes their size
        root.draw_without_rendering()
    extent = ax.get_window_extent()
    points = 72.0 / root.dpi
    width, height = extent.width * points, extent.height * points
    size = min(width / plan.width, height / plan.height, LARGEST)
    beside = (width / size - plan.width) / 2
    above = (height / size - plan.height) / 2
    ax.set_xlim(-beside, plan.width + beside)
    ax.set_ylim(plan.height + above, -above)
    ax.set_aspect("equal")
    ax.set_axis_off()
    return size


def _line(
    ax: Axes, path: Path, colour: Any, width: float, depth: float, **properties: Any
) -> PathPatch:
    patch = PathPatch(path, facecolor="none", edgecolor=colour, linewidth=width, zorder=depth)
    patch.set(capstyle="butt", **properties)
    ax.add_patch(patch)
    return patch


def _path(curve: Curve) -> Path:
    return Path(curve, [Path.MOVETO, *[Path.CURVE4] * (len(curve) - 1)])


def _node(ax: Axes, name: str, box: Box, lines: Sequence[str], size: float) -> Text:
    code = name[:2]
    patch: Ellipse | FancyBboxPatch
    if code == "SK":
        corner = box.x - box.width / 2, box.y - box.height / 2
        patch = FancyBboxPatch(corner, box.width, box.height, "round,pad=0,rounding_size=0.9")
    else:
        patch = Ellipse((box.x, box.y), box.width, box.height)
    patch.set(facecolor=FILL[code], edgecolor=EDGE[code], linewidth=0.09 * size, zorder=5)
    ax.add_patch(patch)
    return ax.text(
        box.x, box.y, "\n".join(lines), size=size, color=INK, ha="center", va="center",
        linespacing=1.05, parse_math=False, zorder=6,
    )  # fmt: skip


def _between_layers(curve: Curve) -> Iterator[Point]:
    """Yield points of a link between layers, from the middles outwards."""
    pieces = [curve[begin : begin + 4] for begin in range(3, len(curve) - 1, 6)]
    for along in (0.5, 0.42, 0.58, 0.34, 0.66, 0.26, 0.74, 0.18, 0.82, 0.1, 0.9):
        t, s = along, 1.0 - along
        shares = s**3, 3 * s * s * t, 3 * s * t * t, t**3
        for piece in pieces:
            x, y = (sum(w * p[i] for w, p in zip(shares, piece, strict=True)) for i in (0, 1))
            yield x, y


def _draw_key(ax: Axes, plan: Plan, size: float) -> None:
    """Explain the colours at the bottom."""
    y = plan.height - 0.95 * len(plan.key) - 0.9
    ax.text(MARGIN, y, "0", size=0.85 * size, color=INK, va="center")
    steps, length = 40, 6.0
    for number in range(steps):
        begin = MARGIN + 0.9 + length * number / steps
        path = Path([(begin, y), (begin + length / steps + 0.08, y)])
        _line(ax, path, INFLUENCE(number / (steps - 1)), 0.5 * size, 3.0)
    ax.text(MARGIN + 7.2, y, "1", size=0.85 * size, color=INK, va="center")
    ax.text(
        MARGIN, y + 0.55, "\n".join(plan.key), size=0.8 * size, color=INK, va="top",
        linespacing=1.0,
    )  # fmt: skip
