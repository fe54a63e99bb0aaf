"""What networks begin with, and what is refused: one line with the place."""

import re

import networkx as nx
import numpy as np
import pandas as pd
import pytest

from socialmind import (
    Agent,
    Link,
    Model,
    ModelError,
    Network,
    Population,
    SocialmindError,
    generator,
    once,
    parameter,
)
from socialmind.errors import UnknownNameError, ValueRefusedError
from socialmind.sources.loading import load_file
from socialmind.sources.provenance import sources_of


class Person(Agent):
    wealth: float = 1.0


class Firm(Agent):
    pass


class Job(Link):
    wage: float = 1.0
    since: int | None = None


def count(model):
    model.seen = len(model.friends)


class Town(Model):
    seen: int = 0
    n: int = parameter(20, low=1)
    rewiring: float = parameter(0.25, low=0.0, high=1.0)
    people = Population(Person, "n")
    firms = Population(Firm, 3)
    friends = Network(people, start=generator("watts_strogatz_graph", k=4, p="rewiring"))
    follows = Network(people, directed=True, start=generator("gnp_random_graph", p=0.1))
    jobs = Network(people, firms, Job, start=generator("random_graph", p=0.5))
    setup = (once(count),)


def pairs(network):
    return list(zip(network.source.tolist(), network.target.tolist(), strict=True))


def test_generators_make_links_before_the_setup():
    town = Town(seed=4, compiled=False)
    assert town.seen == len(town.friends) == 40
    assert len(Town(seed=4, compiled=False, n=30).friends) == 60
    assert town.friends.degrees().sum() == 80
    assert 0 < len(town.follows) < 20 * 19 and 0 < len(town.jobs) < 60


def test_their_luck_is_the_seed_of_the_society():
    one, same, other = (Town(seed=seed, compiled=False) for seed in (1, 1, 2))
    for name in ("friends", "follows", "jobs"):
        assert pairs(one.tables[name]) == pairs(same.tables[name])
        assert pairs(one.tables[name]) != pairs(other.tables[name])
    ring = Town(rewiring=0.0, compiled=False).friends
    assert {frozenset(pair) for pair in pairs(ring)} == {
        frozenset((one, (one + step) % 20)) for one in range(20) for step in (1, 2)
    }


def test_a_multigraph_of_a_generator_has_one_link_between_two():
    class Web(Model):
        people = Population(Person, 60)
        links = Network(people, directed=True, start=generator("scale_free_graph"))

    found = pairs(Web(seed=1, compiled=False).links)
    assert len(found) == len(set(found)) > 60
    assert all(one != other for one, other in found)


@pytest.mark.parametrize(
    ("links", "edges"),
    [
        ({"source": [0, 3], "target": [4, 1], "wage": [2, 0.5]}, [(0, 4, 2.0), (3, 1, 0.5)]),
        (pd.DataFrame({"source": [2], "target": [1]}), [(2, 1, 1.0)]),
        (nx.Graph([(0, 1, {"wage": 3.0, "colour": 7}), (2, 1)]), [(0, 1, 3.0), (1, 2, 1.0)]),
        (nx.path_graph(["ann", "bob", "eve", "pam", "sue"][:5]), None),
    ],
)
def test_tables_and_graphs_begin_a_network(links, edges):
    class Group(Model):
        people = Population(Person, 5)
        friends = Network(people, Job, start=links)

    friends = Group(compiled=False).friends
    if edges is None:  # nodes that are no identities stand for the agents in order
        edges = [(one, one + 1, 1.0) for one in range(4)]
    found = list(zip(friends.source, friends.target, friends.wage, strict=True))
    assert {(*sorted(pair), wage) for *pair, wage in found} == {
        (*sorted(pair), wage) for *pair, wage in edges
    }
    assert friends.since.tolist() == [None] * len(edges)


MODEL = """from socialmind import Agent, Link, Model, Network, Population

class Person(Agent):
    pass

class Tie(Link):
    age: int = 0

class Group(Model):
    people = Population(Person, 4)
    ties = Network(people, Tie, start="ties.csv")
"""


def group(folder, text, suffix=".csv"):
    (folder / "model.py").write_text(MODEL.replace(".csv", suffix))
    if text is not None:
        (folder / f"ties{suffix}").write_text(text)
    return load_file(folder / "model.py").Group


