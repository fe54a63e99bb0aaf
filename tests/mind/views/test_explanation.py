"""What is said of an evaluation: who influenced whom, and what counted in each command."""

import random

import pytest
from hypothesis import given
from hypothesis import strategies as st
from random_minds import MASTER, random_mind, sensor_values
from small_minds import constant, mind, wired

from socialmind.errors import ModelError
from socialmind.mind import Counter, Hierarchy, Variable
from socialmind.mind.views.explanation import (
    DRIVE,
    IMPULSE,
    Command,
    Influence,
    Part,
    Passage,
    Received,
    explanation_of,
)


def explained(skills, sensors=None, variables=(), drive=None, master=None):
    hierarchy = Hierarchy(mind(skills, variables), master, drive=drive)
    hierarchy.evaluate(sensors or {})
    return explanation_of(hierarchy)


def by_name(rows, name):
    return next(
        row for row in rows if name in (getattr(row, "name", ""), getattr(row, "skill", ""))
    )


# Equation 6.1 and figure 6.6 -------------------------------------------------------------------

EQUATION_6_1 = (
    constant("Avoid", {"SK:moveForward": 1.0, "SK:turnLeft": 1.0}),
    constant("moveForward", {"MO:MotL": 1.0, "MO:MotR": 1.0}),
    constant("turnLeft", {"MO:MotL": 0.0, "MO:MotR": 1.0}),
)


def test_equation_6_1_part_by_part():
    explanation = explained(EQUATION_6_1)
    assert explanation.influences == (
        Influence("Avoid", 1.0, (Received(IMPULSE, 1.0),)),
        Influence("moveForward", 1.0, (Received("Avoid", 1.0),)),
        Influence("turnLeft", 1.0, (Received("Avoid", 1.0),)),
    )
    assert explanation.motors[0] == Command(
        name="MotL",
        command=0.5,
        weight=2.0,
        parts=(Part("moveForward", 1.0, 1.0, 50.0), Part("turnLeft", 0.0, 1.0, 50.0)),
        passages=(Passage("Avoid", 2.0, 100.0),),
        driven=False,
    )
    assert explanation.motors[0].by_skills == 0.5
    assert explanation.motors[1].command == 1.0


PRIMITIVES = (
    constant("moveForward", {"MO:MotL": 1.0, "MO:MotR": 1.0}),
    constant("moveBackwards", {"MO:MotL": 0.0, "MO:MotR": 0.0}),
    constant("turnLeft", {"MO:MotL": 0.0, "MO:MotR": 1.0}),
    constant("turnRight", {"MO:MotL": 1.0, "MO:MotR": 0.0}),
)


def step_of_figure_6_6(to_object, to_zone, object_infl, zone_infl, go_object, go_zone, avoid):
    """A step in which the complex skills give these influences, whatever the sensors say.

    The last three are influences on moveForward, moveBackwards, turnLeft and turnRight.
    """

    def on_primitives(values):
        return {f"SK:{one.name}": value for one, value in zip(PRIMITIVES, values, strict=True)}

    return explained(
        [
            constant("Collect", {"SK:Object+": to_object, "SK:Zone+": to_zone}),
            constant("Object+", {"SK:GoToObject": object_infl[0], "SK:Avoid": object_infl[1]}),
            constant("Zone+", {"SK:GoToDropZone": zone_infl[0], "SK:Avoid": zone_infl[1]}),
            constant("GoToObject", on_primitives(go_object)),
            constant("GoToDropZone", on_primitives(go_zone)),
            constant("Avoid", on_primitives(avoid)),
            *PRIMITIVES,
        ]
    )


def shares(explanation, motor):
    """The rounded percents of the motor's skills and of the complex ones, where there are any."""
    command = by_name(explanation.motors, motor)
    return {
        row.skill: round(row.percent, 6)
        for row in (*command.parts, *command.passages)
        if row.percent > 0.0
    }


