"""The evaluator that others are compared with, held to computations by hand."""

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st
from independent import Alone, Society, top_down
from independent_networks import perceptron, run_network, sigmoid
from small_minds import constant, mind, wired, written

from socialmind.mind import (
    Actuator,
    Counter,
    MindDescription,
    Programmed,
    Regulated,
    Simple,
    Skill,
    Variable,
    Wave,
)
from socialmind.mind.functions import network as form


def test_influence_flows_down_by_equations_4_2_and_4_3():
    alone = Alone(
        mind(
            [
                constant("Master", {"SK:A": 0.5, "SK:B": 0.25}),
                constant("A", {"SK:Left": 1.0, "SK:Right": 0.5}),
                constant("B", {"SK:Right": 0.5}),
                constant("Left", {"MO:M": 0.2}),
                constant("Right", {"MO:M": 0.8, "MO:N": 0.3}),
            ]
        )
    )
    # Right: 0.5 · 0.5 + 0.25 · 0.5 = 0.375;  M: (0.5 · 0.2 + 0.375 · 0.8) / (0.5 + 0.375)
    assert alone.step({}) == pytest.approx({"M": 0.4 / 0.875, "N": 0.3})
    assert alone.agent.influences == {
        "Master": 1.0, "A": 0.5, "B": 0.25, "Left": 0.5, "Right": 0.375,
    }  # fmt: skip
    assert alone.agent.outputs["B", "SK:Right"] == 0.5
    assert alone.agent.links["B", "SK:Right"] == 0.125


def test_equation_6_1():
    alone = Alone(
        mind(
            [
                constant("Avoid", {"SK:moveForward": 1.0, "SK:turnLeft": 1.0}),
                constant("moveForward", {"MO:MotL": 1.0, "MO:MotR": 1.0}),
                constant("turnLeft", {"MO:MotL": 0.0, "MO:MotR": 1.0}),
            ]
        )
    )
    assert alone.step({}) == {"MotL": 0.5, "MotR": 1.0}


def test_a_motor_without_influence_is_neutral():
    skills = [constant("Master", {"SK:Base": 0.0}), constant("Base", {"MO:M": 1.0})]
    actuators = [Actuator("M", neutral=0.3), Actuator("Other")]
    alone = Alone(MindDescription("still", (), actuators, (), skills))
    assert alone.step({}) == {"M": 0.3, "Other": 0.5}


def test_derivatives_and_histories_by_hand():
    shown = {"MO:value": "SE:S", "MO:change": "SD:S", "MO:one": "SH:S:1", "MO:three": "SH:S:3"}
    alone = Alone(mind([wired("Show", shown)]))
    seen = [alone.step({"S": value}) for value in (0.2, 0.6, 0.1, 1.0, 1.0)]
    assert [one["value"] for one in seen] == [0.2, 0.6, 0.1, 1.0, 1.0]
    assert [one["change"] for one in seen] == pytest.approx([0.5, 0.7, 0.25, 0.95, 0.5])
    assert [one["one"] for one in seen] == [0.2, 0.2, 0.6, 0.1, 1.0]
    assert [one["three"] for one in seen] == [0.2, 0.2, 0.2, 0.2, 0.6]


def values(variable, commands, influences=None):
    """A variable's value at each tick, for commands that are given at the ticks."""
    alone = Alone(written(variable))
    seen = []
    for command, influence in zip(commands, influences or [1.0] * len(commands), strict=True):
        alone.step({"command": command, "influence": influence, "one": 1.0})
        seen.append(alone.agent.values()["X"])
    return seen


def test_a_simple_variable_takes_the_command_of_the_last_cycle():
    assert values(Variable("X", Simple(), 0.5), [0.1, 0.2, 0.9], [1.0, 0.0, 1.0]) == [0.5, 0.1, 0.1]


def test_a_counter_counts_edges():
    commands = [0.9, 0.9, 0.5, 0.9, 0.8, 0.81, 0.1, 0.1, 0.3, 0.9]
    expected = [0.0, 0.1, 0.1, 0.1, 0.2, 0.2, 0.3, 0.0, 0.0, 0.0]
    assert values(Variable("X", Counter()), commands) == expected
    overflow = [1.0, 0.5] * 4
    expected = [0.0, 0.5, 0.5, 1.0, 1.0, 0.0, 0.0, 0.5]
    assert values(Variable("X", Counter(maximum=2)), overflow) == expected


def test_a_wave_goes_on_by_its_last_command():
    seen = values(Variable("X", Wave()), [0.0, 0.5, 1.0, 1.0], [0.0, 0.7, 0.0, 0.0])
    phases = [1.0, 2.0, 2.0 + 0.001 + 0.5 * 2.999, 2.0 + 2 * (0.001 + 0.5 * 2.999)]
    assert seen == pytest.approx([0.5 + math.sin(phase) / 2 for phase in phases])


def test_a_regulation_sees_command_value_and_memory():
    def sluggish(command, value, memory, commanded):
        return value + 0.5 * (command - value) if commanded else 0.0, memory + 1.0

    alone = Alone(written(Variable("X", Regulated(sluggish), 0.4)))
    seen = []
    for influence in (1.0, 0.0, 1.0):
        alone.step({"command": 1.0, "influence": influence, "one": 1.0})
        seen.append((alone.agent.values()["X"], alone.agent.variables["X"].memory))
    assert seen == [(0.0, 1.0), (0.5, 2.0), (0.0, 3.0)]


