"""What a population asks of minds: cognitons, hierarchies and both meet it in the same way."""

from pathlib import Path

import pytest

from socialmind import Agent, Model, Population, each
from socialmind.mind import MindDescription, Perceptron, Skill, Variable
from socialmind.mind.contract import CognitonMinds, SkillMinds
from socialmind.sources.loading import load_file

GRAZING = load_file(Path(__file__).parents[1] / "learning" / "grazing.py")
CLIMBER = MindDescription(
    "climber", ["Slope"], ["Step"], [Variable("Height")],
    [Skill("Climb", ["SE:Slope", "VA:Height"], ["MO:Step", "VA:Height"], Perceptron(layers=0),
           [0.5, 0.25, 0.125, 0.5, 0.5, 0.0])],
)  # fmt: skip


class Climber(Agent):
    """Who climbs."""

    step: float = 0.0


def climb(climber, rng):
    """Do what the hierarchy commands."""
    climber.hierarchy.set_sensor("Slope", rng.random())
    climber.hierarchy.evaluate()
    climber.step = climber.hierarchy.actuator("Step")


class Climbing(Model):
    """Agents with a hierarchy alone."""

    ticks = 10
    cows = Population(Climber, 4, hierarchy=CLIMBER)
    schedule = (each(cows, climb),)


@pytest.fixture(
    params=[GRAZING.Grazing, Climbing, GRAZING.Weighed], ids=["scheme", "skills", "both"]
)
def society(request):
    """A society that has lived for some ticks."""
    made = request.param(seed=2, compiled=False)
    made.advance(5)
    return made


def inside(society, slot):
    """All that the minds of the agent in a slot hold, but for draws, which everybody has anew."""
    table = society.tables["cows"]
    held = []
    if table.society is not None:
        held += table.mind_of(slot).cognitons().values()
    if table.minds is not None:
        arrays = table.minds.snapshot()
        held += [arrays[name][slot].tolist() for name in ("sensors", "values", "actuators")]
    return held


def everything(society):
    return {name: array.tobytes() for name, array in society.state().items()}


def test_each_kind_meets_the_contract(society):
    table = society.tables["cows"]
    sides = [(table.society, CognitonMinds), (table.minds, SkillMinds)]
    there = [(side, kind) for side, kind in sides if side is not None]
    assert there
    assert all(isinstance(side, kind) for side, kind in there)


def test_who_is_born_begins_as_the_founders_did(society):
    table = society.tables["cows"]
    stranger = table.create()
    begun = society.fresh()
    assert inside(society, stranger._slot) == inside(begun, 0)
    assert inside(society, 0) != inside(begun, 0)


def test_a_copy_has_what_its_parent_has(society):
    table = society.tables["cows"]
    parent = next(iter(society.cows))
    child = table.hatch(parent)
    assert inside(society, child._slot) == inside(society, parent._slot)
    society.advance(3)
    assert inside(society, child._slot) != inside(society, parent._slot)


def test_room_is_made_and_nobody_changes(society):
    table = society.tables["cows"]
    before = [inside(society, slot) for slot in table.slots]
    table.grow()
    assert [inside(society, slot) for slot in table.slots] == before
    assert len(table.rows) == 256


def test_a_slot_that_is_taken_again_keeps_nothing(society):
    table = society.tables["cows"]
    table.die(next(iter(society.cows)))
    table.settle()
    heir = table.create()
    assert heir._slot == 0
    assert inside(society, 0) == inside(society.fresh(), 0)


def test_a_state_brings_everything_back(society):
    kept, before = society.state(), everything(society)
    society.advance(4)
    after = everything(society)
    assert after != before
    society.restore(kept)
    assert everything(society) == before
    society.advance(4)
    assert everything(society) == after
