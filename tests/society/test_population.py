"""Who is alive: births, deaths, identities and room, at both speeds."""

import numpy as np
import pytest

from coglogo_py import CognitiveScheme, Cogniton
from socialmind import Agent, Model, Population, each, once, parameter
from socialmind.agents.bookkeeping import NEXT_ID

SCHEME = CognitiveScheme("herd", (Cogniton("Hunger", start_value=1.0, influence={"eat": 1.0}),))


class Cow(Agent):
    age: int = 0
    mother: int = -1
    calves: int = 0
    weight: float = 40.0
    herd: int | None = None


def eat(cow):
    cow.weight += 1


def grow_up(cow, model, rng):
    cow.age += 1
    if cow.age % 3 == 0 and len(model.cows) < model.most:
        calf = cow.hatch()
        calf.age = 0
        calf.mother = cow.id
        cow.calves += 1
    if rng.random() < model.risk:
        cow.die()


class Herd(Model):
    most: int = parameter(200)
    risk: float = parameter(0.08, low=0.0, high=1.0)
    cows = Population(Cow, 5, mind=SCHEME, plans={"eat": eat})
    schedule = (each(cows, grow_up),)


def burst(model):
    for _ in range(model.litter):
        calf = model.calves.create()
        calf.age = model.tick


def wean(calf):
    if calf.id % 2 == 0:
        calf.die()


class Nursery(Model):
    litter: int = parameter(1000)
    calves = Population(Cow, 0)
    schedule = (once(burst), each(calves, wean))


def look(cow, model):
    cow.calves = len(model.cows)
    if cow.age == 0 and model.tick == 0:
        calf = cow.hatch()
        calf.age = 100


class Acting(Model):
    cows = Population(Cow, 3)
    schedule = (each(cows, look), each(cows, eat))


def cull(cow, model):
    cow.calves += 1
    for other in model.cows:
        if other.id == (cow.id + 1) % 4:
            other.die()


class Culling(Model):
    cows = Population(Cow, 4)
    schedule = (each(cows, cull, shuffled=False), each(cows, eat))


def both(cls, ticks, seed=2, **parameters):
    societies = [cls(seed, compiled=compiled, **parameters) for compiled in (True, False)]
    for society in societies:
        society.advance(ticks)
    return societies


@pytest.mark.parametrize("risk", [0.0, 0.08, 0.4])
def test_births_and_deaths_are_alike(risk):
    fast, slow = both(Herd, 40, risk=risk)
    for name in ("id", "age", "mother", "calves", "weight"):
        assert getattr(fast.cows, name).tolist() == getattr(slow.cows, name).tolist()
    assert fast.cows.cogniton("Hunger").tolist() == slow.cows.cogniton("Hunger").tolist()
    assert len(fast.cows) == len(fast.cows.id) == len(list(fast.cows))
    if risk == 0.0:
        assert len(fast.cows) == 200
    if risk == 0.4:
        assert len(fast.cows) == 0


def test_identities_grow_and_are_never_used_again():
    herd = Herd(3, compiled=False)
    met = set(herd.cows.id.tolist())
    for _ in range(30):
        before = set(herd.cows.id.tolist())
        herd.advance(1)
        now = herd.cows.id.tolist()
        assert now == sorted(now)  # the order of birth
        born = set(now) - before
        assert not born & met
        met |= born
        assert all(herd.cows.contains(cow) for cow in now)
        assert not any(herd.cows.contains(cow) for cow in before - set(now))
    assert len(met) > len(now)


def test_the_newborn_act_from_the_next_tick_on():
    for society in both(Acting, 1):
        assert society.cows.age.tolist() == [0, 0, 0, 100, 100, 100]
        # Each of the first three saw those born before it; the newborn did nothing yet.
        assert sorted(society.cows.calves[:3].tolist()) == [3, 4, 5]
        assert society.cows.weight.tolist() == [41.0] * 3 + [40.0] * 3
        society.advance(1)
        assert society.cows.calves.tolist() == [6] * 6
        assert society.cows.weight.tolist() == [42.0] * 3 + [41.0] * 3


def test_the_dead_act_no_more():
    for society in both(Culling, 1):
        # 0 kills 1; 2 kills 3: neither 1 nor 3 comes to its turn.
        assert society.cows.id.tolist() == [0, 2]
        assert society.cows.calves.tolist() == [1, 1]
        assert society.cows.weight.tolist() == [41.0, 41.0]


