"""Thresholds of fields make cognitons active and inactive, alike at both speeds."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from coglogo_py import CognitiveScheme, Cogniton, Culturon, Group, Role
from socialmind import Agent, Civilisation, Model, ModelError, Population, Torus, each, parameter
from socialmind.observation import mind_columns

STEPS = 12
HUNGER = Cogniton(
    "Hunger", starting=False, start_value=2, influence={"eat": 3}, conditional=("eat",),
    reinforcement={"eat": 0.5}, activated_when="energy < 5", deactivated_when="energy > full",
)  # fmt: skip
COLD = Cogniton(
    "Cold", start_value=1, influence={"warm": 4}, conditional=("warm",),
    active_while=["warmth <= 0", "dressed == 0"],
)  # fmt: skip
EASE = Cogniton("Ease", start_value=1, influence={"rest": 5}, conditional=("rest",))
AGED = Cogniton("Aged", start_value=7, influence={"rest": 1}, active_while="age >= old")
SCHEME = CognitiveScheme("humans", (HUNGER, COLD, EASE, AGED))


class Human(Agent):
    energy: float = 6.0
    warmth: float = 1.0
    dressed: bool = False
    age: int | None = None
    told: list[float] = [0.0] * STEPS  # a field
    asked: list[int] = [0] * STEPS
    written: list[float] = [0.0] * STEPS


def follow(human, model):
    """Write fields and ask the mind, as the model's script says."""
    for step in range(12):
        value = human.written[step]
        what = human.asked[step]
        if what == 0:
            human.energy = value
        elif what == 1:
            human.warmth = value
        elif what == 2:
            human.dressed = value > 0.0
        elif what == 3:
            human.age = int(value)
        elif what == 4:
            human.age = None
        elif what == 5:
            human.told[step] = human.mind.get_cogniton_value("Hunger")
        elif what == 6:
            human.told[step] = 1.0 if human.mind.is_active("Cold") else 0.0
        elif what == 7:
            human.mind.set_cogniton_value("Hunger", value)
        elif what == 8:
            human.mind.deactivate_cogniton("Cold")
        elif what == 9:
            human.mind.activate_cogniton("Aged")
        elif what == 10:
            human.plan = human.mind.choose_next_plan()
            human.told[step] = 10.0
            if human.plan == "eat":
                human.told[step] = 11.0
            if human.plan == "warm":
                human.told[step] = 12.0
        elif what == 11:
            if human.reconsider_plan(1.5):
                human.told[step] = 1.0
        elif what == 12:
            human.mind.feed_back_from_plan("eat", 1.0)
        elif what == 13:
            human.told[step] = human.mind.get_cogniton_value("Aged")


class Scripted(Model):
    full: float = parameter(8.0)
    old: int = parameter(3)
    humans = Population(Human, 40, mind=SCHEME)
    schedule = (each(humans, follow),)


class Account:
    """A mind as plain Python has it."""

    def __init__(self, fields, full, old):
        self.fields, self.full, self.old = fields, full, old
        self.values = {"Hunger": None, "Cold": 1.0, "Ease": 1.0, "Aged": 7.0}
        self.plan = None
        self.heed()

    def heed(self):
        values, f = self.values, self.fields
        if f["energy"] > self.full:
            values["Hunger"] = None
        elif f["energy"] < 5 and values["Hunger"] is None:
            values["Hunger"] = 2.0
        for name, start, holds in (
            ("Cold", 1.0, f["warmth"] <= 0 and not f["dressed"]),
            ("Aged", 7.0, f["age"] is not None and f["age"] >= self.old),
        ):
            if not holds:
                values[name] = None
            elif values[name] is None:
                values[name] = start

    def weights(self):
        values, found = self.values, {}
        if values["Hunger"] is not None:
            found["eat"] = 3 * values["Hunger"]
        if values["Cold"] is not None:
            found["warm"] = 4 * values["Cold"]
        found["rest"] = 5 * values["Ease"] + (values["Aged"] or 0.0)
        return found

    def choose(self):
        weights = self.weights()
        self.plan = max(weights, key=weights.get)
        return self.plan

    def step(self, what, value):
        fields = self.fields
        if what in (0, 1):
            fields[("energy", "warmth")[what]] = value
        elif what == 2:
            fields["dressed"] = value > 0
        elif what in (3, 4):
            fields["age"] = int(value) if what == 3 else None
        else:
            self.heed()
            values = self.values
            if what == 5:
                return values["Hunger"] or 0.0
            if what == 6:
                return float(values["Cold"] is not None)
            if what == 7 and values["Hunger"] is not None:
                values["Hunger"] = value
            if what == 8:
                values["Cold"] = None
            if what == 9 and values["Aged"] is None:
                values["Aged"] = 0.0
            if what == 10:
                return {"eat": 11.0, "warm": 12.0, "rest": 10.0}[self.choose()]
            if what == 11:
                return self.reconsider()
            if what == 12 and values["Hunger"] is not None:
                values["Hunger"] += 0.5
            if what == 13:
                return values["Aged"] or 0.0
        return 0.0

    def reconsider(self):
        before, weights = self.plan, self.weights()
        if before is not None and before in weights:
            goes_on = weights[before]
            if not any(w > goes_on and w > 1.5 * goes_on for w in weights.values()):
                return 0.0
        return float(self.choose() != before)


