"""Programs of skills are text: opened, checked without being run, and saved where they lay."""

import shutil

import pytest

from socialmind.errors import SocialmindError
from socialmind.mind import MindDescription
from socialmind.sources.folders import catalogue
from socialmind.studio.skills.checking import checked
from socialmind.studio.skills.document import EMPTY, checked_shape
from socialmind.studio.skills.files import opened, programs_changed, saved, tree_of

MODELS = catalogue()
FOLDERS = [one for model in MODELS.values() for one in sorted(model.glob("mind*")) if one.is_dir()]
CLAW = "Skills/ClawControl/claw_control.py"
PROGRAM = """import math
from math import pi as half_turn

NEAR = 2 * 0.25
close = 1.0


def grip(objects, zone=0.0):
    return close if objects > NEAR and math.sin(half_turn * zone) < limit(zone) else 0.0


def limit(zone):
    return min(1.0, zone + 0.5)
"""


@pytest.fixture
def collect(tmp_path):
    return shutil.copytree(MODELS["collect"] / "mind", tmp_path / "mind")


def claw(document):
    return next(one for one in document["skills"] if one["name"] == "ClawControl")


def told(document, home):
    return [
        (one["wrong"], one.get("line"), one["text"])
        for one in checked(document, home, opened(home)).findings
        if one["at"] == claw(document)["id"]
    ]


@pytest.mark.parametrize("folder", FOLDERS, ids=lambda one: f"{one.parent.name}/{one.name}")
def test_programs_of_models_are_shown_as_they_are_and_in_the_language(folder):
    document = opened(folder)
    own = [one for one in document["skills"] if one["function"] == "hardCoded"]
    assert [one for one in own if one["program"] is None] == []
    for one in own:
        files = [path.read_text() for path in (folder / "Skills" / one["name"]).glob("*.py")]
        assert one["program"] in files
    assert [one for one in checked(document, folder, document).findings if "line" in one] == []


def test_a_changed_program_changes_its_file_alone_and_is_what_runs(collect):
    document, before = opened(collect), tree_of(collect)
    claw(document)["program"] = PROGRAM
    assert told(document, collect) == [
        (True, None, "'claw_control', which claw_control.py does not define; expected "
         "a function claw_control() there; there is grip, limit")
    ]  # fmt: skip
    text = PROGRAM.replace("grip", "claw_control").rstrip()
    claw(document)["program"] = text
    assert told(document, collect) == []
    assert programs_changed(document, collect)
    assert saved(document, collect, collect) == []
    after = tree_of(collect)
    assert {name for name in after if before[name] != after[name]} == {CLAW}
    assert after[CLAW].decode() == text + "\n"
    function = MindDescription.load(collect).skills["ClawControl"].function.function
    assert [function(1.0, 0.0), function(0.5, 0.0)] == [1.0, 0.0]
    assert not programs_changed(opened(collect), collect)


@pytest.mark.parametrize(
    ("text", "wrong", "line", "said"),
    [
        ("def claw_control(a, b):\n    return (a", True, 2, "'(' was never closed"),
        ("def claw_control(a, b):\n  return a\n return b", True, 3, "unindent"),
        ("def claw_control(a, b):\n    return 1.0\n\nreturn 2", False, 4, "outside function"),
        ("def claw_control(a):\n    return 1.0\n", True, None, "takes 1 values"),
        ("def claw_control(a, b):\n    return a, b\n", False, 1, "expected a number"),
        (
            "def claw_control(a, b):\n    x = [a]\n    return open(x)\n",
            False,
            None,
            "could not run",
        ),
        ("def claw_control(a, b):\n    return sine(a)\n", False, 2, "sine"),
        ("def claw_control(a, b):\n\n    return a if a.b else b\n", False, 3, "could not run"),
        (
            "import os\ndef claw_control(a, b):\n    return os.x\n",
            False,
            1,
            "os is known only when",
        ),
        ("def claw_control(a, b):\n    return n\nn = f()", False, 3, "n is known only when"),
        ("x = 1" + "0" * 30 + "\ndef claw_control(a, b):\n    return x", False, 1, "x is known"),
        ("", True, None, "does not define"),
        ("(" * 5000, True, None, "nested"),
    ],
)
def test_what_is_wrong_is_said_with_its_line(collect, text, wrong, line, said):
    document = opened(collect)
    claw(document)["program"] = text
    ((is_wrong, at, words),) = told(document, collect)
    assert (is_wrong, said in words) == (wrong, True), words
    if line is not None:
        assert at == line and words.startswith(f"line {line}: ")
    assert "socialmind-program" not in words


