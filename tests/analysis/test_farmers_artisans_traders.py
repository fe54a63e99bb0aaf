"""The study of the villages: how far apart their mixes are, whether that lasts, one society."""

from pathlib import Path

import pandas as pd
import pytest

from socialmind.sources.loading import load_file

FOLDER = Path(__file__).parents[2] / "analysis" / "farmers_artisans_traders"
VILLAGES = load_file(FOLDER / "villages.py")
STUDY = load_file(FOLDER / "study.py")


def test_spreads_of_hand_made_villages():
    # Means 1, 0.25 and 0 of two, four and two people; the mean of all is 3/8.
    mix, home = [1, 1, 1, 0, 0, 0, 0, 0], [0, 0, 1, 1, 1, 1, 2, 2]
    spread, by_chance = VILLAGES.spreads(mix, home)
    expected = (2 * 0.625**2 + 4 * 0.125**2 + 2 * 0.375**2) / 8
    assert spread == pytest.approx(expected**0.5)
    assert 0 < by_chance < spread


def test_those_without_a_village_do_not_count():
    assert VILLAGES.spreads([1, 0, 0.5], [0, 1, -1]) == VILLAGES.spreads([1, 0], [0, 1])


@pytest.mark.parametrize(("after", "found"), [([0.2, -0.2], 1.0), ([-0.2, 0.2], -1.0)])
def test_what_lasts(after, found):
    rows = [
        {
            "seed": seed, "artisans_third": 0.4 + 0.1 * sign, "others_third": 0.4,
            "artisans_last": 0.3 + later, "others_last": 0.3,
        }
        for seed in range(3)
        for sign, later in zip((1, -1), after, strict=True)
    ]  # fmt: skip
    assert STUDY.persistence(pd.DataFrame(rows)).mean == pytest.approx(found)


def test_a_society_and_its_villages():
    society, villages = VILLAGES.lived("a community each", 1, 20_000)
    assert sum(one["people"] for one in villages) == 17
    for one in villages:
        assert 0 <= one["artisans_last"] <= 1
        assert 0 <= one["without_tools"] <= 1
    assert 0 <= society["artisans"] <= 1
    assert society["agents_to_tasks_by_chance"] < society["agents_to_tasks"]
    none, _ = VILLAGES.lived("no demands", 1, 20_000)
    assert none["artisans"] != society["artisans"]
