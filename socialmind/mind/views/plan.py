"""What a drawing of a hierarchy shows, and where.

Skills stand in layers with the master on top; actuators, and the variables that skills write, in
the lowest one; sensors, and the variables that are only read, at the left. Lengths are in em, the
size of the type; y grows downwards. Nodes go by the texts of links: `SK:Avoid`, `SE:S1`.
"""

from __future__ import annotations

import re
import textwrap
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import combinations, pairwise

from matplotlib.textpath import TextPath

from socialmind.mind.evaluation.agent_state import Readings
from socialmind.mind.views.layering import SPACE, Box, Layering, Link, layered, layers_of

Point = tuple[float, float]
Curve = tuple[Point, ...]
"""A chain of cubic Bézier curves: where it begins, then two controls and an end for each piece."""

MARGIN = 0.6
KEY = "influence: the centre of a link is what the skill gives, its edge what is transmitted"
_WIDEST = 46.0  # of a layer in one row
_TALLEST = 38.0  # of a column of sensors, where the skills are not taller
_COLUMN_GAP = 4.5


@dataclass(frozen=True)
class Plan:
    """A drawing before it is drawn.

    Attributes:
        boxes: where each node stands.
        lines: what is written in it.
        routes: the curve of each link from a skill; its even pieces stand beside nodes, its odd
            ones lie between layers.
        readings: the curve of each link to an input of a skill.
        key: the lines of the explanation of colours; none without values.
        width, height: of the drawing.
    """

    boxes: Mapping[str, Box]
    lines: Mapping[str, Sequence[str]]
    routes: Mapping[Link, Curve]
    readings: Mapping[Link, Curve]
    key: Sequence[str]
    width: float
    height: float


def planned(hierarchy: Readings, key: bool, known: bool | None = None, inputs: bool = True) -> Plan:
    """Return the plan of a hierarchy's drawing.

    Args:
        hierarchy: what to draw.
        key: whether the colours are explained.
        known: whether values are shown; those of an evaluated hierarchy unless said.
        inputs: whether sensors, and variables that are only read, are shown.
    """
    known = hierarchy.tick > 0 if known is None else known
    skills = [hierarchy.description.skills[name] for name in hierarchy.skills]
    links = [(f"SK:{skill.name}", str(one)) for skill in skills for one in skill.outputs]
    readings = dict.fromkeys(
        (f"{'SE' if one.module == 'sensor' else 'VA'}:{one.name}", f"SK:{skill.name}")
        for skill in skills
        for one in skill.inputs
    )
    commanded = {target for _, target in links}
    if not inputs:
        readings = {link: None for link in readings if link[0] in commanded}
    read = {module for module, _ in readings}
    values = values_of(hierarchy) if known else dict.fromkeys(values_of(hierarchy), "")
    inner = [name for name in values if name.startswith("SK:") or name in commanded]
    beside = [name for name in values if name in read and name not in commanded]
    lines = {name: _lines(name, values[name], name in beside) for name in (*inner, *beside)}
    boxes = {name: _box(name, some) for name, some in lines.items()}
    layer = layers_of(inner, links)
    lowest = max(layer[name] for name in inner if name.startswith("SK:")) + 1
    layer |= {name: lowest for name in inner if not name.startswith("SK:")}
    layering = layered({name: boxes[name] for name in inner}, links, layer, _WIDEST, inputs)
    placed = dict(layering.boxes)
    placed |= _column({name: boxes[name] for name in beside}, list(readings), layering, lowest)
    routes = {link: _joined(_down, points) for link, points in layering.routes.items()}
    curves = {
        link: _reading(link, number, placed, layering, layer)
        for number, link in enumerate(readings)
    }
    return _framed(lines, placed, routes, curves, key)


def _framed(
    lines: Mapping[str, Sequence[str]],
    boxes: Mapping[str, Box],
    routes: Mapping[Link, Curve],
    readings: Mapping[Link, Curve],
    key: bool,
) -> Plan:
    """Move all so that it begins at the margin, and leave room for the key."""
    points = [point for curve in (*routes.values(), *readings.values()) for point in curve]
    left = min([box.x - box.width / 2 for box in boxes.values()] + [x for x, _ in points]) - MARGIN
    top = min([box.y - box.height / 2 for box in boxes.values()] + [y for _, y in points]) - MARGIN

    def moved(curves: Mapping[Link, Curve]) -> dict[Link, Curve]:
        return {
            link: tuple((x - left, y - top) for x, y in curve) for link, curve in curves.items()
        }

    found = {name: replace(box, x=box.x - left, y=box.y - top) for name, box in boxes.items()}
    right = [box.x + box.width / 2 for box in found.values()] + [x - left for x, _ in points]
    width = max(right) + MARGIN
    height = max(box.y + box.height / 2 for box in found.values()) + MARGIN
    explained = textwrap.wrap(KEY, max(16, int(width / 0.48))) if key else []
    if explained:
        height += 1.2 + 0.95 * len(explained)
    return Plan(found, lines, moved(routes), moved(readings), explained, width, height)


# Nodes -------------------------------------------------------------------------------------------


def values_of(hierarchy: Readings) -> dict[str, str]:
    """Return all nodes with their values as texts."""
    tables = {
        "SK": hierarchy.influences(),
        "MO": hierarchy.actuators(),
        "SE": hierarchy.sensors(),
        "VA": hierarchy.variables(),
    }
    return {
        f"{code}:{name}": f"{value:.2f}"
        for code, table in tables.items()
        for name, value in table.items()
    }


