"""Plans that may be interrupted: weighed by links, by a hierarchy, or by a maker of one's own."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from coglogo_py import MaximumWeight, WeightedStochastic
from coglogo_py.decision import DecisionMaker
from socialmind import Population, each
from socialmind.sources.loading import load_file

GRAZING = load_file(Path(__file__).parents[1] / "learning" / "grazing.py")


class Lightest(DecisionMaker):
    """Takes the plan that weighs least."""

    name = "Lightest"

    @staticmethod
    def choose(weights, bias, u):
        best = 0
        for place in range(len(weights)):
            if weights[place] < weights[best]:
                best = place
        return best

    @staticmethod
    def probabilities(weights, bias):
        chances = np.zeros(len(weights))
        chances[np.argmin(weights)] = 1.0
        return chances


class Cow(GRAZING.Cow):
    begun: int = 0


def live(cow, model, rng):
    cow.mind.add_to_cogniton_value("Hunger", rng.uniform(-1, 2))
    cow.mind.add_to_cogniton_value("Fatigue", rng.uniform(-1, 1))
    if rng.random() < 0.1:
        cow.mind.activate_cogniton("Fear")
        cow.mind.set_cogniton_value("Fear", rng.uniform(0, 10))
    elif rng.random() < 0.2:
        cow.mind.deactivate_cogniton("Fear")
    if rng.random() < 0.02:
        cow.mind.deactivate_cogniton("Fatigue")
    if cow.reconsider_plan(1.5):
        cow.begun += 1
    cow.run_plan(model, rng)


class Steady(GRAZING.Grazing):
    cows = Population(Cow, 12, mind=GRAZING.SCHEME, plans=GRAZING.Grazing.cows.plans)
    schedule = (each(cows, live),)


class SteadyWeighed(GRAZING.Grazing):
    cows = Population(
        Cow,
        12,
        mind=GRAZING.SCHEME,
        plans=GRAZING.Grazing.cows.plans,
        hierarchy=GRAZING.MIND,
        weighing=GRAZING.WEIGHING,
    )
    schedule = (each(cows, live),)


def course(model, ticks=80):
    plans = []
    for _ in range(ticks):
        model.advance(1)
        plans.append(model.plans(model.cows))
    return plans, model.cows.begun.tolist(), model.cows.cogniton("Hunger").tolist()


@pytest.mark.parametrize("maker", [None, MaximumWeight(), WeightedStochastic(), Lightest()])
def test_links_and_hierarchies_give_the_same_at_both_speeds(maker):
    scheme = GRAZING.SCHEME if maker is None else replace(GRAZING.SCHEME, decision_maker=maker)
    found = [
        course(model(seed=3, scheme=scheme, compiled=compiled))
        for model in (Steady, SteadyWeighed)
        for compiled in (True, False)
    ]
    assert found[0][:2] == found[1][:2] == found[2][:2] == found[3][:2]
    assert found[0] == found[1]
    assert found[2] == found[3]
    assert 12 < sum(found[0][1]) < 12 * 40  # most ticks go on with the plan


def test_a_plan_goes_on_unless_another_weighs_so_many_times_as_much():
    model = Steady(seed=5, scheme=replace(GRAZING.SCHEME, decision_maker=MaximumWeight()))
    for _ in range(60):
        before = {cow.id: (cow.plan, cow.begun) for cow in model.cows}
        model.advance(1)
        for cow in model.cows:
            plan, begun = before[cow.id]
            assert (cow.begun > begun) == (cow.plan != plan)


def test_the_decision_that_interrupted_is_explained():
    model = Steady(seed=3)
    model.advance(40)
    receipt = model.explain(agent=2, tick=40)
    assert receipt.choice == model.cows[2].plan
