"""The robot that steers for a variable: its ways, its lessons' drive, and no loops."""

from types import SimpleNamespace

import numpy as np
import pytest

from socialmind.catalogue import load_model
from socialmind.commands.checking import print_findings
from socialmind.experiments import score
from socialmind.mind import Hierarchy, MindDescription, Skill
from socialmind.sources.folders import model_folder
from socialmind.sources.loading import load_file

FOLDER = model_folder("target_variable")
MODEL = load_file(FOLDER / "model.py")
LESSONS = load_file(FOLDER / "lessons.py")


def test_the_way_counts_up_to_the_last_delivery():
    robot = SimpleNamespace(
        x=0.0, y=0.0, gone=0.0, path=0.0, counted=0, last_x=0.0, last_y=0.0, delivered=0
    )
    for x, y, delivered in [(3.0, 4.0, 0), (3.0, 10.0, 1), (3.0, 12.0, 1)]:
        robot.x, robot.y, robot.delivered = x, y, delivered
        MODEL.pace(robot)
    assert (robot.gone, robot.path) == (13.0, 11.0)


def test_the_measure_is_the_way_for_each_object_against_the_plain_hierarchy():
    measure = load_model("target_variable").measures["path_ratio"]
    assert measure.mind == model_folder("collect_retrained") / "mind"
    assert measure.combined((600.0, 4.0), (1000.0, 10.0)) == 1.5


@pytest.mark.parametrize("number", [1, 3])
def test_there_are_as_many_objects_as_were_asked_for(number):
    model = load_model("target_variable")(seed=1, number=number, hierarchy=False, compiled=False)
    assert len(model.objects) == number


def test_the_odd_document_lists_the_skills(described, found_in):
    told = described("target_variable")
    assert told == found_in(LESSONS.hierarchy())
    mind = MindDescription.load(FOLDER / "mind")
    assert told == found_in(mind)
    assert mind.masters == (LESSONS.MASTER,)
    assert not print_findings(str(FOLDER / "mind"))


@pytest.mark.parametrize("angle", [0.1, 0.5, 0.77])
def test_the_drive_writes_what_nothing_else_writes_yet(angle):
    mind = LESSONS.hierarchy()
    goes = mind.skills["GoToTarget"]
    draws = np.random.default_rng(4).uniform(-1, 1, goes.genome_size)
    ready = mind.with_modules(
        skills=[Skill(goes.name, goes.inputs, goes.outputs, goes.function, draws)],
        without=["CollectVariable", "GoToTarget+Avoid"],
    )
    driven = Hierarchy(ready, "GoToTarget", drive=LESSONS.follow_object)
    driven.evaluate(dict.fromkeys(mind.sensors, 1.0) | {"RADOBJ": angle})
    assert driven.variables()["Target"] == angle
    alone = Hierarchy(ready, "GoToTarget")
    alone.evaluate({})
    assert alone.variables()["Target"] == 0.5


def test_the_function_can_let_either_direction_through_as_it_is():
    selector = LESSONS.SELECTING
    inputs, outputs = 4, 3
    gates = np.zeros((9, 5))  # of each output: its own branch, RADOBJ, RADDZ; weights and bias
    gates[7] = [-1, 0, 0, 0, 1]  # RADOBJ unless an object is sensed
    gates[8] = [1, 0, 0, 0, 0]  # RADDZ then
    genome = np.concatenate([gates.ravel(), np.zeros(3 * 5)])
    assert len(genome) == selector.genome_size(inputs, outputs)
    mind = LESSONS.hierarchy()
    skills = [
        one.changed(genome=genome if one.name == LESSONS.MASTER else np.zeros(one.genome_size))
        for one in mind.skills.values()
        if one.genome_size
    ]
    chosen = Hierarchy(mind.with_modules(skills=skills))
    sensed = dict.fromkeys(mind.sensors, 0.0) | {"RADOBJ": 0.31, "RADDZ": 0.87}
    for carries, direction in ((0.0, 0.31), (1.0, 0.87)):
        for _ in range(2):
            chosen.evaluate(sensed | {"SENSOBJ": carries})
        assert chosen.variables()["Target"] == pytest.approx(direction)


def test_the_trained_robot_drives_no_loops():
    found = score(load_model("target_variable"), episodes=24, seed=20, workers=1).intervals
    assert found["path_ratio"].mean < 1.3
    assert found["objects"].mean > 2.5
