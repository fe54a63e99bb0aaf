"""What models with hierarchies refuse: one clear line each, with its place where it has one."""

import textwrap

import pytest

from socialmind.catalogue import load_model
from socialmind.errors import ModelError, RuleError, SocialmindError
from socialmind.mind import Hierarchy, MindDescription, Perceptron, Skill

MODEL = """
import math

from socialmind import Agent, Model, Population, each, once, parameter
from socialmind.mind import MindDescription, Perceptron, Programmed, Skill, Variable

MIND = MindDescription(
    "crab", ["Eye"], ["Claw"], [Variable("Mood"), Variable("Shared", group="shoal")],
    [
        Skill("Top", ["SE:Eye"], ["SK:Low"], Perceptron(0), [0.5, 0.5]),
        Skill("Low", ["VA:Mood"], ["MO:Claw", "VA:Mood"], Perceptron(0), [0.5, 0.1, 0.5, 0.1]),
    ],
)
UNTRAINED = MindDescription(
    "egg", ["Eye"], ["Claw"], [], [Skill("Top", ["SE:Eye"], ["MO:Claw"], Perceptron(0))]
)


class Crab(Agent):
    speed: float = 0.0
FIELDS

DRIVE

def rule(crab, model, rng):
RULE


class Crabs(Model):
    crabs = Population(Crab, 3POPULATION)
    schedule = (each(crabs, rule),)
MORE
"""
OWN = ", hierarchy=MIND"


@pytest.fixture
def written(tmp_path):
    """Writes a model out of what differs, and gives its class and file."""

    def write(rule="pass", population=OWN, drive="", fields="", more=""):
        fills = {
            "RULE": textwrap.indent(rule, "    "), "POPULATION": population, "DRIVE": drive,
            "FIELDS": textwrap.indent(fields, "    "), "MORE": textwrap.indent(more, "    "),
        }  # fmt: skip
        text = MODEL
        for mark, fill in fills.items():
            text = text.replace(mark, fill)
        folder = tmp_path / "crabs"
        folder.mkdir(exist_ok=True)
        file = folder / "model.py"
        file.write_text(text)
        return file, text.splitlines()

    return write


@pytest.fixture
def refused(written):
    """Makes a model and runs a tick of it interpreted, which must be refused; gives the message."""

    def call(*words, kind=ModelError, at=None, settings=None, **parts):
        file, lines = written(**parts)
        with pytest.raises(kind) as raised:
            load_model(file.parent)(compiled=False, **(settings or {})).advance(1)
        message = str(raised.value)
        assert "\n" not in message
        for word in words:
            assert word in message
        if at is not None:
            line = next(n for n, text in enumerate(lines, 1) if at in text)
            assert message.startswith(f"{file}:{line}: ")
        return message

    return call


@pytest.mark.parametrize(
    ("rule", "words"),
    [
        ('crab.hierarchy.set_sensor("Eyes", 0.5)', ("sensor 'Eyes'", "'crab'", "Eye")),
        ('crab.hierarchy.set_sensor("Claw", 0.5)', ("sensor 'Claw'", "Eye")),
        ('crab.speed = crab.hierarchy.actuator("Eye")', ("actuator 'Eye'", "Claw")),
        ('crab.speed = crab.hierarchy.variable("Mud")', ("variable 'Mud'", "Mood")),
        ('crab.speed = crab.hierarchy.influence("Lo")', ("skill 'Lo'", "'Low'")),
        ('crab.hierarchy.add_influence("Mood", 0.5)', ("skill 'Mood'", "Low")),
        ('crab.hierarchy.join_group("school", 0, 1.0)', ("'school'", "shoal")),
        ('crab.hierarchy.leave_group("school")', ("'school'", "shoal")),
        ("crab.speed = crab.hierarchy.variable()", ("0 arguments", "expected 1")),
        ('crab.hierarchy.set_sensor("Eye", 0.5, 1.0)', ("3 arguments", "expected 2")),
        ('crab.hierarchy.set_sensor("Eye", value=0.5)', ("value=", "without the name")),
        ("crab.hierarchy.think()", ("think()", "evaluate")),
        ("crab.hierarchy.set_sensor(3, 0.5)", ("name of a sensor",)),
        ('crab.hierarchy.set_sensor("Eye", "much")', ("'much'", "expected a number")),
        ('crab.hierarchy.set_sensor("Eye", None)', ("None",)),
        ('crab.hierarchy.join_group("shoal", 0.5, 1.0)', ("join_group()", "whole number")),
        ("crab.hierarchy = 3", ("'hierarchy'", "cannot be set")),
        ("crab.speed = crab.hierarchy", ("hierarchy", "expected a number")),
        ("crab.speed = crab.hierarchy.evaluate()", ("None", "expected a number")),
        ("crab.speed = crab.hierarchy.speed", ("'speed'",)),
    ],
)
def test_a_rule_that_cannot_be(refused, rule, words):
    refused(*words, at=rule, rule=rule)


