"""The thesis's own examples load and say what the thesis says of them."""

import pytest
import thesis_examples as thesis

from socialmind.mind import Counter, MindDescription, Simple, Wave
from socialmind.mind.files.evoagents import ades, botdesc, simbatch, vardesc
from socialmind.mind.files.folder import load_tasks
from socialmind.mind.functions.convolution import Convolution
from socialmind.mind.functions.perceptron import Perceptron


def test_the_sensors_and_actuators_of_a1():
    sensors, actuators = botdesc.parse(thesis.SENSORS_OF_A1, "B.botdesc")
    assert [(one.name, one.kind, one.parameters, one.line) for one in sensors] == [
        ("S1", "proxSensor", (), 2),
        ("S2", "proxSensor", (), 3),
        ("TARG_AZIM", "TargetSensor", ("1",), 4),
        ("TARG_ELEV", "TargetSensor", ("2",), 5),
    ]
    assert [(one.name, one.kind, one.neutral) for one in actuators] == [
        ("M1", "propeller", 0.5),
        ("M2", "propeller", 0.5),
    ]


def test_the_variables_of_a2():
    variables = vardesc.parse(thesis.VARIABLES_OF_A2, "B.vardesc")
    assert [(one.name, one.regulation, one.start, one.line) for one in variables] == [
        ("VAR_SIN", Wave(), 0.5, 1),
        ("VAR_BASE", Simple(), 0.0, 2),
        ("VAR_COUNT", Counter(), 0.0, 4),
        ("VAR_ROLE", Simple(), 0.5, 5),
    ]


def test_the_mind_of_figure_a1(write_files):
    mind = MindDescription.load(write_files(thesis.COLLECTOR))
    assert mind.name == "T6"
    assert mind.masters == ("Collect",)
    collect = mind.skill("Collect")
    assert [str(one) for one in collect.outputs] == [
        "SK:GTO+Avoid",
        "SK:GTDZ+Avoid",
        "SK:ClawControl",
    ]
    # max(2, 3) + 2 = 5 neurons a layer: 5 · 3 + 5 · 6 + 3 · 6
    assert (collect.function, collect.genome_size) == (Perceptron(layers=2), 63)
    assert [one.line for one in collect.outputs] == [6, 7, 8]
    assert mind.skill("Avoid").inputs[10].reading == "derivative"
    assert len(mind.skill("Avoid").inputs) == 15
    forward = mind.skill("moveForward")
    assert forward.inputs == ()
    assert forward.function.function() == (1.0, 1.0)
    assert mind.actuators["Claw"].neutral == 0.0


def test_the_convolutional_network_of_figure_a2(write_files):
    avoid = MindDescription.load(write_files(thesis.CONVOLUTIONAL)).skill("Avoid")
    network = avoid.function
    assert isinstance(network, Convolution)
    assert network.bypass == (30, 31, 32, 33, 34, 35)
    temporal, spatial = network.kernels
    assert temporal.links[9] == (27, 28, 29)
    assert spatial.links[9] == (9, 0, 1)
    # Two kernels of 3 + 1; 10 + 6 inputs, 18 neurons a layer, 4 outputs.
    assert avoid.genome_size == 8 + 18 * 17 + 18 * 19 + 4 * 19


def test_the_task_of_a4(write_files):
    tasks = load_tasks(write_files(thesis.COLLECTOR))
    assert tasks == {
        "Avoid": simbatch.Task(
            "LEARN2DSIM", "BotType6", "T6-NEAT", "Avoid", "Avoid", "EXP_Avoid", "NEAT", "Minds",
            50, 3, 100000,
        )
    }  # fmt: skip


def test_other_names_of_tasks():
    assert simbatch.parse("TYPE:DEMOSIM\n", "t.simbatch").type == "DEMO2DSIM"
    assert simbatch.parse("TYPE:LEARNSIM\n", "t.simbatch").type.startswith("LEARN")


@pytest.mark.parametrize("kind", simbatch.TYPES)
def test_every_type_of_task_of_a4_2(kind):
    assert simbatch.parse(f"TYPE:{kind}\n", "t.simbatch").type == kind


def test_the_keyword_form_says_what_the_short_form_says():
    short = ades.parse(thesis.COLLECT, "Collect.ades")
    long = ades.parse(
        thesis.COLLECT.replace(
            "layers:2", "TYPE: BASIC\nHIDDEN_TRANSFER:ReLu\nHIDDEN_NEURON_ADDED:2\nLAYERS:2"
        ),
        "Collect.ades",
    )
    assert long.function == short.function


def test_comments_blanks_marks_and_line_ends_count_for_nothing():
    marked = "\ufeff# a skill\r\n\r\n" + thesis.COLLECT.replace("\n", "  # said\r\n\r\n")
    marked = marked.replace("SE:SENSOBJ", " SE : SENSOBJ ")
    plain = ades.parse(thesis.COLLECT, "Collect.ades")
    read = ades.parse(marked, "Collect.ades")
    assert (read.name, read.inputs, read.outputs) == (plain.name, plain.inputs, plain.outputs)
    assert read.function == plain.function
    assert read.inputs[0].line == 7


def test_the_folder_of_another_name_loads(write_files):
    assert MindDescription.load(write_files(thesis.COLLECTOR, "elsewhere")).name == "T6"
    assert MindDescription.load(write_files(thesis.COLLECTOR) / "T6.botdesc").name == "T6"
