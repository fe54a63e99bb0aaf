"""The study of wolves, cows and bulls: one pasture of each setting, and the table."""

from pathlib import Path

import pandas as pd

from socialmind.sources.loading import load_file

FOLDER = Path(__file__).parents[2] / "analysis" / "wolf_cow"
PASTURES = load_file(FOLDER / "pastures.py")
STUDY = load_file(FOLDER / "study.py")


def test_a_pasture_of_each_setting():
    rows = {}
    for setting in PASTURES.SETTINGS:
        row, looks = PASTURES.lived(setting, 3, 1, 400)
        rows[setting] = row
        assert [look["tick"] for look in looks] == list(range(0, 401, PASTURES.EVERY))
        assert looks[-1]["cows"] == 19 + row["born"] - row["killed"] - row["starved"]
        assert row["survived"] == (looks[-1]["cows"] > 0)
    assert rows["no wolves"]["killed"] == 0
    assert rows["fearless wolves"]["early_attacking"] == 1.0
    assert rows["wolves"]["early_killed"] < rows["fearless wolves"]["early_killed"]


def test_seeds_are_compared_in_their_order():
    rows = pd.DataFrame(
        {"setting": "wolves", "bulls": [3, 3, 1], "seed": [1, 0, 0], "cows": [5.0, 6.0, 7.0]}
    )
    assert STUDY.of(rows, "wolves", 3, "cows").tolist() == [6.0, 5.0]