def test_the_five_steps_of_figure_6_6():
    # Step 1: 1.0 · 1.0 · 0.11 to moveForward alone.
    one = step_of_figure_6_6(1, 0, (1, 0), (0.6, 0.4), (0.11, 0, 0, 0), (0.5, 0, 0.5, 0), (0,) * 4)
    assert by_name(one.influences, "moveForward").total == 0.11
    all_through = {"Collect": 100.0, "Object+": 100.0}
    assert shares(one, "MotR") == {"moveForward": 100.0, **all_through, "GoToObject": 100.0}

    # Step 2: Avoid alone, 1.0 to moveForward and turnLeft (equation 6.1).
    two = step_of_figure_6_6(1, 0, (0, 1), (0.6, 0.4), (0, 0, 0, 1), (0.5, 0, 0.5, 0), (1, 0, 1, 0))
    assert by_name(two.motors, "MotL").command == 0.5
    halves = {"moveForward": 50.0, "turnLeft": 50.0}
    assert shares(two, "MotL") == {**halves, **all_through, "Avoid": 100.0}

    # Step 3: GoToObject 0.16, 1.0 of it to turnRight; Avoid 0.84 to moveForward.
    three = step_of_figure_6_6(
        1, 0, (0.16, 0.84), (0.6, 0.4), (0, 0, 0, 1), (0.5, 0, 0.5, 0), (1, 0, 0, 0)
    )
    own = {"moveForward": 84.0, "turnRight": 16.0}
    assert shares(three, "MotR") == {**own, **all_through, "GoToObject": 16.0, "Avoid": 84.0}
    assert by_name(three.motors, "MotR").command == pytest.approx(0.84)

    # Step 4: turnRight 0.16 · 0.9 = 0.144, moveForward 0.84 · 0.2 = 0.168, of 0.312.
    four = step_of_figure_6_6(
        1, 0, (0.16, 0.84), (0.6, 0.4), (0, 0, 0, 0.9), (0.5, 0, 0.5, 0), (0.2, 0, 0, 0)
    )
    right = by_name(four.motors, "MotR")
    assert right.weight == pytest.approx(0.312)
    assert shares(four, "MotR")["turnRight"] == pytest.approx(100 * 0.144 / 0.312)
    assert shares(four, "MotR")["Avoid"] == pytest.approx(100 * 0.168 / 0.312)

    # Step 5: all comes through Zone+; Object+ sends 0.16 and 0.84 of no influence.
    five = step_of_figure_6_6(
        0, 1, (0.16, 0.84), (0.6, 0.4), (0, 0, 0, 0.9), (0.5, 0, 0.5, 0), (0.2, 0, 0, 0)
    )
    avoid = by_name(five.influences, "Avoid")
    assert avoid.received == (Received("Object+", 0.0), Received("Zone+", 0.4))
    # GoToDropZone 0.6 · (0.5 + 0.5) = 0.6, Avoid 0.4 · 0.2 = 0.08, of 0.68.
    assert shares(five, "MotL") == pytest.approx(
        {
            "moveForward": 100 * 0.38 / 0.68,
            "turnLeft": 100 * 0.3 / 0.68,
            "Collect": 100.0,
            "Zone+": 100.0,
            "GoToDropZone": 100 * 0.6 / 0.68,
            "Avoid": 100 * 0.08 / 0.68,
        },
        abs=1e-6,
    )


# Variables, mixed skills, the drive ------------------------------------------------------------


def test_a_skill_that_commands_and_coordinates_has_its_own_part_and_a_passage():
    explanation = explained(
        [
            constant("Top", {"SK:Mid": 0.5, "MO:M": 0.2}),
            constant("Mid", {"SK:Low": 0.4, "MO:M": 0.6}),
            constant("Low", {"MO:M": 1.0}),
        ]
    )
    # Weights: Top 1.0, Mid 0.5, Low 0.2; command (0.2 + 0.3 + 0.2) / 1.7.
    (motor,) = explanation.motors
    assert motor.weight == pytest.approx(1.7)
    assert motor.command == pytest.approx(0.7 / 1.7)
    assert [(part.skill, part.weight) for part in motor.parts] == [
        ("Low", pytest.approx(0.2)),
        ("Mid", pytest.approx(0.5)),
        ("Top", pytest.approx(1.0)),
    ]
    # Through Top flows what Mid and Low have; through Mid what Low has.
    assert [(way.skill, way.weight) for way in motor.passages] == [
        ("Top", pytest.approx(0.7)),
        ("Mid", pytest.approx(0.2)),
    ]


def test_the_command_of_a_variable_is_that_of_the_next_evaluation():
    hierarchy = Hierarchy(
        mind(
            [
                constant("Master", {"SK:A": 0.25, "SK:B": 0.75}),
                wired("A", {"VA:X": "SE:S"}),
                constant("B", {"VA:X": 0.5}),
            ],
            ["X", Variable("Idle", Counter())],
        )
    )
    hierarchy.evaluate({"S": 1.0})
    said, idle = explanation_of(hierarchy).variables
    assert hierarchy.variables()["X"] == 0.0
    assert said.command == 0.25 * 1.0 + 0.75 * 0.5
    assert said.parts == (Part("A", 1.0, 0.25, 25.0), Part("B", 0.5, 0.75, 75.0))
    assert idle == Command("Idle", None, 0.0, (), (), False)
    hierarchy.evaluate({"S": 0.0})
    assert hierarchy.variables()["X"] == said.command


def test_without_influence_an_actuator_is_neutral():
    explanation = explained([constant("Master", {"SK:A": 0.0}), constant("A", {"MO:M": 1.0})])
    assert explanation.motors == (
        Command("M", 0.5, 0.0, (Part("A", 1.0, 0.0, 0.0),), (Passage("Master", 0.0, 0.0),), False),
    )
    assert explanation.motors[0].by_skills is None
    assert "(neutral: no influence)" in str(explanation)


