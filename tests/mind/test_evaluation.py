"""Random hierarchies for one agent, held to plain Python, and to themselves."""

import random

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from independent import Alone
from random_minds import MASTER, bits, minds, random_mind, sensor_values, shuffled

from socialmind.mind import Hierarchy

TICKS = 30
CLOSE = {"rel": 1e-9, "abs": 1e-9}


@pytest.mark.parametrize("seed", range(300))
def test_a_hierarchy_gives_what_plain_python_gives(seed):
    draw = random.Random(seed)
    description = random_mind(draw)
    alone, hierarchy = Alone(description, MASTER), Hierarchy(description, MASTER)
    for values in sensor_values(description, draw, TICKS):
        expected = alone.step(values)
        assert hierarchy.evaluate(values) == pytest.approx(expected, **CLOSE)
        assert hierarchy.influences() == pytest.approx(alone.agent.influences, **CLOSE)
        assert hierarchy.variables() == pytest.approx(alone.agent.values(), **CLOSE)
        assert hierarchy.outputs() == pytest.approx(alone.agent.outputs, **CLOSE)
        assert hierarchy.links() == pytest.approx(alone.agent.links, **CLOSE)
    assert hierarchy.sensors() == values
    assert hierarchy.actuators() == pytest.approx(expected, **CLOSE)
    assert hierarchy.tick == TICKS


@given(minds(), st.integers(0, 2**32))
@settings(max_examples=50)
def test_small_hierarchies_give_what_plain_python_gives(description, seed):
    alone, hierarchy = Alone(description, MASTER), Hierarchy(description, MASTER)
    for values in sensor_values(description, random.Random(seed), 5):
        expected = alone.step(values)
        assert hierarchy.evaluate(values) == pytest.approx(expected, **CLOSE)


@pytest.mark.parametrize("seed", range(1000, 1040))
def test_any_skill_can_be_the_master(seed):
    draw = random.Random(seed)
    description = random_mind(draw)
    master = draw.choice(sorted(description.skills))
    alone, hierarchy = Alone(description, master), Hierarchy(description, master)
    assert sorted(hierarchy.skills) == sorted(alone.agent.skills)
    read = {
        one.name
        for name in alone.agent.skills
        for one in description.skills[name].inputs
        if one.module == "sensor"
    }
    for values in sensor_values(description, draw, TICKS):
        expected = alone.step(values)
        needed = {name: values[name] for name in sorted(read)}
        assert hierarchy.evaluate(needed) == pytest.approx(expected, **CLOSE)


def run(hierarchy, seed):
    """Everything that shows of a run, to the last bit."""
    seen = []
    for values in sensor_values(hierarchy.description, random.Random(seed), TICKS):
        motors = hierarchy.evaluate(values)
        tables = (motors, hierarchy.variables(), hierarchy.influences(), hierarchy.links())
        seen.append([bits(table) for table in tables])
    return seen


@pytest.mark.parametrize("seed", range(1100, 1160))
def test_the_order_of_declaration_changes_nothing(seed):
    draw = random.Random(seed)
    description = random_mind(draw)
    first = run(Hierarchy(description, MASTER), seed)
    assert run(Hierarchy(shuffled(description, draw), MASTER), seed) == first


@pytest.mark.parametrize("seed", range(1200, 1220))
def test_a_run_can_be_had_again(seed):
    description = random_mind(random.Random(seed))
    hierarchy = Hierarchy(description, MASTER)
    first = run(hierarchy, seed)
    hierarchy.reset()
    assert hierarchy.tick == 0
    assert run(hierarchy, seed) == first
    assert run(Hierarchy(description, MASTER), seed) == first