@pytest.mark.parametrize(
    ("rule", "words"),
    [
        ('crab.hierarchy.set_sensor("Eye", 1.5)', ("sensor outside [0, 1]",)),
        ('crab.hierarchy.set_sensor("Eye", math.nan)', ("sensor outside [0, 1]",)),
        ('crab.hierarchy.set_sensor("Eye", -math.inf)', ("sensor outside [0, 1]",)),
        ('crab.hierarchy.set_variable("Mood", -0.5)', ("variable outside [0, 1]",)),
        ('crab.hierarchy.set_variable("Mood", math.nan)', ("variable outside [0, 1]",)),
        ('crab.hierarchy.add_influence("Low", -1.0)', ("influence below 0",)),
        ('crab.hierarchy.add_influence("Low", math.inf)', ("influence",)),
        ('crab.hierarchy.command("Claw", 1.5, 1.0)', ("command outside [0, 1]",)),
        ('crab.hierarchy.command("Claw", 0.5, -1.0)', ("weight",)),
        ('crab.hierarchy.command_variable("Mood", math.nan, 1.0)', ("command outside [0, 1]",)),
        ('crab.hierarchy.join_group("shoal", 2, 1.0)', ("instance", "instances=")),
        ('crab.hierarchy.join_group("shoal", -2, 1.0)', ("instance", "instances=")),
        ('crab.hierarchy.join_group("shoal", 0, -1.0)', ("participation",)),
        ('crab.hierarchy.join_group("shoal", 0, math.inf)', ("participation",)),
        ('crab.hierarchy.join_group("shoal", 0, math.nan)', ("participation",)),
    ],
)
def test_a_value_out_of_range(refused, rule, words):
    population = f"{OWN}, instances=2"
    message = refused(*words, kind=RuleError, at=rule, rule=rule, population=population)
    assert "tick 0, agent" in message


@pytest.mark.parametrize(
    ("population", "words"),
    [
        (", hierarchy=MIND, master='Tip'", ("'crab'", "'Tip'", "'Top'")),
        (", hierarchy=UNTRAINED", ("'Top'", "without a genome", "2 weights")),
        (", hierarchy='nowhere'", ("nowhere", "no such folder")),
        (", hierarchy=5", ("'crabs'", "found 5", "MindDescription")),
        (", hierarchy=MIND, instances=-1", ("instances=-1", "0 or more")),
        (", hierarchy=MIND, instances='n'", ("instances='n'", "0 or more")),
        (", hierarchy=MIND, own_genomes=('Go',)", ("own_genomes=('Go',)", "True or False")),
        (", drive=rule", ("drive=", "no hierarchy")),
        (", master='Top'", ("master=", "no hierarchy")),
        (", own_genomes=True", ("own_genomes=", "no hierarchy")),
        (", instances=2", ("instances=", "no hierarchy")),
        (", hierarchy=MIND, drive='push'", ("'push'", "plain function")),
    ],
)
def test_a_population_that_cannot_be(refused, population, words):
    refused(*words, kind=SocialmindError, population=population)


def test_a_hierarchy_that_no_one_has(refused):
    rule = "crab.hierarchy.evaluate()"
    refused("hierarchy", "Population(…, hierarchy=", at=rule, rule=rule, population="")


@pytest.mark.parametrize("name", ["hierarchy", "minds", "mind", "plan"])
def test_a_field_under_a_name_that_is_taken(refused, name):
    refused(f"'{name}'", "do not use", at=f"{name}: float", fields=f"{name}: float = 0.0")


@pytest.mark.parametrize(
    "more",
    [
        "hierarchy: float = 0.0",
        "hierarchy: float = parameter(0.0)",
        "hierarchy = Population(Crab, 3)",
        "assemblies: float = 0.0",
    ],
)
def test_a_part_of_a_model_under_a_name_that_is_taken(refused, more):
    refused(more.split(":")[0].split(" ")[0], at=more, more=more)


PUSH = f"{OWN}, drive=push"


@pytest.mark.parametrize(
    ("line", "words"),
    [
        ("mind.evaluate()", ("evaluate()", "sensor, actuator")),
        ("mind.restart()", ("restart()",)),
        ('mind.set_sensor("Eye", 0.5)', ("set_sensor()", "'sensor'")),
        ('mind.join_group("shoal", 0, 1.0)', ("join_group()",)),
        ('x = mind.sensor("Eyes")', ("'Eyes'", "Eye")),
        ('mind.command("Claw", value=0.5, weight=1.0)', ("value=",)),
        ("x = [1 for i in range(3)]", ("list comprehension",)),
        ("x = mind.hierarchy", ("'hierarchy'",)),
        ("import os", ("import",)),
        ("x = open('f')", ("open",)),
    ],
)
def test_a_drive_that_cannot_be(refused, line, words):
    refused(*words, at=line, drive=f"def push(mind):\n    {line}\n", population=PUSH)


