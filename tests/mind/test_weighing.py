"""Plans that a hierarchy weighs: as the scheme's links do, where it is the same function."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from coglogo_py import MaximumWeight, WeightedStochastic
from coglogo_py.decision import DecisionMaker
from socialmind import Agent, Model, Population, SocialmindError, each
from socialmind.errors import ModelError
from socialmind.mind import MindDescription, Perceptron, Programmed, Skill, Variable
from socialmind.mind.weighing import Weighing, linear_skill
from socialmind.observation import mind_columns
from socialmind.sources.loading import load_file

GRAZING = load_file(Path(__file__).parents[1] / "learning" / "grazing.py")
Grazing, Weighed, SCHEME, MIND = (
    GRAZING.Grazing, GRAZING.Weighed, GRAZING.SCHEME, GRAZING.MIND
)  # fmt: skip


def course(model, ticks=150):
    """The plans of all agents, tick by tick."""
    plans = []
    for _ in range(ticks):
        model.advance(1)
        plans.append(model.plans(model.cows))
    return plans


@pytest.mark.parametrize("maker", [None, MaximumWeight(), WeightedStochastic()])
@pytest.mark.parametrize("compiled", [True, False])
def test_a_perceptron_with_the_weights_of_the_links_lives_as_the_scheme_does(maker, compiled):
    scheme = SCHEME if maker is None else replace(SCHEME, decision_maker=maker)
    by_links = Grazing(seed=3, compiled=compiled, scheme=scheme)
    weighed = Weighed(seed=3, compiled=compiled, scheme=scheme)
    expected = course(by_links)
    assert course(weighed) == expected
    assert {plan for line in expected for plan in line} >= {"eat", "rest", "wander"}
    for name in ("Hunger", "Fatigue", "Fear"):
        found = weighed.cows.cogniton(name)
        np.testing.assert_array_equal(found, by_links.cows.cogniton(name))


def test_such_a_perceptron_is_made_of_a_scheme():
    made = linear_skill(SCHEME, GRAZING.WEIGHING)
    assert made.genome.tolist() == MIND.skills["Weigh"].genome.tolist()
    assert [str(one) for one in made.inputs] == [str(one) for one in MIND.skills["Weigh"].inputs]
    with pytest.raises(ModelError, match="'Fear', which influences plans"):
        linear_skill(SCHEME, Weighing({"Hunger": 1.0, "Fatigue": 1.0}))


def test_both_speeds_and_a_checkpoint_give_the_same():
    compiled, interpreted = Weighed(seed=5), Weighed(seed=5, compiled=False)
    compiled.advance(80)
    interpreted.advance(80)
    np.testing.assert_array_equal(
        compiled.cows.cogniton("Hunger"), interpreted.cows.cogniton("Hunger")
    )
    state = compiled.state()
    compiled.advance(40)
    gone_on = compiled.cows.cogniton("Hunger")
    again = Weighed(seed=5)
    again.restore(state)
    again.advance(40)
    np.testing.assert_array_equal(again.cows.cogniton("Hunger"), gone_on)


def test_another_mind_decides_otherwise():
    skill = MIND.skills["Weigh"]
    tired = MIND.with_modules(skills=[skill.changed(genome=[0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0])])
    model = Weighed(seed=3, hierarchy=tired, scheme=replace(SCHEME, decision_maker=MaximumWeight()))
    model.advance(50)
    assert set(model.plans(model.cows)) == {"rest"}


def test_sensors_read_cognitons_within_reach_and_what_is_inactive_in_the_middle():
    model = Weighed(seed=1, compiled=False)
    cow = model.cows[0]
    for name, value in (("Hunger", 25.0), ("Fatigue", -60.0)):
        cow.mind.set_cogniton_value(name, value)
    cow.mind.choose_next_plan()
    read = [cow.hierarchy.sensor(name) for name in ("Hunger", "Fatigue", "Fear")]
    assert read == [0.75, 0.0, 0.5]


def test_weights_are_those_of_the_last_decision():
    model = Weighed(seed=4)
    model.advance(30)
    columns = mind_columns(model.cows)
    commands = model.cows.minds.state.actuators[: len(model.cows), 1, 0]
    np.testing.assert_allclose(columns["weight_rest"], (2 * commands - 1) * 200.0)
    assert model.cows[3].mind.plan_weights()["rest"] == columns["weight_rest"][3]


def test_plans_that_no_cogniton_opens_are_not_chosen():
    model = Weighed(seed=2, compiled=False)
    mind = model.cows[0].mind
    mind.deactivate_cogniton("Hunger")
    assert set(mind.plan_weights()) == {"rest"}
    mind.deactivate_cogniton("Fatigue")
    assert mind.choose_next_plan() is None
    assert model.idle.count == 1


def forget(gone):
    """Forget to eat ever more."""
    return min(1.0, gone + 0.25), 1.0 - gone, 0.6, 0.0


def test_the_hierarchy_is_evaluated_once_a_decision_and_remembers():
    mind = MindDescription(
        "cow", ["Hunger"], SCHEME.plans, [Variable("GONE")],
        [Skill("Forget", ["VA:GONE"], ["VA:GONE", "MO:eat", "MO:rest", "MO:wander"],
               Programmed(forget))],
    )  # fmt: skip
    model = Weighed(
        seed=1,
        compiled=False,
        hierarchy=mind,
        scheme=replace(SCHEME, decision_maker=MaximumWeight()),
    )
    plans = [one[0] for one in course(model, 5)]
    assert plans == ["eat", "eat", "rest", "rest", "rest"]  # 1, 0.75, 0.5, … against 0.6


def test_the_choice_of_a_weighed_plan_has_no_receipt_of_cognitons():
    model = Weighed(seed=1)
    model.advance(3)
    with pytest.raises(SocialmindError, match="weigh the plans, not the cognitons"):
        model.explain(0, 2)


class Contrary(DecisionMaker):
    """Takes the plan of the least weight."""

    name = "Contrary"

    @staticmethod
    def choose(weights, bias, u):
        """The first of the least."""
        least = 0
        for position in range(1, len(weights)):
            if weights[position] < weights[least]:
                least = position
        return least

    @staticmethod
    def probabilities(weights, bias):
        """One for it."""
        certain = np.zeros(len(weights))
        certain[np.argmin(weights)] = 1.0
        return certain


def test_a_decision_maker_of_ones_own_chooses_among_the_weights():
    scheme = replace(SCHEME, decision_maker=Contrary())
    assert course(Weighed(seed=6, scheme=scheme), 30) == course(Grazing(seed=6, scheme=scheme), 30)


# Refusals ---------------------------------------------------------------------------------------


def declared(**settings):
    """A model with a population of cows so declared."""
    return type("Wrong", (Model,), {"cows": Population(GRAZING.Cow, 2, **settings)})


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda: Weighing({"Hunger": 0.0}), "the reach 0.0 of Hunger"),
        (lambda: Weighing(reach=float("inf")), "the reach inf of the plans"),
        (lambda: declared(mind=SCHEME, weighing=Weighing()), "not both kinds of mind"),
        (
            lambda: declared(mind=SCHEME, hierarchy=MIND, weighing=Weighing({"Hungr": 1.0}))(),
            "'Hungr', which is no cogniton.*Hunger",
        ),
        (
            lambda: declared(
                mind=SCHEME, weighing=Weighing(),
                hierarchy=MindDescription("m", [], ["eat", "rest"], skills=[
                    Skill("S", [], ["MO:eat", "MO:rest"], Perceptron(layers=0), [0, 0])]),
            )(),
            "without an actuator for the plan 'wander'",
        ),
    ],
)  # fmt: skip
def test_what_does_not_fit_is_refused(call, message):
    with pytest.raises(ModelError, match=message):
        call()


class Stranger(Agent):
    """Somebody else."""


def test_a_phase_for_anothers_population_is_still_refused():
    with pytest.raises(ModelError, match="a population that the class does not have"):
        type("Wrong", (Grazing,), {"schedule": (each(Population(Stranger, 1), GRAZING.live),)})
