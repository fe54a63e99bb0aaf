"""Boids: what a boid senses and does, that they flock, and what each skill is needed for."""

import math
from functools import cache

import numpy as np
import pytest

from socialmind.catalogue import load_model
from socialmind.mind import load_mind

SEEDS = range(5)


@pytest.fixture(scope="module")
def mind():
    """The hierarchy of a boid."""
    return load_mind(load_model("boids").folder() / "mind")


def senses(**given):
    """Return the senses of a boid with much company straight ahead; angles, distances and urges."""
    usual = {
        "CENTRE": 0.5,
        "CENTRE_AWAY": 0.2,
        "NEAREST": 0.5,
        "NEAREST_AWAY": 0.5,
        "HEADING": 0.5,
        "COMPANY": 1.0,
        "COHESION": 1.0,
        "SEPARATION": 1.0,
        "ALIGNMENT": 1.0,
    }
    return {**usual, **given}


def test_flocking_gives_influence_by_distance_and_number(mind):
    mind.reset()
    mind.evaluate(senses(CENTRE_AWAY=0.8, NEAREST_AWAY=0.125, COMPANY=0.5))
    # Half as near as it may be: c = 0.5; l = 0.8 · (1 − 0.25) = 0.6.
    assert mind.influences() == pytest.approx(
        {"Flocking": 1.0, "Separation": 0.5, "Cohesion": 0.3, "Alignment": 0.35}
    )
    mind.evaluate(senses(COMPANY=0.0))
    assert mind.influences() == {
        "Flocking": 1.0, "Separation": 0.0, "Cohesion": 0.0, "Alignment": 0.0
    }  # fmt: skip


def test_the_wings_obey_the_weighted_mean_of_the_skills(mind):
    mind.reset()
    found = mind.evaluate(
        senses(CENTRE=0.75, CENTRE_AWAY=0.8, NEAREST=0.75, NEAREST_AWAY=0.125, COMPANY=0.5)
    )
    # Cohesion sharply right, separation sharply left, alignment straight on; at half speed, as the
    # middle is at the side and so is the nearest.
    turn = (0.3 * 1.0 + 0.5 * 0.0 + 0.35 * 0.5) / 1.15
    assert found == pytest.approx({"TURN": turn, "SPEED": 0.5})


@pytest.mark.parametrize(
    ("skill", "sense", "side"),
    [("COHESION", "CENTRE", 1), ("SEPARATION", "NEAREST", -1), ("ALIGNMENT", "HEADING", 1)],
)
def test_each_skill_turns_its_own_way(mind, skill, sense, side):
    urges = {name: float(name == skill) for name in ("COHESION", "SEPARATION", "ALIGNMENT")}
    for angle in (0.3, 0.4, 0.6, 0.7):
        mind.reset()
        found = mind.evaluate(senses(**{sense: angle, "NEAREST_AWAY": 0.1, **urges}))
        assert (found["TURN"] - 0.5) * (angle - 0.5) * side > 0


@pytest.mark.parametrize("compiled", [True, False], ids=["compiled", "interpreted"])
def test_a_boid_sees_over_the_edge_of_the_torus(compiled):
    society = load_model("boids")(1, compiled, n_boids=2, noise=0.0, alignment=0.0)
    one, other = society.boids[0], society.boids[1]
    one.x, one.y, one.heading = 15.5, 0.0, 0.0
    other.x, other.y, other.heading = -14.5, 0.0, 0.0  # 3 patches to the east
    society.advance(1)
    assert society.boids[0].mates == society.boids[1].mates == 1
    assert 10 < society.boids[0].heading <= 20  # right, as sharply as it can if it acts first
    assert society.boids[1].heading > 180
    assert society.series()["nearest_distance"] < 3


def test_a_boid_alone_flies_straight_on():
    society = load_model("boids")(1, n_boids=1, noise=0.0)
    heading = society.boids[0].heading
    society.advance(20)
    assert society.boids[0].heading == heading
    assert society.boids[0].mates == 0


@cache
def late(seed, **skills):
    """Return the means of the series at ticks 310 … 500 of a run."""
    society = load_model("boids")(seed, **skills)
    society.advance(300)
    rows = []
    for _ in range(20):
        society.advance(10)
        rows.append(society.series())
    return {name: float(np.nanmean([row[name] for row in rows])) for name in rows[0]}


@pytest.mark.parametrize("seed", SEEDS)
def test_flocks_form(seed):
    start = load_model("boids")(seed).series()
    end = late(seed)
    assert start["polarisation"] < 0.35
    assert end["polarisation"] > 0.9
    assert start["nearest_distance"] > 1.7
    assert 0.7 < end["nearest_distance"] < 1.2
    assert start["in_flocks"] < 50 < end["in_flocks"]
    assert end["flocks"] < start["flocks"]


@pytest.mark.parametrize("seed", SEEDS)
def test_without_cohesion_they_spread(seed):
    alone = late(seed, cohesion=0.0)
    assert alone["nearest_distance"] > 1.4 * late(seed)["nearest_distance"]
    assert alone["in_flocks"] < 59
    assert alone["cohesion_influence"] == 0


@pytest.mark.parametrize("seed", SEEDS)
def test_without_separation_they_touch(seed):
    alone = late(seed, separation=0.0)
    assert alone["nearest_distance"] < 0.3
    assert alone["too_near"] > 45 > 5 > late(seed)["too_near"]


@pytest.mark.parametrize("seed", SEEDS)
def test_without_alignment_they_have_no_direction(seed):
    alone = late(seed, alignment=0.0)
    assert alone["polarisation"] < late(seed)["polarisation"] - 0.1
    assert alone["in_flocks"] > 55  # they are together all the same
    assert np.mean([late(one, alignment=0.0)["polarisation"] for one in SEEDS]) < 0.6


def test_measures_by_hand():
    society = load_model("boids")(1, n_boids=5)
    # Three in a row over the edge of the torus, 2 patches apart, and two far from all.
    for boid, (x, y, heading) in zip(
        society.boids,
        [(15.0, 0.0, 0.0), (-16.0, 0.0, 0.0), (-14.0, 0.0, 180.0), (0, 0, 90.0), (0, 10, 90.0)],
        strict=True,
    ):
        boid.x, boid.y, boid.heading = x, y, heading
    found = society.series()
    assert (found["flocks"], found["in_flocks"], found["largest_flock"]) == (1, 3, 3)
    assert found["flock_polarisation"] == pytest.approx(1 / 3)
    assert found["polarisation"] == pytest.approx(math.hypot(1, 2) / 5)
    assert found["nearest_distance"] == pytest.approx((2 + 2 + 2 + 10 + 10) / 5)