def test_an_edge_list_lies_beside_the_model_and_counts_for_its_runs(tmp_path):
    kind = group(tmp_path, "source,target,age\n0,3,7\n2,1,9\n")
    society = kind(compiled=False)
    assert pairs(society.ties) == [(0, 3), (2, 1)] and society.ties.age.tolist() == [7, 9]
    assert any(label.endswith("ties.csv") for label in sources_of(kind).files)
    copied = kind(compiled=False).fresh()
    assert pairs(copied.ties) == [(0, 3), (2, 1)]


def test_a_copy_has_the_links_whatever_became_of_the_file(tmp_path):
    society = group(tmp_path, "source,target\n0,3\n")(compiled=False)
    (tmp_path / "ties.csv").unlink()
    other = group(tmp_path, "source,target\n0,3\n")(compiled=False)
    other.restore(society.state())
    assert pairs(other.ties) == [(0, 3)]


@pytest.mark.parametrize(
    ("text", "message"),
    [
        (None, "ties.csv: No such file or directory"),
        ("source,aim\n0,1\n", "ties.csv: the column 'aim' is no field of 'ties'"),
        ("source,age\n0,1\n", "ties.csv: no column 'target'"),
        ("source,target\n0,1\n1,4\n", "ties.csv, line 3: found 4 as target; expected the identity "
         "of a living agent of 'people', 0 … 3"),
        ("source,target\n2,2\n", "ties.csv, line 2: found a link of agent 2 with itself"),
        ("source,target\n2,1\n\n1,2\n", "line 4: found 1 and 2 linked again, as in line 2"),
        ("source,target\n2,x\n", "ties.csv, column 'target' of line 2: found 'x'"),
        ("source,target,age\n2,1,0.5\n", "ties.csv, column 'age' of line 2: found 0.5; expected a "
         "whole number"),
        ("source,target\n2\n", "ties.csv, line 2: found 1 values; expected 2"),
    ],
)  # fmt: skip
def test_wrong_rows_are_named(text, message, tmp_path):
    kind = group(tmp_path, text)
    with pytest.raises(ModelError) as caught:
        kind(compiled=False)
    said = str(caught.value)
    assert message in said and "\n" not in said
    assert said.startswith(f"{tmp_path / 'model.py'}:11: ")


def test_users_links_are_checked_and_nothing_changes():
    town = Town(compiled=False)
    before = pairs(town.friends)
    wrong = [
        ({"source": [0], "target": [99]}, "row 0: found 99 as target"),
        (nx.DiGraph([(0, 1)]), "found a directed graph; expected an undirected one"),
        (nx.Graph([(0, 0)]), "edge 0–0: found a link of agent 0 with itself"),
        (nx.path_graph(["a", "b"]), "found 2 nodes for agents of 'people'; expected 20"),
        (7, "found 7; expected an edge list"),
    ]
    for links, message in wrong:
        with pytest.raises(SocialmindError, match=re.escape(message)):
            town.friends.set_from(links)
    with pytest.raises(ValueRefusedError, match="expected a living agent of 'people'"):
        town.friends.link(0, 99)
    with pytest.raises(UnknownNameError, match="expected an agent of 'firms'"):
        town.jobs.link(town.people[0], town.people[1])
    with pytest.raises(UnknownNameError, match=r"not directed; write neighbours\(\)"):
        town.friends.successors(0)
    with pytest.raises(UnknownNameError, match=r"write successors\(\) or predecessors\(\)"):
        town.follows.neighbours(0)
    with pytest.raises(UnknownNameError, match="whose links are nowhere; ask the agents"):
        town.friends.near(town.people[0], 2)
    with pytest.raises(UnknownNameError, match="'friends' of town stays"):
        town.friends = 3
    assert pairs(town.friends) == before


DECLARATIONS = [
    ("Network(3)", "found 3 as what the network 'ties' links; expected a population"),
    ("Network(others)", "a network 'ties' of a population that the class does not have"),
    ("Network(people, Person)", "as the links of 'ties'; expected a class that inherits from"),
    ("Network(people, directed=2)", "directed=2 of 'ties'; expected True or False"),
    ("Network(people, Odd)", "a field called 'source'; expected a name that links and networks"),
    ("Network(people, Text)", "found str as the type of 'name'"),
    (
        "Network(people, start=generator('path_graph', n='m'))",
        "n='m' of the generator 'path_graph'",
    ),
    ("Network(people, start=generator(3))", "found generator(3)"),
]


