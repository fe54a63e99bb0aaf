"""Programs in files: found by name, and written out of the program that made the mind."""

import math

import numpy as np
import pytest

from socialmind.errors import ModelError
from socialmind.mind import MindDescription, Programmed, Regulated, Skill, Variable
from socialmind.mind.files.python_file import function_text, load_beside

GAIN = 0.5
FAR = math.inf
NAMES = ["left"]


def gained(value):
    return GAIN * value


def steer(eye: float, ear):
    return gained(eye), np.sin(ear) if ear < FAR else math.pi


def drip(command, value):
    return value + GAIN * (command - value)


def uses_a_list(eye):
    return float(len(NAMES))


def counted(function):
    return function


@counted
def decorated(eye):
    return eye


def _mind(function, inputs=("SE:Eye", "SE:Ear"), outputs=("MO:L", "MO:R")):
    skill = Skill("Steer", inputs, outputs, Programmed(function))
    drops = Variable("Drops", Regulated(drip))
    return MindDescription("v", ["Eye", "Ear"], ["L", "R"], [drops], [skill])


@pytest.mark.parametrize("form", ["v", "v.yaml"])
def test_a_function_is_written_out_with_all_that_it_names(tmp_path, form):
    _mind(steer).save(tmp_path / form)
    read = MindDescription.load(tmp_path / form)
    again = read.skill("Steer").function.function
    assert again is not steer
    assert again(0.5, 1.0) == steer(0.5, 1.0)
    assert again(0.5, math.inf) == (0.25, math.pi)
    assert read.variables["Drops"].regulation.function(1.0, 0.0) == 0.5


def test_a_function_made_in_another_keeps_the_numbers_it_was_made_with(tmp_path):
    def made(gain):
        def pulled(eye, ear):
            return gain * eye, gain * ear

        return pulled

    _mind(made(0.25)).save(tmp_path / "v")
    read = MindDescription.load(tmp_path / "v").skill("Steer").function
    assert (read.name, read.function(1.0, 0.5)) == ("pulled", (0.25, 0.125))


@pytest.mark.parametrize(
    ("function", "words"),
    [
        (uses_a_list, "names 'NAMES'"),
        (decorated, "decorated"),
        (lambda eye: eye, "plain function"),
        (math.sin, "plain function"),
    ],
    ids=["list", "decorated", "lambda", "built-in"],
)
def test_a_function_that_cannot_be_written_is_one_line(function, words):
    with pytest.raises(ModelError) as caught:
        function_text(function)
    assert words in str(caught.value)
    assert caught.value.remedy
    assert "\n" not in str(caught.value)


def test_a_function_without_source_is_one_line():
    space = {}
    exec("def typed(eye):\n    return eye\n", space)
    with pytest.raises(ModelError, match="'typed', whose source cannot be had"):
        function_text(space["typed"])


ADES = "Go\ninput:0\noutput:1\nMO:L\nhardCoded\nclass:GoFast\n"


@pytest.mark.parametrize(
    ("file", "text"),
    [
        ("GoFast.py", "def GoFast():\n    return 0.75\n"),
        ("GoFast.py", "def helper():\n    return 0\n\n\ndef go_fast():\n    return 0.75\n"),
        ("GoFast.py", "def _helper():\n    return 0.75\n\n\ndef step():\n    return _helper()\n"),
        ("Go.py", "def go_fast():\n    return 0.75\n"),
        ("GoFast.py", "from math import sin\nfrom .speed import SPEED\n\n\n"
                      "def go_fast():\n    return SPEED + sin(0)\n"),
    ],
    ids=["as-it-is", "snake-case", "only-one", "file-of-the-skill", "sibling"],
)  # fmt: skip
def test_a_class_names_a_function(write_files, file, text):
    folder = write_files(
        {
            "v.botdesc": "SENSORS\nACTUATORS\nL:wheel\n",
            "Skills/Go/Go.ades": ADES,
            f"Skills/Go/{file}": text,
            "Skills/Go/speed.py": "SPEED = 0.75\n",
        }
    )
    function = MindDescription.load(folder).skill("Go").function
    assert function.function() == 0.75
    assert function.written == "GoFast"


def test_two_skills_may_have_files_of_the_same_name(write_files):
    files = {"v.botdesc": "SENSORS\nACTUATORS\nL:wheel\nR:wheel\n"}
    for name, value in (("A", 0.25), ("B", 0.75)):
        files[f"Skills/{name}/{name}.ades"] = f"{name}\n{ADES.partition(chr(10))[2]}"
        files[f"Skills/{name}/GoFast.py"] = f"def go_fast():\n    return {value}\n"
    mind = MindDescription.load(write_files(files))
    assert [mind.skill(name).function.function() for name in "AB"] == [0.25, 0.75]


def test_a_changed_file_is_loaded_anew(write_files):
    folder = write_files({"f.py": "def f():\n    return 1\n"})
    first = load_beside(folder / "f.py", "", "f", "x.vardesc", 1)
    (folder / "f.py").write_text("def f():\n    return 2\n")
    assert (first(), load_beside(folder / "f.py", "", "f", "x.vardesc", 1)()) == (1, 2)


def test_a_file_that_needs_its_folder_is_not_copied_alone(write_files, tmp_path):
    folder = write_files(
        {
            "v.botdesc": "SENSORS\nACTUATORS\nL:wheel\n",
            "Skills/Go/Go.ades": ADES,
            "Skills/Go/GoFast.py": "from .speed import SPEED\ndef go_fast():\n    return SPEED\n",
            "Skills/Go/speed.py": "SPEED = 0.75\n",
        }
    )
    mind = MindDescription.load(folder)
    with pytest.raises(ModelError, match=r"GoFast.py:1: found an import from the file's own"):
        mind.save(tmp_path / "other")
    mind.save(folder)
    assert MindDescription.load(folder).skill("Go").function.function() == 0.75
