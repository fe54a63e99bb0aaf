"""Where the skills of a hierarchy stand on a page: layers by longest path, with few crossings.

The method is that of Sugiyama: links over several layers pass through lanes of their own, layers
are ordered by barycentres, and places are found by least squares between neighbours. Lengths are
in any one unit; x grows to the right, y downwards.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

Link = tuple[str, str]
Lane = tuple[str, str, int]
"""The place of a link from one node to another in a layer between them."""
Key = str | Lane

SPACE = 0.9
"""Between neighbours."""
LANE = 1.1
"""Width of a lane."""
_SWEEPS = 12


@dataclass(frozen=True)
class Box:
    """The room that a node needs, and where it stands.

    Attributes:
        width, height: of the node.
        x, y: its centre; 0 until it is placed.
    """

    width: float
    height: float
    x: float = 0.0
    y: float = 0.0


@dataclass(frozen=True)
class Layering:
    """Nodes and links with their places.

    Attributes:
        boxes: the nodes by name.
        bands: top and bottom of each layer.
        routes: for each link the points that it passes, from the lower edge of its source to the
            upper edge of its target.
    """

    boxes: Mapping[str, Box]
    bands: tuple[tuple[float, float], ...]
    routes: Mapping[Link, tuple[tuple[float, float], ...]]


def layers_of(names: Sequence[str], links: Sequence[Link]) -> dict[str, int]:
    """Return each node's layer: the length of the longest path that leads to it.

    Args:
        names: the nodes, each after those that it is linked from.
        links: from a node to another.

    >>> layers_of("abc", [("a", "b"), ("a", "c"), ("b", "c")])
    {'a': 0, 'b': 1, 'c': 2}
    """
    layer = dict.fromkeys(names, 0)
    for name in names:
        for source, target in links:
            if source == name:
                layer[target] = max(layer[target], layer[name] + 1)
    return layer


def layered(
    boxes: Mapping[str, Box],
    links: Sequence[Link],
    layer: Mapping[str, int],
    widest: float,
    lanes_above: bool = True,
) -> Layering:
    """Place nodes in layers.

    Args:
        boxes: the room that each node needs, by name.
        links: from a node to one in a lower layer.
        layer: the layer of each node, from 0.
        widest: a layer that is wider is spread over several rows.
        lanes_above: whether there is room above each layer for lines that come from beside it.
    """
    chains = {link: _chain(link, layer) for link in links}
    order = _ordered(_first_order(boxes, chains, layer), chains)
    rows = [_rows(keys, boxes, widest) for keys in order]
    x = _abscissae(order, rows, boxes, chains)
    left = min(x[key] - _width(key, boxes) / 2 for keys in order for key in keys)
    span = max(x[key] + _width(key, boxes) / 2 for keys in order for key in keys) - left
    below = _neighbours(chains)[1]
    placed, bands, top = {}, [], 0.0
    for keys, count in zip(order, rows, strict=True):
        names = [key for key in keys if isinstance(key, str)]
        pitch = max(boxes[name].height for name in names) + SPACE
        for place, name in enumerate(names):
            y = top + (place % count + 0.5) * pitch - SPACE / 2
            placed[name] = Box(boxes[name].width, boxes[name].height, x[name] - left, y)
        bands.append((top, top + count * pitch - SPACE))
        # Long slanting links need height, and so do many.
        crowd = sum(len(below.get(key, [])) for key in keys)
        gap = min(9.0, 4.0 + 0.05 * span + 0.12 * max(0, crowd - 6))
        top = bands[-1][1] + (gap if lanes_above else 0.62 * gap)
    ports = _ports(chains, x, boxes)
    routes = {
        link: _route(chain, [x[key] - left for key in chain[1:-1]], ports, placed, bands, layer)
        for link, chain in chains.items()
    }
    return Layering(placed, tuple(bands), routes)


def _chain(link: Link, layer: Mapping[str, int]) -> list[Key]:
    """Return a link's source, its lanes and its target."""
    source, target = link
    between = range(layer[source] + 1, layer[target])
    return [source, *((source, target, number) for number in between), target]