script = st.lists(
    st.tuples(st.integers(0, 13), st.sampled_from([-1.0, 0.0, 1.0, 3.0, 4.5, 5.0, 8.0, 9.0])),
    min_size=STEPS,
    max_size=STEPS,
)


@settings(max_examples=12)
@given(st.lists(script, min_size=3, max_size=3), st.lists(st.floats(2, 10), min_size=2, max_size=2))
def test_both_speeds_agree_with_a_plain_account(scripts, bounds):
    full, old = bounds[0], int(bounds[1])
    societies = [Scripted(full=full, old=old, compiled=one) for one in (True, False)]
    begins = {"energy": 6.0, "warmth": 1.0, "dressed": False, "age": None}
    account = Account(begins, full, old)
    for steps in scripts:
        expected = [account.step(*one) for one in steps]
        account.heed()
        for society in societies:
            humans = society.humans
            humans.told = [0.0] * STEPS
            humans.asked = [what for what, _ in steps]
            humans.written = [value for _, value in steps]
            society.advance(1)
            assert humans.told[7].tolist() == expected
            assert humans[7].mind.cognitons() == account.values
            assert society.humans.cogniton("Hunger")[7] == account.values["Hunger"] or math.isnan(
                society.humans.cogniton("Hunger")[7]
            )


def test_they_hold_at_birth_and_between_ticks_for_who_looks():
    society = Scripted(old=2)
    human = society.humans[0]
    assert human.mind.cognitons() == {"Hunger": None, "Cold": None, "Ease": 1, "Aged": None}
    society.humans.age = 2
    society.humans.warmth = -1.0
    human.energy = 4.0
    assert human.mind.plan_weights() == {"eat": 6, "warm": 4, "rest": 12}
    assert np.isnan(society.humans.cogniton("Hunger")).sum() == 39
    columns = mind_columns(society.humans)
    assert columns["cogniton_Cold"].tolist() == [1.0] * 40
    assert columns["weight_rest"].tolist() == [12.0] * 40
    human.energy = 6.0  # between the thresholds it stays
    assert human.mind.is_active("Hunger")
    human.energy = 8.5
    assert not human.mind.is_active("Hunger")


def test_looking_changes_no_run():
    looked, alone = (Scripted(seed=3) for _ in range(2))
    for society in (looked, alone):
        society.humans.asked = [k % 14 for k in range(STEPS)]
        society.humans.written = [float(k - 4) for k in range(STEPS)]
    for _ in range(4):
        looked.advance(1)
        mind_columns(looked.humans)
        looked.humans[3].mind.explain()
    alone.advance(4)
    for name, array in alone.state().items():
        np.testing.assert_array_equal(array, looked.state()[name], err_msg=name)


def eat_up(human):
    human.energy = 9.0 - human.energy  # 3 in the first tick, 6 in the second
    human.plan = human.mind.choose_next_plan()


class Meals(Scripted):
    schedule = (each(Scripted.humans, eat_up),)


@pytest.mark.parametrize("compiled", [True, False])
def test_receipts_and_later_explanations_show_what_was_heeded(compiled):
    society = Meals(compiled=compiled)
    assert society.humans[5].mind.explain().influences[0].value is None
    society.advance(2)
    for tick in (1, 2):
        receipt = society.explain(5, tick)
        assert receipt.choice == "eat" and receipt.influences[0].value == 2.0
    assert society.humans[5].mind.explain().choice == "eat"


def test_founders_of_civilisations_begin_with_what_their_conditions_leave_them():
    people = tuple(
        Civilisation(name, 2, cognitons={"Hunger": 6.0, "Cold": 3.0}, values={"energy": energy})
        for name, energy in (("fed", 9.0), ("content", 6.0), ("hungry", 4.0))
    )

    class Peoples(Scripted):
        world = Torus(5)
        humans = Population(Human, mind=SCHEME, civilisations=people)
        schedule = ()

    society = Peoples(compiled=False)
    found = society.humans.cogniton("Hunger")
    assert np.isnan(found[:2]).all() and found[2:].tolist() == [6.0] * 4
    assert np.isnan(society.humans.cogniton("Cold")).all()


# Births, cultures, resumed runs -------------------------------------------------------------


def be_born(beast):
    beast.energy = 3.0


