"""Births and deaths as they are noted: by both speeds alike, and what they say is so."""

import copy

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from socialmind import (
    Agent,
    Link,
    Message,
    Messages,
    Model,
    Network,
    Population,
    SocialmindError,
    each,
    once,
    parameter,
)


class Cell(Agent):
    age: int = 0


class Note(Message):
    pass


class Stone(Agent):
    pass


def seed_stones(model, rng):
    for _ in range(rng.integers(0, 4)):
        model.stones.create()


def live(cell, model, rng):
    cell.age += 1
    if rng.random() < model.birth:
        child = cell.hatch()
        child.age = 0
        if rng.random() < 0.2:
            child.die()  # within its first tick
    if model.burst > 0 and model.tick == 2 and cell.id == 0:
        for _ in range(model.burst):
            cell.hatch()
    if rng.random() < model.death:
        cell.die()
        cell.die()
    elif len(model.cells) > 1:
        other = model.cells.one_of(rng)
        if other != cell:
            model.ties.link(cell, other)
            model.notes.send(cell, other)


def rain(model, rng):
    for _ in range(model.created):
        model.drops.create()
    if len(model.drops) > 3:
        model.drops.one_of(rng).die()


class Soup(Model):
    n: int = parameter(3, low=0, high=50)
    birth: float = parameter(0.2, low=0.0, high=1.0)
    death: float = parameter(0.2, low=0.0, high=1.0)
    burst: int = parameter(0, low=0, high=10_000)
    created: int = parameter(1, low=0, high=5)
    stones = Population(Stone, 2)
    cells = Population(Cell, "n")
    drops = Population(Cell, 0)
    notes = Messages(Note, to=cells)
    ties = Network(cells, Link)
    setup = (once(seed_stones),)
    schedule = (each(cells, live), once(rain))


def begun(compiled, seed, **parameters):
    soup = Soup(seed=seed, compiled=compiled, **parameters)
    soup.keep_events()
    return soup


def numbers(soup):
    return {name: set(soup.tables[name].id.tolist()) for name in ("stones", "cells", "drops")}


def alive_after(founders, events, tick):
    """Who lives at a tick, by the founders and the events alone."""
    living = {name: set(one) for name, one in founders.items()}
    columns = (np.asarray(events[name]).tolist() for name in ("tick", "population", "agent"))
    for when, name, agent, event in zip(*columns, events["event"].tolist(), strict=True):
        if when <= tick:
            change = living[name].add if event == "born" else living[name].remove
            assert (agent in living[name]) == (event == "died")
            change(agent)
    return living


WORLDS = st.fixed_dictionaries(
    {
        "n": st.integers(0, 20),
        "birth": st.sampled_from([0.0, 0.3, 0.7]),
        "death": st.sampled_from([0.0, 0.3, 0.5]),
        "burst": st.sampled_from([0, 0, 500]),
        "created": st.integers(0, 3),
    }
)


@settings(max_examples=40)
@given(WORLDS, st.integers(0, 2**64 - 1), st.lists(st.integers(1, 5), min_size=1, max_size=3))
def test_events_and_founders_say_who_lives_at_each_tick(parameters, seed, stretches):
    plain, quick = begun(False, seed, **parameters), begun(True, seed, **parameters)
    founders, seen = numbers(plain), {}
    for _ in range(sum(stretches)):
        plain.advance(1)
        seen[plain.tick] = numbers(plain)
    for stretch in stretches:
        quick.advance(stretch)
    events = plain.kept_events()
    for tick, living in seen.items():
        assert alive_after(founders, events, tick) == living
    assert np.array_equal(plain.event_log.so_far(), quick.event_log.so_far())
    unwatched = Soup(seed=seed, **parameters)
    unwatched.advance(sum(stretches))
    assert numbers(unwatched) == numbers(quick) and not unwatched.event_log.count
    assert list(np.asarray(events["tick"])) == sorted(events["tick"])


class Twin(Agent):
    pass


def double(twin):
    child = twin.hatch()
    child.die()
    twin.die()


def renew(model):
    model.twins.create()


class Twins(Model):
    twins = Population(Twin, 2)
    schedule = (each(twins, double), once(renew))


@pytest.mark.parametrize("compiled", [False, True])
def test_events_by_hand(compiled):
    society = Twins(compiled=compiled)
    with pytest.raises(SocialmindError, match=r"twins keeps no births and deaths; call"):
        society.kept_events()
    society.advance(1)
    society.keep_events()
    society.advance(2)
    found = {name: np.ma.asarray(one).tolist() for name, one in society.kept_events().items()}
    # After the first tick only 4 lives, whom the model created.
    assert found == {
        "tick": [2, 2, 2, 2, 3, 3, 3, 3],
        "population": ["twins"] * 8,
        "agent": [5, 5, 4, 6, 7, 7, 6, 8],
        "event": ["born", "died", "died", "born"] * 2,
        "parent": [4, None, None, None, 6, None, None, None],
    }
    # By hand between ticks: seen by the tables of the tick that is.
    society.twins[8].die()
    assert society.kept_events()["tick"].tolist()[-1] == 3
    assert not copy.deepcopy(society).event_log.kept


def test_only_populations_that_change_in_ticks_are_paid_for():
    assert Soup.typed().eventful == ("cells", "drops")
    assert Twins.typed(False).eventful == ("twins",)

    class Still(Model):
        twins = Population(Twin, 2)
        setup = (once(renew), each(twins, double))
        schedule = ()

    assert Still.typed(False).eventful == ()
    assert "_events" not in (Still(compiled=False).contexts.dtype.names or ())


def fail_at_three(cell, model):
    cell.hatch()
    if model.tick == 3 and cell.id == 1:
        raise_error = 0
        cell.age = 1 // raise_error


class Failing(Model):
    cells = Population(Cell, 2)
    schedule = (each(cells, fail_at_three),)


def test_a_stretch_that_is_done_again_is_noted_once():
    societies = [Failing(compiled=compiled) for compiled in (False, True)]
    for one in societies:
        one.keep_events()
        with pytest.raises(SocialmindError, match="division"):
            one.advance(10)
    plain, quick = (one.event_log.so_far() for one in societies)
    assert np.array_equal(plain, quick) and len(plain) > 14
