"""What an evaluation refuses: one clear line each."""

import math

import numpy as np
import pytest
from small_minds import constant, mind, wired

from socialmind.errors import ModelError
from socialmind.mind import Hierarchy, MindDescription, Minds, Programmed, Skill, Variable
from socialmind.mind.functions.perceptron import Perceptron
from socialmind.mind.regulation import Regulated

WRONG = [-0.1, 1.1, math.nan, math.inf, -math.inf]


@pytest.fixture
def vehicle():
    skill = wired("Seek", {"MO:MotL": "SE:EyeR", "MO:MotR": "SE:EyeL"})
    return MindDescription("vehicle", ["EyeL", "EyeR", "Bumper"], ["MotL", "MotR"], (), [skill])


def one_line(raised, *words):
    message = str(raised.value)
    assert "\n" not in message
    for word in words:
        assert word in message
    return message


def test_a_missing_sensor(vehicle):
    with pytest.raises(ModelError) as raised:
        Hierarchy(vehicle).evaluate({"EyeL": 0.5})
    one_line(raised, "EyeR")
    with pytest.raises(ModelError) as raised:
        Minds(vehicle, agents=2).evaluate({"EyeL": 0.5})
    one_line(raised, "EyeR")


def test_a_sensor_that_no_skill_reads_may_be_missing_or_given(vehicle):
    hierarchy = Hierarchy(vehicle)
    assert hierarchy.evaluate({"EyeL": 0.25, "EyeR": 0.5}) == {"MotL": 0.5, "MotR": 0.25}
    motors = hierarchy.evaluate({"EyeL": 0.25, "EyeR": 0.5, "Bumper": 1.0})
    assert motors == {"MotL": 0.5, "MotR": 0.25}


def test_an_unknown_sensor(vehicle):
    with pytest.raises(ModelError) as raised:
        Hierarchy(vehicle).evaluate({"EyeL": 0.5, "EyeR": 0.5, "EyeRR": 0.5})
    one_line(raised, "EyeRR", "EyeR")
    with pytest.raises(ModelError) as raised:
        Minds(vehicle, agents=2).evaluate({"EyeL": 0.5, "EyeR": 0.5, "Nose": 0.5})
    one_line(raised, "Nose")


@pytest.mark.parametrize("value", WRONG)
@pytest.mark.parametrize("name", ["EyeL", "Bumper"])
def test_a_sensor_outside_its_range(vehicle, name, value):
    good = {"EyeL": 0.5, "EyeR": 0.5, "Bumper": 0.5}
    hierarchy = Hierarchy(vehicle)
    with pytest.raises(ModelError) as raised:
        hierarchy.evaluate(good | {name: value})
    one_line(raised, name, f"{value}")
    assert hierarchy.evaluate(good) == {"MotL": 0.5, "MotR": 0.5}  # and it goes on
    many = Minds(vehicle, agents=3)
    with pytest.raises(ModelError) as raised:
        many.evaluate(good | {name: np.array([0.5, value, 0.5])})
    one_line(raised, name, f"{value}", "agent 1")
    assert many.evaluate(good)["MotL"].tolist() == [0.5] * 3


@pytest.mark.parametrize("value", ["0.5", None, [0.5], {}, "much"])
def test_a_sensor_that_is_no_number(vehicle, value):
    with pytest.raises(ModelError) as raised:
        Hierarchy(vehicle).evaluate({"EyeL": value, "EyeR": 0.5})
    one_line(raised, "EyeL")


@pytest.mark.parametrize("value", ["much", None, {}, np.zeros(2), np.zeros((3, 1))])
def test_a_sensor_of_many_that_is_no_array_of_numbers(vehicle, value):
    with pytest.raises(ModelError) as raised:
        Minds(vehicle, agents=3).evaluate({"EyeL": value, "EyeR": 0.5})
    one_line(raised, "EyeL")


@pytest.mark.parametrize("value", [0, 1, True, np.float32(0.5), np.float64(1.0), np.int64(1)])
def test_numbers_of_all_kinds_are_taken(vehicle, value):
    assert Hierarchy(vehicle).evaluate({"EyeL": value, "EyeR": 0.0})["MotR"] == float(value)


