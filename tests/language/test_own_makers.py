"""Decision makers of the modeller's own in a model: refused alike at both speeds."""

import numpy as np
import pytest

from coglogo_py import CognitiveScheme, Cogniton, DecisionMaker, SchemeError
from socialmind import Agent, Model, Population, RuleError, each


def third(weights):
    return weights[2]


class Faulty(DecisionMaker):
    """Goes wrong in the way that its bias says, so that one compiled model has all faults."""

    name = "Faulty"

    @staticmethod
    def choose(weights, bias, u):
        if bias == 2.0:
            return len(weights)
        if bias == 3.0:
            return -1
        if bias == 4.0:
            weights[10**6] = 1.0
        if bias == 5.0:
            return int(third(weights))
        if bias == 6.0:
            return int(np.inf)
        if bias == 7.0:
            return 1 // (len(weights) - 2)
        if bias == 8.0:
            weights[:] = np.nan
        return 1

    @staticmethod
    def probabilities(weights, bias):
        return np.array([0.0, 1.0])


class Half(DecisionMaker):
    name = "Half"

    @staticmethod
    def choose(weights, bias, u):
        return 0.5

    @staticmethod
    def probabilities(weights, bias):
        return np.array([0.5, 0.5])


class Herd(Agent):
    eaten: int = 0


def eat(one):
    one.eaten += 1


def rest(one):
    one.eaten += 0


def act(one, model, rng):
    one.plan = one.mind.choose_next_plan()
    one.run_plan(model, rng)


HUNGER = Cogniton("Hunger", start_value=2, influence={"rest": 1}, conditional=("rest", "eat"))


class Deciding(Model):
    """A herd whose decision maker comes from outside."""

    herd = Population(
        Herd, size=3, mind=CognitiveScheme("herd", (HUNGER,)), plans={"eat": eat, "rest": rest}
    )
    schedule = (each(herd, act),)


def run(maker, compiled):
    scheme = CognitiveScheme("herd", (HUNGER,), decision_maker=maker)
    model = Deciding(seed=1, compiled=compiled, scheme=scheme)
    model.advance(2)
    return model


@pytest.mark.parametrize(
    ("fault", "said"),
    [
        (2, r"Faulty\.choose\(\) returned 2; expected a position, a whole number in 0 … 1"),
        (3, r"Faulty\.choose\(\) returned -1"),
        (4, "IndexError"),
        (5, "IndexError"),
        (6, "OverflowError"),
        (7, "ZeroDivisionError"),
    ],
)
def test_a_fault_is_said_alike_at_both_speeds(fault, said):
    with pytest.raises(RuleError, match=said) as compiled:
        run(Faulty(fault), compiled=True)
    with pytest.raises(RuleError) as interpreted:
        run(Faulty(fault), compiled=False)
    assert str(compiled.value) == str(interpreted.value)
    assert "test_own_makers.py:" in str(compiled.value)
    assert str(compiled.value).endswith("; in tick 0, agent 2 of 'herd'")


@pytest.mark.parametrize("fault", [1, 8])
def test_what_a_maker_writes_into_the_weights_is_its_own(fault):
    compiled, interpreted = run(Faulty(fault), True), run(Faulty(fault), False)
    assert [one.eaten for one in compiled.herd] == [2, 2, 2]
    assert [one.eaten for one in interpreted.herd] == [2, 2, 2]
    for name, array in interpreted.tables["herd"].society.state().items():
        assert np.array_equal(array, compiled.tables["herd"].society.state()[name], equal_nan=True)


def test_a_maker_that_returns_no_whole_number_is_refused_alike():
    with pytest.raises(RuleError, match=r"Half\.choose\(\) returned 0\.5") as compiled:
        run(Half(), True)
    with pytest.raises(RuleError) as interpreted:
        run(Half(), False)
    assert str(compiled.value) == str(interpreted.value)


class Texts(Half):
    name = "Texts"

    @staticmethod
    def choose(weights, bias, u):
        return open("/nowhere").fileno()  # noqa: PTH123


def test_what_cannot_be_compiled_is_one_line_with_its_place():
    with pytest.raises(SchemeError, match=r"test_own_makers\.py:\d+: found Texts\.choose\(\)") as e:
        run(Texts(), True)
    assert "run interpreted" in str(e.value)
    assert "\n" not in str(e.value)