@pytest.mark.parametrize(
    ("head", "body", "words"),
    [
        ("def push(mind, more):", "pass", ("'push'", "2 parameters")),
        ("def push():", "pass", ("'push'", "0 parameters")),
        ("def push(mind):", "return 1.0", ("'push'", "returns")),
    ],
)
def test_a_drive_of_a_wrong_form(refused, head, body, words):
    refused(*words, at=head, drive=f"{head}\n    {body}\n", population=PUSH)


@pytest.mark.parametrize(
    ("line", "words"),
    [
        ('mind.add_influence("Low", -1.0)', ("influence below 0",)),
        ('mind.set_variable("Mood", 2.0)', ("variable outside [0, 1]",)),
        ('x = 1.0 / mind.sensor("Eye")', ("ZeroDivisionError",)),
    ],
)
def test_a_drive_that_fails(refused, line, words):
    drive = f"def push(mind):\n    {line}\n"
    refused(
        *words, kind=RuleError, at=line, drive=drive, population=PUSH,
        rule="crab.hierarchy.evaluate()",
    )  # fmt: skip


PROGRAM = """def wire(eye):
    {}

PROGRAMMED = MindDescription(
    "wired", ["Eye"], ["Claw"], [], [Skill("Wire", ["SE:Eye"], ["MO:Claw"], Programmed(wire))]
)
"""


@pytest.mark.parametrize(
    ("line", "at", "kind", "words"),
    [
        ("return 1.0 / eye", "return 1.0 / eye", RuleError, ("ZeroDivisionError",)),
        ("return math.inf * eye", "hierarchy.evaluate()", RuleError, ("nan", "wire()", "'Wire'")),
        ("return eye, eye", "def wire", ModelError, ("2 values", "a number")),
        ("eye = 1.0", "def wire", ModelError, ("None", "a number")),
        ("return eyes", "return eyes", ModelError, ("eyes",)),
    ],
)
def test_a_program_that_fails(refused, line, at, kind, words):
    refused(
        *words, kind=kind, at=at, drive=PROGRAM.format(line), population=", hierarchy=PROGRAMMED",
        rule="crab.hierarchy.evaluate()",
    )  # fmt: skip


OTHER = MindDescription(
    "other", ["Eye"], ["Claw"], [], [Skill("Only", ["SE:Eye"], ["MO:Claw"], Perceptron(0), [1, 0])]
)


@pytest.mark.parametrize(
    ("given", "population", "words"),
    [
        ("mind", "", ("0 populations with hierarchies",)),
        (5, OWN, ("found 5", "'crabs'")),
        (Hierarchy(OTHER), OWN, ("<hierarchy 'other'", "MindDescription")),
        ("/nowhere/at/all", OWN, ("/nowhere/at/all", "no such folder")),
        ({"cows": OTHER}, OWN, ("'cows'", "crabs")),
        (OTHER, OWN + ", master='Top'", ("'other'", "'Top'", "Only")),
    ],
)
def test_another_hierarchy_that_cannot_be(refused, given, population, words):
    refused(
        *words, kind=SocialmindError, population=population, settings={"hierarchy": given},
    )  # fmt: skip


def test_a_skill_that_another_mind_lacks_is_found_at_the_rule_that_names_it(refused):
    rule = 'crab.speed = crab.hierarchy.influence("Low")'
    refused("'Low'", "'other'", "Only", at=rule, rule=rule, settings={"hierarchy": OTHER})


def test_weights_of_agents(written):
    file, _ = written(population=OWN + ", own_genomes=True")
    minds = load_model(file.parent)(compiled=False).tables["crabs"].minds
    minds.set_genome("Top", [[1, 2], [3, 4]], [0, 2])
    assert minds.state.genome[[0, 2], :2, 0].tolist() == [[1, 2], [3, 4]]
    for arguments, word in (
        (("Tip", [1, 2]), "'Tip'"),
        (("Top", [1]), "2"),
        (("Top", ["a", "b"]), "numbers"),
        (("Top", [[1, 2], [2, 3], [3, 4]], [0, 1]), "3 genomes for 2 slots"),
        (("Top", [1, float("nan")], [0]), "nan"),
    ):
        with pytest.raises(ModelError, match=word):
            minds.set_genome(*arguments)
    shared = load_model(written()[0].parent)(compiled=False).tables["crabs"].minds
    with pytest.raises(ModelError, match="own_genomes=True"):
        shared.set_genome("Top", [1, 2], [0])
