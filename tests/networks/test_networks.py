"""Networks in rules: random sequences of events against networkx, and both speeds alike."""

import copy
import math

import networkx as nx
import numpy as np
import pytest

from socialmind import Agent, Link, Model, Network, Population, RuleError, each, once

LENGTH = 40
"""Events in a sequence."""
LOOPS = 10_007


class Person(Agent):
    met: int = 0


class Firm(Agent):
    staff: int = 0


class Tie(Link):
    strength: float = 1.0
    since: int | None = None


def happen(model):
    """Let a sequence of events happen, each on both networks of people; note whom loops meet."""
    for k in range(LENGTH):
        what, one, other = model.events[3 * k], model.events[3 * k + 1], model.events[3 * k + 2]
        if not model.people.contains(one) or not model.people.contains(other):
            continue
        if one == other:
            what = what // 2 + 7
        befall(model.people[one], model.people[other], what, model)


def befall(one, other, what, model):
    if what == 0 or what == 1 or what == 2:
        tie = model.friends.link(one, other)
        tie.strength += 1.0
        tie.since = model.tick
        model.follows.link(one, other)
    elif what == 3:
        model.friends.unlink(one, other)
        model.follows.unlink(one, other)
    elif what == 4:
        for friend in model.friends.neighbours(one):
            note(friend.id, model)
            if friend != other:
                model.friends.link(friend, other)
            if friend.id % 3 == 0:
                model.friends.unlink(one, friend)
        for leader in model.follows.successors(one):
            note(leader.id, model)
            if leader.id % 2 == 0:
                model.follows.unlink(one, leader)
                model.follows.link(leader, one)
    elif what == 5:
        for tie in model.friends.links_of(one):
            note(tie.other(one).id, model)
            if model.friends.linked(tie.other(one), other):
                tie.die()
            else:
                tie.strength *= 0.5
        for mention in model.follows.links_to(one):
            note(mention.source.id, model)
            if mention.source == other:
                mention.die()
    elif what == 6:
        for friend in model.friends.neighbours(one):
            note(friend.id, model)
            if friend.id % 5 == 0:
                friend.die()
            for further in model.friends.neighbours(friend):
                note(further.id, model)
                if further.id % 7 == 1 and further != one:
                    model.friends.unlink(further, friend)
                    break
            else:
                note(0, model)
    elif what == 7 or what == 8:
        child = one.hatch()
        for leader in model.follows.predecessors(one):
            model.follows.link(leader, child)
            model.friends.link(child, leader)
    elif what == 9:
        one.die()
    else:
        note(len(model.friends.neighbours(one)), model)
        for tie in model.friends:
            if tie.source.id > tie.target.id and tie.strength > 3.0:
                tie.die()


def note(number, model):
    model.met = (model.met * 31 + number + 1) % LOOPS


class Town(Model):
    met: int = 0
    events: list[int] = [0] * (3 * LENGTH)
    people = Population(Person, 12)
    friends = Network(people, Tie)
    follows = Network(people, directed=True)
    schedule = (once(happen),)


