"""The study of the classics: its measures by hand, and that its rows are of what they say."""

from pathlib import Path

import numpy as np
import pytest

from socialmind.catalogue import load_model
from socialmind.sources.loading import load_file

SOCIETIES = load_file(Path(__file__).parents[2] / "analysis" / "classics" / "societies.py")


def test_a_flock_is_linked_through_others_and_round_the_world():
    places = np.array([[0.0, 0.0], [3.0, 0.0], [3.0, 3.0], [0.0, 6.1], [-49.0, 9.0], [49.0, 9.0]])
    assert SOCIETIES.largest_flock(places, 100) == pytest.approx(3 / 6)
    assert SOCIETIES.largest_flock(np.zeros((4, 2)), 100) == 1.0
    assert SOCIETIES.largest_flock(np.zeros((1, 2)), 100) == 1.0


def test_neighbours_alike_are_counted_over_pairs():
    town = load_model("schelling")(1, n_agents=4, world_size=9)
    for person, place in zip(town.people, ((0, 0), (0, 1), (1, 0), (-4, 4)), strict=True):
        town.world.move_to(person, *place)
    # Of the three pairs, one is of two of kind 0.
    assert SOCIETIES.share_alike(town) == pytest.approx(1 / 3)


def test_cycles_and_delays_are_found_in_noise():
    time = np.arange(1900)
    noise = np.random.default_rng(3).normal(size=(2, len(time)))
    sheep = 80 + 20 * np.sin(2 * np.pi * time / 80) + 5 * noise[0]
    wolves = 60 + 20 * np.sin(2 * np.pi * (time - 25) / 80) + 5 * noise[1]
    length, strength = SOCIETIES.cycle_of(sheep)
    assert length == pytest.approx(80, abs=2)
    assert strength > 0.8
    assert SOCIETIES.delay_of(sheep, wolves) == pytest.approx(25, abs=2)


def test_what_never_goes_against_itself_has_no_cycle():
    once = np.zeros(1900)
    once[:1000] = 1.0  # a step: alike at all lags that are looked at
    assert np.isnan(SOCIETIES.cycle_of(once)).all()


def test_rows_say_who_died_out_and_when():
    (row,) = SOCIETIES.wolves_and_sheep(40, 1)
    assert 0 < row["wolves_end"] < 300
    society = load_model("wolves_sheep")(1, regrowth=40)
    society.advance(row["wolves_end"] - 1)
    assert len(society.wolves) > 0
    society.advance(1)
    assert len(society.wolves) == 0
    assert "cycle" not in row


def test_rows_of_moments():
    rows = SOCIETIES.segregated(0, 1)
    assert [row["tick"] for row in rows] == [20, 500]
    assert [row["happy"] for row in rows] == [1.0, 1.0]
    assert rows[0]["alike"] == pytest.approx(0.5, abs=0.05)
