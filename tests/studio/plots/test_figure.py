"""Panels as files show what the page shows."""

import pandas as pd
import pytest

from socialmind.studio.plots.figure import Drawn, figure_of
from socialmind.studio.plots.table import csv_of

SERIES = [
    Drawn({"tick": [0, 10], "farmers": [0.0, 13.0]}, "1. programmed", {"farmers": "agents"}),
    Drawn({"tick": [0, 5, 10], "farmers": [0.0, None, 9.0]}, "2. learned"),
]


def test_series_of_several_societies_stand_in_one_figure_with_their_names():
    drawn = figure_of("series", SERIES, "svg").decode()
    assert all(text in drawn for text in ("1. programmed", "2. learned", "farmers (agents)"))


@pytest.mark.parametrize(
    ("kind", "columns"),
    [
        ("histogram", {"agent": [1, 2, 3], "wheat": [1.0, 2.5, None]}),
        ("histogram", {"agent": [1, 2], "plan": ["Farm", "Rest"]}),
        ("scatter", {"agent": [1, 2], "wheat": [1.0, 2.0], "tools": [3.0, 1.0]}),
    ],
)
def test_agents_are_drawn_as_pdf_and_svg(kind, columns):
    society = Drawn(columns, "1")
    assert figure_of(kind, [society], "pdf").startswith(b"%PDF")
    drawn = figure_of(kind, [society], "svg").decode()
    assert next(name for name in columns if name != "agent") in drawn


def test_a_table_of_several_says_whose_rows_are_whose(tmp_path):
    (tmp_path / "plot.csv").write_bytes(csv_of(SERIES))
    rows = pd.read_csv(tmp_path / "plot.csv")
    assert rows.groupby("society").size().to_dict() == {"1. programmed": 2, "2. learned": 3}
    assert rows["farmers"].isna().sum() == 1
