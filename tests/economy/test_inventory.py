"""Bags and facilities: what goes in comes out, and nothing comes of nothing."""

from types import SimpleNamespace

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from coglogo_py import CognitiveScheme, Cogniton, Group, Role
from socialmind import Agent, Model, Population, each, once
from socialmind.economy import (
    Facility,
    build_for_group,
    build_private,
    clear_deserted,
    clear_ownerless,
    craft,
    may_use,
    swap,
    take,
    transfer,
)

bags = st.lists(st.integers(0, 9), min_size=4, max_size=4)
things = st.integers(0, 3)
counts = st.integers(-3, 12)


@given(bags, bags, things, counts)
def test_a_transfer_keeps_the_sum(one, other, thing, count):
    before = [a + b for a, b in zip(one, other, strict=True)]
    had = one[thing]
    moved = transfer(one, other, thing, count)
    assert moved == max(min(had, count), 0)
    assert [a + b for a, b in zip(one, other, strict=True)] == before
    assert min(one) >= 0


@given(bags, bags, things, counts, things, counts)
def test_a_swap_is_whole_or_not_at_all(one, other, given_, many, taken, price):
    before = list(one), list(other)
    fair = many >= 0 and price >= 0 and one[given_] >= many and other[taken] >= price
    assert swap(one, other, given_, many, taken, price) == fair
    for thing in range(4):
        moved = (price if thing == taken else 0) - (many if thing == given_ else 0)
        assert one[thing] == before[0][thing] + (moved if fair else 0)
        assert other[thing] == before[1][thing] - (moved if fair else 0)
    assert min(*one, *other) >= 0


@given(bags, st.dictionaries(things, st.integers(1, 4), min_size=1), things)
def test_what_is_made_takes_its_recipe(bag, recipe, thing):
    before, pairs = list(bag), tuple(recipe.items())
    able = all(before[one] >= many for one, many in pairs)
    assert craft(bag, pairs, thing, 2) == able
    for one in range(4):
        change = (2 if one == thing else 0) - recipe.get(one, 0)
        assert bag[one] == before[one] + (change if able else 0)


def test_more_than_there_is_cannot_be_taken():
    bag = [3]
    assert [take(bag, 0, count) for count in (2, 2, 2)] == [2, 1, 0]


def test_a_facility_is_for_its_owner_its_group_or_everybody():
    agent, other = (SimpleNamespace(id=k, x=1.0, y=2.0) for k in (4, 5))
    barn = SimpleNamespace(owner=-1, group=-1, x=0.0, y=0.0)
    assert may_use(other, barn, -1)
    build_private(barn, agent)
    assert (barn.x, barn.y) == (1.0, 2.0)
    assert may_use(agent, barn, -1)
    assert not may_use(other, barn, 3)
    barn.owner = -1
    build_for_group(barn, agent, 3)
    assert may_use(other, barn, 3)
    assert not may_use(other, barn, 2)
    assert not may_use(other, barn, -1)


class Human(Agent):
    pass


class Barn(Facility):
    stock: list[int] = [0] * 2


def found(human, model):
    barn = model.barns.create()
    if human.id < 2:
        human.mind.create_and_join_group("clan", "member")
        build_for_group(barn, human, human.mind.get_group_id("clan"))
    elif human.id < 4:
        build_private(barn, human)


def leave(human, model):
    if model.tick == 0 and human.id == 2:
        human.die()
    if model.tick == 1 and human.id == 0:
        human.mind.leave_group("clan")


def clear(model):
    clear_ownerless(model.barns, model.humans)
    clear_deserted(model.barns, model.humans, "clan")


class Clans(Model):
    humans = Population(
        Human,
        5,
        mind=CognitiveScheme(
            "humans",
            (Cogniton("Will", influence={"be": 1.0}, conditional=("be",)),),
            (Group("clan", (Role("member"),)),),
        ),
    )
    barns = Population(Barn, 0)
    setup = (each(humans, found, shuffled=False),)
    schedule = (each(humans, leave), once(clear))


def test_facilities_go_with_their_owner_and_with_the_last_member():
    society = Clans(compiled=False)
    assert society.barns.id.tolist() == [0, 1, 2, 3, 4]
    society.advance(1)
    assert society.barns.id.tolist() == [0, 1, 3, 4]
    society.advance(1)
    assert society.barns.id.tolist() == [1, 3, 4]
    np.testing.assert_array_equal(society.barns.owner, [-1, 3, -1])