def _width(key: Key, boxes: Mapping[str, Box]) -> float:
    return boxes[key].width if isinstance(key, str) else LANE


# The order in each layer -------------------------------------------------------------------------


def _first_order(
    boxes: Mapping[str, Box], chains: Mapping[Link, list[Key]], layer: Mapping[str, int]
) -> list[list[Key]]:
    """Return the nodes and lanes of each layer as a walk in depth comes to them."""
    below: dict[Key, list[Key]] = {}
    for chain in chains.values():
        for upper, lower in pairwise(chain):
            below.setdefault(upper, []).append(lower)
    order: list[dict[Key, None]] = [{} for _ in range(max(layer.values()) + 1)]
    waiting: list[Key] = [name for name in reversed(list(boxes)) if layer[name] == 0]
    while waiting:
        key = waiting.pop()
        level = order[layer[key] if isinstance(key, str) else key[2]]
        if key not in level:
            level[key] = None
            waiting += reversed(below.get(key, []))
    return [list(level) for level in order]


def _ordered(order: list[list[Key]], chains: Mapping[Link, list[Key]]) -> list[list[Key]]:
    """Return the layers in an order of few crossings, by sweeps of barycentres."""
    above, below = _neighbours(chains)
    best, fewest = order, _crossings(order, below)
    for sweep in range(_SWEEPS):
        order = [list(keys) for keys in order]
        down = sweep % 2 == 0
        numbers = range(1, len(order)) if down else range(len(order) - 2, -1, -1)
        for number in numbers:
            fixed = order[number - 1 if down else number + 1]
            place = {key: at for at, key in enumerate(fixed)}
            linked = above if down else below
            centre = {
                key: float(np.mean([place[other] for other in linked[key]]))
                if linked.get(key)
                else at * len(fixed) / len(order[number])
                for at, key in enumerate(order[number])
            }
            order[number].sort(key=centre.__getitem__)
        count = _crossings(order, below)
        if count < fewest:
            best, fewest = order, count
    return best


def _neighbours(
    chains: Mapping[Link, list[Key]],
) -> tuple[dict[Key, list[Key]], dict[Key, list[Key]]]:
    above: dict[Key, list[Key]] = {}
    below: dict[Key, list[Key]] = {}
    for chain in chains.values():
        for upper, lower in pairwise(chain):
            above.setdefault(lower, []).append(upper)
            below.setdefault(upper, []).append(lower)
    return above, below


def _crossings(order: list[list[Key]], below: Mapping[Key, list[Key]]) -> int:
    """Count the pairs of links that cross between neighbouring layers."""
    total = 0
    for upper, lower in pairwise(order):
        place = {key: at for at, key in enumerate(lower)}
        ends = np.array(
            [(at, place[other]) for at, key in enumerate(upper) for other in below.get(key, [])]
        ).reshape(-1, 2)
        apart = np.sign(ends[:, None, :] - ends[None, :, :])
        total += int((apart[..., 0] * apart[..., 1] < 0).sum()) // 2
    return total


# Places ------------------------------------------------------------------------------------------


def _rows(keys: list[Key], boxes: Mapping[str, Box], widest: float) -> int:
    """Return over how many rows a layer is spread."""
    width = sum(_width(key, boxes) + SPACE for key in keys)
    nodes = sum(isinstance(key, str) for key in keys)
    return min(max(1, round(width / widest + 0.4)), 3, nodes)


def _abscissae(
    order: list[list[Key]],
    rows: list[int],
    boxes: Mapping[str, Box],
    chains: Mapping[Link, list[Key]],
) -> dict[Key, float]:
    """Return where nodes and lanes stand from left to right: near those they are linked with."""
    above, below = _neighbours(chains)
    apart = [_apart(keys, count, boxes) for keys, count in zip(order, rows, strict=True)]
    x: dict[Key, float] = {}
    for keys, steps in zip(order, apart, strict=True):
        places = np.concatenate([[0.0], np.cumsum(steps)])
        x.update(zip(keys, (places - places[-1] / 2).tolist(), strict=True))
    downwards = list(range(len(order)))
    for sweep in range(_SWEEPS):
        for number in downwards if sweep % 2 == 0 else reversed(downwards):
            keys = order[number]
            # In the end both sides count, so that parents stand over the middle of their children.
            sides = (above, below) if sweep > _SWEEPS // 2 else ((above, below)[sweep % 2],)
            wanted, weights = [], []
            for key in keys:
                others = [x[other] for side in sides for other in side.get(key, [])]
                wanted.append(float(np.mean(others)) if others else x[key])
                weights.append(1.0 if isinstance(key, str) else 2.0)
            x.update(zip(keys, _spread(wanted, weights, apart[number]), strict=True))
    return x


