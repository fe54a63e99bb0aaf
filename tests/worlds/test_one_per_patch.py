"""Worlds in which a patch has room for one agent: at both speeds, resumed, and what is refused."""

import math
import pickle

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from socialmind import Agent, Grid, Model, Population, Torus, each, parameter
from socialmind.errors import ModelError, RuleError, SocialmindError, ValueRefusedError
from socialmind.worlds.grid.extent import of_grid, values_of
from socialmind.worlds.grid.one_per_patch import freed, moved, open_all


class Ant(Agent):
    steps: int = 0


class Moth(Agent):
    placed: bool = False


def arrive(ant, model, rng):
    spot = model.world.one_free(rng)
    model.world.move_to(ant, spot.x, spot.y)
    ant.heading = rng.uniform(0, 360)


def live(ant, model, rng):
    model.world.right(ant, rng.uniform(-50, 50))
    x = ant.x + math.sin(math.radians(ant.heading))
    y = ant.y + math.cos(math.radians(ant.heading))
    if model.world.is_free(x, y):
        model.world.forward(ant, 1.0)
        ant.steps += 1
    if rng.random() < 0.1 and model.world.free_count > 0:
        arrive(ant.hatch(), model, rng)
    if rng.random() < 0.1:
        ant.die()
        arrive(ant, model, rng)  # the dead take no room
    if rng.random() < 0.05 and model.world.free_count > 0:
        arrive(model.moths.create(), model, rng)


class Hill(Model):
    width: int = parameter(9, low=1)
    height: int = parameter(5, low=1)
    n_ants: int = parameter(12, low=0)
    world = Grid("width", "height", wraps="x", one_per_patch=True)
    ants = Population(Ant, "n_ants")
    moths = Population(Moth, 0)
    setup = (each(ants, arrive),)
    schedule = (each(ants, live),)


def places(society):
    return [
        (math.floor(agent.x + 0.5), math.floor(agent.y + 0.5))
        for table in (society.ants, society.moths)
        for agent in table
    ]


def same(one, other):
    first, second = one.state(), other.state()
    assert list(first) == list(second)
    for name, array in first.items():
        np.testing.assert_array_equal(array, second[name], err_msg=name)


@pytest.mark.parametrize("seed", [1, 2, 3])
def test_both_speeds_agree_and_no_patch_holds_two(seed):
    fast, slow = Hill(seed=seed), Hill(seed=seed, compiled=False)
    for _ in range(6):
        fast.advance(10)
        slow.advance(10)
        same(fast, slow)
        found = places(fast)
        assert len(found) == len(set(found))
        assert fast.world.free_count == 45 - len(found)
        for x in range(-4, 5):
            for y in range(-2, 3):
                assert fast.world.is_free(x, y) is ((x, y) not in found)
    assert len(fast.moths) > 0


def test_it_goes_on_from_its_state_at_either_speed():
    whole = Hill(seed=5)
    whole.advance(40)
    half = Hill(seed=5)
    half.advance(17)
    for compiled in (True, False):
        resumed = Hill(seed=5, compiled=compiled)
        resumed.restore(half.state())
        resumed.advance(23)
        for name, array in whole.state().items():
            np.testing.assert_array_equal(array, resumed.state()[name], err_msg=name)
    again = pickle.loads(pickle.dumps(half))
    again.advance(23)
    same(whole, again)


@given(st.integers(1, 6), st.lists(st.tuples(st.integers(0, 5), st.integers(0, 40)), max_size=60))
@settings(max_examples=200)
def test_the_list_of_free_patches_is_those_that_are_free(size, moves):
    places = size * size
    taken = np.full(places, -1, np.int64)
    free, free_at = np.zeros(places + 1, np.int64), np.zeros(places, np.int64)
    open_all(taken, free, free_at)
    stand: dict[int, int] = {}
    for who, goal in moves:
        old = stand.get(who, 0)  # who stands nowhere may look as if it stood at the first
        if goal >= places:
            freed(taken, free, free_at, old, who)
            stand.pop(who, None)
        else:
            may = goal not in [at for one, at in stand.items() if one != who]
            assert moved(taken, free, free_at, old, goal, who) is may
            if may:
                stand[who] = goal
        assert sorted(free[1 : free[0] + 1]) == sorted(set(range(places)) - set(stand.values()))
        assert {int(taken[at]): at for at in range(places) if taken[at] >= 0} == stand


def test_every_free_patch_is_drawn_as_often():
    society = Hill(seed=0, compiled=False, width=3, height=2, n_ants=2)
    drawn = [society.world.one_free(np.random.default_rng(seed)) for seed in range(400)]
    found = {(one.x, one.y): 0 for one in drawn}
    for one in drawn:
        found[one.x, one.y] += 1
    assert len(found) == 4 and min(found.values()) > 60
    assert not set(found) & set(places(society))


