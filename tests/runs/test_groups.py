"""Groups in the tables of a run, and runs made before they were recorded."""

import sys

import pyarrow.parquet as pq
import pytest

from coglogo_py import CognitiveScheme, Cogniton, Culturon, Group, Role
from socialmind import Agent, Model, Population, SocialmindError, each, once
from socialmind.agents.agent_columns import as_before
from socialmind.agents.group_columns import group_instances, has_groups
from socialmind.runs.execution import resume, run
from socialmind.runs.result import Run
from socialmind.runs.verification import replay

LAW = Culturon("Law", 2.0, influence={"work": 3.0}, conditional=("work",))
FOLK = CognitiveScheme(
    "folk",
    (Cogniton("Rest", start_value=1.0),),
    (Group("village", (Role("member", (LAW,)),)), Group("guild", (Role("master"),))),
)
LORDS = CognitiveScheme("lords", groups=(Group("village", (Role("chief"),)),))


class Peasant(Agent):
    role_village: int = 7


class Lord(Agent):
    pass


def found(lord, model):
    if lord.mind.create_and_join_group("village", "chief"):
        model.last = lord.mind.get_group_id("village")
    lord.mind.add_to_culturon_value("village", "Law", 0.5)


def enter(peasant, model, rng):
    if peasant.id == 1 and model.ticks_done == 3:
        peasant.mind.create_and_join_group("guild", "master")
    if peasant.id == 2 and model.ticks_done >= 2:
        peasant.mind.join_group("village", "member", model.last)
        peasant.mind.set_participation("village", 0.25)
    if rng.random() < 0.02:
        peasant.mind.leave_all_groups()


def count(model):
    model.ticks_done += 1


class Realm(Model):
    last: int = -1
    ticks_done: int = 0
    lords = Population(Lord, 1, mind=LORDS, culture="realm")
    folk = Population(Peasant, 3, mind=FOLK, culture="realm")
    schedule = (once(count), each(lords, found), each(folk, enter))


class Alone(Model):
    lords = Population(Lord, 1, mind=CognitiveScheme("alone"))
    schedule = ()


Realm.__module__ = Alone.__module__ = __name__
assert sys.modules[__name__].Realm is Realm


def of_columns(path):
    return pq.read_table(path).to_pydict()


def test_a_run_records_groups_by_hand(tmp_path):
    folder = run(Realm, ticks=3, every=1, agents_every=1, out=tmp_path / "run", compiled=False)
    assert of_columns(folder / "groups.parquet") == {
        "tick": [1, 2, 3, 3],
        "populations": ["lords, folk"] * 4,
        "group": ["village", "village", "village", "guild"],
        "instance": [0, 0, 0, 1],
        "members": [1, 2, 2, 1],
        "culturon_Law": [2.5, 3.0, 3.5, None],
    }
    agents = of_columns(folder / "agents.parquet")
    last = slice(-4, None)  # the lord, then three peasants, at tick 3
    assert agents["group_village"][last] == [0, None, None, 0]
    assert agents["mind.role_village"][last] == ["chief", None, None, "member"]
    assert agents["role_village"][last][1:] == [7, 7, 7]
    assert agents["participation_village"][last] == [1.0, None, None, 0.25]
    assert agents["group_guild"][last] == [None, None, 1, None]
    assert agents["role_guild"][last] == [None, None, "master", None]
    assert Run(folder).groups["members"].tolist() == [1, 2, 2, 1]


def test_a_run_made_longer_has_the_tables_of_one_never_stopped(tmp_path):
    whole = run(Realm, ticks=9, every=1, agents_every=2, out=tmp_path / "a", compiled=False)
    parts = run(Realm, ticks=5, every=1, agents_every=2, out=tmp_path / "b", compiled=False)
    resume(parts, ticks=9, model_class=Realm, compiled=False)
    for name in ("series", "agents", "groups"):
        assert (whole / f"{name}.parquet").read_bytes() == (parts / f"{name}.parquet").read_bytes()
    assert replay(whole, model_class=Realm).exact
    assert not replay(whole, model_class=Realm).differences


def test_without_groups_there_is_no_table_of_them(tmp_path):
    assert not has_groups(Alone(seed=0))
    folder = run(Alone, ticks=1, out=tmp_path / "run", compiled=False)
    assert not (folder / "groups.parquet").exists()
    with pytest.raises(SocialmindError, match=r"has no table of groups; only runs of models whose"):
        _ = Run(folder).groups


def test_a_society_before_its_first_group_has_the_columns_without_rows():
    assert group_instances(Realm(seed=0, compiled=False)) == {
        "populations": [], "group": [], "instance": [], "members": [], "culturon_Law": [],
    }  # fmt: skip


def test_a_run_that_began_without_memberships_goes_on_without():
    today = {"agent": [0], "plan": ["eat"], "group_herd": [3], "role_herd": ["a"], "fat": [1.0]}
    assert as_before(today, ("agent", "plan", "fat"), "cows") == {
        "agent": [0], "plan": ["eat"], "fat": [1.0],
    }  # fmt: skip
