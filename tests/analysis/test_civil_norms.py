"""The study of norms: what a run comes to, and the tables and the figure made of it."""

from pathlib import Path

import pandas as pd
import pytest

from socialmind.sources.loading import load_file

STUDY = load_file(Path(__file__).parents[2] / "analysis" / "civil_norms" / "study.py")


def rows(**columns):
    """Two runs of every condition, with the same numbers but for some."""
    found = {"living": 10.0, "starved": 2.0, "given": 0.5, "store": 3.0, "inequality": 0.2}
    table = [
        {"condition": name, "seed": seed, "sharers": 3 * seed, "keepers": 1, **found, **columns}
        for name in STUDY.CONDITIONS
        for seed in (0, 1)
    ]
    return pd.DataFrame(table)


def test_the_part_of_the_sharers_is_half_where_nobody_is_left():
    left = pd.DataFrame({"sharers": [0, 3, 0], "keepers": [4, 1, 0]})
    assert list(STUDY.part_of_sharers(left)) == [0.0, 0.75, 0.5]


def test_the_table_counts_who_is_left_and_has_a_row_for_each_condition():
    lines = STUDY.table(rows()).splitlines()
    assert "| sharers | 10.0 (10.0 – 10.0) | 2.0 (2.0 – 2.0) | 0.50 (0.50 – 0.50) |" in lines[4]
    together = [line for line in lines if "| 0 | 1 | 1 |" in line]
    assert len(together) == len(STUDY.TOGETHER)
    assert "| 0.38 (" in together[0]


def test_the_figure_shows_every_run():
    axes = STUDY.draw(rows()).axes[0]
    dots = [line for line in axes.lines if line.get_marker() == "."]
    assert len(dots) == len(STUDY.TOGETHER)
    assert all(list(line.get_xdata()) == [0.0, 0.75] for line in dots)
    means = [line for line in axes.lines if line.get_marker() == "o"]
    assert {line.get_markerfacecolor() for line in means} == {"none"}


def test_alone_without_culturons_a_run_comes_to_the_same():
    found = [
        STUDY.outcome(f"alone: {who}, no culturons", seed=1, ticks=200)
        for who in ("sharers", "keepers")
    ]
    for name in ("living", "starved", "given", "store", "inequality"):
        assert found[0][name] == pytest.approx(found[1][name], rel=1e-12), name
    assert found[0]["sharers"] == found[1]["keepers"] > 0
