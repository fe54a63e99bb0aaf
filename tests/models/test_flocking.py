"""Flocking: how a bird turns, by hand; who is seen; and that birds come to fly one way."""

import math

import numpy as np
import pytest

from socialmind.catalogue import load_model


@pytest.fixture(params=[True, False], ids=["compiled", "interpreted"])
def make(request):
    """Make a flock at either speed, of birds that stand and fly where they are told."""

    def made(*birds, **parameters):
        society = load_model("flocking")(
            1, compiled=request.param, n_birds=len(birds), **parameters
        )
        for bird, (x, y, east, north) in zip(society.birds, birds, strict=True):
            bird.x, bird.y, bird.east, bird.north = x, y, east, north
        return society

    return made


def flights(society):
    birds = society.birds
    return np.array([birds.x, birds.y, birds.east, birds.north]).T


def turned(own, cohere=(0, 0), separate=(0, 0), match=(0, 0), count=1):
    """Return the direction that the rule makes of sums over the neighbours."""
    sums = 0.03 * np.array(cohere) + 0.015 * np.array(separate) + 0.05 * np.array(match)
    found = np.array(own) + sums / count
    return found / np.hypot(*found)


def test_a_bird_alone_flies_straight_on(make):
    society = make((0, 0, 0.6, 0.8), (20, 0, -1, 0))
    society.advance(3)
    assert flights(society)[0] == pytest.approx([1.8, 2.4, 0.6, 0.8])


def test_a_bird_turns_to_the_other_and_flies_as_it_does(make):
    # Both do the same, mirrored, whoever is first; the one who is second sees the first moved.
    society = make((0, 0, 0, 1), (4, 0, 0, -1))
    society.advance(1)
    ways = []
    for first in (0, 1):
        at = np.array([[0.0, 0.0], [4.0, 0.0]])
        way = np.array([[0.0, 1.0], [0.0, -1.0]])
        for one in (first, 1 - first):
            other = 1 - one
            way[one] = turned(way[one], cohere=at[other] - at[one], match=way[other])
            at[one] += way[one]
        ways.append(np.hstack([at, way]))
    assert any(flights(society) == pytest.approx(one) for one in ways)


def test_the_first_to_fly_by_numbers(make):
    # 0.03 · 4 to the east; 1 − 0.05 to the north.
    society = make((0, 0, 0, 1), (4, 0, 0, -1), speed=0.0)
    society.advance(1)
    length = math.hypot(0.12, 0.95)
    first = (0.12 / length, 0.95 / length)
    assert any((abs(bird.east), abs(bird.north)) == pytest.approx(first) for bird in society.birds)


def test_who_is_too_near_is_fled(make):
    # Not matching, the order of the two does not matter as nobody moves.
    society = make((0, 0, 0, 1), (0.5, 0, 0, 1), speed=0.0, match=0.0, separate=0.1)
    society.advance(1)
    push = 0.1 * 0.5 - 0.03 * 0.5
    length = math.hypot(push, 1)
    assert flights(society)[:, 2:] == pytest.approx(
        np.array([[-push / length, 1 / length], [push / length, 1 / length]])
    )


@pytest.mark.parametrize(("distance", "seen"), [(5.0, True), (5.01, False)])
def test_the_border_of_sight_is_seen(make, distance, seen):
    society = make((0, 0, 0, 1), (distance, 0, 0, 1), speed=0.0)
    society.advance(1)
    assert (society.birds[0].east > 0) == seen


def test_what_is_just_not_too_near_is_not_fled(make):
    society = make((0, 0, 0, 1), (1.0, 0, 0, 1), speed=0.0, separate=9.0)
    society.advance(1)
    assert society.birds[0].east > 0


def test_the_mean_is_taken_over_all_in_sight(make):
    society = make((0, 0, 0, 1), (3, 0, 0, 1), (-1, 2, 0, 1), speed=0.0, match=0.0)
    society.advance(1)
    wanted = turned((0, 1), cohere=(3 - 1, 0 + 2), count=2)
    assert flights(society)[0, 2:] == pytest.approx(wanted)


def test_birds_see_and_fly_round_the_world(make):
    # The world of 100 goes from −50.5 to 49.5.
    society = make((49, 0, 0, 1), (-49.5, 0, 0, 1), speed=0.0)
    society.advance(1)
    assert society.birds[0].east > 0
    assert society.birds[1].east < 0
    society = make((49, 0, 1, 0))
    society.advance(1)
    assert flights(society)[0] == pytest.approx([-50, 0, 1, 0])


def test_polarisation_is_the_length_of_the_mean(make):
    society = make((0, 0, 0, 1), (20, 0, 1, 0))
    assert society.series() == {"birds": 2, "polarisation": pytest.approx(math.sqrt(0.5))}


def test_birds_come_to_fly_one_way():
    found = []
    for seed in range(10):
        society = load_model("flocking")(seed, sight=15.0)
        begin = society.series()["polarisation"]
        society.advance(300)
        found.append((begin, society.series()["polarisation"]))
        directions = np.hypot(society.birds.east, society.birds.north)
        assert directions == pytest.approx(np.ones(200))
    begin, end = np.mean(found, axis=0)
    assert begin < 0.15
    assert end > 0.5
