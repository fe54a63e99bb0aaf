"""Robots among strangers, in other arenas: what is added, and that nothing else is changed."""

from types import SimpleNamespace

import numpy as np
import pytest

from socialmind.learning.episodes.plane_episodes import Episodes
from socialmind.mind import MindDescription
from socialmind.sources.folders import model_folder
from socialmind.sources.loading import load_file

FOLDER = model_folder("foraging_roles")
ELSEWHERE = load_file(FOLDER / "elsewhere.py")
MIND = MindDescription.load(FOLDER / "mind")
WORLDS = [6001, 6002]
RECORD = ("robots.delivered_a", "robots.delivered_b", "robots.changes_brought", "last_beyond")


def settled_mind():
    """A mind whose robots keep the role that they have."""
    genome = np.zeros(39)
    genome[21] = 1.0  # the influence on the role as it is
    return MIND.with_modules(skills=[MIND.skill("ForageRole").changed(genome=genome)])


def lived(mind, record=RECORD, **parameters):
    episodes = Episodes(
        ELSEWHERE.ForagingElsewhere,
        {"unlearned": 0, **parameters},
        hierarchy=mind,
        ticks=3000,
        record=record,
    )
    return episodes.run(None, WORLDS).fields


@pytest.mark.study
def test_the_head_that_sleeps_does_nothing():
    first, second = MIND, settled_mind()
    without = lived(ELSEWHERE.two_headed(first, second))
    for same in (
        lived(first),
        lived(ELSEWHERE.two_headed(second, first), strangers=1.0),
    ):
        assert all((without[name] == same[name]).all() for name in RECORD)
    other = lived(ELSEWHERE.two_headed(first, second), strangers=1.0)
    assert (other["robots.changes_brought"] == 0).all()
    assert not all((without[name] == other[name]).all() for name in RECORD)


def test_strangers_are_as_many_as_asked_for_and_decide_by_their_own_mind():
    mind = ELSEWHERE.two_headed(MIND, settled_mind())
    found = lived(mind, ("robots.stranger", "robots.changes"), strangers=3 / 9, start=2)
    stranger = found["robots.stranger"].astype(bool)
    assert (stranger.sum(axis=-1) == 3).all()
    assert (found["robots.changes"][stranger] == 0).all()
    assert found["robots.changes"][~stranger].sum() > 0


def test_without_anything_else_the_worlds_are_those_of_the_model():
    seen = ["objects_a", "objects_b", "obstacles", "robots"]
    by_thresholds = load_file(FOLDER / "thresholds.py").ForagingByThresholds(
        seed=5, compiled=False, unlearned=0
    )
    elsewhere = ELSEWHERE.ForagingElsewhere(seed=5, compiled=False, unlearned=0)
    for model in (by_thresholds, elsewhere):
        model.advance(4)
    for name in seen:
        one, other = getattr(by_thresholds, name), getattr(elsewhere, name)
        assert np.array_equal(one.x, other.x) and np.array_equal(one.y, other.y)


def test_objects_are_farther_and_obstacles_stay_in_the_middle():
    near = ELSEWHERE.ForagingElsewhere(seed=5, compiled=False, unlearned=0)
    far = ELSEWHERE.ForagingElsewhere(
        seed=5, compiled=False, unlearned=0, reach_a=2.0, half_width=130.0
    )
    for model in (near, far):
        model.advance(2)
    assert near.objects_a.x == pytest.approx(far.objects_a.x / 2)
    assert near.objects_b.x == pytest.approx(far.objects_b.x)
    assert near.obstacles.x == pytest.approx(far.obstacles.x)
    cleared = ELSEWHERE.ForagingElsewhere(seed=5, compiled=False, unlearned=0, cleared=1)
    assert len(cleared.obstacles) == 0


def test_payoffs_are_read_more_sharply():
    robot = SimpleNamespace(payoff=0.475)
    assert ELSEWHERE.sharpened(robot, SimpleNamespace(gain=4.0)) == pytest.approx(0.4)
    assert ELSEWHERE.sharpened(robot, SimpleNamespace(gain=1.0)) == 0.475
