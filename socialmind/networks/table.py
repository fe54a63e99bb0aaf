"""The links of a network of a running model, as rules and users have them."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from coglogo_py.border.errors import shown
from socialmind.agents import bookkeeping
from socialmind.agents.rows import Row
from socialmind.columns import column, columns_of
from socialmind.errors import UnknownNameError, nearest
from socialmind.fields import presence
from socialmind.language.shape import LinksShape, PopulationShape
from socialmind.language.typing.calls.neighbours import AGENTS
from socialmind.networks import adjacency, exchange
from socialmind.networks.linked import LinkedSet, slot_in
from socialmind.networks.start import Generator, Links, Reader, seed_of
from socialmind.society.founding.beginning import is_table
from socialmind.society.table import Table

if TYPE_CHECKING:
    import pandas as pd

    from socialmind.agents.running import Running
    from socialmind.society.founding.blueprint import TableForm


class NetworkTable(Table):
    """A network of a running model.

    It is what `model.friends` gives: the number of links, a loop over them in order of birth, each
    field as a column, and what is asked of agents: who is linked with whom.

    Args:
        model: the model.
        shape: the shape of the links.
        form: what its tables have in common in all societies.
    """

    joins: LinksShape

    def __init__(self, model: Running, shape: PopulationShape, form: TableForm) -> None:
        super().__init__(model, shape, form, 0, None)
        assert shape.links is not None  # a network's
        object.__setattr__(self, "joins", shape.links)
        self._joined = np.zeros((len(self.rows), 2), np.int64)

    def settle_in(self, tables: Mapping[str, Table]) -> None:
        """Take note of the agents that are linked; their tables let the network know of deaths."""
        self._sources, self._targets = tables[self.joins.source], tables[self.joins.target]
        for table in dict.fromkeys((self._sources, self._targets)):
            table.joined_by(self)
        room = min(16 * sum(map(len, self.ends)), adjacency.AT_FIRST) + bookkeeping.MARGIN
        self.reserve(room, room)
        self.build_index()

    # Links ------------------------------------------------------------------------------------

    def link(self, source: Any, target: Any) -> Any:
        """Return the link between two agents, a new one unless they are linked.

        Raises:
            ValueError: one of them is dead, or both are the same.
        """
        one, other = self._ends(source, target)
        if not (self._sources.alive[one] and self._targets.alive[other]):
            raise ValueError("link() of an agent that is dead")
        if one == other and self._sources is self._targets:
            raise ValueError("link() of an agent with itself")
        slot = self._slot_between(one, other)
        if slot < 0:
            slot = self._place()
            self.rows[slot] = self.default[0]
            self._named(slot)
            self.columns["_source"][slot] = self._sources.columns["_id"][one]
            self.columns["_target"][slot] = self._targets.columns["_id"][other]
            self._joined[slot] = one, other
            identity = int(self.columns["_id"][slot])
            if not (
                adjacency.tie(self._heads_out, self._ties_out, one, identity, slot, other)
                and adjacency.tie(self._heads_in, self._ties_in, other, identity, slot, one)
            ):
                self.build_index()
        return self.row_class(self, slot)

    def unlink(self, source: Any, target: Any) -> None:
        """End the link between two agents, if there is one."""
        slot = self._slot_between(*self._ends(source, target))
        if slot >= 0:
            self._cut(slot)

    def linked(self, source: Any, target: Any) -> bool:
        """Say whether two agents are linked; in a directed network, from the first to the second.

        The shorter of their lists of links is looked through.
        """
        return self._slot_between(*self._ends(source, target)) >= 0

    def between(self, source: Any, target: Any) -> Any:
        """Return the link between two agents, or None."""
        slot = self._slot_between(*self._ends(source, target))
        return None if slot < 0 else self.row_class(self, slot)

    def end_of(self, slot: int, name: str) -> Any:
        """Return the agent at an end of the link in a slot, "source" or "target"."""
        ends = self._sources if name == "source" else self._targets
        return ends[self.columns[f"_{name}"].item(slot)]

    def other_end(self, slot: int, agent: Any) -> Any:
        """Return the agent at the other end of the link in a slot."""
        if agent._table is self._sources and agent.id == self.columns["_source"][slot]:
            return self.end_of(slot, "target")
        if agent._table is self._targets and agent.id == self.columns["_target"][slot]:
            return self.end_of(slot, "source")
        raise ValueError("other() of an agent that the link does not join")

    def _ends(self, source: Any, target: Any) -> tuple[int, int]:
        """Return the slots of two agents; users give identities too."""
        return slot_in(self._sources, source), slot_in(self._targets, target)

    def _slot_between(self, one: int, other: int) -> int:
        out, into = (self._heads_out, self._ties_out), (self._heads_in, self._ties_in)
        return int(adjacency.link_between(*out, *into, one, other))

    def create(self) -> Any:
        """Refuse: a link joins two agents."""
        raise ValueError(f"create() of a link; write society.{self.shape.name}.link(one, other)")

    def hatch(self, parent: Any, keep_groups: bool = False) -> Any:
        """Refuse: between two agents there is one link."""
        raise ValueError(f"hatch() of a link; write society.{self.shape.name}.link(one, other)")

    def die(self, agent: Any) -> None:
        """End a link."""
        if self.alive[agent._slot]:
            self._cut(agent._slot)

    def _cut(self, slot: int) -> None:
        identity = int(self.columns["_id"][slot])
        one, other = self._joined[slot].tolist()
        adjacency.untie(self._heads_out, self._ties_out, one, identity)
        adjacency.untie(self._heads_in, self._ties_in, other, identity)
        bookkeeping.died(self.counters, self.alive, self.slot_of, slot, identity)

    def end_links_of(self, table: Table, slot: int) -> None:
        """End the links of an agent that dies, the youngest first.

        Args:
            table: its population.
            slot: its slot there.
        """
        out, into = (self._heads_out, self._ties_out), (self._heads_in, self._ties_in)
        for ends, (heads, ties) in ((self._sources, out), (self._targets, into)):
            while ends is table and heads[slot, adjacency.DEGREE] > 0:
                last = heads[slot, adjacency.BEGIN] + heads[slot, adjacency.DEGREE] - 1
                self._cut(int(ties[last, adjacency.SLOT]))

    # Who is linked with whom ------------------------------------------------------------------

    def neighbours(self, agent: Any) -> list[Any]:
        """Return those whom an agent is linked with, in the order of the links' birth.

        Args:
            agent: an agent, or the identity of one of the source's population.

        Raises:
            UnknownNameError: the network is directed: there are `successors` and `predecessors`.
        """
        return list(self.linked_set(self._list_of(agent, "neighbours"), "agents", agent))

    def links_of(self, agent: Any) -> list[Any]:
        """Return the links of an agent, in the order of their birth; `neighbours` has the rest."""
        return list(self.linked_set(self._list_of(agent, "links_of"), "links", agent))

    def successors(self, agent: Any) -> list[Any]:
        """Return those whom an agent's links lead to, in the order of the links' birth."""
        return list(self.linked_set(self._directed("out", "successors"), "agents", agent))

    def predecessors(self, agent: Any) -> list[Any]:
        """Return those from whom links lead to an agent, in the order of the links' birth."""
        return list(self.linked_set(self._directed("in", "predecessors"), "agents", agent))

    def links_from(self, agent: Any) -> list[Any]:
        """Return the links that lead from an agent, in the order of their birth."""
        return list(self.linked_set(self._directed("out", "links_from"), "links", agent))

    def links_to(self, agent: Any) -> list[Any]:
        """Return the links that lead to an agent, in the order of their birth."""
        return list(self.linked_set(self._directed("in", "links_to"), "links", agent))

    def linked_set(self, side: str, what: str, agent: Any) -> LinkedSet:
        """Return whom or what the list of an agent holds, as rules ask for it.

        Args:
            side: "out" for the links that it is the source of, "in" for the others; in a network
                that does not tell them apart "out" is all.
            what: "agents" at the other ends, or "links".
            agent: whose list.
        """
        of, ends = self._sources, self._targets
        lists = self._heads_out, self._ties_out
        if side == "in":
            of, ends, lists = ends, of, (self._heads_in, self._ties_in)
        return LinkedSet(self, lists, self if what == "links" else ends, slot_in(of, agent))

    def _list_of(self, agent: Any, asked: str) -> str:
        """Return which list holds all links of an agent."""
        if self.joins.directed and self._sources is self._targets:
            instead = "links_from() or links_to()" if asked == "links_of" else _BOTH_WAYS
            name = self.shape.name
            raise UnknownNameError(f"{asked}() of the directed network {name!r}; write {instead}")
        is_target = isinstance(agent, Row) and agent._table is self._targets
        return "in" if is_target and self.joins.apart else "out"

    def _directed(self, side: str, asked: str) -> str:
        """Return a list of sources or of targets, where these are told apart."""
        if not self.joins.apart:
            instead = "links_of()" if asked.startswith("links") else "neighbours()"
            raise UnknownNameError(
                f"{asked}() of the network {self.shape.name!r}, which is not directed; "
                f"write {instead}"
            )
        return side

    # All links at once ------------------------------------------------------------------------

    def begin(self, start: Any, folder: Callable[[], Path]) -> None:
        """Make the links that the network begins with, before any setup.

        Args:
            start: a `Generator`, an edge list or a graph.
            folder: gives the model's.

        Raises:
            SocialmindError: there is no such generator or file, or a link is wrong.
        """
        if isinstance(start, Generator):
            ends = dict.fromkeys((self._sources, self._targets))
            sizes = tuple(len(table) for table in ends)
            seed = seed_of(self.model.seed, self.shape.name)
            graph = start.graph(sizes, seed, lambda name: getattr(self.model, name))
            links = self._reader.of_graph(graph, mends=True)
        else:
            links = self._reader.read(start, folder)
        self.replace(links)

    def set_from(self, data: Any, by: str | None = None) -> None:
        """End all links and make others, or set fields of links.

        Args:
            data: a graph of networkx, or an edge list: a CSV or Parquet file, a data frame, an
                Arrow table or a mapping with the columns source and target and those of fields. A
                table without these two sets fields, as of a population.
            by: then the column that holds the links' identities.

        Raises:
            SocialmindError: a row or an edge is wrong; nothing has changed then.
        """
        of_fields = is_table(data) and not isinstance(data, str | Path)
        if of_fields and not {"source", "target"} & set(columns_of(data, "links")):
            super().set_from(data, by)
            return
        self.replace(self._reader.read(data, Path))

    @property
    def _reader(self) -> Reader:
        ends = (np.asarray(self._sources.id), np.asarray(self._targets.id))
        return Reader(self.shape.name, self.joins, self.shape.fields, ends)

    def replace(self, links: Links) -> None:
        """End all links and make others, which act from the next tick on.

        Args:
            links: checked.
        """
        counters, count = self.counters, len(links.sources)
        self.alive[:] = False
        self.slot_of[: counters[bookkeeping.NEXT_ID]] = -1
        counters[bookkeeping.ALIVE] = 0
        self.settle()
        first = int(counters[bookkeeping.NEXT_ID])
        self.reserve(count, first + count)
        end = int(counters[bookkeeping.FREE])
        slots = self.free[end - count : end][::-1].copy()
        identities = np.arange(first, first + count)
        self.order[:count] = slots
        self.alive[slots] = True
        self.slot_of[identities] = slots
        counters[bookkeeping.FREE] = end - count
        counters[bookkeeping.NEXT_ID] = first + count
        for part in (bookkeeping.COUNT, bookkeeping.ENTRIES, bookkeeping.ALIVE):
            counters[part] = count
        self.rows[slots] = self.default[0]
        ends = {"_slot": slots, "_id": identities, "_source": links.sources}
        for name, values in (ends | {"_target": links.targets}).items():
            self.columns[name][slots] = values
        for name, (values, there) in links.fields.items():
            self.columns[name][slots] = values
            if self.shape.fields[name].optional:
                self.columns[presence(name)][slots] = there
        self.build_index()

    # Columns ----------------------------------------------------------------------------------

    def __getattr__(self, name: str) -> NDArray[Any]:
        """Return a field of the links, or the identities of their ends, in order of birth."""
        if name in ("source", "target") and "shape" in self.__dict__:
            ends = self.columns[f"_{name}"][self.slots]
            return column(ends, f"society.{self.shape.name}.{name}")
        if name in AGENTS and "shape" in self.__dict__:
            raise UnknownNameError(
                f"{name}() of the network {self.shape.name!r}, whose links are nowhere; ask the "
                f"agents: society.{self.joins.source}.{name}(…)"
            )
        return super().__getattr__(name)

    # As data ----------------------------------------------------------------------------------

    @property
    def ends(self) -> tuple[Table, ...]:
        """The populations whose agents it links: the source's and, if another, the target's."""
        return tuple(dict.fromkeys((self._sources, self._targets)))

    def degrees(self, population: str | None = None) -> NDArray[np.int64]:
        """Return how many links each of the living has, in order of birth; both ways if directed.

        Args:
            population: whose agents; the source's unless given.
        """
        table = self._end(population)
        counts = np.zeros(len(table.rows), np.int64)
        if table is self._sources:
            counts += self._heads_out[:, adjacency.DEGREE]
        if table is self._targets and self.joins.apart:
            counts += self._heads_in[:, adjacency.DEGREE]
        return counts[table.slots]

    def out_degrees(self) -> NDArray[np.int64]:
        """Return how many links lead from each living agent of the source's population."""
        self._directed("out", "out_degrees")
        return self._heads_out[self._sources.slots, adjacency.DEGREE]

    def in_degrees(self) -> NDArray[np.int64]:
        """Return how many links lead to each living agent of the target's population."""
        self._directed("in", "in_degrees")
        return self._heads_in[self._targets.slots, adjacency.DEGREE]

    def components(self, population: str | None = None) -> NDArray[np.int64]:
        """Return the number of the component that each of the living belongs to.

        Two agents are in one component if links lead from one to the other, whichever way.
        Components are numbered from 0 in the order in which their first agents were born.

        Args:
            population: whose agents; the source's unless given.
        """
        return exchange.components(self)[self.ends.index(self._end(population))]

    def edges(self) -> pd.DataFrame:
        """Return the links as a data frame: source, target and the fields, in order of birth."""
        return exchange.edges(self)

    def to_networkx(self) -> Any:
        """Return a graph of networkx: nodes are identities with the agents' fields, edges links.

        Between two populations nodes are called as ``"firms 3"``.
        """
        return exchange.graph(self)

    def save(self, path: str | Path) -> Path:
        """Write the network: ``.graphml`` with its agents, ``.csv`` or ``.parquet`` the links.

        Raises:
            SocialmindError: another suffix, or the file cannot be written.
        """
        return exchange.save(self, path)

    def _end(self, population: str | None) -> Table:
        """Return one of the populations that it links."""
        known = {table.shape.name: table for table in self.ends}
        if population is not None and population not in known:
            raise UnknownNameError(
                f"the network {self.shape.name!r} links no agents of {shown(population)}; "
                f"{nearest(str(population), known)}"
            )
        return self._sources if population is None else known[population]

    # The index --------------------------------------------------------------------------------

    def link_arrays(self) -> dict[str, NDArray[Any]]:
        """Return the lists of links, and the slots of the agents that each link joins."""
        arrays = {"heads_out": self._heads_out, "ties_out": self._ties_out, "joined": self._joined}
        if self.joins.apart:
            arrays |= {"heads_in": self._heads_in, "ties_in": self._ties_in}
        return arrays

    def build_index(self) -> None:
        """Build the lists of links anew from the rows."""
        slots = self.slots
        links = self.columns["_id"][slots]
        sources = self._sources.slot_of[self.columns["_source"][slots]]
        targets = self._targets.slot_of[self.columns["_target"][slots]]
        self._joined = np.zeros((len(self.rows), 2), np.int64)
        self._joined[slots, 0], self._joined[slots, 1] = sources, targets
        count = len(self._sources.rows)
        if self.joins.apart:
            lists = adjacency.built(sources, links, slots, targets, count)
            self._heads_out, self._ties_out = lists
            lists = adjacency.built(targets, links, slots, sources, len(self._targets.rows))
        else:
            ends, others = (
                np.column_stack(both).ravel() for both in ((sources, targets), (targets, sources))
            )
            lists = adjacency.built(ends, np.repeat(links, 2), np.repeat(slots, 2), others, count)
            self._heads_out, self._ties_out = lists
        self._heads_in, self._ties_in = lists

    def follow_ends(self) -> None:
        """Have a list for each slot of agents, of which there are more now."""
        self._heads_out = _with_lists(self._heads_out, len(self._sources.rows))
        if self.joins.apart:
            self._heads_in = _with_lists(self._heads_in, len(self._targets.rows))
        else:
            self._heads_in = self._heads_out

    def reserve(self, slots: int, identities: int) -> None:
        """Have at least so many slots and identities."""
        super().reserve(slots, identities)
        self._joined = np.concatenate(
            [self._joined, np.zeros((len(self.rows) - len(self._joined), 2), np.int64)]
        )

    @property
    def short_of_room(self) -> bool:
        """Whether the next tick could bring more links than there is room for."""
        return super().short_of_room or self._short_of_space

    @property
    def _short_of_space(self) -> bool:
        return any(adjacency.short_of_space(ties) for ties in (self._ties_out, self._ties_in))

    def grow(self) -> None:
        """Make room for links, and for their lists, as they are short."""
        if super().short_of_room:
            super().grow()
        if self._short_of_space:
            self.build_index()

    def odd_rows(self, rows: NDArray[Any], state: Mapping[str, NDArray[Any]]) -> str | None:
        """Say what is odd about the links of a state, if anything."""
        ends = []
        for name, of in (("_source", self.joins.source), ("_target", self.joins.target)):
            known = np.asarray(state[f"{of}.slot_of"])
            end = rows[name]
            if len(end) and (end.min() < 0 or end.max() >= len(known) or (known[end] < 0).any()):
                return "links of agents that do not live"
            ends.append(end)
        if not self.joins.directed and not self.joins.apart:
            ends = [np.minimum(*ends), np.maximum(*ends)]
        if len(np.unique(np.column_stack(ends), axis=0)) != len(rows):
            return "two links between the same agents"
        if self.joins.source == self.joins.target and (ends[0] == ends[1]).any():
            return "a link of an agent with itself"
        return None


_BOTH_WAYS = "successors() or predecessors()"


def _with_lists(heads: NDArray[np.int64], agents: int) -> NDArray[np.int64]:
    return np.concatenate([heads, np.zeros((agents - len(heads), 3), np.int64)])