def test_a_shared_variable_is_weighted_by_participation():
    variable = Variable("X", group="herd")
    shares = [(0, 1.0), (0, 0.5), (1, 1.0)]
    herd = Society(written(variable), ["Master"], 3, groups={"herd": shares})
    given_now = [
        {"command": 1.0, "influence": 0.4, "one": 1.0},
        {"command": 0.0, "influence": 1.0, "one": 1.0},
        {"command": 0.3, "influence": 0.0, "one": 1.0},
    ]
    herd.evaluate(given_now)
    motors = herd.evaluate(given_now)
    # (1.0 · 0.4 · 1.0 + 0.5 · 1.0 · 0.0) / (1.0 · 0.4 + 0.5 · 1.0)
    assert [one["value"] for one in motors] == pytest.approx([4 / 9, 4 / 9, 0.0])


def test_a_drive_acts_between_variables_and_skills():
    skills = [
        constant("Master", {"MO:M": 0.0}),
        wired("Outside", {"MO:N": "VA:X"}),
    ]

    def drive(agent):
        agent.set_variable("X", 0.75)
        agent.command("M", 1.0, weight=3.0)
        agent.add_influence("Outside", 0.2)

    alone = Alone(mind(skills, ["X"]), "Master", "Outside", drive=drive)
    # M: (0.0 · 1.0 + 1.0 · 3.0) / (1.0 + 3.0)
    assert alone.step({}) == pytest.approx({"M": 0.75, "N": 0.75})


def test_a_perceptron_by_hand():
    # One hidden layer of 2 neurons, 1 output; neuron by neuron, weights in input order, bias last.
    genome = [2.0, -1.0, 0.5, 1.0, 1.0, -3.0, 0.25, 4.0, 0.125]
    # max(0, 2 · 0.5 - 1 · 0.25 + 0.5) = 1.25; max(0, 0.5 + 0.25 - 3) = 0; 0.25 · 1.25 + 0.125
    assert perceptron([0.5, 0.25], genome, 1, layers=1, added=0) == [0.4375]
    low = sigmoid(-2.25)
    expected = 0.25 * sigmoid(1.25) + 4.0 * low + 0.125
    found = perceptron([0.5, 0.25], genome, 1, layers=1, added=0, hidden=sigmoid)
    assert found == pytest.approx([expected])
    with pytest.raises(ValueError, match="1 weights too many"):
        perceptron([0.5, 0.25], [*genome, 1.0], 1, layers=1, added=0)


def test_the_size_of_a_perceptron_is_that_of_equation_5_1():
    size = 5 * 3 + 5 * 6 + 3 * 6  # two inputs, three outputs: 3 + 2 = 5 hidden neurons
    assert len(perceptron([0.0, 0.0], [0.0] * size, 3)) == 3


def test_steps_of_a_network_by_hand():
    mean = form.Neuron((0, 1), (0, 1), 2, form.LINEAR, form.MEAN, response=2.0)
    most = form.Neuron((0, 1), (0, 1), -1, form.CLAMP, form.GREATEST)
    steps = (
        form.Recall(0, 2, 1),
        form.Neurons(3, (mean, most)),
        form.Gather((4, 2), 5),
        form.Dense(5, 2, 7, 2, 3, form.RELU),
        form.Mix(9, (((4, 7), (0, 8)), ((2, 3),))),
        form.Remember(7, 0, 1),
    )
    network = form.Network(2, 2, 9, 11, 9, 1, steps)
    genome = [1.0, 0.5, 0.25, 0.5, 2.0, 0.125, 0.0, -1.0, 0.75]
    memory = [0.0]
    # nodes 3: 0.25 + 2 · (0.5 + 0.125) / 2; 4: 0.5; 7: 0.25 + 0 + 0.125; 8: 0.75
    # outputs: (0.5 · 0.375 + 0.5 · 0.75) / 1.0; no influence, 0.5
    assert run_network(network, [0.5, 0.25], genome, memory) == [0.5625, 0.5]
    assert memory == [0.375]
    # nodes 7: 0.25 + 2 · 0.375 + 0.125 = 1.125; 8: 0.75 - 0.375; 0.375 · 0.875 / 0.375
    found = run_network(network, [0.5, 0.25], genome, memory)
    assert found == pytest.approx([(0.5 * 1.125 + 0.5 * 0.375) / 1.0, 0.875])
    assert memory == [1.125]


def test_programs_give_one_number_or_several():
    def ends(inputs):
        return inputs[0] - 1.0, inputs[-1] + 1.0

    skills = [
        Skill("Master", ["SE:A", "SE:B"], ["MO:M", "MO:N"], Programmed(ends)),
    ]
    assert Alone(mind(skills)).step({"A": 0.4, "B": 0.6}) == {"M": 0.0, "N": 1.0}


@given(st.permutations(["A", "B", "C", "D"]))
def test_skills_come_after_all_that_influence_them(names):
    first, second, third, last = names
    skills = [
        constant(last, {"MO:M": 1.0}),
        constant(third, {f"SK:{last}": 1.0}),
        constant(first, {f"SK:{last}": 1.0, f"SK:{second}": 1.0}),
        constant(second, {f"SK:{third}": 1.0}),
    ]
    assert top_down(mind(skills), [first]) == [first, second, third, last]
