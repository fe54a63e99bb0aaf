"""A newborn has its parent's plan, and no decision of its own yet."""

import pytest

from coglogo_py import CognitiveScheme, Cogniton
from socialmind import Agent, Model, Population, SocialmindError, each

LAY = Cogniton("Lay", start_value=1, influence={"lay": 1}, conditional=("lay",))


class Hen(Agent):
    """A hen."""


def choose(hen, model):
    hen.plan = hen.mind.choose_next_plan()
    if hen.id == 0 and model.tick == 1:
        hen.hatch()


class Hens(Model):
    hens = Population(Hen, 2, mind=CognitiveScheme("hens", (LAY,)))
    schedule = (each(hens, choose),)


@pytest.mark.parametrize("compiled", [True, False])
def test_who_was_just_hatched_has_taken_no_decision(compiled):
    society = Hens(compiled=compiled)
    society.advance(2)
    assert society.hens[2].plan == "lay"
    with pytest.raises(SocialmindError, match="agent 2 has taken no decision up to tick 2"):
        society.explain(2, 2)
    assert society.explain(0, 2).decision == 2
    assert society.explain(2, 3).decision == 1
