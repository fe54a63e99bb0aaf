"""Networks as data: against what networkx says, there and back, recorded and drawn."""

from pathlib import Path

import networkx as nx
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from matplotlib.figure import Figure

from socialmind import Agent, Link, Model, Network, Population, SocialmindError
from socialmind.catalogue import load_model
from socialmind.drawing.network import draw_network
from socialmind.errors import UnknownNameError
from socialmind.experiments import Run, replay, resume, run
from socialmind.observation import network_columns


class Person(Agent):
    wealth: float = 1.0
    home: int | None = None


class Firm(Agent):
    staff: int = 0


class Tie(Link):
    trust: float = 1.0
    since: int | None = None


class Town(Model):
    people = Population(Person, 9)
    firms = Population(Firm, 4)
    friends = Network(people, Tie)
    follows = Network(people, directed=True)
    jobs = Network(people, firms, Tie)


def linked(pairs, dead):
    """A town in which some are linked on all networks, and one has died."""
    town = Town(compiled=False)
    for one, other in pairs:
        if one != other:
            town.friends.link(one, other).trust = one + other / 16
            town.follows.link(one, other)
        town.jobs.link(one, other % 4).since = one if other % 2 else None
    town.people[dead].die()
    town.people[(dead + 1) % 9].home = 3
    town.advance(1)
    return town


PAIRS = st.lists(st.tuples(st.integers(0, 8), st.integers(0, 8)), max_size=20)


@settings(max_examples=60)
@given(PAIRS, st.integers(0, 8))
def test_graphs_degrees_and_components_are_those_of_networkx(pairs, dead):
    town = linked(pairs, dead)
    for network in (town.friends, town.follows, town.jobs):
        graph = network.to_networkx()
        plain = graph.to_undirected() if graph.is_directed() else graph
        parts = list(nx.connected_components(plain))
        found = {}
        for table in network.ends:
            name = table.shape.name
            nodes = [f"{name} {one}" if network is town.jobs else one for one in table.id.tolist()]
            assert [graph.degree(node) for node in nodes] == network.degrees(name).tolist()
            found |= dict(zip(nodes, network.components(name).tolist(), strict=True))
        assert list(found) == list(graph)
        labels = {frozenset(found[node] for node in part) for part in parts}
        assert all(len(label) == 1 for label in labels) and len(labels) == len(parts)
        firsts = [min(list(found).index(node) for node in part) for part in parts]
        order = [found[list(found)[place]] for place in sorted(firsts)]
        assert order == list(range(len(parts)))
    follows = town.follows.to_networkx()
    assert [
        follows.out_degree(one) for one in town.people.id
    ] == town.follows.out_degrees().tolist()
    assert [follows.in_degree(one) for one in town.people.id] == town.follows.in_degrees().tolist()


@settings(max_examples=25)
@given(PAIRS, st.integers(0, 8))
def test_what_goes_out_comes_back(tmp_path_factory, pairs, dead):
    folder = tmp_path_factory.mktemp("exchange")
    town = linked(pairs, dead)
    for name in ("friends", "follows", "jobs"):
        network = town.tables[name]

        def rows(network=network, name=name):
            ends = zip(network.source.tolist(), network.target.tolist(), strict=True)
            ends = [tuple(sorted(pair)) if name == "friends" else pair for pair in ends]
            fields = [getattr(network, field).tolist() for field in network.shape.fields]
            return sorted(zip(ends, *fields, strict=True), key=str)

        before = rows()
        network.save(folder / f"{name}.graphml")
        graphs = (network.to_networkx(), nx.read_graphml(folder / f"{name}.graphml"))
        for way in (
            *graphs,
            network.edges(),
            *(folder / f"{name}{s}" for s in (".csv", ".parquet")),
        ):
            if isinstance(way, Path):
                network.save(way)
            network.set_from(way)
            assert rows() == before


def test_a_graph_has_the_fields_of_agents_and_links():
    town = linked([(1, 2), (2, 6)], 6)
    graph = town.friends.to_networkx()
    assert graph.edges[1, 2] == {"trust": 1.125}
    assert graph.nodes[7] == {
        "agent": 7, "x": 0.0, "y": 0.0, "heading": 0.0, "wealth": 1.0, "home": 3
    }  # fmt: skip
    firm = town.jobs.to_networkx().nodes["firms 2"]
    assert firm["population"] == "firms" and firm["bipartite"] == 1 and firm["agent"] == 2


