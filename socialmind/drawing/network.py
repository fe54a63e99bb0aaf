"""Drawing a network: agents as dots, links as lines, where the agents are or as springs would."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection
from numpy.typing import NDArray

from socialmind.drawing.style import BLUE, GOLD, GREY

if TYPE_CHECKING:
    from socialmind.networks.table import NetworkTable

COLOURS = (BLUE, GOLD)
"""Of the agents of the source's population and of the target's."""
HEAD = 0.22
"""How much of a link, at the end that it leads to, is drawn thick where it has a direction."""


def draw_network(
    network: NetworkTable,
    axes: Axes,
    colour: Mapping[str, Any] | None = None,
    size: float = 14.0,
    seed: int = 0,
) -> None:
    """Draw the links of a network and the agents that it links.

    Agents that have places are drawn there, with links the short way as the plane of the paper has
    it; else where networkx's spring layout puts them. The end of a directed link is thick.

    Args:
        network: `society.friends`.
        axes: where to draw; its ticks are taken away.
        colour: by population, one colour for all or one for each of the living in order of birth.
        size: of a dot, in square points.
        seed: of the spring layout.
    """
    places = _places(network, seed)
    # Identities grow with birth, so they stand in order.
    sources = places[0][np.searchsorted(network.ends[0].id, network.source)]
    targets = places[-1][np.searchsorted(network.ends[-1].id, network.target)]
    lines = np.stack([sources, targets], axis=1)
    axes.add_collection(LineCollection(list(lines), colors=GREY, linewidths=0.5, zorder=1))
    if network.joins.directed:
        heads = lines.copy()
        heads[:, 0] += (1 - HEAD) * (lines[:, 1] - lines[:, 0])
        axes.add_collection(LineCollection(list(heads), colors=GREY, linewidths=1.4, zorder=1))
    for table, where, usual in zip(network.ends, places, COLOURS, strict=False):
        own = (colour or {}).get(table.shape.name, usual)
        axes.scatter(where[:, 0], where[:, 1], size, own, zorder=2, linewidths=0)
    axes.set(xticks=[], yticks=[])
    axes.set_aspect("equal", "datalim")
    axes.spines[:].set_visible(False)
    axes.margins(0.05)
    axes.autoscale_view()


def _places(network: NetworkTable, seed: int) -> list[NDArray[np.float64]]:
    """Return where the agents of each population that it links are drawn."""
    found = [np.column_stack([table.x, table.y]) for table in network.ends]
    if any(len(np.unique(where, axis=0)) > 1 for where in found):
        return found
    import networkx

    graph = network.to_networkx()
    layout = networkx.spring_layout(graph, seed=seed)
    nodes = np.array([layout[node] for node in graph.nodes]).reshape(-1, 2)
    return list(np.split(nodes, np.cumsum([len(table) for table in network.ends])[:-1]))