def test_more_births_in_a_tick_than_there_is_room_for():
    fast, slow = both(Nursery, 5)
    assert len(fast.calves) > 2000
    assert fast.calves.id.tolist() == slow.calves.id.tolist()
    assert fast.calves.age.tolist() == slow.calves.age.tolist()
    # Each litter is weaned from the next tick on: only the last one holds even identities.
    assert [cow for cow in fast.calves.id if cow % 2 == 0] == list(range(4000, 5000, 2))


def test_the_dead_take_no_room_but_for_their_identity():
    fast, slow = both(Herd, 400, risk=0.2)
    for herd in (fast, slow):
        table = herd.tables["cows"]
        assert len(table.rows) == len(table.society.minds.mind_id) == 512
        assert len(table.slot_of) >= table.counters[NEXT_ID] > 10_000
    assert fast.cows.age.tolist() == slow.cows.age.tolist()
    fast.advance(3600)
    table = fast.tables["cows"]
    assert len(table.slot_of) >= table.counters[NEXT_ID] > 100_000
    assert len(table.rows) == len(table.society.minds.mind_id) == 512


def test_a_state_with_room_for_the_dead_comes_back():
    """As states had that were kept when slots grew along with identities."""
    one, other = Herd(5, risk=0.2), Herd(5, risk=0.2)
    one.advance(60)
    kept = one.state()
    one.tables["cows"].reserve(4096, 4096)
    wide = one.state()
    assert len(wide["cows.rows"]) == 4096 > len(kept["cows.rows"])
    for herd, state in ((one, wide), (other, kept)):
        herd.restore(state)
        herd.advance(60)
    assert one.cows.id.tolist() == other.cows.id.tolist()
    assert one.cows.age.tolist() == other.cows.age.tolist()
    assert one.cows.slots.tolist() == other.cows.slots.tolist()


def test_who_goes_on_from_a_state_has_the_room_of_who_never_stopped():
    one, other = Herd(5, risk=0.2), Herd(5, risk=0.2)
    one.advance(200)
    other.restore(one.state())
    for herd in (one, other):
        herd.advance(200)
    for name, array in one.state().items():
        assert str(array.tolist()) == str(other.state()[name].tolist()), name


def test_slots_of_the_dead_are_used_again_but_not_within_the_tick():
    society = Nursery(1, compiled=False, litter=10)
    society.advance(300)
    assert len(society.calves.rows) < 5000
    assert len(np.unique(society.calves.slots)) == len(society.calves)


def test_a_state_comes_back_after_births_and_deaths():
    one = Herd(5)
    one.advance(10)
    state = one.state()
    one.advance(15)
    other = Herd(5)
    other.restore(state)
    assert other.tick == 10
    other.advance(15)
    assert other.cows.id.tolist() == one.cows.id.tolist()
    assert other.cows.weight.tolist() == one.cows.weight.tolist()


def test_a_calf_is_its_mothers_copy():
    herd = Herd(1, compiled=False)
    mother = herd.cows[0]
    mother.weight, mother.herd, mother.plan = 333.0, 7, "eat"
    mother.mind.set_cogniton_value("Hunger", 9.0)
    calf = mother.hatch()
    assert (calf.weight, calf.herd, calf.plan) == (333.0, 7, "eat")
    assert calf.mind.get_cogniton_value("Hunger") == 9.0
    calf.mind.set_cogniton_value("Hunger", 1.0)
    calf.weight = 1.0
    assert mother.mind.get_cogniton_value("Hunger") == 9.0
    assert mother.weight == 333.0
    assert calf.id == 5
    created = herd.cows.create()
    assert (created.weight, created.herd, created.plan) == (40.0, None, None)


def test_what_a_population_gives_to_its_user():
    herd = Herd(1, compiled=False)
    herd.cows[2].weight = 50
    herd.cows[3].herd = 4
    assert herd.cows.weight.tolist() == [40, 40, 50, 40, 40]
    assert herd.cows.herd.tolist() == [None, None, None, 4, None]
    assert [cow.id for cow in herd.cows] == [0, 1, 2, 3, 4]
    assert herd.cows[2] == herd.cows[2]
    assert herd.cows[2] != herd.cows[3]
    assert len({herd.cows[2], herd.cows[2], herd.cows[3]}) == 2
    herd.cows[2].die()
    assert len(herd.cows) == 4
    with pytest.raises(IndexError, match="no living agent of 'cows' has the identity 2"):
        herd.cows[2].weight = 1
    with pytest.raises(AttributeError, match="no field 'wheat'; there is id, x, y"):
        herd.cows.wheat.sum()