def expected(friends, follows, events, born):
    """The same events on graphs of networkx; returns whom loops met."""
    met = 0

    def note(number):
        nonlocal met
        met = (met * 31 + number + 1) % LOOPS

    def still(graph, one):
        """Each neighbour, as far as the edge that was there at the begin still is."""
        for other, edge in list(graph.adj[one].items()):
            if graph.has_edge(one, other) and graph.edges[one, other] is edge:
                yield other

    def follows_only(one, other):
        if not follows.has_edge(one, other):
            follows.add_edge(one, other)

    def befriend(one, other):
        if not friends.has_edge(one, other):
            friends.add_edge(one, other, source=one, target=other, strength=1.0)
        return friends.edges[one, other]

    def die(one):
        friends.remove_node(one)
        follows.remove_node(one)

    def drop(graph, one, other):
        if graph.has_edge(one, other):
            graph.remove_edge(one, other)

    for what, one, other in events:
        if one not in friends or other not in friends:
            continue
        if one == other:
            what = what // 2 + 7
        if what in (0, 1, 2):
            befriend(one, other)["strength"] += 1.0
            follows_only(one, other)
        elif what == 3:
            drop(friends, one, other)
            drop(follows, one, other)
        elif what == 4:
            for friend in still(friends, one):
                note(friend)
                if friend != other:
                    befriend(friend, other)
                if friend % 3 == 0:
                    drop(friends, one, friend)
            for leader in still(follows, one):
                note(leader)
                if leader % 2 == 0:
                    drop(follows, one, leader)
                    follows_only(leader, one)
        elif what == 5:
            for friend in still(friends, one):
                note(friend)
                if friends.has_edge(friend, other):
                    drop(friends, one, friend)
                else:
                    friends.edges[one, friend]["strength"] *= 0.5
            for fan in list(follows.pred[one]):
                note(fan)
                if fan == other:
                    drop(follows, fan, one)
        elif what == 6:
            for friend in still(friends, one):
                note(friend)
                further_ones = [] if friend % 5 == 0 else still(friends, friend)
                if friend % 5 == 0:
                    die(friend)
                for further in further_ones:
                    note(further)
                    if further % 7 == 1 and further != one:
                        drop(friends, further, friend)
                        break
                else:
                    note(0)
        elif what in (7, 8):
            child, born = born, born + 1
            friends.add_node(child)
            follows.add_node(child)
            for fan in list(follows.pred[one]):
                follows_only(fan, child)
                befriend(child, fan)
        elif what == 9:
            die(one)
        else:
            note(friends.degree(one))
            for edge in [data for *_, data in friends.edges(data=True)]:
                if edge["source"] > edge["target"] and edge["strength"] > 3.0:
                    drop(friends, edge["source"], edge["target"])
    return met, born


def sequences(count, seed=3):
    rng = np.random.default_rng(seed)
    for _ in range(count):
        events = np.column_stack(
            [rng.integers(0, 11, LENGTH), rng.integers(0, 14, LENGTH), rng.integers(0, 14, LENGTH)]
        )
        yield events


@pytest.mark.parametrize(("compiled", "count"), [(True, 1000), (False, 60)])
def test_links_are_those_of_networkx(compiled, count):
    town = Town(compiled=compiled)
    begin = town.state()
    for number, events in enumerate(sequences(count)):
        if number % 4 == 0:  # else it goes on, with slots that others had
            town.restore(begin)
            friends, follows, born = nx.Graph(), nx.DiGraph(), 12
            friends.add_nodes_from(range(12))
            follows.add_nodes_from(range(12))
        town.met, town.events = 0, events.ravel()
        town.advance(1)
        met, born = expected(friends, follows, events.tolist(), born)
        assert town.people.id.tolist() == list(friends), number
        for network, graph in ((town.friends, friends), (town.follows, follows)):
            lists = {one: list(graph.adj[one]) for one in graph}
            ask = network.neighbours if network is town.friends else network.successors
            assert {p.id: [o.id for o in ask(p)] for p in town.people} == lists, number
        fans = {one: list(follows.pred[one]) for one in follows}
        assert {p.id: [o.id for o in town.follows.predecessors(p)] for p in town.people} == fans
        strengths = {
            (e["source"], e["target"]): e["strength"] for *_, e in friends.edges(data=True)
        }
        links = zip(town.friends.source, town.friends.target, strict=True)
        assert dict(zip(links, town.friends.strength, strict=True)) == strengths
        assert town.met == met, number


def state_of(society):
    """All that a society holds of its tables, as lists."""
    held = {}
    for name, table in society.tables.items():
        ends = ["source", "target"] if table.shape.links else []
        for column in ["id", *ends, *table.shape.fields]:
            held[name, column] = getattr(table, column).tolist()
    return held


def mingle(person, model, rng):
    friend = model.friends.neighbours(person).one_of(rng)
    if friend is not None:
        other = model.friends.links_of(friend).one_of(rng).other(friend)
        if other != person and not model.friends.linked(person, other):
            model.friends.link(person, other).since = model.tick
        tie = model.friends.between(friend, person)
        if tie is None or rng.random() < 0.3:
            model.friends.unlink(person, friend)
        person.met += friend.id
    stranger = model.people.one_of(rng)
    if stranger != person:
        model.friends.link(stranger, person).strength = rng.random()
    work(person, model, rng)
    if rng.random() < 0.1:
        person.hatch()
        person.die()


