"""The drive module (thesis, 5.1.3 and A.5.4): between variables and skills, in both evaluators."""

import math
import random

import numpy as np
import pytest
from independent import Alone, Society
from random_minds import bits, sensor_values
from small_minds import constant, mind, wired

from socialmind.errors import ModelError
from socialmind.mind import Counter, Hierarchy, MindDescription, Minds, Skill, Variable, Wave
from socialmind.mind.functions.perceptron import Perceptron
from socialmind.mind.functions.recurrent import Recurrent


def everything(mind):
    level = mind.sensor("S1")
    if level > 0.3:
        mind.set_variable("V", level)
    if mind.variable("W") > 0.5:
        mind.command_variable("W", 0.1, 2.0)
        mind.command_variable("Count", 0.9, 1.0)
    mind.add_influence("Outside", 0.5 * mind.sensor("S2"))
    mind.add_influence("Master", 0.25)
    mind.command("M", 1.0 - level, 0.75)


ROOTS = ["Master", "Outside"]


def driven_mind(seed):
    """A master, and a skill outside its hierarchy; both reach the same motors and variables."""
    draw = random.Random(seed)

    def skill(name, inputs, outputs, function):
        made = Skill(name, inputs, outputs, function)
        genome = [draw.uniform(-0.5, 0.7) for _ in range(made.genome_size)]
        return made.changed(genome=genome)

    shown = ["VA:V", "VD:V", "VH:V:1", "VH:V:3", "SE:S1", "SD:S2"]
    skills = [
        skill("Master", shown, ["SK:Shared", "MO:M", "VA:V"], Perceptron(hidden="sigmoid")),
        skill("Outside", ["VA:Wave", "SE:S2"], ["SK:Shared", "MO:N", "VA:W"], Perceptron()),
        skill("Shared", ["VA:Count", "VA:W"], ["MO:N", "VA:W", "VA:Wave"], Recurrent(layers=1)),
    ]
    variables = [Variable("V"), Variable("W"), Variable("Count", Counter(3)),
                 Variable("Wave", Wave())]  # fmt: skip
    return MindDescription("driven", ["S1", "S2"], ["M", "N"], variables, skills)


@pytest.mark.parametrize("seed", range(20))
def test_a_drive_does_what_it_does_in_plain_python(seed):
    description = driven_mind(seed)
    alone = Alone(description, *ROOTS, drive=everything)
    hierarchy = Hierarchy(description, "Master", drive=everything)
    for values in sensor_values(description, random.Random(seed), 30):
        assert hierarchy.evaluate(values) == pytest.approx(alone.step(values), abs=1e-9)
        assert hierarchy.variables() == pytest.approx(alone.agent.values(), abs=1e-9)
        for name, influence in alone.agent.influences.items():
            assert hierarchy.influences()[name] == pytest.approx(influence, abs=1e-9)


@pytest.mark.parametrize("seed", range(20, 30))
def test_a_drive_acts_for_each_of_many(seed):
    description = driven_mind(seed)
    many = Minds(description, "Master", 5, drive=everything)
    single = [Hierarchy(description, "Master", drive=everything) for _ in range(5)]
    society = Society(description, ROOTS, 5, drive=everything)
    draw = random.Random(seed)
    for values in zip(*(list(sensor_values(description, draw, 30)) for _ in range(5)), strict=True):
        motors = many.evaluate({name: [one[name] for one in values] for name in ("S1", "S2")})
        expected = society.evaluate(values)
        for number, hierarchy in enumerate(single):
            found = {name: motors[name][number] for name in motors}
            assert found == pytest.approx(expected[number], abs=1e-9)
            assert bits(found) == bits(hierarchy.evaluate(values[number]))


def go_to_target(mind):
    mind.set_variable("VAR_TARGET", mind.sensor("RADOBJA"))
    mind.set_variable("VAR_TARGETDIST", mind.sensor("DISTOBJA"))


def test_the_thesis_s_own_drive():
    """A.5.4: the drive sets the variables that no skill sets while GoToTarget is the master."""
    skill = wired("GoToTarget", {"MO:turn": "VA:VAR_TARGET", "MO:speed": "VA:VAR_TARGETDIST"})
    description = MindDescription(
        "A.5.4", ["RADOBJA", "DISTOBJA"], ["turn", "speed"], ["VAR_TARGET", "VAR_TARGETDIST"],
        [skill],
    )  # fmt: skip
    hierarchy = Hierarchy(description, drive=go_to_target)
    assert hierarchy.evaluate({"RADOBJA": 0.3, "DISTOBJA": 0.9}) == {"turn": 0.3, "speed": 0.9}
    assert hierarchy.evaluate({"RADOBJA": 0.4, "DISTOBJA": 0.8}) == {"turn": 0.4, "speed": 0.8}


