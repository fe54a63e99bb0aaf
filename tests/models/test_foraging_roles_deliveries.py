"""Roles seen from outside: the economy of deliveries, the model measured by them, the lessons."""

import numpy as np
import pytest

from socialmind.catalogue import load_model
from socialmind.errors import ModelError
from socialmind.mind import Perceptron
from socialmind.sources.folders import model_folder
from socialmind.sources.loading import load_file

FOLDER = model_folder("foraging_roles")
DELIVERIES = load_file(FOLDER / "deliveries.py")
LESSONS = load_file(FOLDER / "role_lessons.py")
BY_DELIVERIES = load_file(FOLDER / "by_deliveries.py")
BOTH = LESSONS.BOTH
CALM = {"numbers": (9,), "ratios": (2 / 3,), "events": (0,), "missing": 0.0}
STAY = np.zeros(39)
STAY[21] = 1.0  # the influence on the role as it is
# Each of both outputs: the weights of ROLE, of the two distances, and a bias.
PLAIN = np.array([-1000.0, 0, 0, 500, 1000, 0, 0, -499])  # A below 0.5, else B
TURNED = np.array([1000.0, 0, 0, -499, -1000, 0, 0, 500])  # the other way round
TORN = np.array([0.0, 0, 0, 1, 0, 0, 0, 0.2])  # A, with a fifth of its influence on B
WAVERING = np.array([0.0, 1, 0, 0, 0, 0, 1, 0])  # what is farther away: never what it is at


@pytest.fixture(scope="module")
def mind():
    return LESSONS.choosing(choice=Perceptron(layers=0))


def economy(mind, ticks=None, **terms):
    return DELIVERIES.DeliveryEconomy(terms, mind, LESSONS.MASTER, BOTH, ticks=ticks)


def genome(choice):
    return np.concatenate([STAY, choice])


def test_what_role_means_is_for_the_mind_to_say(mind):
    as_they_begin = economy(mind, **CALM, starts=(0,)).run([genome(PLAIN), genome(TURNED)], [1, 2])
    # All nine bring A, six B are wanted; or all bring B.
    late = [3 * 5.5 / 9 + 0.3, 3 * 2.5 / 9 + 0.3]
    mean = [6 / 9, 3 / 9]  # but for what is not known before the first deliveries
    for found, split, rest in zip(as_they_begin.score, mean, late, strict=True):
        assert -split - rest <= found.min() and found.max() <= -rest - 0.97 * split
    assert (as_they_begin.fields["changes"] == 0).all()


def test_the_trips_are_those_of_the_economy(mind):
    terms = DELIVERIES.DeliveryTerms(numbers=(9,), events=(0,))
    one, other = DELIVERIES.World(4, terms, 60_000), DELIVERIES.DeliveryWorld(4, terms, 60_000)
    assert (one.trips == other.trips).all()
    assert other.away.min() >= 0.35 and other.away.max() <= 0.45


def test_two_minds_are_slow_and_wavering_ones_slowest(mind):
    terms = {**CALM, "starts": (0,)}
    brought = economy(mind, **terms).run([genome(c) for c in (PLAIN, TORN, WAVERING)], [1])
    straight, torn, wavering = brought.fields["brought"][:, 0]
    assert straight == pytest.approx(60_000 / DELIVERIES.USUAL, rel=0.1)
    assert torn == pytest.approx(0.83 * straight, rel=0.05)
    assert wavering == pytest.approx(0.06 * straight, rel=0.3)


def test_missing_objects_cost(mind):
    terms = {**CALM, "starts": (0,)}
    found = [
        economy(mind, **{**terms, "missing": missing}).run([genome(TORN)], [1])
        for missing in (0.0, 2.0)
    ]
    short = 1 - found[0].fields["brought"][0, 0] * DELIVERIES.USUAL / 60_000
    assert found[0].score - found[1].score == pytest.approx(2.0 * short)


