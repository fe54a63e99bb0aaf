"""The contract of worlds, held over torus, plane, none, and one that is no part of the library."""

import copy
import pickle
from pathlib import Path

import numpy as np
import pytest

from socialmind import Agent, Model, Patch, Population, Torus, each, parameter
from socialmind.catalogue import load_model
from socialmind.errors import ModelError, SocialmindError
from socialmind.sources.loading import load_file
from socialmind.worlds.contract import Ground, World

FOLDER = Path(__file__).parent
ring = load_file(FOLDER / "ring.py", alone=True)


class Walker(Agent):
    pace: float = 1.5
    steps: int = 0


class Land(Patch):
    trodden: int = 0


def walk_round(walker, model, rng):
    model.world.stroll(walker, walker.pace + rng.random())
    walker.steps += model.world.length


def walk(walker, model):
    model.world.forward(walker, walker.pace)
    model.world.patch(walker.x, walker.y).trodden += 1
    walker.steps += model.world.size


def stay(walker):
    walker.steps += 1


class OnRing(Model):
    places: int = parameter(9, low=1)
    walkers = Population(Walker, 7)
    world = ring.Ring("places")
    schedule = (each(walkers, walk_round),)


class OnTorus(Model):
    places: int = parameter(9, low=1)
    walkers = Population(Walker, 7)
    world = Torus("places", Land)
    schedule = (each(walkers, walk),)


class Nowhere(Model):
    walkers = Population(Walker, 7)
    schedule = (each(walkers, stay),)


@pytest.fixture(params=["ring", "torus", "none", "plane"])
def kind(request):
    """A model in each world."""
    known = {"ring": OnRing, "torus": OnTorus, "none": Nowhere}
    return known.get(request.param) or load_model(FOLDER / "plane" / "seekers")


def same(one, other):
    first, second = one.state(), other.state()
    assert list(first) == list(second)
    for name, array in first.items():
        np.testing.assert_array_equal(array, second[name], err_msg=name)


def test_a_world_is_declaration_shape_and_ground(kind):
    society = kind(seed=3)
    assert isinstance(kind.declared_world, World)
    assert isinstance(society.ground, Ground)
    assert society.shape.world is kind.shape.world
    if "world" in vars(kind):
        assert kind.world is kind.declared_world
        assert society.world is society.ground.world


def test_both_speeds_agree(kind):
    compiled, interpreted = kind(seed=3), kind(seed=3, compiled=False)
    for society in (compiled, interpreted):
        society.advance(5)
    same(compiled, interpreted)


def test_it_goes_on_from_its_state(kind):
    whole, resumed = kind(seed=4, compiled=False), kind(seed=4, compiled=False)
    whole.advance(4)
    half = kind(seed=4, compiled=False)
    half.advance(2)
    resumed.restore(half.state())
    resumed.advance(2)
    same(whole, resumed)


def test_it_is_copied(kind):
    society = kind(seed=5, compiled=False)
    society.advance(2)
    again = copy.copy(society)
    society.advance(1)
    again.advance(1)
    same(society, again)


def test_a_state_of_another_model_is_refused(kind):
    state = kind(seed=3).state()
    state["context"] = state["context"].copy()
    state["context"]["_tick"] = -1
    with pytest.raises(SocialmindError, match="checkpoint"):
        kind(seed=3).restore(state)


def test_places_are_kept_within(kind):
    society = kind(seed=1)
    table = next(iter(society.tables.values()))
    keep = society.ground.keeper(table.shape.name, "x")
    if keep is None:
        table.x = 1e6
        assert (table.x == 1e6).all()
        return
    try:
        expected = keep(1e6, "somebody")
    except SocialmindError as refused:
        with pytest.raises(type(refused), match="outside"):
            table.x = 1e6
        return
    table.x = 1e6
    assert (table.x == expected).all()


def test_the_ring_wraps_by_hand():
    society = OnRing(seed=0, places=4, compiled=False)
    society.walkers.x = 5.0
    assert society.walkers.x.tolist() == [1.0] * 7
    society.walkers.pace = 100.0  # at most once round, which is where it began
    society.advance(1)
    assert society.walkers.x.tolist() == [1.0] * 7
    assert society.walkers.steps.tolist() == [4] * 7


def test_a_size_below_one_is_refused():
    for kind in (OnRing, OnTorus):
        with pytest.raises(SocialmindError, match="places"):
            kind(places=0)


def test_devices_of_another_world_are_refused():
    with pytest.raises(ModelError, match="rewards without a plane"):

        class Paid(Model):
            world = ring.Ring(3)
            rewards = {"gain": 1}  # noqa: RUF012


def test_a_society_elsewhere_is_pickled():
    society = load_model(FOLDER / "plane" / "seekers")(seed=2, compiled=False)
    society.advance(1)
    same(society, pickle.loads(pickle.dumps(society)))
