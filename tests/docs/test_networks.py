"""The page on networks: its model runs alike at both speeds, and its tables hold what there is."""

import re
from pathlib import Path

import pandas as pd
import pytest

from socialmind.drawing import style as paper
from socialmind.experiments import Run, run
from socialmind.language.typing.calls.networks import ALL, ONE_WAY, PAIRS
from socialmind.networks.table import NetworkTable
from socialmind.sources.loading import load_file

PAGE = (Path(__file__).parents[2] / "docs" / "networks.md").read_text("utf-8")
RULES = (Path(__file__).parents[2] / "docs" / "rules.md").read_text("utf-8")


@pytest.fixture(scope="module")
def page(tmp_path_factory):
    """The code of the page as a module."""
    file = tmp_path_factory.mktemp("networks") / "networks.py"
    file.write_text("\n".join(re.findall(r"```python\n(.*?)```", PAGE, re.DOTALL)), "utf-8")
    return load_file(file)


def test_its_society_is_alike_at_both_speeds(page):
    slow, fast = page.Town(seed=1, compiled=False), page.Town(seed=1)
    for town in (slow, fast):
        town.advance(30)
    for name, table in slow.tables.items():
        for field in table.shape.fields:
            assert getattr(table, field).tolist() == getattr(fast.tables[name], field).tolist()
    pd.testing.assert_frame_equal(slow.friends.edges(), fast.friends.edges())


def test_what_it_asks_from_outside(page):
    friends = page.society.friends
    assert list(page.ends) == ["source", "target", "trust"]
    assert page.graph.number_of_edges() == len(page.ends) == page.degrees.sum() / 2
    assert len(set(page.parts)) >= 1 and page.staff.sum() == 60
    assert page.society.follows.source.tolist() == [0, 1]
    assert [one.id for one in page.first] == [one.id for one in friends.neighbours(0)]
    assert list(page.Watched(compiled=False).agents())[-1] == "component_jobs"


def test_its_links_are_recorded_and_drawn(page, tmp_path):
    made = Run(run(page.Town, ticks=20, out=tmp_path / "run", compiled=False, every=5))
    assert list(made.links) == ["tick", "network", "link", "source", "target", "trust", "wage",
                                "since"]  # fmt: skip
    assert set(made.links["network"]) == {"friends", "jobs"}
    paper.write_figure(page.drawn(page.society), tmp_path / "drawn.png")
    assert (tmp_path / "drawn.png").stat().st_size > 5000


def test_it_names_all_that_can_be_asked():
    names = (*PAIRS, *ALL, *ONE_WAY)
    assert all(f".{name}(" in PAGE for name in names)
    assert all(callable(getattr(NetworkTable, name)) for name in names)
    assert "(networks.md)" in RULES
