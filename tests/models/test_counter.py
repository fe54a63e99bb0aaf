"""The robot that counts: what a sequence is, what it earns, and that learned minds count."""

from functools import cache
from types import SimpleNamespace

import numpy as np
import pytest

from socialmind.catalogue import load_model
from socialmind.commands.checking import print_findings
from socialmind.experiments import score
from socialmind.mind import Hierarchy, MindDescription, Programmed, Skill
from socialmind.sources.folders import model_folder
from socialmind.sources.loading import load_file

FOLDER = model_folder("counter")
MODEL = load_file(FOLDER / "model.py")
LESSONS = load_file(FOLDER / "lessons.py")
SKETCH = load_file(FOLDER / "sketch.py")
MINDS = {"mind": 2, "mind_wanted": 0}


# What a sequence is -----------------------------------------------------------------------------


class Draws:
    """A random stream that gives numbers in turn."""

    def __init__(self, *numbers):
        self.numbers = list(numbers)

    def integers(self, low, high):
        """Return the next number, within its bounds."""
        found = self.numbers.pop(0)
        assert low <= found < high
        return found


def robot(wanted=2):
    return SimpleNamespace(
        delivered=0, counted=0, wanted=wanted, collected=0, validating=False, correct=0, ended=0,
        earned=0.0, overdone=False,
    )  # fmt: skip


def lives(one, steps, wanted=2, rng=None):
    """Let a robot deliver (d), be in the validation zone (v) or elsewhere (.), a tick each."""
    for step in steps:
        one.delivered += step == "d"
        MODEL.reckon(one, SimpleNamespace(wanted=wanted), rng, step == "v")
    return one


@pytest.mark.parametrize(
    ("steps", "correct", "ended", "earned"),
    [
        ("d.d.v", 1, 1, 10.0),
        ("d.d.vvv.v", 1, 1, 10.0),  # being there, and being there again, is no other sequence
        ("d.v.d.v", 0, 2, 0.0),  # too early pays nothing
        ("v.v.d.d.v", 1, 1, 10.0),  # without an object nothing has begun
        ("d.d.v.d.d.v", 2, 2, 20.0),
        ("d.d.v.d.v", 1, 2, 10.0),
        ("d.d.", 0, 0, 0.0),  # in hand
    ],
)
def test_a_sequence_is_two_objects_and_a_validation(steps, correct, ended, earned):
    one = lives(robot(), steps)
    assert (one.correct, one.ended, one.earned) == (correct, ended, earned)
    assert not MODEL.too_many(one)


def test_an_object_too_many_ends_the_run():
    one = lives(robot(), "d.d.d")
    assert (one.correct, one.ended, one.earned) == (0, 1, 0.0)
    assert MODEL.too_many(one)


def test_what_is_wanted_is_drawn_anew_for_each_sequence_and_sensed():
    one = robot(wanted=1)
    lives(one, "d.v", wanted=0, rng=Draws(4))
    assert (one.correct, one.wanted) == (1, 4)
    assert MODEL.wanted_share(one) == 1.0
    lives(one, "dddd.v", wanted=0, rng=Draws(3))
    assert (one.correct, one.wanted) == (2, 3)
    assert MODEL.wanted_share(one) == 0.75


def test_rewards_need_no_mind():
    # So nothing of a mind decides what is earned.
    model = load_model("counter")(seed=1, hierarchy=False, compiled=False)
    one, (zone,) = model.robots[0], model.validation_zones
    model.advance(1)
    one.delivered = 2
    model.advance(1)
    one.x, one.y = zone.x, zone.y
    model.advance(3)
    assert (one.collected, one.correct, one.score) == (0, 1, MODEL.SEQUENCE)


# The lesson in outline ----------------------------------------------------------------------------


def count(obj, zone, valid, value):
    """Count deliveries; go and validate at two."""
    command = 0.5
    if obj > 0.5 and zone > 0.5:
        command = 1.0
    if valid > 0.5:
        command = 0.0
    done = value > 0.15
    return (0.0 if done else 1.0), (1.0 if done else 0.0), command


def only_collect(obj, zone, valid, value):
    """Collect and never validate."""
    return 1.0, 0.0, 0.0


def in_outline(function):
    """Run the sketch with a program as the master; return the robot."""
    known = LESSONS.hierarchy()
    master = known.skills[LESSONS.MASTER]
    skill = Skill(master.name, master.inputs, master.outputs, Programmed(function))
    mind = known.with_modules(skills=[skill]).on_stand_ins(master.name, SKETCH.STAND_INS)
    model = SKETCH.Sketch(seed=2, hierarchy=mind, compiled=False)
    while model.over is None and model.tick < model.ticks:
        model.advance(1)
    return model.robots[0], model.over


def test_in_outline_who_counts_has_correct_sequences_alone():
    one, over = in_outline(count)
    assert over is None
    assert one.correct >= 5
    assert one.correct == one.ended


def test_in_outline_who_does_not_validate_earns_three_objects():
    one, over = in_outline(only_collect)
    assert over == "too many"
    assert (one.score, one.correct, one.ended) == (3.0, 0, 1)


# Minds --------------------------------------------------------------------------------------------


def test_the_odd_document_lists_the_skills(described, found_in):
    assert described("counter") == found_in(MindDescription.load(FOLDER / "mind"))
    wanted = found_in(MindDescription.load(FOLDER / "mind_wanted"))
    assert wanted["CountObjects"][0] == ["SENSOBJ", "SENSDZ", "SENSVZ", "Count", "WANTED"]
    assert wanted["CountObjects"][2] == 18


@pytest.mark.parametrize("name", MINDS)
def test_nothing_is_odd_and_the_master_alone_was_learned(name, found_in):
    assert not print_findings(str(FOLDER / name))
    mind = MindDescription.load(FOLDER / name)
    assert mind.masters == (LESSONS.MASTER,)
    before = LESSONS.hierarchy(inputs=LESSONS.WANTED if name == "mind_wanted" else ())
    assert found_in(mind) == found_in(before)
    for skill in before.skills.values():
        if skill.genome is not None:
            assert mind.skills[skill.name].genome.shape == skill.genome.shape


def test_going_to_validate_is_going_to_drop_with_another_sensor():
    mind = LESSONS.hierarchy()
    for angle in (0.1, 0.5, 0.8):
        valid = Hierarchy(mind, "GoToValid").evaluate({"RADVZ": angle})
        drop = Hierarchy(mind, "GoToDropZone").evaluate({"RADDZ": angle})
        assert valid == drop
    assert np.array_equal(
        mind.skills["GoToValid+Avoid"].genome, mind.skills["GoToDropZone+Avoid"].genome
    )


@cache
def scored(name):
    return score(
        load_model("counter"), mind=FOLDER / name, episodes=24, seed=20, workers=1,
        parameters={"wanted": MINDS[name]},
    )  # fmt: skip


@pytest.mark.parametrize("name", MINDS)
def test_learned_minds_count_in_new_worlds(name):
    found = scored(name)
    # Who collects without a memory ends most runs with an object too many.
    assert found.intervals["correct_sequences"].mean > 0.8
    assert found.intervals["sequences"].mean > 1.0
