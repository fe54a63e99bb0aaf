"""What somebody who steered a robot has shown: what the skill read, and what was done then."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from socialmind.catalogue import load_model
from socialmind.errors import SocialmindError
from socialmind.experiments import Steer, run
from socialmind.interventions.following import advanced
from socialmind.learning.imprinting.recording import Recording
from socialmind.learning.imprinting.steered import recording_of, recording_of_run, shown_skills

ROVERS = Path(__file__).parents[2] / "interventions" / "rovers"
TICKS = 70
WAYS = [
    Steer(10, "rovers", 1, (0.25, 1.0)),
    Steer(30, "rovers", 1, (1.0, 1.0)),
    Steer(40, "rovers", 1, None),
    Steer(50, "rovers", 0, (0.0, 0.125)),
]


@pytest.fixture(scope="module")
def steered(tmp_path_factory):
    kind = load_model(ROVERS)
    folder = tmp_path_factory.mktemp("steered") / "run"
    return run(kind, TICKS, seed=2, interventions=WAYS, out=folder)


def test_a_stretch_in_hand_is_an_episode_of_what_was_read_and_done(steered):
    found = recording_of_run(steered, "Drive")
    assert found.lengths == (30, 20)
    assert found.outputs[:20].tolist() == [[0.25, 1.0]] * 20
    assert found.outputs[20:30].tolist() == [[1.0, 1.0]] * 10
    assert found.outputs[30:].tolist() == [[0.0, 0.125]] * 20
    # What it read at tick 25: the eye as it was then, and two ticks before.
    society = advanced(load_model(ROVERS)(seed=2), 23, WAYS)
    eye = []
    for _ in range(3):
        eye.append(float(society.tables["rovers"].rows["readings"][1][0]))
        society = advanced(society, 1, WAYS)
    assert found.inputs[15].tolist() == [eye[2], eye[0]]


def test_it_is_a_table_for_imprinting(steered, tmp_path):
    skill = load_model(ROVERS).populations["rovers"].hierarchy.skills["Drive"]
    found = recording_of_run(steered, "Drive")
    found.write(tmp_path / "steered.csv", skill)
    again = Recording.read(tmp_path / "steered.csv", skill)
    assert again.lengths == found.lengths
    assert np.array_equal(again.inputs, found.inputs)


def test_who_is_steered_from_the_beginning_shows_from_the_first_reading_on():
    kind = load_model(ROVERS)
    ways = [Steer(0, "rovers", 1, (0.25, 1.0)), Steer(4, "rovers", 0, (0.0, 0.5))]
    found, _ = recording_of(kind(seed=2), ways, 7, "Drive")
    later, _ = recording_of(kind(seed=2), [replace(ways[0], tick=1), ways[1]], 7, "Drive")
    assert found.outputs.tolist() == later.outputs.tolist()
    # A stretch of each robot, of which each record is the robot's own.
    assert found.lengths == (3, 3)
    assert found.outputs.tolist() == [[0.25, 1.0]] * 3 + [[0.0, 0.5]] * 3


@pytest.mark.parametrize("ways", [[Steer(1, "rovers", 1, None)], [Steer(90, "rovers", 1, (1, 1))]])
def test_without_a_tick_in_hand_there_is_nothing_to_learn_from(ways):
    with pytest.raises(SocialmindError, match="nobody of 'rovers' was steered by hand"):
        recording_of(load_model(ROVERS)(seed=2), ways, 7, "Drive")


def test_skills_that_command_more_than_actuators_are_not_shown(steered):
    society = load_model(ROVERS)(seed=1)
    assert shown_skills(society, "rovers") == ["Drive"]
    with pytest.raises(SocialmindError, match="actuators alone"):
        recording_of_run(steered, "Top")


def test_a_run_that_nobody_steered_shows_nothing(tmp_path):
    folder = run(load_model(ROVERS), 5, out=tmp_path / "run")
    with pytest.raises(SocialmindError, match="nobody was steered"):
        recording_of_run(folder, "Drive")