@pytest.mark.parametrize(("written", "message"), DECLARATIONS)
def test_wrong_declarations_are_refused(written, message, tmp_path):
    text = MODEL.replace('Network(people, Tie, start="ties.csv")', written).replace(
        "import Agent", "import generator, Agent"
    )
    more = "\nclass Odd(Link):\n    source: float = 0.0\n\nclass Text(Link):\n    name: str = ''\n"
    text = text.replace("\nclass Group", f"{more}\nothers = Population(Person, 2)\n\nclass Group")
    (tmp_path / "model.py").write_text(text)
    with pytest.raises(ModelError) as caught:
        load_file(tmp_path / "model.py")
    said = str(caught.value)
    assert message in said and "\n" not in said and "model.py:" in said


@pytest.mark.parametrize(
    ("start", "message"),
    [
        (generator("watts_strogatz_grph", k=4, p=0.1), "did you mean 'watts_strogatz_graph'"),
        (generator("pagerank"), "which networkx does not have"),
        (generator("watts_strogatz_graph", k=4), "networkx.watts_strogatz_graph(n=5, k=4)"),
        (generator("path_graph", n=3), "found 3 nodes for agents of 'people'; expected 5"),
    ],
)
def test_wrong_generators_are_named(start, message):
    class Group(Model):
        people = Population(Person, 5)
        friends = Network(people, start=start)

    with pytest.raises(ModelError) as caught:
        Group(compiled=False)
    said = str(caught.value)
    assert message in said and "for the network 'friends'" in said and "\n" not in said
    assert "test_start.py:" in said


RULES = [
    (
        "model.ties.link(one, 3)",
        "a whole number for link() of 'ties'; expected an agent of 'people'",
    ),
    ("model.ties.link(one)", "link() like this; write model.ties.link(one, other)"),
    ("model.ties.add(one, one)", "add() of the network 'ties'; write model.ties.link(one, other)"),
    ("model.ties.create()", "create() of the network 'ties'; write model.ties.link("),
    ("model.ties.nearest(one)", "nearest() of the network 'ties', whose links are nowhere; ask"),
    ("model.ties.successors(one)", "which is not directed; write neighbours"),
    ("model.ties.neighbours(3)", "a whole number for neighbours() of 'ties'; expected an agent"),
    ("model.ties.link(one, one).hatch()", "hatch() of a link of 'ties'; between two there is one"),
    ("model.ties.link(one, one).age = 0.5", "a number with a fraction for the field 'age'"),
    ("model.ties.link(one, one).years = 1", "the unknown field 'years' of an agent of 'ties'"),
    ("model.ties.link(one, one).source = one", "a new value for 'source'"),
    ("found = model.ties.neighbours(one)", "a set of agents of 'people' as the variable 'found'"),
    ("model.ties.link(one, one).other(3)", "other() of a whole number"),
]


@pytest.mark.parametrize(("line", "message"), RULES)
def test_wrong_rules_are_refused_with_their_line(line, message, tmp_path):
    text = MODEL.replace(', start="ties.csv"', "").replace("import Agent", "import each, Agent")
    text += "    schedule = (each(people, act),)\n"
    text = text.replace("\nclass Group", f"\ndef act(one, model):\n    {line}\n\nclass Group")
    (tmp_path / "model.py").write_text(text)
    kind = load_file(tmp_path / "model.py").Group
    with pytest.raises(ModelError) as caught:
        kind(compiled=False)
    said = str(caught.value)
    assert said.startswith(f"{tmp_path / 'model.py'}:10: ")
    assert message in said and "\n" not in said


def test_states_with_odd_links_are_refused():
    town = Town(compiled=False)
    state = town.state()
    wrong = [
        ("_source", 40, "links of agents that do not live"),
        ("_target", None, "a link of an agent with itself"),
    ]
    for column, place, message in wrong:
        odd = {name: array.copy() for name, array in state.items()}
        rows = odd["friends.rows"]
        rows[column][0] = rows["_source"][0] if place is None else place
        with pytest.raises(SocialmindError, match=f"friends.rows holds {message}"):
            town.restore(odd)
    assert np.array_equal(town.state()["friends.rows"], state["friends.rows"])
