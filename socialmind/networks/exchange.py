"""A network as data: its links as a table, as a graph of networkx, in files; degrees, components.

networkx and pandas are imported by the functions that give their objects.
"""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from coglogo_py.border.errors import shown
from socialmind.errors import SocialmindError

if TYPE_CHECKING:
    import pandas as pd

    from socialmind.society.table import Table


def columns_of_links(network: Any) -> dict[str, Any]:
    """Return identity, ends and fields of the links, in order of birth; array fields are left out.

    Returns:
        A sequence for each column: ``link``, ``source``, ``target`` and the fields.
    """
    columns = {"link": network.id, "source": network.source, "target": network.target}
    plain = [field.name for field in network.shape.fields.values() if field.size is None]
    return columns | {name: getattr(network, name) for name in plain}


def links_of_all(model: Any) -> dict[str, Any]:
    """Return the links of all networks of a model as one table, as runs record them.

    Returns:
        A list for each column: ``network``, ``link``, ``source``, ``target`` and the fields, None
        where a network's links have no such field.
    """
    parts = {name: columns_of_links(model.tables[name]) for name in model.networks}
    names = dict.fromkeys(column for part in parts.values() for column in part)
    table: dict[str, Any] = {
        "network": [n for n, p in parts.items() for _ in range(len(p["link"]))]
    }
    for column in names:
        table[column] = [
            value
            for part in parts.values()
            for value in np.asarray(part.get(column, [None] * len(part["link"])), object).tolist()
        ]
    return table


def edges(network: Any) -> pd.DataFrame:
    """Return the links as a data frame, one row each; `Network(start=…)` and `set_from` take it."""
    import pandas as pd

    columns = columns_of_links(network)
    del columns["link"]
    return pd.DataFrame({name: list(values) for name, values in columns.items()})


def graph(network: Any) -> Any:
    """Return the network as a graph of networkx, directed as it is.

    Nodes are agents, called by their identities; between two populations by population and
    identity, as ``"firms 3"``. Their attributes are ``agent``, the identity, and the fields, with
    two populations also ``population`` and ``bipartite``, 0 for the source's. Edges have the fields
    of links. What is None is left out.
    """
    import networkx

    joins = network.joins
    made = networkx.DiGraph() if joins.directed else networkx.Graph()
    names = []
    for side, table in enumerate(network.ends):
        known = table.id.tolist()
        several = joins.source != joins.target
        nodes = [f"{table.shape.name} {one}" for one in known] if several else known
        names.append(dict(zip(known, nodes, strict=True)))
        fields = _plain(table)
        if several:
            fields["population"] = [table.shape.name] * len(known)
            fields["bipartite"] = [side] * len(known)
        made.add_nodes_from(zip(nodes, _attributes({"agent": known} | fields), strict=True))
    sources = [names[0][one] for one in network.source.tolist()]
    targets = [names[-1][one] for one in network.target.tolist()]
    held = _attributes(_plain(network)) or [{} for _ in sources]
    made.add_edges_from(zip(sources, targets, held, strict=True))
    return made


def _plain(table: Table) -> dict[str, list[Any]]:
    fields = [field.name for field in table.shape.fields.values() if field.size is None]
    return {name: getattr(table, name).tolist() for name in fields}


def _attributes(columns: dict[str, list[Any]]) -> list[dict[str, Any]]:
    rows = zip(*columns.values(), strict=True)
    return [
        {name: value for name, value in zip(columns, row, strict=True) if value is not None}
        for row in rows
    ]


def save(network: Any, path: str | Path) -> Path:
    """Write a network into a file.

    Args:
        network: the network.
        path: ``.graphml`` for the graph with its agents, ``.csv`` or ``.parquet`` for the links.

    Returns:
        The path.

    Raises:
        SocialmindError: another suffix, or the file cannot be written.
    """
    path = Path(path)
    try:
        if path.suffix == ".graphml":
            import networkx

            networkx.write_graphml(graph(network), path)
        elif path.suffix == ".csv":
            edges(network).to_csv(path, index=False)
        elif path.suffix == ".parquet":
            edges(network).to_parquet(path, index=False)
        else:
            raise SocialmindError(
                f"{path}: found the suffix {shown(path.suffix)}; expected .graphml, .csv or "
                ".parquet"
            )
    except OSError as error:
        raise SocialmindError(f"{path}: {error.strerror or error}") from error
    return path


def components(network: Any) -> tuple[NDArray[np.int64], ...]:
    """Return to which component each agent belongs, whichever way links lead.

    Components are numbered from 0 in the order in which their first agents were born; between two
    populations those with agents of the source's come first.

    Returns:
        The numbers over the living of the source's population and, if that is another, over those
        of the target's.
    """
    tables = network.ends
    sizes = [len(table) for table in tables]
    places = []
    for table, offset in zip(tables, (0, sizes[0]), strict=False):
        place = np.full(len(table.slot_of), -1, np.int64)
        place[table.id] = np.arange(offset, offset + len(table))
        places.append(place)
    one, other = places[0][network.source], places[-1][network.target]
    label = np.arange(sum(sizes))
    while True:
        # Each takes the least label around it, then follows the labels to their roots.
        least = np.minimum(label[one], label[other])
        new = label.copy()
        for roots in (label[one], label[other], one, other):
            np.minimum.at(new, roots, least)
        while not np.array_equal(new, new[new]):
            new = new[new]
        if np.array_equal(new, label):
            break
        label = new
    numbers = np.unique(label, return_inverse=True)[1].astype(np.int64)
    return tuple(np.split(numbers, sizes[:1])) if len(sizes) == 2 else (numbers,)
