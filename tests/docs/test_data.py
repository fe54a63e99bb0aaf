"""The page about data: its code runs, and what it says comes true."""

import re
from pathlib import Path

import pytest

from socialmind.errors import ValueRefusedError
from socialmind.sources.loading import load_file

PAGE = (Path(__file__).parents[2] / "docs" / "data.md").read_text("utf-8")
BLOCK = re.compile(r"```python\n(.*?)```", re.DOTALL)


@pytest.fixture(scope="module")
def page(tmp_path_factory):
    """The code of the page as a module."""
    file = tmp_path_factory.mktemp("data") / "data.py"
    file.write_text("\n".join(BLOCK.findall(PAGE)), "utf-8")
    return load_file(file)


def test_its_society_stops_and_is_recorded(page):
    assert (page.when, page.why) == (10, "bare")
    village = page.Village(seed=1, compiled=False, rule="share")
    village.farmers.set_from(page.census.assign(agent=[0, 1, 3]))
    assert village.farmers.wheat.tolist() == [5.0, 8.5, 10.0, 3.0]
    assert village.agents()["field"].tolist() == [7, None, None, 9]
    assert list(village.series()) == ["farmers", "wheat", "richest"]
    with pytest.raises(ValueRefusedError, match=r"write society\.farmers\.wheat = "):
        village.farmers.wheat[:] = 0


def test_its_events_say_how_many_live(page):
    assert page.events["agent"].tolist() == [1, 2, 0, 3]
    assert page.alive == len(page.dough.yeast) == 3


def test_its_threads_get_what_one_alone_gets(page):
    alone = [page.harvest(page.Village(seed, compiled=False)) for seed in range(3)]
    assert page.harvests == alone


def test_its_groups_form(page, tmp_path):
    file = tmp_path / "cattle.yaml"
    file.write_text(page.SCHEME)
    society = page.cattle(str(file))(seed=2, compiled=False)
    society.advance(3)
    assert sorted(society.plans(society.cows)) == ["follow", "follow", "follow", "lead"]
    leads = [cow.mind.get_group_role_id("herd", "leader") >= 0 for cow in society.cows]
    assert sum(leads) == 1 and max(society.cows.led) == 3
