"""The hierarchies of a model's agents, as columns of tables and under Mesa."""

import pytest

from socialmind import Agent, Model, Population, each
from socialmind.mind import MindDescription, Programmed, Skill
from socialmind.observation import hierarchy_columns


def lean(left, right):
    return left, right, left


MIND = MindDescription(
    "scales",
    ["LEFT", "RIGHT"],
    ["PAN", "BEAM"],
    ["LAST"],
    [Skill("Lean", ["SE:LEFT", "SE:RIGHT"], ["MO:PAN", "MO:BEAM", "VA:LAST"], Programmed(lean))],
)


class Scales(Agent):
    pass


def weigh(scales):
    scales.hierarchy.set_sensor("LEFT", scales.id / 10)
    scales.hierarchy.set_sensor("RIGHT", 0.5)
    scales.hierarchy.evaluate()
    if scales.id == 1:
        scales.die()


class Shop(Model):
    scales = Population(Scales, 4, hierarchy=MIND)
    schedule = (each(scales, weigh),)


class Bare(Model):
    scales = Population(Scales, 4)


@pytest.fixture
def shop():
    society = Shop(compiled=False)
    society.advance(2)
    return society


def test_columns_hold_what_the_hierarchies_did(shop):
    columns = hierarchy_columns(shop.scales)
    assert {name: column.tolist() for name, column in columns.items()} == {
        "influence_Lean": [1.0, 1.0, 1.0],
        "variable_LAST": [0.0, 0.2, 0.3],
        "command_PAN": [0.0, 0.2, 0.3],
        "command_BEAM": [0.5, 0.5, 0.5],
    }


def test_a_population_without_hierarchies_has_no_such_columns():
    assert hierarchy_columns(Bare().scales) == {}


def test_agents_under_mesa_have_their_hierarchy(shop):
    agents = shop.mesa().agents
    commands = sorted(agent.hierarchy.actuator("PAN") for agent in agents)
    assert commands == [0.0, 0.2, 0.3]