def concurrent(mind):
    mind.command("M", 1.0, 3.0)
    mind.add_influence("Outside", 0.5)


def test_commands_and_influences_of_a_drive_by_hand():
    skills = [constant("Master", {"MO:M": 0.0}), constant("Outside", {"MO:M": 0.4, "MO:N": 0.9})]
    hierarchy = Hierarchy(mind(skills), "Master", drive=concurrent)
    # M: (1.0 · 0.0 + 0.5 · 0.4 + 3.0 · 1.0) / (1.0 + 0.5 + 3.0)
    expected = {"M": 3.2 / 4.5, "N": 0.9}
    assert hierarchy.evaluate({}) == pytest.approx(expected)
    assert hierarchy.evaluate({}) == pytest.approx(expected)  # nothing adds up from tick to tick
    assert hierarchy.influences()["Outside"] == 0.5
    many = Minds(mind(skills), "Master", 3, drive=concurrent)
    many.evaluate({})
    assert many.evaluate({})["M"] == pytest.approx(np.full(3, 3.2 / 4.5))


def repeating(mind):
    for value, weight in ((1.0, 3.0), (0.25, 1.0)):
        mind.command("M", value, weight)
        mind.command_variable("V", value, weight)
    mind.add_influence("Middle", 0.25)
    mind.add_influence("Middle", 0.5)


def test_what_a_drive_says_twice_adds_up_and_the_master_need_not_be_first():
    skills = [
        constant("Above", {"SK:Middle": 1.0, "MO:M": 1.0}),
        constant("Middle", {"MO:N": 0.75, "MO:M": 0.5}),
    ]
    hierarchy = Hierarchy(mind(skills, ["V"]), "Middle", drive=repeating)
    # M: (1.75 · 0.5 + 3.0 · 1.0 + 1.0 · 0.25) / (1.75 + 3.0 + 1.0); nothing reaches Above.
    for heard in (0.0, 3.25 / 4.0):
        assert hierarchy.evaluate({}) == pytest.approx({"M": 4.125 / 5.75, "N": 0.75})
        assert hierarchy.influences() == {"Above": 0.0, "Middle": 1.75}
        assert hierarchy.variables() == {"V": heard}


def jumping(mind):
    if mind.sensor("S") > 0.5:
        mind.set_variable("V", 1.0)


def test_what_a_drive_sets_stays_until_a_skill_commands():
    skills = [
        wired("Master", {"SK:Write": "SE:on", "MO:value": "VA:V", "MO:change": "VD:V"}),
        constant("Write", {"VA:V": 0.25}),
    ]
    description = MindDescription("set", ["S", "on"], ["value", "change"], ["V"], skills)
    hierarchy = Hierarchy(description, "Master", drive=jumping)

    def step(jump, on):
        return tuple(hierarchy.evaluate({"S": jump, "on": on}).values())

    assert step(0.0, 0.0) == (0.0, 0.5)
    assert step(1.0, 0.0) == (1.0, 1.0)  # the skills see it at once, and how it changed
    assert step(0.0, 1.0) == (1.0, 0.5)
    assert step(0.0, 0.0) == (0.25, 0.125)


def discouraging(mind):
    mind.add_influence("Outside", -0.5)


def undefined(mind):
    mind.add_influence("Outside", math.inf - math.inf)


def overshooting(mind):
    mind.set_variable("V", 2.0)


def excessive(mind):
    mind.command("M", 3.0, 1.0)


def withdrawing(mind):
    mind.command("M", 0.5, -2.0)


def misspelt(mind):
    mind.add_influence("Outsside", 1.0)


@pytest.mark.parametrize(
    ("drive", "word"),
    [
        (discouraging, "influence"),
        (undefined, "influence"),
        (overshooting, "variable"),
        (excessive, "command"),
        (withdrawing, "weight"),
        (misspelt, "Outsside"),
    ],
)
def test_what_a_drive_may_not_do(drive, word):
    skills = [wired("Master", {"MO:M": "VA:V"}), constant("Outside", {"MO:M": 0.5})]
    for made, named in ((Hierarchy, word), (Minds, drive.__name__)):
        with pytest.raises(ModelError) as raised:
            made(mind(skills, ["V"]), "Master", drive=drive).evaluate({})
        assert "\n" not in str(raised.value)
        assert named in str(raised.value) or word in str(raised.value)
