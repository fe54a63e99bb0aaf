"""Interactions: weights by hand, outcomes at both speeds, files, and what is refused."""

from types import SimpleNamespace

import numpy as np
import pytest

from coglogo_py import BiasedWeightedStochastic, MaximumWeight
from coglogo_py.decision import DecisionMaker
from socialmind import (
    Agent,
    Interaction,
    Model,
    ModelError,
    Patch,
    Population,
    RuleError,
    Torus,
    each,
)

FILE = """\
name: theft
decision_maker: {name: BiasedWeightedStochastic, bias: 1.5}
outcomes: [caught, gone, nothing]
base: {nothing: 2}
instigator:
  skill: {gone: 1, caught: -0.5}
  bold: {nothing: -1}
recipient:
  sight: {caught: 2}
location:
  light: {caught: 0.5, gone: -0.25}
"""
LINKS = {
    "instigator": {"skill": {"gone": 1, "caught": -0.5}, "bold": {"nothing": -1}},
    "recipient": {"sight": {"caught": 2}},
    "location": {"light": {"caught": 0.5, "gone": -0.25}},
}
OUTCOMES = ("caught", "gone", "nothing")
BASE = {"nothing": 2}
THEFT = Interaction(
    "theft", OUTCOMES, **LINKS, base=BASE, decision_maker=BiasedWeightedStochastic(1.5)
)
DUEL = Interaction(
    "duel",
    ("won", "lost"),
    {"skill": {"won": 1.0}},
    {"skill": {"lost": 1.0}},
    decision_maker=MaximumWeight(),
)


class Human(Agent):
    skill: float = 0.0
    sight: float = 1.0
    bold: bool = False
    gone: int = 0
    caught: int = 0
    log: int = 0
    won: int = 0
    lamps: list[int] = [0] * 2


class Lamp(Agent):
    light: int = 3


class Land(Patch):
    light: float = 0.0


def begin(human, rng):
    human.skill = rng.uniform(0, 5)
    human.sight = rng.uniform(0, 3)
    human.bold = rng.random() < 0.5


def live(human, model, rng):
    other = model.humans.one_of(rng)
    here = model.world.patch(human.x, human.y)
    here.light = rng.random()
    came = model.theft.outcome(human, other, here, rng)
    if came == "gone":
        human.gone += 1
    elif came == "caught":
        human.caught += 1
    if model.theft.outcome(human, other, model.lamps[0], rng) != "nothing":
        human.log += 1
    if model.duel.outcome(human, other, rng) == "won":
        human.won += 1
    human.log = human.log * 3 + rng.integers(3)
    human.log %= 100003


class Street(Model):
    world = Torus(5, Land)
    humans = Population(Human, 30)
    lamps = Population(Lamp, 1)
    theft = THEFT
    duel = DUEL
    setup = (each(humans, begin),)
    schedule = (each(humans, live),)


def test_links_weigh_outcomes_as_cognitons_weigh_plans():
    thief = SimpleNamespace(skill=4.0, bold=True)
    victim, place = SimpleNamespace(sight=1.5), SimpleNamespace(light=2.0)
    weights = THEFT.weights(thief, victim, place)
    # caught: −0.5 · 4 + 2 · 1.5 + 0.5 · 2; gone: 4 − 0.25 · 2; nothing: 2 − 1.
    assert weights == {"caught": 2.0, "gone": 3.5, "nothing": 1.0}
    maker = BiasedWeightedStochastic(1.5)
    expected = maker.probabilities(np.array([2.0, 3.5, 1.0]), 1.5).tolist()
    assert THEFT.probabilities(thief, victim, place) == dict(zip(OUTCOMES, expected, strict=True))


def test_both_speeds_draw_the_same():
    fast, slow = Street(seed=1), Street(seed=1, compiled=False)
    for model in (fast, slow):
        model.advance(60)
    for column in fast.humans.dtype.names:
        found = [one.humans.columns[column] for one in (fast, slow)]
        np.testing.assert_array_equal(*found, err_msg=column)
    assert fast.humans.gone.sum() > 100
    assert fast.humans.caught.sum() > 100
    # Who is equally skilled (oneself) wins: the first of equal weights.
    best = int(np.argmax(fast.humans.skill))
    assert fast.humans.won[best] == 60


def test_outcomes_come_as_often_as_they_are_probable():
    street = Street(seed=2, compiled=False)
    thief, victim, lamp = street.humans[0], street.humans[1], street.lamps[0]
    draws = np.linspace(0, 1, 2000, endpoint=False)
    found = [
        THEFT.outcome(thief, victim, lamp, SimpleNamespace(random=lambda u=u: u)) for u in draws
    ]
    for outcome, chance in THEFT.probabilities(thief, victim, lamp).items():
        assert found.count(outcome) / 2000 == pytest.approx(chance, abs=1.5e-3)