def test_nothing_of_a_program_is_run(collect, tmp_path):
    touched = tmp_path / "touched"
    run = f"__import__('pathlib').Path({str(touched)!r}).touch()"
    document = opened(collect)
    claw(document)["program"] = f"""{run}
x = {run}

@({run})
def grip(a=({run}), *, b: ({run}) = ({run})) -> ({run}): pass

class Claw:
    {run}

for _ in [{run}]:
    pass

def claw_control(a: ({run}), b=1.0):
    {run}
    return x

"""
    assert [wrong for wrong, *_ in told(document, collect)] == [False]
    assert saved(document, collect, collect) == []
    opened(collect)
    assert not touched.exists()
    with pytest.raises(SocialmindError, match="loading stopped"):
        MindDescription.load(collect)
    assert touched.exists()  # so it would have shown


def test_a_program_goes_with_its_class_and_its_skill(collect):
    document = opened(collect)
    one = claw(document)
    one["lines"] = ["class:Grip"]
    assert told(document, collect) == []  # the file's only function
    assert saved(document, collect, collect) == []
    names = sorted(path.name for path in (collect / "Skills" / "ClawControl").iterdir())
    assert names == ["ClawControl.ades", "Grip.py"]
    document = opened(collect)
    one = claw(document)
    one["name"], one["program"] = "Claw", one["program"].replace("1.0", "0.75")
    for other in document["skills"]:
        renamed = {"SK:ClawControl": "SK:Claw"}
        other["outputs"] = [renamed.get(to, to) for to in other["outputs"]]
    assert saved(document, collect, collect) == []
    names = sorted(path.name for path in (collect / "Skills" / "Claw").iterdir())
    assert names == ["Claw.ades", "Grip.py"]
    assert MindDescription.load(collect).skills["Claw"].function.function(1.0, 0.0) == 0.75


def test_lines_end_as_they_ended_and_what_is_not_changed_is_not_touched(collect):
    old = (collect / CLAW).read_bytes().replace(b"\n", b"\r\n")
    (collect / CLAW).write_bytes(b"\xef\xbb\xbf" + old)
    document = opened(collect)
    assert "\r" not in claw(document)["program"]
    assert not programs_changed(document, collect)
    assert saved(document, collect, collect) == []
    assert (collect / CLAW).read_bytes() == b"\xef\xbb\xbf" + old
    claw(document)["program"] += "# a word\n"
    assert saved(document, collect, collect) == []
    assert (collect / CLAW).read_bytes() == old + b"# a word\r\n"


def test_a_program_is_written_from_nothing_and_in_a_yaml_file_too(tmp_path):
    skill = {
        "id": "k", "was": None, "name": "Stand", "inputs": ["SE:EYE"], "outputs": ["MO:M"],
        "function": "hardCoded", "lines": ["class:Stand"],
        "program": "def stand(eye):\n    return 0.5 * eye\n",
    }  # fmt: skip
    document = checked_shape(
        {
            **EMPTY,
            "sensors": [{"id": "1", "name": "EYE", "kind": "eye", "fields": []}],
            "actuators": [{"id": "2", "name": "M", "kind": "wheel", "fields": []}],
            "skills": [skill],
        }
    )
    assert programs_changed(document, None)
    assert saved(document, tmp_path / "mind", None) == []
    assert (tmp_path / "mind" / "Skills" / "Stand" / "Stand.py").read_text() == skill["program"]
    saved(document, tmp_path / "mind.yaml", None)
    document = opened(tmp_path / "mind.yaml")
    assert document["skills"][0]["program"] == skill["program"]
    document["skills"][0]["program"] = skill["program"].replace("0.5", "0.25")
    saved(document, tmp_path / "mind.yaml", tmp_path / "mind.yaml")
    function = MindDescription.load(tmp_path / "mind.yaml").skills["Stand"].function.function
    assert function(1.0) == 0.25


@pytest.mark.parametrize("program", [7, ["x"], "x" * 200_001, "\ud800"])
def test_what_can_be_no_text_is_refused(collect, program):
    document = opened(collect)
    claw(document)["program"] = program
    with pytest.raises(SocialmindError, match="program"):
        checked_shape(document)
