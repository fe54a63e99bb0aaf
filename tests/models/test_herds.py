"""Herds: cows found, join and leave them as their plans say."""

import pytest

from coglogo_py import CognitiveScheme
from socialmind.catalogue import load_model
from socialmind.sources.folders import model_folder
from socialmind.sources.loading import load_file

NAME = "herds"


@pytest.fixture(params=[True, False], ids=["compiled", "interpreted"])
def make(request):
    """Make a pasture with few cows, at either speed, where cows do as they are told."""

    def made(n_cows=3, **parameters):
        return load_model(NAME)(5, compiled=request.param, n_cows=n_cows, **parameters)

    return made


@pytest.fixture
def rules():
    """The rules, called from outside as the interpreter calls them."""
    return load_file(model_folder(NAME) / "model.py")


def placed(society, *places):
    """Put the cows on places and return them."""
    cows = list(society.cows)
    for cow, (x, y) in zip(cows, places, strict=True):
        cow.x, cow.y = x, y
    return cows


def herds_of(cows):
    return [cow.mind.get_group_id("herd") for cow in cows]


def test_the_scheme_is_that_of_coglogo():
    scheme = CognitiveScheme.load(model_folder(NAME) / "scheme.yaml")
    assert (scheme.decision_maker.name, scheme.decision_maker.bias) == (
        "BiasedWeightedStochastic",
        2,
    )
    energy, base = scheme.cognitons
    assert dict(energy.influence) == {
        "lead-herd": 0.01, "cow-eat": -0.1, "create-group": 0.01, "follow-leader": 0.01,
    }  # fmt: skip
    assert (base.start_value, tuple(base.conditional)) == (
        50,
        ("cow-eat", "look-for-group", "create-group"),
    )
    assert [role.name for role in scheme.groups[0].roles] == ["leader", "follower"]


def test_a_cow_joins_the_nearest_leader_in_sight(rules):
    society = load_model(NAME)(5, compiled=False, n_cows=4)
    cows = placed(society, (0, 0), (3, 0), (-2, 0), (12, 0))
    for leader in (cows[1], cows[2], cows[3]):
        rules.create_group(leader, society)
    rules.look_for_group(cows[0], society, None)
    assert herds_of(cows)[0] == herds_of(cows)[2]
    assert cows[0].leader == cows[2].id
    assert cows[0].mind.get_participation("herd") == 4.0
    assert [cow.founded for cow in cows] == [0, 1, 1, 1]
    # A leader that sees another one follows it, and its herd is left without.
    rules.look_for_group(cows[2], society, None)
    assert herds_of(cows)[2] == herds_of(cows)[1]
    assert herds_of(cows)[0] >= 0
    rules.follow_leader(cows[0], society)
    assert herds_of(cows)[0] == -1
    assert cows[0].leader is None


def test_a_follower_walks_to_its_leader_and_stops_beside_it(rules):
    society = load_model(NAME)(5, compiled=False, n_cows=2)
    cow, leader = placed(society, (0, 0), (0, 2.5))
    rules.create_group(leader, society)
    rules.look_for_group(cow, society, None)
    places = []
    for _ in range(3):
        rules.follow_leader(cow, society)
        places.append((cow.x, cow.y))
    assert places == [(0, 1), (0, 2), (0, 2)]


def test_a_herd_whose_leader_has_died_is_left(rules):
    society = load_model(NAME)(5, compiled=False, n_cows=2)
    cow, leader = placed(society, (0, 0), (0, 2))
    rules.create_group(leader, society)
    rules.look_for_group(cow, society, None)
    leader.die()
    assert herds_of([cow])[0] >= 0
    rules.follow_leader(cow, society)
    assert herds_of([cow]) == [-1]


def test_a_follower_founds_a_herd_of_its_own_and_a_leader_none(rules):
    society = load_model(NAME)(5, compiled=False, n_cows=2)
    cow, leader = placed(society, (0, 0), (0, 2))
    rules.create_group(leader, society)
    rules.look_for_group(cow, society, None)
    rules.create_group(cow, society)
    rules.create_group(leader, society)
    assert len(set(herds_of([cow, leader]))) == 2
    assert (cow.founded, leader.founded, cow.leader) == (1, 1, None)


def test_meals_whole_in_part_and_none(rules):
    society = load_model(NAME)(5, compiled=False, n_cows=1)
    (cow,) = placed(society, (0, 0))
    patch = society.world.patch(0, 0)
    patch.grass = 129.0
    energy = cow.energy
    rules.eat(cow, society, None)
    assert (cow.energy, patch.grass) == (pytest.approx(energy + 5.4), 43.0)
    rules.eat(cow, society, None)
    assert (cow.energy, patch.grass) == (pytest.approx(energy + 5.4 * 1.5), 0.0)
    assert cow.eaten == 129.0


def test_cows_starve_without_grass(make):
    society = make(growth=0.0)
    society.world.grass = 0.0
    for cow in society.cows:
        cow.energy = 1.0
    society.advance(3)
    assert len(society.cows) == 3
    society.advance(8)
    assert len(society.cows) == 0
    assert society.series() == {
        "cows": 0, "herds": 0, "in_herds": 0, "largest": 0, "energy": 0.0,
    }  # fmt: skip


def test_what_is_counted(make):
    society = make(n_cows=16)
    society.advance(400)
    herds, leading = society.cows.herd, society.cows.leading
    assert society.herds == leading.sum() >= 1
    assert society.in_herds == (herds >= 0).sum()
    assert society.largest == max((herds == one).sum() for one in herds[leading])
    assert herds.tolist() == herds_of(society.cows)


def test_nobody_joins_a_leader_that_is_out_of_sight(make):
    society = make(n_cows=16, sight=0.0)
    society.advance(600)
    assert society.cows.joined.sum() == 0
    assert society.largest == 1