def test_columns_of_agents():
    town = linked([(1, 2), (2, 3), (5, 0)], 6)
    columns = network_columns(town.people)
    assert list(columns) == [
        "degree_friends", "component_friends", "degree_follows", "out_degree_follows",
        "in_degree_follows", "component_follows", "degree_jobs", "component_jobs",
    ]  # fmt: skip
    assert columns["degree_friends"].tolist() == [1, 1, 2, 1, 0, 1, 0, 0]
    assert columns["component_friends"].tolist() == [0, 1, 1, 1, 2, 0, 3, 4]
    assert list(network_columns(town.firms)) == ["degree_jobs", "component_jobs"]


def test_what_cannot_be_asked_or_saved_is_refused(tmp_path):
    town = Town(compiled=False)
    with pytest.raises(SocialmindError, match=r"found the suffix '.gml'; expected .graphml, .csv"):
        town.friends.save(tmp_path / "friends.gml")
    with pytest.raises(SocialmindError, match=r"nowhere/f.csv: "):
        town.friends.save(tmp_path / "nowhere" / "f.csv")
    with pytest.raises(UnknownNameError, match="links no agents of 'firms'; there is people"):
        town.friends.degrees("firms")
    with pytest.raises(UnknownNameError, match="'friends', which is not directed"):
        town.friends.in_degrees()


def test_they_are_drawn_where_agents_are_or_as_springs_put_them():
    town = linked([(1, 2), (2, 3), (5, 0)], 6)
    for network in (town.friends, town.follows, town.jobs):
        axes = Figure().subplots()
        draw_network(network, axes, {"people": town.people.wealth})
        dots = [one for one in axes.collections if len(one.get_offsets()) > 1]
        assert [len(one.get_offsets()) for one in dots] == [len(table) for table in network.ends]
    town.people.x = np.arange(8.0)
    axes = Figure().subplots()
    draw_network(town.friends, axes)
    lines = [path.vertices[:, 0].tolist() for path in axes.collections[0].get_paths()]
    assert lines == [[1.0, 2.0], [2.0, 3.0], [5.0, 0.0]]


MODEL = '''"""Who meets."""
from socialmind import Agent, Link, Model, Network, Population, each


class Person(Agent):
    pass


class Tie(Link):
    age: int = 0


def meet(person, model, rng):
    other = model.people.one_of(rng)
    if other != person and rng.random() < 0.1:
        model.ties.link(person, other)


def fade(tie, model, rng):
    tie.age += 1
    if rng.random() < 0.05:
        tie.die()


class Meeting(Model):
    people = Population(Person, 20)
    ties = Network(people, Tie)
    schedule = (each(people, meet), each(ties, fade))
    record_links = True
'''


def test_links_are_recorded_alike_however_often_a_run_is_stopped(tmp_path):
    home = tmp_path / "meeting"
    home.mkdir()
    (home / "model.py").write_text(MODEL)
    kind = load_model(home)
    how = {"seed": 2, "every": 3, "agents_every": 6, "compiled": False}
    whole = run(kind, ticks=40, out=tmp_path / "whole", **how)
    longer = run(kind, ticks=17, out=tmp_path / "longer", **how)
    resume(longer, ticks=40)
    links = Run(whole).links
    assert links.columns.tolist() == ["tick", "network", "link", "source", "target", "age"]
    assert links["tick"].unique().tolist() == [6, 12, 18, 24, 30, 36, 40]
    for name in ("series", "agents", "links"):
        assert (whole / f"{name}.parquet").read_bytes() == (longer / f"{name}.parquet").read_bytes()
    assert replay(whole).equal
    assert Run(whole).agents.columns.tolist() == ["tick", "agent", "x", "y"]
    (home / "model.py").write_text(MODEL.replace("record_links = True", "ticks = 3"))
    without = Run(run(load_model(home), out=tmp_path / "without", compiled=False))
    with pytest.raises(SocialmindError, match=r"has no table of links; .* record_links = True"):
        without.links  # noqa: B018
