"""Wolves, cows and bulls: fears, meals, calves, attacks and flight."""

import math

import pytest

from socialmind.catalogue import load_model
from socialmind.sources.folders import model_folder
from socialmind.sources.loading import load_file

NAME = "wolf_cow"


@pytest.fixture
def rules():
    """The rules, called from outside as the interpreter calls them."""
    return load_file(model_folder(NAME) / "model.py")


def pasture(cow=(0, 0), bull=None, wolf=None, **parameters):
    """Make one cow, and a bull and a wolf where they have a place."""
    society = load_model(NAME)(
        5, compiled=False, n_cows=1, n_bulls=int(bull is not None),
        n_wolves=int(wolf is not None),
        bull_step=0.0, **parameters,
    )  # fmt: skip
    for animals, place in ((society.cows, cow), (society.bulls, bull), (society.wolves, wolf)):
        for animal in animals:
            animal.x, animal.y = place
    return society


@pytest.mark.parametrize(
    ("bull", "fear"), [((0, 2.05), 5), ((0, 4.1), 10), ((9, 0), 10), ((0, 0), 0), (None, 10)]
)
def test_a_cow_fears_to_be_far_from_bulls(rules, bull, fear):
    society = pasture(bull=bull)
    assert rules.fear_of_cow(society.cows[0], society) == pytest.approx(fear)


@pytest.mark.parametrize(
    ("bull", "courage", "fear"), [((0, 5), 50, 10), ((0, 5), 100, 0), ((4, 3), 0, 20), (None, 0, 0)]
)
def test_a_wolf_fears_to_be_near_bulls(rules, bull, courage, fear):
    society = pasture(bull=bull, wolf=(0, 0), courage=float(courage))
    assert rules.fear_of_wolf(society.wolves[0], society) == pytest.approx(fear)


@pytest.mark.parametrize(
    ("energy", "bull", "plan"),
    [
        (24.0, (0, 0), "cow-eat"),
        (26.0, (0, 0), "reproduce"),
        (24.0, (9, 0), "follow-bull"),
        (9.0, (9, 0), "cow-eat"),
        (39.0, (9, 0), "follow-bull"),
        (42.0, (9, 0), "reproduce"),
    ],
)
def test_what_a_cow_does(energy, bull, plan):
    society = pasture(bull=bull)
    society.cows[0].energy = energy
    society.advance(1)
    assert society.cows[0].plan == plan


@pytest.mark.parametrize(
    ("hunger", "plan"), [(0.0, "flee"), (49.0, "flee"), (50.0, "attack"), (90.0, "attack")]
)
def test_hunger_overcomes_a_wolfs_fear(hunger, plan):
    # Fear is 50 / 5 = 10: it attacks from a hunger of 50 on.
    society = pasture(bull=(0, 5), wolf=(0, 0), hunger_growth=0.0)
    society.wolves[0].hunger = hunger
    society.cows[0].x = 12
    society.advance(1)
    assert society.wolves[0].plan == plan
    assert (society.attacking, society.fleeing) == ((1, 0) if plan == "attack" else (0, 1))


def test_a_wolf_goes_for_a_cow_and_eats_it(rules):
    society = pasture(cow=(0, 1.5), wolf=(0, 0))
    wolf = society.wolves[0]
    wolf.hunger = 7.0
    rules.attack(wolf, society, None)
    assert (wolf.y, wolf.hunger, society.killed) == (1.0, 7.0, 0)
    rules.attack(wolf, society, None)
    assert (wolf.hunger, wolf.eaten, society.killed, len(society.cows)) == (0.0, 1, 1, 0)


def test_a_wolf_flees_a_step_away_from_the_bull(rules):
    for seed in range(5):
        society = pasture(bull=(0, 5), wolf=(0, 0))
        wolf = society.wolves[0]
        turn = (seed - 2) * 5.0

        class Drawn:
            @staticmethod
            def uniform(low, high, turn=turn):
                assert (low, high) == (-10, 10)
                return turn

        rules.flee(wolf, society, Drawn)
        assert (wolf.x, wolf.y) == pytest.approx(
            (-math.sin(math.radians(turn)), -math.cos(math.radians(turn)))
        )


def test_a_calf_gets_half_the_energy_and_the_mind(rules):
    society = pasture()
    cow = society.cows[0]
    cow.energy = 30.0
    rules.reproduce(cow, society)
    assert (len(society.cows), society.born) == (1, 0)
    cow.energy = 44.0
    cow.mind.set_cogniton_value("fear", 3.5)
    rules.reproduce(cow, society)
    calf = list(society.cows)[1]
    assert (cow.energy, calf.energy, calf.generation, society.born) == (22.0, 22.0, 1, 1)
    assert (calf.x, calf.y) == (cow.x, cow.y)
    assert calf.mind.get_cogniton_value("fear") == 3.5


def test_meals_whole_in_part_and_none(rules):
    society = pasture()
    cow, patch = society.cows[0], society.world.patch(0, 0)
    patch.grass, cow.energy = 129.0, 10.0
    rules.eat(cow, society, None)
    assert (cow.energy, patch.grass) == (pytest.approx(15.4), 43.0)
    rules.eat(cow, society, None)
    assert (cow.energy, patch.grass) == (pytest.approx(18.1), 0.0)


def test_every_cow_is_accounted_for():
    society = load_model(NAME)(3)
    society.advance(2_000)
    assert len(society.cows) == 19 + society.born - society.killed - society.starved
    assert society.killed == society.wolves.eaten.sum() > 0
    assert society.attacking + society.fleeing == 5
