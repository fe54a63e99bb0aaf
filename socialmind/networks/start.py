"""What a network begins with: a generator of networkx, an edge list or a graph, as checked links.

networkx is imported when it is asked for: a model without networks starts without it.
"""

from __future__ import annotations

import hashlib
import inspect
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

from coglogo_py.border.errors import shown
from coglogo_py.border.numbers import is_number, is_truth, is_whole
from socialmind.errors import ModelError, SocialmindError, ValueRefusedError, called_at, nearest
from socialmind.fields import Field
from socialmind.language.shape import LinksShape
from socialmind.society.founding.beginning import Beginning, beginning_of, is_table
from socialmind.values import fitted_column

ENDS = ("source", "target")
Pair: TypeAlias = tuple[NDArray[np.int64], NDArray[np.int64]]
"""The identities of the sources and the targets of links."""


@dataclass(frozen=True)
class Generator:
    """A function of networkx that makes a graph; `generator` makes one."""

    name: str
    arguments: Mapping[str, Any]

    def check(self, parameters: Mapping[str, Any]) -> None:
        """Refuse texts that name no parameter, and what is no number.

        Raises:
            ModelError: so it is.
        """
        for name, value in self.arguments.items():
            if isinstance(value, str) and value not in parameters:
                raise ModelError(
                    f"{name}={value!r} of the generator {self.name!r}",
                    "a number or the name of a parameter",
                    nearest(value, parameters),
                )
            several = value if isinstance(value, list | tuple) else [value]
            if not isinstance(value, str) and not all(is_number(o) or is_truth(o) for o in several):
                raise ModelError(
                    f"{name}={shown(value)} of the generator {self.name!r}",
                    "a number or the name of a parameter",
                )

    def graph(self, sizes: tuple[int, ...], seed: int, value: Callable[[str], Any]) -> Any:
        """Return the graph that it makes.

        Args:
            sizes: how many agents there are: of the source's population and the target's, or one.
            seed: of the generator's draws, 32 bits.
            value: gives the value of a parameter by its name.

        Raises:
            SocialmindError: networkx has no such generator, or it refuses its arguments.
        """
        make = self._function(len(sizes) == 2)
        given = {n: value(v) if isinstance(v, str) else v for n, v in self.arguments.items()}
        takes = inspect.signature(make).parameters
        for names in (("n",),) if len(sizes) == 1 else (("n", "m"), ("n1", "n2")):
            if all(name in takes for name in names):
                given = dict(zip(names, sizes, strict=True)) | given
                break
        if "seed" in takes:
            given = {"seed": seed} | given
        try:
            return make(**given)
        except Exception as error:  # whatever networkx makes of the arguments
            written = ", ".join(f"{n}={shown(v)}" for n, v in given.items() if n != "seed")
            raise SocialmindError(
                f"networkx.{self.name}({written}): {type(error).__name__}: {error}"
            ) from error

    def _function(self, bipartite: bool) -> Callable[..., Any]:
        import networkx

        home: Any = networkx.bipartite if bipartite else networkx
        found = getattr(home, self.name, None)
        if not callable(found) or not self.name.endswith("_graph"):
            known = [name for name in dir(home) if name.endswith("_graph")]
            where = "networkx.bipartite" if bipartite else "networkx"
            hint = nearest(self.name, known)
            hint = hint if hint.startswith("did") else f"see the generators of {where}"
            raise SocialmindError(
                f"the generator {self.name!r}, which {where} does not have; {hint}"
            )
        make: Callable[..., Any] = found
        return make


def generator(name: str, **arguments: Any) -> Generator:
    """Name a function of networkx that makes the links with which a network begins.

    Args:
        name: as networkx has it, ``"watts_strogatz_graph"``; between two populations, one of
            ``networkx.bipartite``, as ``"random_graph"``.
        arguments: those that it takes. A text is the name of a parameter of the model, which gives
            the value. How many nodes there are (`n`; between two populations `n` and `m`) is how
            many agents there are, and `seed` comes from the society's seed, unless they are given.

    >>> generator("watts_strogatz_graph", k=4, p="rewiring").name
    'watts_strogatz_graph'
    """
    if not isinstance(name, str):
        found = f"generator({shown(name)})"
        raise ModelError(found, "the name of a generator of networkx", None, *called_at())
    return Generator(name, arguments)


