"""Fields and flocks: two kinds of minds act on one another, and one agent has both."""

import math

import numpy as np
import pytest

from socialmind.catalogue import load_model

SEEDS = range(5)


@pytest.fixture(params=[True, False], ids=["compiled", "interpreted"])
def make(request):
    """Make a society of one farmer, one sheep and one shepherd, at either speed."""

    def made(**parameters):
        few = {"n_farmers": 1, "n_sheep": 1, "n_shepherds": 1}
        model = load_model("fields_and_flocks")
        return model(4, compiled=request.param, **{**few, **parameters})

    return made


def put(agent, x, y, heading=0.0):
    agent.x, agent.y, agent.heading = x, y, heading


def away_from_all(society):
    """Put everybody out of sight of everybody else, and of the field."""
    farmer = society.farmers[0]
    put(society.sheep[0], 0.0, 0.0)
    put(society.shepherds[0], 0.0, 12.0)
    return farmer, society.sheep[0], society.shepherds[0]


def short_way(difference):
    return (difference + 16.5) % 33 - 16.5


# Sheep and fields ---------------------------------------------------------------------------------


def test_a_sheep_eats_crop_before_grass_at_the_owners_loss(make):
    society = make(sheep_speed=0.0)
    farmer, sheep, _ = away_from_all(society)
    society.advance(1)
    assert sheep.food == pytest.approx(0.05)
    assert farmer.loss == 0
    society.world.crop = 0.03
    put(sheep, farmer.field_x, farmer.field_y)
    society.advance(1)
    assert sheep.food == pytest.approx(0.08)  # no more than there is
    assert farmer.loss == pytest.approx(0.03)
    assert farmer.mind.get_cogniton_value("Anger") == pytest.approx(0.03, abs=0.021)


def test_a_sheep_flees_from_those_who_are_after_it_alone(make):
    society = make()
    _, sheep, shepherd = away_from_all(society)
    put(shepherd, 0.0, 1.5)  # half of what sheep fear, to the north
    shepherd.plan = "Rest"
    society.advance(1)
    assert sheep.fear == 0
    put(sheep, 0.0, 0.0)
    put(shepherd, 0.0, 1.5)
    shepherd.plan = "Herd"
    society.advance(1)
    assert sheep.fear == pytest.approx(0.5)
    for _ in range(20):
        put(shepherd, 0.0, 1.5)
        shepherd.plan, shepherd.timer = "Herd", 5
        society.advance(1)
    assert math.hypot(sheep.x, sheep.y - 1.5) > 2.5


def test_behave_by_hand(make):
    society = make()
    _, sheep, shepherd = away_from_all(society)
    put(shepherd, 0.0, 2.25)
    shepherd.plan = "Herd"
    society.advance(1)
    # A quarter of the fear; alone, so nothing to gather with; grass under its feet.
    influence = sheep.hierarchy.influence
    assert influence("Flee") == pytest.approx(0.25)
    assert influence("Gather") == 0
    assert influence("Graze") == pytest.approx(0.75 * 0.5)


# Farmers -----------------------------------------------------------------------------------------


def test_a_farmer_without_intruders_tends_the_field(make):
    society = make(growth=0.25)
    farmer, _, _ = away_from_all(society)
    for ticks, harvest in ((3, 0), (1, 9), (4, 18)):
        for _ in range(ticks):
            away_from_all(society)
            society.advance(1)
            assert farmer.plan == "Tend"
        assert farmer.harvest == harvest


def test_an_angry_farmer_chases_and_the_shepherd_hears_of_it(make):
    society = make(sheep_speed=0.0)
    farmer, sheep, shepherd = away_from_all(society)
    farmer.mind.set_cogniton_value("Anger", 50.0)
    put(sheep, farmer.field_x + 1.0, farmer.field_y + 1.0)
    society.advance(1)
    assert farmer.plan == "Chase"
    assert math.hypot(short_way(farmer.x - farmer.field_x), farmer.y - farmer.field_y) > 0.5
    society.advance(1)
    assert shepherd.mind.get_cogniton_value("Complaints") == 1
    assert sheep.fear > 0


# Shepherds: a hierarchy carries a plan out --------------------------------------------------------


@pytest.mark.parametrize(
    ("plan", "skill", "other"), [("Herd", "Herd", "Return"), ("Rest", "Return", "Herd")]
)
def test_the_plan_decides_which_skill_is_in_charge(make, plan, skill, other):
    society = make()
    _, _, shepherd = away_from_all(society)
    shepherd.plan, shepherd.timer = plan, 5
    society.advance(1)
    assert shepherd.plan == plan
    assert shepherd.hierarchy.influence(skill) == 1
    assert shepherd.hierarchy.influence(other) == 0


def test_a_shepherd_outruns_a_stray_and_then_drives_it(make):
    society = make(sheep_speed=0.0)
    _, sheep, shepherd = away_from_all(society)
    skills = []
    put(sheep, 0.0, 8.0)
    put(shepherd, 0.0, 0.0)
    for _ in range(40):
        shepherd.plan, shepherd.timer = "Herd", 5
        society.advance(1)
        skills.append(shepherd.hierarchy.influence("Drive"))
    assert skills[0] == 0  # the place behind the stray, 10 patches off, comes first
    assert max(skills) > 0.5
    assert math.hypot(shepherd.x - sheep.x, shepherd.y - sheep.y) < 4


def test_a_shepherd_at_rest_goes_home(make):
    society = make()
    _, _, shepherd = away_from_all(society)
    for _ in range(120):
        shepherd.plan, shepherd.timer = "Rest", 5
        society.advance(1)
    assert math.hypot(shepherd.x, shepherd.y) < 2


def test_herding_tires_and_rest_recovers(make):
    society = make()
    _, _, shepherd = away_from_all(society)
    for plan, ticks, fatigue in (("Herd", 10, 0.1), ("Rest", 1, 0.05), ("Rest", 5, 0.0)):
        for _ in range(ticks):
            shepherd.plan, shepherd.timer = plan, 5
            society.advance(1)
        assert shepherd.mind.get_cogniton_value("Fatigue") == pytest.approx(fatigue)


# Society -----------------------------------------------------------------------------------------


def outcome(seed, shepherds):
    """Return strays and chasing farmers in the mean of a run, and the sheep's food."""
    society = load_model("fields_and_flocks")(seed, n_shepherds=shepherds)
    rows = []
    for _ in range(60):
        society.advance(20)
        series = society.series()
        rows.append((series["strays"], series["chasing"], series["food"], series["harvest"]))
    means = np.mean(rows, axis=0)
    return means[0], means[1], rows[-1][2], rows[-1][3]


def test_shepherds_keep_the_peace_and_sheep_pay_for_it():
    without = np.array([outcome(seed, 0) for seed in SEEDS])
    guarded = np.array([outcome(seed, 2) for seed in SEEDS])
    assert (guarded[:, 0] < 0.75 * without[:, 0]).all()  # strays, in every society
    assert guarded[:, 1].mean() < without[:, 1].mean()  # farmers who chase
    assert guarded[:, 2].mean() < 0.95 * without[:, 2].mean()  # food of the sheep
    assert guarded[:, 3].mean() > without[:, 3].mean()  # harvest


def test_fields_are_apart_and_off_the_pasture():
    for seed in SEEDS:
        society = load_model("fields_and_flocks")(seed, n_farmers=20)
        assert (society.world.owner >= 0).sum() == 20 * 9
        places = np.hypot(society.farmers.field_x, society.farmers.field_y)
        assert places.min() > 10
