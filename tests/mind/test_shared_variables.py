"""Variables that the members of a group share (thesis, 9.2.2), weighted by participation."""

import random

import numpy as np
import pytest
from independent import Society
from random_minds import MASTER, random_mind, sensor_values
from small_minds import written

from socialmind.mind import Counter, Hierarchy, Minds, Simple, Variable, Wave

GROUP = "herd"


def herd(regulation=None, agents=4, instances=2, default=None):
    variable = Variable("V", regulation or Simple(), default, GROUP)
    return Minds(written(variable), "Master", agents, instances=instances)


def step(minds, commands, influences):
    """Command the variable by each agent; return what each sees at this tick."""
    minds.evaluate({"command": np.array(commands), "influence": np.array(influences), "one": 1.0})
    return minds.variable("V").tolist()


def test_members_see_the_mean_of_commands_weighted_by_participation_and_influence():
    minds = herd()
    minds.join(GROUP, [0, 1], 0, 1.0)
    minds.join(GROUP, 2, 0, 0.5)
    minds.join(GROUP, 3, 1)
    assert step(minds, [1.0, 0.5, 0.0, 0.25], [1.0, 0.4, 0.2, 0.1]) == [0.0] * 4
    # (1 · 1.0 · 1.0 + 1 · 0.4 · 0.5 + 0.5 · 0.2 · 0.0) / (1 · 1.0 + 1 · 0.4 + 0.5 · 0.2)
    expected = pytest.approx([0.8, 0.8, 0.8, 0.25])
    assert step(minds, [0.0] * 4, [0.0] * 4) == expected
    assert step(minds, [0.0] * 4, [0.0] * 4) == expected  # nobody influences: it is kept


def test_who_does_not_participate_sees_and_is_not_heard():
    minds = herd(agents=2)
    minds.join(GROUP, 0, 1, 1.0)
    minds.join(GROUP, 1, 1, 0.0)
    step(minds, [0.25, 1.0], [0.5, 1.0])
    assert step(minds, [0.0, 1.0], [0.0, 1.0]) == [0.25, 0.25]
    assert step(minds, [0.0, 0.0], [0.0, 0.0]) == [0.25, 0.25]


def test_who_is_in_no_group_has_the_variable_alone():
    minds = herd(agents=3, default=0.5)
    minds.join(GROUP, [0, 1], 0)
    assert step(minds, [0.0, 1.0, 0.125], [1.0, 1.0, 0.5]) == [0.5, 0.5, 0.5]
    assert step(minds, [0.0, 0.0, 0.0], [0.0, 0.0, 0.0]) == [0.5, 0.5, 0.125]
    alone = Hierarchy(written(Variable("V", Simple(), 0.5, GROUP)), "Master")
    alone.evaluate({"command": 0.125, "influence": 0.5, "one": 1.0})
    alone.evaluate({"command": 0.0, "influence": 0.0, "one": 1.0})
    assert alone.variables() == {"V": 0.125}


def test_a_shared_counter_counts_once_for_all():
    minds = herd(Counter(), agents=3, instances=1)
    minds.join(GROUP, [0, 1, 2], 0)
    step(minds, [1.0, 1.0, 1.0], [1.0, 1.0, 1.0])
    assert step(minds, [0.5, 0.5, 0.5], [1.0, 1.0, 1.0]) == [0.1] * 3
    # The mean command is 0.75: one member alone does not bring it above 0.8.
    assert step(minds, [1.0, 0.5, 0.75], [1.0, 1.0, 1.0]) == [0.1] * 3
    assert step(minds, [1.0, 1.0, 1.0], [1.0, 1.0, 1.0]) == [0.1] * 3
    assert step(minds, [0.0, 0.0, 0.0], [1.0, 1.0, 1.0]) == [0.2] * 3
    assert step(minds, [0.0, 0.0, 0.0], [1.0, 1.0, 1.0]) == [0.0] * 3


@pytest.mark.parametrize("regulation", [Simple(), Counter(), Wave()], ids=lambda one: one.keyword)
def test_a_group_of_one_is_like_an_agent_alone(regulation):
    minds = herd(regulation, agents=2, instances=1)
    minds.join(GROUP, 0, 0, 0.25)
    draw = random.Random(1)
    for _ in range(30):
        command, influence = draw.random(), draw.choice([0.0, draw.random()])
        member, alone = step(minds, [command] * 2, [influence] * 2)
        assert member == pytest.approx(alone, abs=1e-12)


@pytest.mark.parametrize("seed", range(3000, 3030))
def test_random_groups_share_as_in_plain_python(seed):
    draw = random.Random(seed)
    description = random_mind(draw, skills=20, programs=False, group=GROUP)
    agents = 11
    members = [
        draw.choice([None, (draw.randrange(3), draw.choice([1.0, 0.0, draw.random()]))])
        for _ in range(agents)
    ]
    society = Society(description, [MASTER], agents, groups={GROUP: members})
    minds = Minds(description, MASTER, agents, instances=3)
    if any(one.group for one in description.variables.values()):
        for number, membership in enumerate(members):
            if membership is not None:
                minds.join(GROUP, number, *membership)
    streams = [list(sensor_values(description, draw, 30)) for _ in range(agents)]
    for values in zip(*streams, strict=True):
        expected = society.evaluate(values)
        sensed = {name: np.array([one[name] for one in values]) for name in description.sensors}
        motors = minds.evaluate(sensed)
        for number, agent in enumerate(society.agents):
            found = {name: minds.variable(name)[number] for name in description.variables}
            assert found == pytest.approx(agent.values(), rel=1e-9, abs=1e-9)
            found = {name: motors[name][number] for name in motors}
            assert found == pytest.approx(expected[number], rel=1e-9, abs=1e-9)


def test_agents_may_change_groups():
    minds = herd(agents=2)
    minds.join(GROUP, 0, 0)
    minds.join(GROUP, 1, 1)
    step(minds, [0.25, 0.75], [1.0, 1.0])
    assert step(minds, [0.25, 0.75], [1.0, 1.0]) == [0.25, 0.75]
    minds.join(GROUP, 1, 0)
    step(minds, [0.25, 0.75], [1.0, 1.0])
    assert step(minds, [0.0, 0.0], [0.0, 0.0]) == [0.5, 0.5]
    minds.join(GROUP, 0, None)
    step(minds, [0.125, 1.0], [1.0, 1.0])
    assert step(minds, [0.0, 0.0], [0.0, 0.0]) == [0.125, 1.0]
