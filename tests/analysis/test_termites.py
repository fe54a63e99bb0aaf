"""The study of termites: rows of moments, and chips scattered anew."""

from pathlib import Path

import numpy as np
import pandas as pd

from socialmind.catalogue import load_model
from socialmind.sources.loading import load_file

FOLDER = Path(__file__).parents[2] / "analysis" / "termites"
MOUNDS = load_file(FOLDER / "mounds.py")
STUDY = load_file(FOLDER / "study.py")


def test_rows_of_moments_are_those_of_the_society():
    rows = MOUNDS.gathered("two kinds", 4)
    assert [row["tick"] for row in rows] == list(MOUNDS.MOMENTS)
    society = load_model("termites")(4, n_kinds=2)
    assert society.series().items() <= rows[0].items()
    society.advance(500)
    assert society.series().items() <= rows[1].items()
    for row in rows:
        assert row["heaps"] <= row["piles"]
        assert row["largest_heap"] >= row["largest"]
    assert rows[-1]["piles"] < rows[-1]["scattered_piles"] / 5
    assert STUDY.as_markdown(pd.DataFrame(rows)).count("\n| ") == len(MOUNDS.MOMENTS) + 1


def test_scattering_keeps_the_chips():
    chips = np.zeros((6, 6), int)
    chips[:3] = 1
    found = MOUNDS.scattered(chips, seed=1)
    assert found == MOUNDS.scattered(chips, seed=1)
    assert 1 <= found["scattered_largest"] <= 18
    assert MOUNDS.scattered(np.ones((4, 4), int), 2) == {
        "scattered_piles": 1, "scattered_largest": 16,
    }  # fmt: skip
