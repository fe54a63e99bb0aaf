"""Ants: two ways of the length that they say, steps by their marks, food taken and brought home."""

import math

import pytest

from socialmind.catalogue import load_model
from socialmind.sources.folders import model_folder
from socialmind.sources.loading import load_file

NAME = "ant_foraging"
BRIDGE = {"bridge": True, "outward": 0.3, "homeward": 0.3}


@pytest.fixture(params=[True, False], ids=["compiled", "interpreted"])
def make(request):
    """Make a colony at either speed, of one ant unless told otherwise."""

    def made(seed=4, **parameters):
        options = {"n_ants": 1, **parameters}
        return load_model(NAME)(seed, compiled=request.param, **options)

    return made


@pytest.fixture
def rules():
    """The rules, called from outside as the interpreter calls them."""
    return load_file(model_folder(NAME) / "model.py")


def open_patches(society):
    return {(patch.x, patch.y) for patch in society.world.patches if patch.open}


def around(place, patches):
    x, y = place
    beside = {(x + dx, y + dy) for dx in (-1, 0, 1) for dy in (-1, 0, 1)} - {place}
    return beside & patches


@pytest.mark.parametrize("detour", range(19))
def test_a_way_takes_16_steps_and_two_for_each_patch_of_detour(detour):
    society = load_model(NAME)(1, compiled=False, n_ants=1, bridge=True, detour_north=detour)
    patches = open_patches(society)
    north = {(x, y) for x, y in patches if y > 0}
    assert around((-8, 0), north) == {(-7, 1)}
    assert around((8, 0), north) == {(7, 1)}
    # From the nest on, each patch goes on to one other: there is nothing to choose.
    here, before, steps = (-7, 1), (-8, 0), 1
    while here != (8, 0):
        (there,) = around(here, patches) - {before}
        here, before, steps = there, here, steps + 1
    assert steps == 16 + 2 * detour == len(north) + 1


def test_ways_of_equal_detour_are_mirrored():
    society = load_model(NAME)(1, compiled=False, n_ants=1, bridge=True, detour_north=12)
    patches = open_patches(society)
    assert {(x, -y) for x, y in patches} == patches


def test_piles_lie_around_the_nest_and_hold_what_they_say():
    for seed in range(5):
        society = load_model(NAME)(seed, compiled=False, n_ants=1, n_piles=4, pile_food=20)
        food = [(patch.x, patch.y, patch.food) for patch in society.world.patches if patch.food]
        assert sum(pieces for _, _, pieces in food) == 80
        assert {pieces for _, _, pieces in food} == {2, 3}
        assert all(abs(math.hypot(x, y) - 14) < 2.5 for x, y, _ in food)
        assert not any(society.world.patch(x, y).nest for x, y, _ in food)


def test_marks_and_the_nest_attract(rules):
    society = load_model(NAME)(1, compiled=False, n_ants=1, homing=1.5)
    ant = society.ants[0]
    society.world.move_to(ant, 5, 0)
    society.world.patch(6, 0).pheromone = 4.0
    assert rules.attraction(ant, 2, society) == pytest.approx((20 + 4) ** 2)
    assert rules.attraction(ant, 6, society) == pytest.approx(20**2)
    ant.laden = True
    assert rules.attraction(ant, 2, society) == pytest.approx(24**2 * math.exp(-1.5))
    assert rules.attraction(ant, 6, society) == pytest.approx(20**2 * math.exp(1.5))
    assert rules.attraction(ant, 7, society) == pytest.approx(
        20**2 * math.exp(1.5 * math.sqrt(0.5))
    )
    society.world.move_to(ant, 20, 0)
    assert rules.attraction(ant, 2, society) == 0.0  # the wall


def test_an_ant_on_its_way_weighs_three_steps_and_one_in_the_nest_all(rules):
    society = load_model(NAME)(1, compiled=False, n_ants=1)
    ant = society.ants[0]
    ant.heading = 0.0
    rules.weigh(ant, rules.AHEAD, society)
    assert [chance > 0 for chance in ant.chances] == [1, 1, 0, 0, 0, 0, 0, 1]
    rules.weigh(ant, rules.ANYWHERE, society)
    assert all(chance > 0 for chance in ant.chances)


def test_one_ant_goes_to_the_food_and_back_and_marks_its_way(make):
    society = make(bridge=True, leaving=1.0, outward=2.0, homeward=3.0, detour_south=2,
                   diffusion=0.0, evaporation=0.0)  # fmt: skip
    ant = society.ants[0]
    society.advance(19)
    assert not ant.laden
    society.advance(1)
    assert ant.laden
    assert (ant.x, ant.y) == (8, 0)
    # Twenty steps, of which the last ends on the food, which is not marked.
    assert society.world.pheromone.sum() == pytest.approx(19 * 2.0)
    society.advance(20)
    assert (ant.inside, ant.laden, ant.brought, society.brought) == (True, False, 1, 1)
    assert (ant.x, ant.y) == (-8, 0)
    assert society.world.pheromone.sum() == pytest.approx(19 * 5.0)
    assert society.passed_north + society.passed_south == 2
    assert society.world.patch(8, 0).food == 1


def test_food_of_a_pile_comes_to_an_end(make):
    society = make(n_ants=30, n_piles=1, pile_food=12, pile_distance=4.0)
    for _ in range(40):
        society.advance(5)
        series = society.series()
        assert series["food"] + series["laden"] + series["brought"] == 12
        assert series["brought"] == society.ants.brought.sum()
    assert series["brought"] == 12


def test_marks_fade(make):
    society = make(leaving=0.0, diffusion=0.4, evaporation=0.1)
    society.world.patch(20, 20).pheromone = 80.0
    society.advance(1)
    # In the corner five eighths of what spreads have nowhere to go.
    assert society.world.patch(20, 20).pheromone == pytest.approx(0.9 * (80 - 3 * 4))
    assert society.world.patch(19, 19).pheromone == pytest.approx(0.9 * 4)
    assert society.world.pheromone.sum() == pytest.approx(72)
    assert society.series()["outside"] == 0


def shares(**parameters):
    """Return the share of traffic on the northern way, late, for eight seeds."""
    found = []
    for seed in range(8):
        society = load_model(NAME)(seed, **{**BRIDGE, **parameters})
        society.advance(1_000)
        north, south = society.passed_north, society.passed_south
        society.advance(500)
        north, south = society.passed_north - north, society.passed_south - south
        found.append(north / (north + south))
    return found


def test_the_shorter_way_wins_in_most_colonies():
    assert sum(share > 0.9 for share in shares()) >= 7
    assert sum(share < 0.1 for share in shares(detour_north=12, detour_south=2)) >= 7


def test_without_marks_neither_way_wins():
    assert all(0.4 < share < 0.6 for share in shares(outward=0.0, homeward=0.0))


def test_of_two_equal_ways_one_wins():
    assert all(share < 0.1 or share > 0.9 for share in shares(detour_south=2))


def test_marks_bring_the_food_of_one_pile_home_sooner():
    for seed in range(3):
        marked, bare = (
            load_model(NAME)(seed, n_piles=1, pile_food=900, homeward=drop) for drop in (10.0, 0.0)
        )
        marked.advance(500)
        bare.advance(500)
        assert marked.brought > 1.5 * bare.brought