@pytest.mark.parametrize(("event", "off"), [(2, 2 / 6), (3, 4 / 12)])
def test_robots_taken_away_and_added_count_by_what_they_bring(mind, event, off):
    terms = {**CALM, "starts": (0,), "off_late": 0.0, "out_late": 0.0, "events": (event,)}
    score = economy(mind, **terms).run([genome(TURNED)], [3, 4, 5, 6]).score[0]
    if event == 2:
        # All bring B: three of nine are away, or nobody where those in A are taken.
        known = {round(-(3 / 9 + off) / 2, 1), round(-3 / 9, 1)}
        assert {round(one, 1) for one in score.tolist()} <= known
    else:
        assert score == pytest.approx(-(3 / 9 + off) / 2, abs=0.02)


def test_a_score_hangs_on_genome_and_world_alone(mind):
    rng = np.random.default_rng(3)
    genomes = rng.normal(0, 0.5, (3, 47))
    whole = economy(mind, ticks=20_000).run(genomes, [1, 2, 3, 4]).score
    alone = economy(mind, ticks=20_000).run(genomes[1:2], [3]).score
    assert (alone == whole[1:2, 2:3]).all()
    assert len(set(whole.ravel().tolist())) > 6


def test_other_skills_are_refused(mind):
    with pytest.raises(ModelError, match="a role and a choice"):
        DELIVERIES.DeliveryEconomy({}, mind, "Forage", ("ForageRole", "CollectSelect", "Forage"))
    with pytest.raises(ModelError, match="SE:DISTOBJA"):
        DELIVERIES.DeliveryEconomy({}, mind, "Forage", ("ForageRole", "Forage"))


def test_a_role_is_learned_with_the_choice_that_the_mind_has(mind):
    for choice in (PLAIN, TURNED):
        knowing = mind.with_modules(skills=[mind.skill("CollectSelect").changed(genome=choice)])
        alone = DELIVERIES.DeliveryEconomy(CALM, knowing, LESSONS.MASTER, "ForageRole")
        assert alone.genome_size == 39
        both = economy(mind, **CALM).run([genome(choice)], [1, 2])
        assert (alone.run([STAY], [1, 2]).score == both.score).all()


def test_errands_ask_for_two_meanings_and_for_going_straight(mind):
    errands = DELIVERIES.Errands({}, mind, "CollectSelect", "CollectSelect")
    score = errands.run([PLAIN, TURNED, TORN, WAVERING], [1, 2, 3]).score
    assert (score[0] > 0.6).all() and (score[1] > 0.6).all()  # few of 64 roles are off a half
    assert score[:2].mean() > 0.8
    assert (score[2] == 0).all()  # A alone
    assert (score[3] < 0.07).all()


# In bodies --------------------------------------------------------------------------------------


@pytest.mark.study
def test_robots_are_measured_by_what_they_bring_in_the_same_worlds():
    plain = load_model("foraging_roles")(seed=3, start=0, programmed=1.0)
    seen = BY_DELIVERIES.ForagingByDeliveries(seed=3, start=0, programmed=1.0, add_at=1500)
    said = np.array([], bool)
    for _ in range(12):
        plain.advance(100)
        seen.advance(100)
        robots = seen.robots
        said = robots.is_b.copy()
        assert (robots.x == plain.robots.x).all()
        assert (said == plain.robots.is_b).all()
    brought = robots.brought.copy()
    assert (brought[robots.delivered_a + robots.delivered_b == 0] == 0).all()
    assert seen.in_b == (brought == 2).sum() == 0
    seen.advance(1500)
    assert len(seen.robots) == 12
    assert seen.changed == seen.changed_kind
    assert seen.in_b == (seen.robots.brought == 2).sum()


@pytest.mark.study
def test_a_robot_in_the_thesis_lesson_is_paid_for_nearness_to_the_ratio():
    model = LESSONS.ForageInBodies(seed=3, start=1, foragers=3, hierarchy=FOLDER / "mind")
    while model.robots.delivered_b.sum() + model.robots.delivered_a.sum() == 0:
        model.advance(1)
    paid_at = model.tick - 1
    model.advance(1)
    # Of 9 counted, which have faded, and one B more; a share of 1 would be farthest.
    left = 9 * (1 - model.decay) ** paid_at
    share = (left * 2 / 3 + 1) / (left + 1)
    assert model.robots.score.sum() == pytest.approx(1 - (share - 2 / 3) / (2 / 3))
