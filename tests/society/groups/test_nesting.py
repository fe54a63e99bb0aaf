"""Groups in groups, in rules: both speeds agree, and tables say what lies in what."""

import pyarrow.parquet as pq
import pytest

from coglogo_py import CognitiveScheme, Culturon, Group, Role
from socialmind import Agent, Model, Population, each
from socialmind.runs.execution import run
from socialmind.runs.result import Run

LAW = Culturon("Law", 2.0, influence={"work": 1.0}, conditional=("work",),
               reinforcement={"work": 0.25})  # fmt: skip
CLAN = Group("clan", (Role("member", (LAW,)), Role("chief")), {"grain": 0})
LORDS = CognitiveScheme("lords", groups=(Group("clan", (Role("chief"),)),))
FOLK = CognitiveScheme("folk", groups=(Group("family", (Role("kin"),), within=("clan", "member")),
                                       CLAN))  # fmt: skip


class Human(Agent):
    worked: int = 0


def found(lord, model, rng):
    if lord.mind.create_and_join_group("clan", "chief"):
        model.last = lord.mind.get_group_id("clan")
        lord.mind.set_culturon_value("clan", "Law", 3.0)
    elif rng.random() < 0.2:
        lord.mind.leave_group("clan")


def live(human, model, rng):
    if rng.random() < 0.3:
        human.mind.create_and_join_group("family", "kin")
    elif model.folk.members_of("clan", model.last).one_of(rng) is None and rng.random() < 0.3:
        human.mind.create_and_join_group("clan", "member")
    elif rng.random() < 0.1:
        human.mind.leave_all_groups()
    elif rng.random() < 0.1 and len(model.folk) < 30:
        human.hatch(keep_groups=True)
    elif rng.random() < 0.1:
        human.die()
        return
    if human.mind.get_enclosing_group_id("family") >= 0 and rng.random() < 0.2:
        human.mind.release_group("family")
    for lord in model.lords:
        clan = lord.mind.get_group_id("clan")
        if clan >= 0 and rng.random() < 0.5:
            human.mind.enclose_group("family", clan)
    human.plan = human.mind.choose_next_plan()
    human.run_plan(model, rng)


def work(human):
    human.worked += 1
    human.mind.add_to_group_attribute("clan", "grain", 1.0)
    human.mind.feed_back_from_plan("work", 1.0)


class Land(Model):
    last: int = -1
    lords = Population(Human, 2, mind=LORDS, culture="land")
    folk = Population(Human, 10, mind=FOLK, culture="land", plans={"work": work})
    schedule = (each(lords, found), each(folk, live))


def facts(land):
    found = [land.folk.id.tolist(), land.folk.worked.tolist()]
    for one in (*land.lords, *land.folk):
        mind = one.mind
        found += [mind.get_group_id("clan"), mind.get_enclosing_group_id("family")]
        found += [mind.get_culturon_value("clan", "Law"), mind.plan_weights()]
        found += [mind.get_group_attribute("clan", "grain")]
    return found


@pytest.mark.parametrize("seed", range(6))
def test_both_speeds_and_a_resumed_society_agree(seed):
    fast, slow = Land(seed=seed), Land(seed=seed, compiled=False)
    for tick in range(10):
        fast.advance(2)
        slow.advance(2)
        assert facts(fast) == facts(slow)
        if tick == 5:
            fast = Land(seed=seed)
            fast.restore(slow.state())
    nested = [one for one in slow.folk if one.mind.get_enclosing_group_id("family") >= 0]
    assert slow.folk.worked.sum() > 0
    assert nested


def test_the_table_of_groups_says_what_lies_in_what(tmp_path):
    folder = run(Land, seed=1, ticks=8, every=1, agents_every=1, out=tmp_path / "run",
                 compiled=False)  # fmt: skip
    table = pq.read_table(folder / "groups.parquet").to_pylist()
    assert list(table[0])[:6] == ["tick", "populations", "group", "instance", "members", "within"]
    clans = {(row["tick"], row["instance"]) for row in table if row["group"] == "clan"}
    inside = [row for row in table if row["within"] is not None]
    assert inside
    assert all(row["group"] == "family" for row in inside)
    assert all((row["tick"], row["within"]) in clans for row in inside)
    assert "within" in Run(folder).groups.columns
