"""Lessons are refused where they are wrong, and say what decides their result."""

import json
import math

import numpy as np
import pytest

from socialmind.errors import ModelError
from socialmind.learning import Lesson


class Field:
    ticks = 70


def test_what_is_not_given_is_the_skills_own():
    lesson = Lesson("Avoid", Field)
    assert (lesson.skills, lesson.master, lesson.episode_ticks) == (("Avoid",), "Avoid", 70)
    assert Lesson("Avoid", Field, ticks=5).episode_ticks == 5
    several = Lesson("All", Field, skill=["A", "B"], master="Top")
    assert (several.skills, several.master) == (("A", "B"), "Top")


@pytest.mark.parametrize(
    ("changes", "said"),
    [
        ({"name": ""}, "'' as the name of a lesson"),
        ({"environment": 3}, "environment 3; expected a class"),
        ({"skill": ("A", "A"), "master": "T"}, "the skills A, A; expected each skill once"),
        ({"skill": ("A", "B")}, "several skills and no master"),
        ({"repetitions": 0}, "repetitions=0; expected a whole number, 1 or more"),
        ({"generations": 2.5}, "generations=2.5"),
        ({"ticks": True}, "ticks=True"),
        ({"budget": -1}, "budget=-1"),
        ({"optimiser": "LUCK"}, "the optimiser 'LUCK'; expected one of GENETIC"),
        ({"settings": {"populatoin": 3}}, "'populatoin' of an optimiser; expected one of popul"),
        ({"settings": {"elite": -1}}, "elite=-1 of an optimiser"),
        ({"start": "anew"}, "start='anew'; expected 'scratch' or 'known'"),
        ({"worlds": "old"}, "worlds='old'"),
        ({"spread": math.nan}, "spread=nan"),
        ({"drive": "Drive"}, "the drive 'Drive'"),
        ({"stand_ins": ("Go",)}, "stand_ins=('Go',); expected skills"),
        ({"first": np.zeros((1, 2)), "start": "known"}, "first individuals and start='known'"),
        ({"optimiser": "NEAT", "start": "known"}, "NEAT and start='known'; expected graphs that"),
        ({"optimiser": "NEAT", "first": np.zeros((1, 2))}, "NEAT and first individuals"),
    ],
)
def test_wrong_arguments_are_refused(changes, said):
    with pytest.raises(ModelError) as raised:
        Lesson(**{"name": "Avoid", "environment": Field, "file": "lessons.py", **changes})
    assert said in str(raised.value)
    assert str(raised.value).startswith("lessons.py: found ")


def test_the_record_holds_all_settings_and_goes_through_json():
    def bold(mind):
        pass

    record = Lesson("Avoid", Field, settings={"elite": 3}, drive=bold, ticks=9).record()
    assert record == json.loads(json.dumps(record))
    assert record["settings"]["elite"] == 3
    assert record["settings"]["population"] == 200
    assert (record["environment"], record["ticks"]) == ("Field", 9)
    assert record["drive"].endswith("bold")


def test_given_individuals_are_part_of_what_decides_its_result():
    records = [
        Lesson("A", Field, first=np.full((2, 3), value)).record()["first"] for value in (0.0, 1.0)
    ]
    assert all(one.startswith("2 given, SHA-256 ") for one in records)
    assert records[0] != records[1]
    assert records[0] == Lesson("A", Field, first=np.zeros((2, 3))).record()["first"]
