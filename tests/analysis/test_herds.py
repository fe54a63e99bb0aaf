"""The study of herds: distances, lives, one pasture."""

from pathlib import Path

import numpy as np
import pandas as pd
import pytest

from socialmind.sources.loading import load_file

FOLDER = Path(__file__).parents[2] / "analysis" / "herds"
PASTURES = load_file(FOLDER / "pastures.py")
STUDY = load_file(FOLDER / "study.py")
SURVIVAL = load_file(FOLDER / "survival.py")


def test_distances_of_followers_go_the_short_way_round():
    x, y = np.array([-16.0, 15.0, 0.0]), np.array([0.0, 0.0, 4.0])
    distances = PASTURES.between(x, y, 33)
    assert distances[0, 1] == 2.0
    herds, leading = np.array([3, 3, -1]), np.array([True, False, False])
    assert PASTURES.follower_distances(distances, herds, leading) == [2.0]
    assert PASTURES.follower_distances(distances, herds, ~leading & False) == []


def test_the_share_of_herds_that_outlive_an_age():
    # Four herds; the second was still there at 3, so of the two that reached 5 one is left then.
    ages, shares = STUDY.surviving([2, 3, 5, 8], [True, False, True, False])
    assert ages == [0.0, 2.0, 5.0]
    assert shares == pytest.approx([1.0, 0.75, 0.375])


def test_a_curve_has_a_band_over_seeds_and_marks_who_still_lived():
    rows = {"seed": [0, 0, 1, 1], "life": [2, 3, 5, 8], "ended": [True, False, True, False]}
    curve = SURVIVAL.curve_of(pd.DataFrame(rows))
    assert curve.ages.tolist() == [0, 2, 3, 5, 8] and curve.seen_last.tolist() == [3, 8]
    assert curve.share([0, 2.5, 9]).tolist() == pytest.approx([1.0, 0.75, 0.375])
    assert (curve.low <= curve.shares).all() and (curve.shares <= curve.high).all()


def test_the_mean_life_counts_the_ticks_of_those_that_still_live():
    rows = [
        {"seed": seed, "life": life, "ended": ended}
        for seed in range(2)
        for life, ended in ((100, True), (50, False))
    ]
    assert STUDY.life(pd.DataFrame(rows)).mean == pytest.approx(150)
    assert STUDY.life(pd.DataFrame(rows[1:2])) is None


def test_lives_are_compared_seed_by_seed():
    def herds(lives):
        return pd.DataFrame({"seed": [0, 0, 1], "life": lives, "ended": [True, False, True]})

    more = STUDY.longer(herds([100, 40, 60]), herds([50, 20, 30]))
    assert more.mean == pytest.approx(200 / 2 - 100 / 2)
    none = herds([9, 9, 9]).assign(ended=False)
    assert STUDY.longer(herds([9, 9, 9]), none) is None


def test_a_pasture_and_its_herds():
    pasture, herds, looks = PASTURES.lived("participation 4", 1, 600)
    assert len(looks) == 60
    assert 0 < pasture["in_herds"] <= 1
    assert len(herds) == round(pasture["founded"] * 0.6) > 0
    assert all(1 <= one["life"] <= 600 for one in herds)
    alone, _, _ = PASTURES.lived("nobody joins", 1, 600)
    assert (alone["ended"], alone["largest"]) == (0, 1.0)
