"""Grids as worlds of models: both speeds, a torus as the square that wraps, what is refused."""

import math
import pickle

import numpy as np
import pytest

from socialmind import Agent, Grid, Model, Patch, Population, Torus, each, once, parameter
from socialmind.errors import ModelError, RuleError, SocialmindError, ValueRefusedError


class Walker(Agent):
    met: int = 0
    away: float = 0.0


class Land(Patch):
    trodden: int = 0
    grass: float = 1.0


def arrive(walker, model, rng):
    model.world.move_to(
        walker,
        rng.integers(model.world.low_x, model.world.high_x + 1),
        rng.integers(model.world.low_y, model.world.high_y + 1),
    )


def walk(walker, model, rng):
    world = model.world
    world.right(walker, rng.uniform(-90, 90))
    if not world.can_move(walker, 1.5):
        world.left(walker, 100)
    world.forward(walker, rng.uniform(-2, 4))
    here = world.patch(walker.x, walker.y)
    here.trodden += 1
    for patch in world.in_radius(walker, 2.3):
        patch.grass *= 0.9
        walker.met += patch.x + 3 * patch.y
    walker.away += world.distance(walker, 0, 1) + world.towards(walker, 1, 0)
    world.walk_to(walker, here.x, here.y, 0.3)
    world.forward(walker, 1)
    world.forward(walker, -2)
    if world.is_inside(walker.x + 1, walker.y) and world.is_on(walker, here.x, here.y):
        walker.x += 1


def grow(model):
    for patch in model.world.patches:
        patch.grass = min(1.0, patch.grass + 0.01 * (patch.x - model.world.low_x))


class OnGrid(Model):
    across: int = parameter(7, low=1)
    up: int = parameter(4, low=1)
    walkers = Population(Walker, 9)
    world = Grid("across", "up", wraps=False, patch=Land, low=(-1, 0))
    setup = (each(walkers, arrive),)
    schedule = (each(walkers, walk), once(grow))


class OnTube(OnGrid):
    world = Grid("across", "up", wraps="y", patch=Land)


class OnTorus(OnGrid):
    world = Torus("across", Land)


class OnSquare(OnGrid):
    world = Grid("across", "across", patch=Land)


def state_of(society):
    society.advance(30)
    return society.state()


@pytest.mark.parametrize("kind", [OnGrid, OnTube])
def test_both_speeds_agree(kind):
    for across, up in ((7, 4), (2, 1), (3, 9)):
        fast = state_of(kind(seed=3, across=across, up=up))
        slow = state_of(kind(seed=3, across=across, up=up, compiled=False))
        for name, array in fast.items():
            np.testing.assert_array_equal(array, slow[name], err_msg=name)


def test_a_torus_is_the_square_that_wraps():
    for compiled in (True, False):
        one = state_of(OnTorus(seed=4, compiled=compiled))
        other = state_of(OnSquare(seed=4, compiled=compiled))
        for name, array in one.items():
            if name != "context":
                np.testing.assert_array_equal(array, other[name], err_msg=name)


def test_it_goes_on_from_its_state_and_is_pickled():
    whole, half = OnTube(seed=6), OnTube(seed=6)
    whole.advance(12)
    half.advance(5)
    resumed = OnTube(seed=6, compiled=False)
    resumed.restore(half.state())
    again = pickle.loads(pickle.dumps(half))
    for society in (resumed, again):
        society.advance(7)
        for name, array in whole.state().items():
            np.testing.assert_array_equal(array, society.state()[name], err_msg=name)
    world = pickle.loads(pickle.dumps(half.world))
    assert (world.trodden == half.world.trodden).all() and world.low_x == half.world.low_x


def test_columns_of_fields_are_by_column_from_the_south_west():
    society = OnGrid(seed=1)
    society.world.grass = np.arange(28.0).reshape(7, 4)
    assert society.world.grass.shape == (7, 4)
    assert society.world.patch(-1, 0).grass == 0.0
    assert society.world.patch(0, 2).grass == 6.0
    with pytest.raises(ValueRefusedError, match=r"found the shape \(4, 7\); expected \(7, 4\)"):
        society.world.set(grass=np.zeros((4, 7)))
    with pytest.raises(AttributeError, match="size"):
        print(society.world.size)


def test_users_move_agents_as_rules_do():
    society = OnGrid(seed=1)
    walker = society.walkers[0]
    society.world.move_to(walker, 5, 3)
    walker.heading = 90.0
    society.world.forward(walker, 9)
    assert (walker.x, walker.y) == (5.0, 3.0)
    assert society.world.distance(walker, 2, 3) == 3.0
    for x, y in ((6, 3), (5, 4), (math.nan, 0)):
        with pytest.raises(ValueRefusedError, match="outside the world"):
            society.world.move_to(walker, x, y)
    with pytest.raises(ValueRefusedError, match="agent 0"):
        walker.x = 6
    with pytest.raises(ValueRefusedError, match=r"'walkers' \(row 0\): found 9"):
        society.walkers.y = 9
    assert (walker.x, walker.y) == (5.0, 3.0)


def leave(walker, model):
    walker.x = model.world.high_x + 1


def look(walker, model):
    model.world.patch(0, model.world.low_y - 1).grass = 0


@pytest.mark.parametrize("rule", [leave, look])
@pytest.mark.parametrize("compiled", [True, False])
def test_what_lies_outside_is_an_error_in_rules(rule, compiled):
    kind = type("Leaving", (OnGrid,), {"schedule": (each(OnGrid.walkers, rule),)})
    with pytest.raises(RuleError, match=r"test_grid.py:\d+: .*outside the world.*in tick 0, agent"):
        kind(seed=1, compiled=compiled).advance(1)


@pytest.mark.parametrize(
    ("declared", "expected"),
    [
        (lambda: Grid(3, 0), "the size 0; expected a whole number, 1 or more"),
        (lambda: Grid(3, "many"), "the size 'many'"),
        (lambda: Grid(3, 3, wraps="z"), "wraps='z' of the world; expected True, False, 'x' or 'y'"),
        (lambda: Grid(3, 3, low=3), "low=3 of the world; .*two whole numbers; write low="),
        (lambda: Grid(3, 3, one_per_patch=2), "one_per_patch=2; expected True or False"),
        (lambda: Grid(3, 3, patch=Walker), "as the patches of the world"),
    ],
)
def test_wrong_declarations_are_refused(declared, expected):
    with pytest.raises(ModelError, match=expected):
        type("Wrong", (Model,), {"world": declared()})


def test_names_that_the_world_uses_are_refused():
    class Named(Patch):
        height: float = 0.0

    with pytest.raises(ModelError, match="a field called 'height'"):
        type("Wrong", (Model,), {"world": Grid(3, 3, patch=Named)})


def test_a_world_without_the_origin_is_refused():
    kind = type("Far", (Model,), {"world": Grid(3, 3, low=(5, 0))})
    with pytest.raises(SocialmindError, match=r"low=\(5, 0\) of a world of 3 × 3 patches"):
        kind()
