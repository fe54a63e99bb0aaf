"""Hierarchies are laid out once; their values come with each frame, and are traced by repeating."""

from pathlib import Path

import pytest

from socialmind.catalogue import load_model
from socialmind.errors import SocialmindError
from socialmind.interventions.steer import Steer
from socialmind.mind.evaluation.agent_state import AgentState
from socialmind.studio.running.hierarchies import laid_out, node_values, traced, values_in
from socialmind.studio.running.live_run import LiveRun
from socialmind.studio.running.watching import watched

ROVERS = Path(__file__).parents[2] / "interventions" / "rovers"


@pytest.fixture
def run():
    return LiveRun(load_model(ROVERS)(seed=1, n=2))


def state(run, agent=0):
    table = run.society.tables["rovers"]
    return AgentState(table.minds, table[agent]._slot)


def test_every_node_and_link_has_its_place(run):
    plan = laid_out(run.society, "rovers")
    assert {one["name"] for one in plan["boxes"]} == {
        "SK:Top", "SK:Drive", "SE:AHEAD", "MO:MotL", "MO:MotR",
    }  # fmt: skip
    named = {one["name"]: one for one in plan["boxes"]}
    assert named["SK:Top"]["lines"] == ["Top"]
    assert named["SK:Top"]["y"] < named["SK:Drive"]["y"] < named["MO:MotL"]["y"]
    assert {(one["from"], one["to"]) for one in plan["links"]} == {
        ("SK:Top", "SK:Drive"), ("SK:Drive", "MO:MotL"), ("SK:Drive", "MO:MotR"),
    }  # fmt: skip
    assert len(plan["readings"]) == 2


def test_values_come_with_what_is_watched(run):
    assert watched(run.society, "rovers", 0)["skills"] is None  # before the first evaluation
    run.advance(5)
    seen = watched(run.society, "rovers", 0)["skills"]
    assert seen == values_in(state(run))
    assert seen["values"]["SK:Drive"] == 1.0
    assert seen["sent"]["Drive MO:MotL"] == seen["values"]["MO:MotL"] == 0.75


def test_a_trace_is_what_was_seen_tick_by_tick(run):
    seen = []
    run.intervene(Steer(0, "rovers", 0, (0.0, 1.0)))
    for _ in range(60):
        run.advance(1)
        seen.append(node_values(state(run)))
    before = run.society.state()
    found = traced(run, "rovers", 0, 20)
    assert found["tick"] == list(range(40, 61))
    assert found["values"]["SE:AHEAD"] == [one["SE:AHEAD"] for one in seen[39:]]
    assert len(set(found["values"]["SE:AHEAD"])) > 1
    assert run.tick == 60
    assert all((run.society.state()[name] == one).all() for name, one in before.items())
    whole = traced(run, "rovers", 0, 500)
    assert whole["tick"] == list(range(1, 61))


def test_what_has_no_hierarchy_is_not_traced(run):
    with pytest.raises(SocialmindError, match="no living agent 9"):
        traced(run, "rovers", 9, 5)