def test_a_file_says_the_same(tmp_path):
    file = tmp_path / "theft.yaml"
    file.write_text(FILE)
    assert Interaction.load(file) == THEFT


@pytest.mark.parametrize(
    ("line", "instead", "found"),
    [
        ("name: theft\n", "", "theft.yaml:1: found an interaction without name; exp"),
        ("bias: 1.5", "bias: -1", "theft.yaml:2: .*bias"),
        ("BiasedWeightedStochastic", "Biased", "theft.yaml:2: found decision maker 'Biased'"),
        ("caught, gone", "caught, caught", "theft.yaml:3: 'caught' stands twice in outcomes"),
        ("gone: 1,", "gnoe: 1,", "theft.yaml:6: found field 'gnoe' in 'skill' of the instigator"),
        ("sight: {caught: 2}", "sight: {caught: two}", "theft.yaml:9: found 'two' as 'sight' of"),
        ("location:", "place:", "theft.yaml:10: found field 'place' in the interaction; .*locati"),
    ],
)
def test_a_wrong_file_names_its_line(line, instead, found, tmp_path):
    file = tmp_path / "theft.yaml"
    file.write_text(FILE.replace(line, instead))
    with pytest.raises(ModelError, match=found):
        Interaction.load(file)


class First(DecisionMaker):
    name = "First"

    @staticmethod
    def choose(weights, bias, u):
        return 0

    @staticmethod
    def probabilities(weights, bias):
        return np.eye(len(weights))[0]


@pytest.mark.parametrize(
    ("make", "found"),
    [
        (lambda: Interaction("a", ()), r"the outcomes \(\) of the interaction 'a'; expected"),
        (lambda: Interaction("a", ("b", "b")), r"the outcomes \('b', 'b'\)"),
        (
            lambda: Interaction("a", ("b",), {"c": {"d": 1}}),
            "the outcome 'd' in the ability 'c' ",
        ),
        (lambda: Interaction("a", ("b",), {"c": {"b": "x"}}), "'x' as the weight of 'b' in the ab"),
        (lambda: Interaction("a", ("b",), {"c": 3}), "3 as the ability 'c' of the instigator of"),
        (lambda: Interaction("a", ("b",), 3), "instigator=3 of the interaction 'a'; expected link"),
        (lambda: Interaction("a", ("b",), decision_maker=First()), "First.* as decision maker of"),
    ],
)
def test_a_wrong_interaction_is_refused_where_it_is_written(make, found):
    with pytest.raises(ModelError, match=rf"test_interaction.py:\d+: (found )?{found}"):
        make()


def no_place(human, model, rng):
    if model.theft.outcome(human, human, rng) == "gone":
        human.gone += 1


def no_ability(human, model, rng):
    if model.theft.outcome(human, model.lamps[0], model.lamps[0], rng) == "gone":
        human.gone += 1


def no_outcome(human, model, rng):
    if model.duel.outcome(human, human, rng) == "drawn":
        human.gone += 1


def no_call(human, model, rng):
    if model.duel.result(human, human, rng) == "won":
        human.gone += 1


@pytest.mark.parametrize(
    ("rule", "found"),
    [
        (
            no_place,
            "outcome.. of the interaction 'theft' like this; write model.theft.outcome",
        ),
        (no_ability, "an agent of 'lamps' as the recipient with the ability 'sight', which it doe"),
        (no_outcome, "the text 'drawn', which is none of the choices"),
        (no_call, "result.. of the interaction 'duel'; write model.duel.outcome.instigator, recip"),
    ],
)
def test_rules_that_use_it_otherwise_are_refused(rule, found):
    kind = type("Wrong", (Street,), {"schedule": (each(Street.humans, rule),)})
    with pytest.raises(ModelError, match=rf"test_interaction.py:\d+: (found )?{found}"):
        kind(compiled=False)


def boast(human):
    human.skill = 1e308


def duel_twice(human, model, rng):
    if model.feud.outcome(human, human, rng) == "won":
        human.won += 1


FEUD = Interaction("feud", ("won", "lost"), {"skill": {"won": 10.0}})


class Feud(Model):
    humans = Population(Human, 2)
    feud = FEUD
    setup = (each(humans, boast),)
    schedule = (each(humans, duel_twice),)


@pytest.mark.parametrize("compiled", [True, False])
def test_a_weight_beyond_all_numbers_is_an_error_of_the_rule(compiled):
    with pytest.raises(RuleError, match=r"test_interaction.py:\d+: ValueError: an outcome"):
        Feud(compiled=compiled).advance(1)
