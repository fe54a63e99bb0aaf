"""The page on groups gives what it says."""

import re
from pathlib import Path

import pytest

TEXT = (Path(__file__).parents[2] / "docs" / "groups.md").read_text()


@pytest.fixture(scope="module")
def page(tmp_path_factory):
    file = tmp_path_factory.mktemp("village") / "village.py"
    file.write_text("\n".join(re.findall(r"```python\n(.*?)```", TEXT, re.DOTALL)))
    page = {"__name__": "village", "__file__": str(file)}
    exec(compile(file.read_text(), str(file), "exec"), page)  # the page's own code
    return page


def test_a_child_is_under_the_law_of_its_familys_clan(page):
    assert page["child"].plan_weights() == {"work": 1.5}


@pytest.fixture
def village(page):
    return page["Village"]


def test_a_lord_grants_entry_while_there_is_grain_and_expels_thieves(page):
    for compiled in (False, True):
        realm = page["Realm"](seed=1, compiled=compiled)
        realm.advance(2)
        village = realm.lords[0].mind.get_group_id("village")
        assert len(realm.strangers.members_of("village", village)) == 3
        assert realm.strangers.asking("village", village) == []
        assert realm.lords[0].mind.get_group_attribute("village", "grain") == 0
    thieves = page["Realm"](seed=1, compiled=False, dishonesty=1)
    thieves.step()
    assert thieves.strangers.members_of("village", 0) == []


def test_sanctions_bring_the_norm_about_and_it_stays(village):
    society = village(seed=1, compiled=False)
    worked = []
    for _ in range(3):
        society.step()
        worked.append(int(society.folk.worked.sum()))
    assert worked == [0, 0, 20]
    society.advance(17)
    for guard in society.guards:
        guard.die()
    before = int(society.folk.worked.sum())
    society.advance(10)
    assert int(society.folk.worked.sum()) == before + 200
    assert next(iter(society.folk)).mind.get_culturon_value("village", "Norm") > 4


def test_without_sanction_or_without_obedience_nobody_follows_it(village):
    idle = village(seed=1, compiled=False, harshness=0)
    idle.advance(50)
    assert idle.folk.worked.sum() == 0
    rebels = village(seed=1, compiled=False, obedience=0)
    rebels.advance(2)
    # Their group's culturons count for nothing, so fear alone must reach 4.
    assert rebels.folk[0].mind.plan_weights() == {"work": 3.0, "rest": 4.0}