@dataclass(frozen=True)
class Links:
    """Links to make: the identities of their ends, and values of their fields.

    Attributes:
        sources, targets: identities of living agents; no two links join the same.
        fields: by name the values, and which of them are there, not None.
    """

    sources: NDArray[np.int64]
    targets: NDArray[np.int64]
    fields: Mapping[str, tuple[NDArray[Any], NDArray[np.bool_]]]


class Reader:
    """Reads links for a network, and names what is wrong with them.

    Args:
        name: the network's.
        joins: what its links join.
        fields: those of its links.
        ends: the identities of the living of the source's population and of the target's.
    """

    def __init__(
        self,
        name: str,
        joins: LinksShape,
        fields: Mapping[str, Field],
        ends: Pair,
    ) -> None:
        self.name, self.joins, self.fields = name, joins, fields
        self.ends = dict(zip(ENDS, ends, strict=True))
        self.whose = {"source": joins.source, "target": joins.target}

    def read(self, source: Any, folder: Callable[[], Path]) -> Links:
        """Return the links of an edge list, a file or a table, or of a graph of networkx.

        Args:
            source: which.
            folder: gives the model's, beside which files lie.

        Raises:
            SocialmindError: it is none of these, or a row is wrong, with the file and the row.
        """
        if is_graph(source):
            return self.of_graph(source)
        if not is_table(source):
            raise ValueRefusedError(
                f"links of {self.name!r}: found {shown(source)}; expected an edge list (a CSV or "
                "Parquet file, a table with the columns source and target) or a graph of networkx"
            )
        ends = {end: Field(end, int, "i8", 0) for end in ENDS}
        found = beginning_of(source, self.name, ends | dict(self.fields), folder)
        return self.of_table(found)

    def of_table(self, table: Beginning) -> Links:
        """Return the links of a table, one a row.

        Raises:
            SocialmindError: a row is wrong.
        """
        for end in ENDS:
            if end not in table.columns:
                raise ValueRefusedError(
                    f"{table.what}: no column {end!r}; expected the identities of the agents that "
                    "are linked, in the columns source and target"
                )
        sources, targets = (
            fitted_column(
                Field(end, int, "i8", 0),
                table.columns[end],
                table.count,
                f"{table.what}, column {end!r}",
                table.row,
            )[0]
            for end in ENDS
        )
        self._check((sources, targets), lambda row: f"{table.what}, {table.row(row)}")
        columns = {name: one for name, one in table.columns.items() if name not in ENDS}
        return Links(sources, targets, self._fitted(columns, table.count, table.what, table.row))

    def of_graph(self, graph: Any, mends: bool = False) -> Links:
        """Return the links of a graph of networkx.

        Nodes that have an attribute ``agent`` stand for the agents of these identities; nodes that
        are whole numbers are identities themselves; others stand for the agents in order of birth
        (between two populations those with ``bipartite=0`` for the source's, the others for the
        target's). In a directed network an undirected edge is a link each way. Attributes of edges
        that are called as fields are their values.

        Args:
            graph: the graph.
            mends: leave out loops, and all but one of parallel edges, as generators make them.

        Raises:
            SocialmindError: nodes are no agents, or edges cannot be links.
        """
        what = f"the graph for {self.name!r}"
        if graph.is_directed() and not self.joins.apart and not mends:
            raise ValueRefusedError(
                f"{what}: found a directed graph; expected an undirected one; write "
                "graph.to_undirected(), or declare the network with directed=True"
            )
        places = self._places(graph, what, mends)
        edges = list(graph.edges(data=True))
        one, other = (np.array([places[edge[side]] for edge in edges], np.int64) for side in (0, 1))
        if self.joins.source != self.joins.target:
            turned = np.array([graph.nodes[edge[0]]["bipartite"] == 1 for edge in edges], bool)
            one, other = np.where(turned, other, one), np.where(turned, one, other)
        elif self.joins.directed and not graph.is_directed():
            one, other = np.append(one, other), np.append(other, one)
            edges += edges
        if mends:
            kept = self._proper((one, other))
            one, other = one[kept], other[kept]
            edges = [edges[place] for place in kept.tolist()]

        def row(place: int) -> str:
            return f"edge {edges[place][0]!r}–{edges[place][1]!r}"

        self._check((one, other), lambda place: f"{what}, {row(place)}")
        held = {name for edge in edges for name in edge[2]} & set(self.fields)
        columns = {
            name: [edge[2].get(name, self.fields[name].default) for edge in edges]
            for name in self.fields
            if name in held
        }
        return Links(one, other, self._fitted(columns, len(edges), what, row))

    def _places(self, graph: Any, what: str, in_order: bool) -> dict[Any, int]:
        """Return the identity of the agent that each node stands for."""
        agents = dict(graph.nodes(data="agent"))
        if agents and not in_order and all(is_whole(one) for one in agents.values()):
            return agents  # as `to_networkx` names them
        whole = all(isinstance(node, int | np.integer) for node in graph.nodes)
        if self.joins.source == self.joins.target:
            parts = {"source": list(graph.nodes)}
            if whole and not in_order:
                return {node: int(node) for node in graph.nodes}
        else:
            parts = {end: [] for end in ENDS}
            for node, side in graph.nodes(data="bipartite"):
                if side not in (0, 1):
                    raise ValueRefusedError(
                        f"{what}: the node {node!r} with bipartite={side!r}; expected 0 for agents "
                        f"of {self.joins.source!r}, 1 for those of {self.joins.target!r}"
                    )
                parts[ENDS[side]].append(node)
        places: dict[Any, int] = {}
        for end, nodes in parts.items():
            known = self.ends[end].tolist()
            if len(nodes) != len(known):
                raise ValueRefusedError(
                    f"{what}: found {len(nodes)} nodes for agents of {self.whose[end]!r}; "
                    f"expected {len(known)}, one for each"
                )
            places |= dict(zip(nodes, known, strict=True))
        return places

    def _keys(self, pairs: Pair) -> NDArray[np.int64]:
        """Return a number for each pair; pairs that may be linked once have the same."""
        one, other = pairs
        if not self.joins.apart:
            one, other = np.minimum(one, other), np.maximum(one, other)
        return one * (other.max(initial=0) + 1) + other

    def _proper(self, pairs: Pair) -> NDArray[np.int64]:
        """Return the places of the first of each pair, without loops."""
        _, first = np.unique(self._keys(pairs), return_index=True)
        first = np.sort(first)
        loops = self.joins.source == self.joins.target
        return first[pairs[0][first] != pairs[1][first]] if loops else first

    def _check(self, pairs: Pair, place: Callable[[int], str]) -> None:
        """Refuse ends that do not live, loops and pairs that come twice."""
        for end, identities in zip(ENDS, pairs, strict=True):
            known = self.ends[end]
            wrong = np.flatnonzero(~np.isin(identities, known))
            if len(wrong):
                row = int(wrong[0])
                some = f", {known[0]} … {known[-1]}" if len(known) else "; none lives"
                raise ValueRefusedError(
                    f"{place(row)}: found {identities[row]} as {end}; expected the identity of a "
                    f"living agent of {self.whose[end]!r}{some}"
                )
        one, other = pairs
        loops = np.flatnonzero(one == other)
        if len(loops) and self.joins.source == self.joins.target:
            row = int(loops[0])
            raise ValueRefusedError(
                f"{place(row)}: found a link of agent {one[row]} with itself; expected two agents"
            )
        keys = self._keys(pairs)
        _, first, again = np.unique(keys, return_index=True, return_inverse=True)
        firsts = first[again]
        twice = np.flatnonzero(firsts != np.arange(len(one)))
        if len(twice):
            row = int(twice[0])
            before = place(int(firsts[row])).rpartition(", ")[2]
            raise ValueRefusedError(
                f"{place(row)}: found {one[row]} and {other[row]} linked again, as in {before}; "
                "expected one link between two"
            )

    def _fitted(
        self, columns: Mapping[str, Any], count: int, what: str, row: Callable[[int], str]
    ) -> dict[str, tuple[NDArray[Any], NDArray[np.bool_]]]:
        return {
            name: fitted_column(self.fields[name], values, count, f"{what}, column {name!r}", row)
            for name, values in columns.items()
        }


def is_graph(source: Any) -> bool:
    """Return whether this is a graph of networkx, without importing it."""
    return hasattr(source, "is_directed") and hasattr(source, "edges") and hasattr(source, "nodes")


def seed_of(seed: int, network: str) -> int:
    """Return the seed of a network's generator, 32 bits, from the society's."""
    digest = hashlib.sha256(f"{seed}\n{network}".encode()).digest()
    return int.from_bytes(digest[:4], "little")