def _apart(keys: list[Key], rows: int, boxes: Mapping[str, Box]) -> list[float]:
    """Return the least distance of each two neighbours' centres in a layer.

    In a layer of several rows a node leaves room for the links of those in the other rows alone.
    """
    steps = []
    for left, right in pairwise(keys):
        widths = _width(left, boxes), _width(right, boxes)
        if rows == 1 or not (isinstance(left, str) and isinstance(right, str)):
            steps.append(sum(widths) / 2 + SPACE)
        else:
            # Links leave and arrive within three tenths of the width beside a node's centre.
            beside = max(widths) / 2 + 0.3 * min(widths) + SPACE / 2
            steps.append(max(beside, sum(widths) / 2 / (rows - 0.5)))
    return steps


def _spread(wanted: list[float], weights: list[float], apart: list[float]) -> list[float]:
    """Return the places nearest to the wanted ones (least squares) that are far enough apart.

    >>> _spread([0.0, 0.0, 9.0], [1.0, 1.0, 1.0], [2.0, 2.0])
    [-1.0, 1.0, 9.0]
    """
    offsets = np.concatenate([[0.0], np.cumsum(apart)])
    pools: list[list[float]] = []  # mean, weight, members: pool adjacent violators
    for want, weight, offset in zip(wanted, weights, offsets, strict=True):
        pools.append([want - offset, weight, 1])
        while len(pools) > 1 and pools[-2][0] >= pools[-1][0]:
            mean, total, members = pools.pop()
            last = pools[-1]
            last[0] = (last[0] * last[1] + mean * total) / (last[1] + total)
            last[1] += total
            last[2] += members
    means = [mean for mean, _, members in pools for _ in range(int(members))]
    return [float(mean + offset) for mean, offset in zip(means, offsets, strict=True)]


# Links -------------------------------------------------------------------------------------------


def _ports(
    chains: Mapping[Link, list[Key]], x: Mapping[Key, float], boxes: Mapping[str, Box]
) -> dict[tuple[Link, bool], float]:
    """Return how far from their nodes' centres links leave (True) and arrive (False)."""
    ends: dict[tuple[str, bool], list[tuple[float, Link]]] = {}
    for link, chain in chains.items():
        ends.setdefault((link[0], True), []).append((x[chain[1]], link))
        ends.setdefault((link[1], False), []).append((x[chain[-2]], link))
    ports = {}
    for (name, leaves), found in ends.items():
        found.sort()
        step = min(1.0, 0.6 * boxes[name].width / len(found))
        for place, (_, link) in enumerate(found):
            ports[link, leaves] = (place - (len(found) - 1) / 2) * step
    return ports


def _route(
    chain: list[Key],
    lanes: list[float],
    ports: Mapping[tuple[Link, bool], float],
    placed: Mapping[str, Box],
    bands: Sequence[tuple[float, float]],
    layer: Mapping[str, int],
) -> tuple[tuple[float, float], ...]:
    """Return the points of a link; in the bands of layers it goes straight down."""
    first, last = str(chain[0]), str(chain[-1])
    link = first, last
    source, target = placed[first], placed[last]
    begin, end = source.x + ports[link, True], target.x + ports[link, False]
    points = [(begin, source.y + source.height / 2), (begin, bands[layer[first]][1])]
    for number, lane in enumerate(lanes, layer[first] + 1):
        points += [(lane, bands[number][0]), (lane, bands[number][1])]
    points += [(end, bands[layer[last]][0]), (end, target.y - target.height / 2)]
    return tuple(points)