def breed(beast, model, rng):
    beast.energy = beast.energy - 1.0 if rng.random() < 0.7 else 9.0
    if rng.random() < 0.2 and len(model.beasts) < 60:
        child = beast.hatch()
        child.energy = 7.0
        if child.mind.is_active("Hunger"):
            model.hungry_children = model.hungry_children + 1
    if rng.random() < 0.1:
        new = model.beasts.create()
        new.energy = 1.0
    if rng.random() < 0.15:
        beast.die()
    else:
        beast.plan = beast.mind.choose_next_plan()


class Beast(Agent):
    energy: float = 6.0


HERD = Group("herd", (Role("member", (Culturon("Norm", 1, influence={"eat": 1}),)),))
WILD = CognitiveScheme("wild", (HUNGER, EASE), (HERD,))
TAME = CognitiveScheme("tame", (EASE, HUNGER, AGED, COLD), (HERD,))


def join(beast):
    beast.mind.create_and_join_group("herd", "member")


class Herds(Model):
    full: float = parameter(8.0)
    old: int = parameter(3)
    hungry_children: int = 0
    beasts = Population(Beast, 30, mind=WILD, culture="herds", at_birth=be_born)
    humans = Population(Human, 5, mind=TAME, culture="herds")
    setup = (each(beasts, join),)
    schedule = (each(beasts, breed), each(humans, follow))


def test_births_and_cultures_run_alike_and_resume(tmp_path):
    fast, slow = Herds(seed=2), Herds(seed=2, compiled=False)
    assert set(fast.humans.cogniton("Ease")) == {1.0}
    # The rule at birth comes before the end of the setup.
    assert fast.beasts.cogniton("Hunger").tolist() == [2.0] * 30
    half = None
    for tick in range(30):
        fast.advance(1)
        slow.advance(1)
        if tick == 10:
            half = fast.state()
    assert fast.hungry_children > 0
    again = Herds(seed=2)
    again.restore(half)
    again.advance(19)
    for name, array in fast.state().items():
        if name.endswith(("rows", "values", "draws", "context")):
            for other in (slow, again):
                found = other.state()[name]
                if name.endswith("context"):
                    assert found["hungry_children"] == array["hungry_children"]
                else:
                    size = min(len(found), len(array))
                    np.testing.assert_array_equal(found[:size], array[:size], err_msg=name)


def test_a_scheme_with_conditions_in_place_of_one_without():
    """The class's program serves both: what is compiled for one is not taken for the other."""

    class Plain(Scripted):
        humans = Population(
            Human,
            2,
            mind=CognitiveScheme(
                "plain",
                (
                    EASE,
                    *(
                        Cogniton(one.name, starting=False, conditional=one.conditional)
                        for one in (HUNGER, COLD, AGED)
                    ),
                ),
            ),
        )
        schedule = (each(humans, follow),)

    for compiled in (True, False):
        for scheme, active in ((None, False), (SCHEME, True), (None, False)):
            society = Plain(scheme=scheme, compiled=compiled)
            society.humans.energy = 2.0
            society.advance(1)
            assert society.humans[0].mind.is_active("Hunger") is active


# What is refused ----------------------------------------------------------------------------


def model_with(mind):
    class Wrong(Model):
        full: float = parameter(8.0)
        mood: str = parameter("calm", choices=("calm", "wild"))
        humans = Population(Human, 2, mind=mind)

    return Wrong


@pytest.mark.parametrize(
    ("condition", "message"),
    [
        (
            "enrgy < 5",
            "found 'enrgy' in the condition 'enrgy < 5' of cogniton 'Hunger'; expected a",
        ),
        ("enrgy < 5", "expected a field of the agents of 'humans' that is a number or a truth"),
        ("enrgy < 5", "did you mean 'energy'?"),
        ("told < 5", "found 'told' in"),
        ("energy < ful", "found 'ful' in the condition"),
        ("energy < ful", "a parameter of the model that is a number or a truth value; did you"),
        ("energy < mood", "found 'mood' in"),
        ("energy < warmth", "found 'warmth' in the condition 'energy < warmth'"),
    ],
)
def test_fields_and_parameters_must_be_there(tmp_path, condition, message):
    file = tmp_path / "humans.yaml"
    file.write_text(f"name: a\ncognitons:\n  Hunger:\n    active_while: {condition}\n")
    with pytest.raises(ModelError) as error:
        model_with(file)()
    assert str(error.value).startswith(f"{file}:4: found ")
    assert message in str(error.value) and "\n" not in str(error.value)
    scheme = CognitiveScheme("a", (Cogniton("Hunger", active_while=condition),))
    with pytest.raises(ModelError) as error:
        model_with(scheme)()
    line = model_with.__code__.co_firstlineno + 4
    assert str(error.value).startswith(f"{__file__}:{line}: found") and message in str(error.value)
