"""Trainings that were begun anywhere are paused and resumed, and nothing runs that should not."""

from dataclasses import replace
from pathlib import Path

import pytest

from socialmind.errors import SocialmindError
from socialmind.learning import Curriculum, Lesson, Training, TrainingInterrupted, learn
from socialmind.learning.training.capsule import TrainingCapsule
from socialmind.mind import MindDescription, Perceptron, Skill
from socialmind.sources.folders import STUDIES_FILE, shipped
from socialmind.sources.loading import load_file
from socialmind.studio.learning.listing import summary
from socialmind.studio.learning.processes import LearningProcesses
from socialmind.studio.learning.resuming import resuming

SLOPES = load_file(Path(__file__).parents[2] / "learning" / "slopes.py")
MIND = MindDescription(
    "robot", ["S"], ["M"], skills=[Skill("Go", ["SE:S"], ["MO:M"], Perceptron(layers=0))]
)
COLLECT = shipped("analysis", STUDIES_FILE)["collect"]


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """A training of lessons given in Python, paused by the studio after two generations."""
    out = tmp_path_factory.mktemp("t") / "tiny"
    processes, told = LearningProcesses(out.parent), []

    def ask(news, left):
        told.append(summary(out))
        if len(told) == 2:
            processes.pause(out)
            told.append(summary(out))

    lesson = Lesson("Go", SLOPES.Slope, generations=5, settings={"population": 6}, finals=1)
    with pytest.raises(TrainingInterrupted, match="paused by the studio"):
        learn(None, Curriculum([lesson], mind=MIND), out=out, on_generation=ask)
    assert [one["pausing"] for one in told] == [False, False, True]
    assert all(one["held"] and one["process"]["pid"] for one in told)
    return out


def test_what_was_paused_says_how_it_stands(folder):
    told = summary(folder)
    assert (told["status"], told["held"], told["pausing"]) == ("interrupted", False, False)
    assert not told["resumable"]
    with pytest.raises(SocialmindError, match="given in Python; go on with it where it was begun"):
        LearningProcesses(folder.parent).resume(folder)
    with pytest.raises(SocialmindError, match="does not go on"):
        LearningProcesses(folder.parent).pause(folder)


def test_lessons_of_a_model_are_gone_on_with_by_learn(folder):
    manifest = replace(TrainingCapsule(folder).manifest, chosen=["Go"])
    command = resuming(folder, manifest)
    assert command.words == ["socialmind", "learn", "--resume", str(folder), "--quiet"]
    assert command.folder is None


@pytest.mark.parametrize(
    ("plan", "place", "known"),
    [
        ({"module": "analysis.collect.trainings", "name": "x"}, COLLECT / "trainings" / "x", True),
        ({"module": "analysis.collect.trainings", "name": "x"}, Path("trainings/x"), False),
        ({"module": "analysis.collect.trainings", "name": "y"}, COLLECT / "trainings" / "x", False),
        ({"module": "analysis.collect.none", "name": "x"}, COLLECT / "trainings" / "x", False),
        ({"module": "os", "name": "x"}, COLLECT / "trainings" / "x", False),
        (
            {"module": "analysis.mine.trainings", "name": "x"},
            Path("analysis/mine/trainings/x"),
            False,
        ),
        ({}, COLLECT / "trainings" / "x", False),
    ],
)
def test_a_manifest_chooses_among_the_commands_of_shipped_studies_alone(folder, plan, place, known):
    command = resuming(place, replace(TrainingCapsule(folder).manifest, plan=plan))
    assert (command is not None) == known
    if known:
        assert command.words == ["analysis.collect.trainings", "x"]
        assert command.folder == COLLECT.parents[1]


def test_the_curve_of_a_paused_one_is_whole(folder):
    assert Training(folder).curve["generation"].tolist() == [1, 2]
