"""The study of ants: traffic is counted, fields are looked at, times found."""

import math
from pathlib import Path

import pandas as pd
import pytest

from socialmind.catalogue import load_model
from socialmind.sources.loading import load_file

FOLDER = Path(__file__).parents[2] / "analysis" / "ant_foraging"
COLONIES = load_file(FOLDER / "colonies.py")
STUDY = load_file(FOLDER / "study.py")


def test_traffic_is_that_of_the_last_ticks():
    row = COLONIES.crossed("20 and 40 steps", 0.6, seed=3, ticks=1_200)
    colony = load_model("ant_foraging")(
        3, bridge=True, outward=0.6, homeward=0.6, detour_north=2, detour_south=12
    )
    colony.advance(200)
    north, south = colony.passed_north, colony.passed_south
    colony.advance(1_000)
    north, south = colony.passed_north - north, colony.passed_south - south
    assert row["north"] == north / (north + south)
    assert row["brought"] == colony.brought
    assert row["wins"] == (north > south)


def test_settings_are_what_their_names_say():
    for name, options in COLONIES.BRIDGES.items():
        lengths = [16 + 2 * options[side] for side in ("detour_north", "detour_south")]
        if "steps" in name:
            assert name == f"{lengths[0]} and {lengths[1]} steps"
            assert options["outward"] == options["homeward"] == COLONIES.DROP
        else:
            assert lengths == [20, 40]
            assert options["outward"] == 0
    for options in COLONIES.FIELDS.values():
        assert options["n_piles"] * options["pile_food"] == COLONIES.ALL


def test_a_field_is_looked_at_and_the_time_of_half_and_all_found():
    rows = COLONIES.gathered("one pile", True, seed=3, ticks=100)
    assert [row["tick"] for row in rows] == list(range(0, 101, 10))
    looks = pd.DataFrame(
        {"field": "one pile", "marks": True, "seed": 1, "tick": [0, 10, 20], "brought": brought}
        for brought in [[0, 449, 450]]
    ).explode(["tick", "brought"])
    (found,) = STUDY.times(looks).to_dict("records")
    assert (found["half"], found["all"]) == (20, math.inf)
    assert STUDY.time_shown(pd.Series([20.0, math.inf]), 30) == "1 of 2 within 30"
    assert STUDY.time_shown(pd.Series([20.0, 20.0]), 30) == "20 (20 … 20)"


def test_the_bare_field_has_no_marks():
    marked, bare = (COLONIES.gathered("one pile", marks, 3, 200)[-1] for marks in (True, False))
    assert (marked["marks"], bare["marks"]) == (True, False)
    assert marked["brought"] != bare["brought"]
    assert bare["brought"] == pytest.approx(0.2 * COLONIES.ALL, rel=0.8)