def test_a_taken_patch_is_refused_and_nothing_changes():
    society = Hill(seed=1)
    one, other = society.ants[0], society.ants[1]
    before = society.state()
    with pytest.raises(ValueRefusedError, match=r"agent 0 of 'ants' onto <patch .*agent 1 of 'a"):
        society.world.move_to(one, other.x, other.y)
    with pytest.raises(ValueRefusedError, match="outside the world"):
        society.world.move_to(one, 0, 100)
    for refused in ("x", "y"):
        with pytest.raises(ValueRefusedError, match="move in one step"):
            setattr(one, refused, 1.0)
        with pytest.raises(ValueRefusedError, match="move in one step"):
            setattr(society.ants, refused, 1.0)
    for name, array in society.state().items():
        np.testing.assert_array_equal(array, before[name])
    spot = society.world.one_free(np.random.default_rng(1))
    left = one.x, one.y
    society.world.move_to(one, spot.x + 9, spot.y)
    assert (one.x, one.y) == (spot.x, spot.y)
    assert society.world.is_free(*left) and not society.world.is_free(spot.x, spot.y)
    society.world.move_to(one, spot.x + 0.3, spot.y)  # on its own patch it may move
    assert one.x == pytest.approx(spot.x + 0.3)


def seek(ant, model, rng):
    ant.steps += len(model.ants.neighbours(ant)) + 10 * len(model.ants.near(ant, 2.5))
    spot = model.world.one_free(rng)
    model.world.move_to(ant, spot.x, spot.y)
    ant.steps += 100 * len(model.ants.on(ant)) + 1000 * len(model.ants.neighbours4(ant))
    if rng.random() < 0.1:
        ant.die()
    elif rng.random() < 0.1:
        arrive(ant.hatch(), model, rng)


class Seeking(Hill):
    schedule = (each(Hill.ants, seek),)


def test_who_moves_so_is_found_where_it_is():
    fast, slow = Seeking(seed=4), Seeking(seed=4, compiled=False)
    for society in (fast, slow):
        society.advance(30)
    assert fast.ants.steps.tolist() == slow.ants.steps.tolist()
    assert fast.ants.x.tolist() == slow.ants.x.tolist()


def crowd(ant, model):
    model.world.move_to(ant, 1, 1)


def stay(ant, model):
    model.world.is_free(0, 0)


def bear(ant, model):
    if model.tick == 2:
        ant.hatch()


def draw(ant, model, rng):
    model.world.move_to(ant, model.world.one_free(rng).x, 0)
    model.world.one_free(rng)


@pytest.mark.parametrize("compiled", [True, False])
def test_what_fails_in_a_rule_says_who_and_where(compiled):
    class Crowded(Model):
        ants = Population(Ant, 2)
        world = Torus(3, one_per_patch=True)
        setup = (each(ants, arrive),)
        schedule = (each(ants, crowd),)

    with pytest.raises(RuleError, match=r"test_one_per_patch.py:\d+: .*where agent \d of 'ants'"):
        Crowded(compiled=compiled).advance(1)

    class Unplaced(Crowded):
        schedule = (each(Crowded.ants, bear),)

    society = Unplaced(compiled=compiled)
    with pytest.raises(
        RuleError, match=r"stands nowhere; place it .* in tick 2, agent 2 of 'ants'"
    ):
        society.advance(5)

    class Nowhere(Crowded):
        setup = (each(Crowded.ants, stay),)

    with pytest.raises(RuleError, match="in the setup: an agent that stands nowhere"):
        Nowhere(compiled=compiled)

    class Full(Crowded):
        world = Grid(2, 1, one_per_patch=True)
        schedule = (each(Crowded.ants, draw),)

    with pytest.raises(RuleError, match=r"one_free\(\) of a world without a free patch"):
        Full(compiled=compiled).advance(1)


def test_setting_a_place_in_a_rule_is_refused_with_what_to_write():
    def jump(ant, model):
        ant.x += 1

    class Jumping(Model):
        ants = Population(Ant, 2)
        world = Torus(3, one_per_patch=True)
        schedule = (each(ants, jump),)

    with pytest.raises(ModelError, match=r"'x' alone; .*move in one step, world.move_to\(agent"):
        Jumping()


def test_a_large_setup_is_compiled_and_fails_alike():
    class Large(Model):
        ants = Population(Ant, 30_000)
        world = Torus(200, one_per_patch=True)
        setup = (each(ants, arrive),)

    assert Large(seed=1).world.free_count == 10_000

    class TooSmall(Large):
        world = Torus(150, one_per_patch=True)

    with pytest.raises(RuleError, match="without a free patch"):
        TooSmall(seed=1)


def test_a_checkpoint_with_wrong_holders_is_refused():
    society = Hill(seed=1)
    state = society.state()
    with pytest.raises(SocialmindError, match=r"world\.taken"):
        Hill(seed=1).restore({**state, "world.taken": state["world.taken"][:-1]})
    twice = np.zeros_like(state["world.taken"])
    with pytest.raises(SocialmindError, match="stand on no patch, or on two"):
        Hill(seed=1).restore({**state, "world.taken": twice})
    del state["world.taken"]
    with pytest.raises(SocialmindError, match=r"world\.taken holds nothing"):
        Hill(seed=1).restore(state)


def test_worlds_without_it_have_no_further_columns():
    class Plain(Model):
        world = Torus(3)

    names = Plain().contexts.dtype.names
    assert [name for name in names if "world" in name] == [
        "_world_size",
        "_world_low",
        "_world_high",
    ]
    assert set(values_of(of_grid(True), 3, 3, None)) & {"size"} == set()