def _lines(name: str, value: str, flat: bool) -> list[str]:
    """Return what is written in a node, on one line where it is flat."""
    lines = [f"{name[3:]} {value}"] if flat else [*wrapped(name[3:]), value]
    return [line.strip() for line in lines if line]


def wrapped(name: str) -> list[str]:
    """Break a long name into two or three lines, where its parts meet.

    >>> wrapped("GoToDropZone+Avoid")
    ['GoToDropZone', '+Avoid']
    >>> wrapped("SearchForObject")
    ['Search', 'ForObject']
    """
    count = 1 if len(name) <= 12 else 2 if len(name) <= 28 else 3
    breaks = [match.end() for match in re.finditer(r"[ _\-](?=.)|[^+](?=\+)", name)]
    # Between the words of one part only if there is no better place.
    inside = [match.end() for match in re.finditer(r"[a-z0-9](?=[A-Z])", name)]
    known = sorted({*breaks, *inside})
    candidates = [
        [name[begin:end] for begin, end in pairwise([0, *chosen, len(name)])]
        for chosen in combinations(known, min(count, len(known) + 1) - 1)
    ]

    def ugliness(lines: Sequence[str]) -> float:
        ends, at = [], 0
        for line in lines[:-1]:
            at += len(line)
            ends.append(at)
        return max(map(len, lines)) + 3.0 * sum(end not in breaks for end in ends)

    return [line.strip() for line in min(candidates, key=ugliness)]


def text_width(text: str) -> float:
    """Return how wide a text is, in em."""
    # A dollar sign is no mathematics here.
    path = TextPath((0, 0), text.replace("$", r"\$"), size=1.0)
    return float(path.get_extents().width) if len(path.vertices) else 0.0


def _box(name: str, lines: Sequence[str]) -> Box:
    """Return the room that a node needs; an ellipse more than its text, for the corners."""
    width, count = max(text_width(line) for line in lines), len(lines)
    if name.startswith("SK:"):
        return Box(width + 1.4, 1.2 * count + 0.7)
    if count == 1:
        return Box(1.12 * width + 0.9, 1.75)
    return Box(1.3 * width + 0.9, 1.2 * count + 1.0)


def _column(
    boxes: Mapping[str, Box], readings: Sequence[Link], layering: Layering, lowest: int
) -> dict[str, Box]:
    """Place what is only read at the left of the skills, near the height of those that read it."""
    if not boxes:
        return {}
    heights: dict[str, list[float]] = {name: [] for name in boxes}
    for module, skill in readings:
        if module in heights:
            heights[module].append(layering.boxes[skill].y)
    order = sorted(boxes, key=lambda name: sum(heights[name]) / len(heights[name]))
    pitch = max(box.height for box in boxes.values()) + 0.45
    below = layering.bands[lowest - 1][1]
    columns = -(-len(order) // int(max(below + 6.0, _TALLEST) / pitch))
    rows = -(-len(order) // columns)
    top = below / 2 - rows * pitch / 2
    top = max(top, min(0.0, layering.bands[-1][1] - rows * pitch))
    found, edge = {}, -_COLUMN_GAP
    for number in range(columns):
        names = order[number * rows : (number + 1) * rows]
        width = max(boxes[name].width for name in names)
        for place, name in enumerate(names):
            y = top + (place + 0.5) * pitch
            found[name] = replace(boxes[name], x=edge - width / 2, y=y)
        edge -= width + SPACE
    return found


# What skills read --------------------------------------------------------------------------------


def _reading(
    link: Link,
    number: int,
    placed: Mapping[str, Box],
    layering: Layering,
    layer: Mapping[str, int],
) -> Curve:
    """Return the curve of a link to a skill's input.

    From the left it runs above the skill's layer and comes down on it, so that it passes behind no
    other skill. From a variable in the lowest layer it rises to the skill's right corner.
    """
    module, skill = link
    begin, end = placed[module], placed[skill]
    if module in layering.boxes:
        top = begin.x, begin.y - begin.height / 2
        return _joined(_down, [top, (end.x + end.width / 2 - 0.5, end.y + end.height / 2)])
    start = begin.x + begin.width / 2, begin.y
    row = [box for name, box in layering.boxes.items() if layer[name] == layer[skill]]
    first = min(box.x - box.width / 2 for box in row)
    if first == end.x - end.width / 2:
        return _joined(_across, [start, (first, end.y)])
    several = len({box.y for box in row}) > 1
    down = end.x - 0.5 if several else end.x - end.width / 2 + 0.6
    along = layering.bands[layer[skill]][0] - 0.9 - 0.13 * (number % 12)
    turn, stop = (down - 0.8, along), (down, end.y - end.height / 2)
    curve = _joined(_across, [start, (min(first, 0.0) - 0.8, along), turn])
    return (*curve, (down, along), (down, along), stop)


def _joined(piece: Callable[[Point, Point], Curve], points: Sequence[Point]) -> Curve:
    """Return a curve through points."""
    return (points[0], *(one for pair in pairwise(points) for one in piece(*pair)))


def _down(begin: Point, end: Point) -> Curve:
    """Return a piece of a curve that is upright at both ends."""
    middle = (begin[1] + end[1]) / 2
    return (begin[0], middle), (end[0], middle), end


def _across(begin: Point, end: Point) -> Curve:
    """Return a piece of a curve that is level at both ends."""
    middle = (begin[0] + end[0]) / 2
    return (middle, begin[1]), (middle, end[1]), end