def work(person, model, rng):
    firm = model.jobs.neighbours(person).one_of(rng)
    if firm is None:
        firm = model.firms.one_of(rng)
        model.jobs.link(person, firm)
    firm.staff = len(model.jobs.neighbours(firm))
    for tie in model.jobs.links_of(firm):
        tie.strength += 0.125
        tie.other(firm).met += 1
        tie.target.staff += 1
    if firm.staff > 9 and len(model.firms) > 1:
        firm.die()
    person.met += sum(tie.since for tie in model.friends.links_of(person) if tie.since is not None)


def weaken(tie):
    tie.strength *= 0.75
    if tie.strength < 0.1:
        tie.die()


class Village(Model):
    people = Population(Person, 25)
    firms = Population(Firm, 4)
    friends = Network(people, Tie)
    jobs = Network(people, firms, Tie)
    schedule = (each(people, mingle), each(friends, weaken))


@pytest.fixture(scope="module")
def village():
    """A village that ran for 40 ticks, compiled."""
    made = Village(seed=5)
    made.advance(40)
    return made


def test_both_speeds_are_alike(village):
    slow = Village(seed=5, compiled=False)
    slow.advance(40)
    assert state_of(slow) == state_of(village)
    assert len(village.friends) > 10 and len(village.jobs) > 10
    assert village.people.id.max() > 60 and village.friends.id.max() > 300


def test_what_goes_on_is_what_was_never_stopped(village):
    stopped = Village(seed=5)
    stopped.advance(17)
    resumed = Village(seed=5)
    resumed.restore(stopped.state())
    for one in (resumed, copy.copy(stopped), copy.deepcopy(stopped)):
        one.advance(23)
        assert state_of(one) == state_of(village)


def test_lists_of_links_are_a_function_of_the_rows(village):
    for network in (village.friends, village.jobs):
        asked = [[one.id for one in network.neighbours(p)] for p in village.people]
        network.build_index()
        assert [[one.id for one in network.neighbours(p)] for p in village.people] == asked
        mine = (network.source.tolist(), network.target.tolist())
        for place, person in enumerate(village.people):
            ends = [t for s, t in zip(*mine, strict=True) if s == person.id]
            if network is village.friends:
                ends = [
                    s + t - person.id for s, t in zip(*mine, strict=True) if person.id in (s, t)
                ]
            assert asked[place] == ends


def test_links_end_with_agents_whatever_takes_them():
    for compiled in (True, False):
        town = Town(compiled=compiled)
        town.friends.link(1, 2)
        town.friends.link(3, 1)
        town.follows.link(2, 1)
        town.follows.link(1, 3)
        town.people[1].die()
        assert len(town.friends) == len(town.follows) == 0
        town.advance(1)
        assert town.friends.neighbours(2) == []


def marry(person, model):
    model.friends.link(person, person)


def mourn(person, model):
    other = model.people[person.id + 1]
    other.die()
    model.friends.link(person, other)


def ask(person, model):
    for tie in model.friends:
        person.met = tie.other(person).id


@pytest.mark.parametrize(
    ("rule", "message"),
    [
        (marry, "link() of an agent with itself"),
        (mourn, "link() of an agent that is dead"),
        (ask, "other() of an agent that the link does not join"),
    ],
)
def test_what_cannot_be_is_said_with_its_line(rule, message):
    lines = []
    for compiled in (True, False):
        kind = type("Odd", (Town,), {"schedule": (each(Town.people, rule),)})
        odd = kind(compiled=compiled)
        odd.friends.link(0, 1)
        odd.friends.link(2, 3)
        with pytest.raises(RuleError) as caught:
            odd.advance(1)
        lines.append(str(caught.value))
        assert odd.tick == 0
    assert lines[0] == lines[1]
    assert message in lines[0] and "test_networks.py:" in lines[0]


def test_numbers_of_a_draw_are_even():
    """Each neighbour is drawn equally often, whatever its place."""
    town = Town(compiled=False)
    for other in (3, 4, 5, 6):
        town.friends.link(0, other)

    class Counting:
        def integers(self, low, high):
            self.place = (getattr(self, "place", -1) + 1) % high
            return low + self.place

    rng = Counting()
    found = town.friends.linked_set("out", "agents", 0)
    assert [found.one_of(rng).id for _ in range(4)] == [3, 4, 5, 6]
    assert len(found) == 4 and math.isclose(town.friends.strength.sum(), 4.0)