def test_the_drive_has_what_no_skill_accounts_for():
    def drive(mind):
        mind.add_influence("A", 0.5)
        mind.command("M", 0.0, 3.5)
        mind.command_variable("X", 1.0, 0.5)

    explanation = explained(
        [
            constant("Master", {"SK:A": 1.0, "VA:X": 0.25}),
            constant("A", {"MO:M": 1.0}),
        ],
        variables=["X"],
        drive=drive,
    )
    assert by_name(explanation.influences, "A") == Influence(
        "A", 1.5, (Received("Master", 1.0), Received(DRIVE, 0.5))
    )
    (motor,) = explanation.motors
    assert (motor.command, motor.by_skills, motor.driven) == (0.3, 1.0, True)
    assert motor.passages == (
        Passage("Master", 1.0, pytest.approx(100 / 1.5)),
        Passage(DRIVE, 0.5, pytest.approx(50 / 1.5)),
    )
    (variable,) = explanation.variables
    assert variable.by_skills == 0.25
    assert variable.command == (0.25 * 1.0 + 1.0 * 0.5) / 1.5
    assert variable.driven
    assert "(drive: the skills alone give 1.000)" in str(explanation)


def test_a_drive_that_adds_nothing_has_no_part():
    def drive(mind):
        mind.add_influence("turnLeft", 0.0)

    explanation = explained(EQUATION_6_1, drive=drive)
    quiet = explained(EQUATION_6_1)
    assert (explanation.influences, explanation.motors) == (quiet.influences, quiet.motors)


# Any hierarchy ---------------------------------------------------------------------------------


@given(st.integers(0, 10_000))
def test_the_parts_add_up_in_any_hierarchy(seed):
    description = random_mind(random.Random(seed), skills=10, depth=5, programs=False)
    hierarchy = Hierarchy(description, MASTER)
    for sensors in sensor_values(description, random.Random(seed), 2):
        hierarchy.evaluate(sensors)
    explanation = explanation_of(hierarchy)
    totals = hierarchy.influences()
    for one in explanation.influences:
        assert sum(part.influence for part in one.received) == pytest.approx(totals[one.skill])
        assert DRIVE not in [part.source for part in one.received]
    for motor in explanation.motors:
        assert motor.command == hierarchy.actuators()[motor.name]
        assert not motor.driven
        if motor.weight > 0.0:
            assert sum(part.percent for part in motor.parts) == pytest.approx(100.0)
            assert motor.by_skills == pytest.approx(motor.command, abs=1e-9)
        # All that does not come from the master's own command flows through the master.
        own = sum(part.weight for part in motor.parts if part.skill == MASTER)
        through = sum(way.weight for way in motor.passages if way.skill == MASTER)
        assert own + through == pytest.approx(motor.weight)


# Text, tables, errors --------------------------------------------------------------------------


def test_the_text_reads_row_by_row():
    assert str(explained(EQUATION_6_1)).splitlines() == [
        "Evaluation 1 of the mind 'small', master 'Avoid'",
        "",
        "skill        influence  from",
        "Avoid            1.000  (impulse) 1.000",
        "moveForward      1.000  Avoid 1.000",
        "turnLeft         1.000  Avoid 1.000",
        "",
        "actuator  command  by             output  weight    share",
        "MotL        0.500  moveForward     1.000   1.000   50.0 %",
        "                   turnLeft        0.000   1.000   50.0 %",
        "                   through Avoid           2.000  100.0 %",
        "MotR        1.000  moveForward     1.000   1.000   50.0 %",
        "                   turnLeft        1.000   1.000   50.0 %",
        "                   through Avoid           2.000  100.0 %",
    ]


def test_many_sources_wrap_within_100_columns():
    names = [f"complex skill number {number}" for number in range(9)]
    skills = [constant("Master", {f"SK:{name}": 0.5 for name in names})]
    skills += [constant(name, {"SK:Avoid": 0.5}) for name in names]
    skills += [constant("Avoid", {"MO:M": 1.0})]
    text = str(explained(skills))
    assert max(len(line) for line in text.splitlines()) <= 100
    for name in names:
        assert f"{name} 0.250" in text


def test_explain_prints_what_it_returns(capsys):
    hierarchy = Hierarchy(mind(EQUATION_6_1))
    hierarchy.evaluate({})
    explanation = hierarchy.explain()
    assert capsys.readouterr().out == f"{explanation}\n"
    assert explanation == explanation_of(hierarchy)


def test_before_any_evaluation_there_is_nothing_to_explain():
    hierarchy = Hierarchy(mind(EQUATION_6_1))
    with pytest.raises(ModelError, match=r"before its first evaluation; .* call evaluate"):
        hierarchy.explain()
    hierarchy.evaluate({})
    hierarchy.reset()
    with pytest.raises(ModelError, match="before its first evaluation"):
        explanation_of(hierarchy)
