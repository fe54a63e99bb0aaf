"""Walking over ground: how long it takes, what cannot be entered, and roads."""

import pytest

from socialmind import Agent, Grid, Model, Population, each, once, parameter
from socialmind.terrain import Ground, step_ahead, step_towards, wear_off


class Walker(Agent):
    stride: int = 2


def lay(model):
    for patch in model.world.patches:
        patch.passability = model.passability
        patch.effort = model.passability
        patch.impassable = model.walled and (abs(patch.x) > 1 or abs(patch.y) > 1)


def walk(walker, model, rng):
    if model.aims:
        step_towards(walker, model, 4, 2, 3, 20.0, model.roads, rng)
    else:
        step_ahead(walker, model, model.roads, rng)


def recover(model):
    if model.tick % 10 == 9:
        wear_off(model, model.wear)


class Field(Model):
    """Walkers on a field."""

    passability: int = parameter(25)
    walled: bool = parameter(False)
    aims: bool = parameter(False)
    wear: int = parameter(1)
    roads: int = parameter(3)
    walkers = Population(Walker, 1)
    world = Grid(11, 11, patch=Ground)
    setup = (once(lay),)
    schedule = (each(walkers, walk), once(recover))


@pytest.mark.parametrize(
    ("passability", "places"),
    [
        (25, [1, 2, 3, 4]),  # a patch a tick
        (39, [1, 2, 3, 4]),  # 3 - 2
        (45, [0, 1, 1, 2]),  # 4 - 2 ticks
        (55, [0, 0, 1, 1]),  # 5 - 2 ticks
        (12, [2, 4, -5, -3]),  # two patches in a tick, round the world
        (3, [2, 4, -5, -3]),
    ],
)
def test_a_patch_takes_as_long_as_its_passability_says(passability, places):
    field = Field(seed=1, compiled=False, passability=passability)
    field.walkers.heading = 90.0
    found = []
    for _ in places:
        field.advance(1)
        found.append(field.walkers[0].x)
    assert found == places


@pytest.mark.parametrize("compiled", [True, False])
def test_who_crosses_two_patches_in_a_tick_stops_where_it_wants_to_go(compiled):
    field = Field(seed=1, compiled=compiled, passability=12, aims=True)
    places = []
    for _ in range(4):
        field.advance(1)
        places.append((field.walkers[0].x, field.walkers[0].y))
    assert places[1:] == [(4, 2)] * 3
    field.walkers.x, field.walkers.y = 3, 2
    field.advance(1)
    assert (field.walkers[0].x, field.walkers[0].y) == (4, 2)


def test_nobody_enters_what_is_impassable_at_either_speed():
    found = []
    for compiled in (True, False):
        field = Field(seed=5, compiled=compiled, walled=True)
        places = []
        for _ in range(40):
            field.advance(1)
            places.append((field.walkers[0].x, field.walkers[0].y))
        found.append(places)
    assert found[0] == found[1]
    assert all(max(abs(x), abs(y)) <= 1 for x, y in found[0])
    assert len(set(found[0])) > 4


def test_who_is_walled_in_stays():
    field = Field(seed=5, compiled=False, walled=True)
    for patch in field.world.patches:
        patch.impassable = (patch.x, patch.y) != (0, 0)
    field.advance(5)
    assert (field.walkers[0].x, field.walkers[0].y) == (0.0, 0.0)


def test_what_is_trodden_becomes_a_road_and_is_lost_again():
    field = Field(seed=1, compiled=False, aims=True, wear=4)
    field.advance(4)
    assert (field.walkers[0].x, field.walkers[0].y) == (4.0, 2.0)
    place = field.world.patch(4, 2)
    assert (place.passage, place.road, place.effort) == (1, False, 25.0)
    for _ in range(3):
        field.walkers[0].x = 3.0
        field.advance(1)
    assert (place.passage, place.road, place.effort) == (4, True, 12.5)
    field.advance(3)  # standing there leaves no further trace
    assert (place.passage, place.road, place.effort) == (0, False, 25.0)


@pytest.mark.parametrize("compiled", [True, False])
def test_who_crosses_two_patches_in_a_tick_leaves_a_trace_on_both(compiled):
    field = Field(seed=1, compiled=compiled, passability=12)
    field.walkers.heading = 90.0
    field.advance(2)
    trodden = [(patch.x, patch.passage) for patch in field.world.patches if patch.passage]
    assert sorted(trodden) == [(1, 1), (2, 1), (3, 1), (4, 1)]


def test_without_roads_there_are_none_however_often_a_patch_is_trodden():
    field = Field(seed=1, compiled=False, aims=True, wear=0, roads=0)
    for _ in range(9):
        field.walkers[0].x, field.walkers[0].y = 3.0, 2.0
        field.advance(1)
    place = field.world.patch(4, 2)
    assert (place.passage, place.road, place.effort) == (9, False, 25.0)
