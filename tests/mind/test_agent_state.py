"""The state of one agent's hierarchy in a model, against the hierarchy alone."""

from pathlib import Path

import pytest

from socialmind.catalogue import load_model
from socialmind.mind import Hierarchy
from socialmind.mind.evaluation.agent_state import AgentState, observe

SEEKERS = Path(__file__).parents[1] / "worlds" / "plane" / "seekers"


@pytest.fixture
def seekers():
    return load_model(SEEKERS)(compiled=False)


def state_of(model, slot):
    return AgentState(model.tables["robots"].minds, slot)


def test_it_reads_as_the_hierarchy_alone(seekers):
    observe(seekers.assemblies["robots"])
    seekers.advance(7)
    readings = seekers.tables["robots"].columns["readings"]
    for slot in (0, 1):
        alone = Hierarchy(seekers.assemblies["robots"].description)
        alone.evaluate({"RADBALL": readings[slot, 1]})
        state = state_of(seekers, slot)
        assert state.skills == alone.skills
        for part in ("influences", "links", "outputs", "sensors", "variables", "actuators"):
            assert getattr(state, part)() == getattr(alone, part)(), part
    assert state_of(seekers, 0).sensors() != state_of(seekers, 1).sensors()


def test_before_its_first_evaluation_the_tick_is_zero(seekers):
    assert state_of(seekers, 0).tick == 0
    seekers.advance()
    assert state_of(seekers, 0).tick > 0


def test_observing_shows_idle_skills_and_changes_nothing_else(seekers):
    watched = load_model(SEEKERS)(compiled=False)
    observe(watched.assemblies["robots"])
    for model in (seekers, watched):
        model.advance(20)
    link = ("Idle", "MO:MotL")
    assert state_of(seekers, 0).outputs()[link] == 0.0
    assert state_of(watched, 0).outputs()[link] == 0.5
    assert state_of(watched, 0).links()[link] == 0.0
    assert state_of(watched, 0).actuators() == state_of(seekers, 0).actuators()
    for name in ("x", "y", "angle"):
        columns = [model.tables["robots"].columns[name].tolist() for model in (seekers, watched)]
        assert columns[0] == columns[1]