def test_an_evaluation_that_is_refused_leaves_no_trace():
    shown = wired("Show", {"MO:now": "SE:S", "MO:change": "SD:S", "MO:before": "SH:S:1"})
    description = MindDescription("shown", ["S", "Other"], ["now", "change", "before"], (), [shown])
    hierarchy = Hierarchy(description)
    hierarchy.evaluate({"S": 0.25})
    with pytest.raises(ModelError):
        hierarchy.evaluate({"S": 0.75, "Other": 2.0})
    with pytest.raises(ModelError):
        hierarchy.evaluate({"S": 0.75, "Nobody": 0.0})
    assert hierarchy.tick == 1
    assert hierarchy.sensors()["S"] == 0.25
    assert hierarchy.evaluate({"S": 0.5}) == {"now": 0.5, "change": 0.625, "before": 0.25}


def test_a_genome_that_is_not_set():
    skills = [
        constant("Master", {"SK:Seek": 1.0}),
        Skill("Seek", ["SE:Eye"], ["MO:Mot"], Perceptron()),
    ]
    for made in (Hierarchy(mind(skills)), Minds(mind(skills), agents=2)):
        with pytest.raises(ModelError) as raised:
            made.evaluate({"Eye": 0.5})
        one_line(raised, "Seek")


def test_a_genome_is_checked_when_it_is_set():
    description = mind([Skill("Seek", ["SE:Eye"], ["MO:Mot"], Perceptron(layers=0))])
    hierarchy, many = Hierarchy(description), Minds(description, agents=2, own_genomes=True)
    for wrong in ([1.0], [1.0, 2.0, 3.0], [math.nan, 0.0], [math.inf, 0.0], ["a", "b"]):
        with pytest.raises(ModelError) as raised:
            hierarchy.skill("Seek").genome = wrong
        one_line(raised, "Seek")
        with pytest.raises(ModelError) as raised:
            many.set_genome("Seek", wrong)
        one_line(raised, "Seek")
    with pytest.raises(ModelError) as raised:
        many.set_genome("Seek", [[1.0, 0.0]] * 3)
    one_line(raised, "Seek")
    hierarchy.skill("Seek").genome = [1.0, 0.0]
    assert hierarchy.evaluate({"Eye": 0.25}) == {"Mot": 0.25}
    kept = hierarchy.skill("Seek").genome
    with pytest.raises(ValueError, match="read-only"):
        kept[0] = 2.0


def test_an_unknown_name(vehicle):
    hierarchy, many = Hierarchy(vehicle), Minds(vehicle, agents=1)
    for call in (
        lambda: hierarchy.skill("Seeek"),
        lambda: many.genome("Seeek"),
        lambda: many.influence("Seeek"),
        lambda: Hierarchy(vehicle, "Seeek"),
        lambda: Minds(vehicle, "Seeek"),
    ):
        with pytest.raises(ModelError) as raised:
            call()
        one_line(raised, "Seeek")
    for call in (lambda: many.actuator("MotX"), lambda: many.sensor("MotX"),
                 lambda: many.variable("MotX")):  # fmt: skip
        with pytest.raises(ModelError) as raised:
            call()
        one_line(raised, "MotX")


def test_a_master_that_is_unclear():
    skills = [constant("A", {"MO:M": 1.0}), constant("B", {"MO:M": 1.0})]
    for made in (Hierarchy, Minds):
        with pytest.raises(ModelError) as raised:
            made(mind(skills))
        one_line(raised, "A", "B")
        with pytest.raises(ModelError) as raised:
            made(MindDescription("empty"))
        one_line(raised)


def undefined(eye):
    return eye * math.inf - math.inf


def both(eye):
    return eye, eye


def drifting(value):
    return value + math.inf - math.inf


def test_a_function_that_gives_no_number():
    description = mind([Skill("Odd", ["SE:Eye"], ["MO:Mot"], Programmed(undefined))])
    for made in (Hierarchy(description), Minds(description, agents=2)):
        with pytest.raises(ModelError) as raised:
            made.evaluate({"Eye": 0.5})
        one_line(raised, "Odd", "undefined")


def test_a_function_that_gives_another_number_of_outputs():
    description = mind([Skill("Odd", ["SE:Eye"], ["MO:Mot"], Programmed(both))])
    for made in (Hierarchy, Minds):
        with pytest.raises(ModelError) as raised:
            made(description).evaluate({"Eye": 0.5})
        one_line(raised, "both")


def test_a_regulation_that_gives_no_number():
    skill = wired("Show", {"MO:Mot": "VA:V"})
    description = mind([skill], [Variable("V", Regulated(drifting))])
    for made in (Hierarchy(description), Minds(description, agents=2)):
        with pytest.raises(ModelError) as raised:
            made.evaluate({})
        one_line(raised, "V", "drifting")
