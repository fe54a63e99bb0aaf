"""Minds are opened as documents, and saved so that only what was changed is another."""

import copy
import shutil
from pathlib import Path
from tempfile import TemporaryDirectory

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from socialmind.errors import SocialmindError
from socialmind.mind import MindDescription
from socialmind.mind.files.evoagents.text_file import Lines
from socialmind.mind.files.layout import SECTIONS, layout_file
from socialmind.sources.folders import catalogue
from socialmind.studio.skills.checking import checked
from socialmind.studio.skills.document import EMPTY, checked_shape
from socialmind.studio.skills.files import opened, patched, saved, tree_of

MODELS = catalogue()
FOLDERS = [one for model in MODELS.values() for one in sorted(model.glob("mind*")) if one.is_dir()]


@pytest.fixture
def collect(tmp_path):
    return shutil.copytree(MODELS["collect"] / "mind", tmp_path / "mind")


ROVER = {
    "name": "rover",
    "sensors": [{"id": "1", "name": "EYE", "kind": "proxSensor", "fields": []}],
    "actuators": [{"id": "2", "name": "MotL", "kind": "wheel", "fields": ["0.25"]}],
    "variables": [
        {"id": "3", "name": "N", "kind": "CounterVariableModule", "fields": ["", "5"]},
        {"id": "4", "name": "MOOD", "kind": "VariableModule", "fields": [""]},
    ],
    "skills": [
        {
            "id": "5", "was": None, "name": "Go", "inputs": ["SE:EYE", "VD:N"],
            "outputs": ["MO:MotL", "VA:MOOD", "VA:N"], "function": "neural",
            "lines": ["TYPE:BASIC", "LAYERS:1"],
        }
    ],
}  # fmt: skip


def skill(document, name):
    return next(one for one in document["skills"] if one["name"] == name)


@pytest.mark.parametrize("folder", FOLDERS, ids=lambda one: f"{one.parent.name}/{one.name}")
def test_what_is_opened_and_saved_unchanged_is_identical(folder, tmp_path):
    document = checked_shape(opened(folder))
    assert not checked(document, folder, document).wrong
    assert saved(document, tmp_path / "copy", folder) == []
    assert tree_of(tmp_path / "copy") == tree_of(folder)
    assert MindDescription.load(tmp_path / "copy") == MindDescription.load(folder)


def test_a_changed_skill_changes_its_own_file_alone(collect):
    before = tree_of(collect)
    document = opened(collect)
    skill(document, "Collect")["outputs"].append("VA:VAR_SIN")
    assert saved(document, collect, collect) == [
        "the weights of Collect did not fit any more and are gone"
    ]
    after = tree_of(collect)
    assert {name for name in before if before[name] != after.get(name)} == {
        "Skills/Collect/Collect.ades", "Skills/Collect/Collect.genome",
    }  # fmt: skip
    mind = MindDescription.load(collect)
    assert [str(one) for one in mind.skills["Collect"].outputs][-1] == "VA:VAR_SIN"
    assert mind.skills["Collect"].genome is None


def test_a_renamed_skill_takes_its_weights_and_program_along(collect):
    weights = MindDescription.load(collect).skills["Avoid"].genome
    document = opened(collect)
    for old, new in (("Avoid", "KeepClear"), ("ClawControl", "Claw")):
        skill(document, old)["name"] = new
        for one in document["skills"]:
            one["outputs"] = [f"SK:{new}" if to == f"SK:{old}" else to for to in one["outputs"]]
    assert saved(document, collect, collect) == []
    mind = MindDescription.load(collect)
    assert mind.skills["KeepClear"].genome.tolist() == weights.tolist()
    assert not (collect / "Skills" / "Avoid").exists()
    assert "SK:KeepClear" in map(str, mind.skills["GoToObject+Avoid"].outputs)
    own = MindDescription.load(MODELS["collect"] / "mind").skills["ClawControl"].function
    assert mind.skills["Claw"].function.function(1.0, 0.0) == own.function(1.0, 0.0)


def test_weights_that_do_not_fit_any_more_are_said_before_they_go(collect):
    before = opened(collect)
    document = opened(collect)
    skill(document, "GoToObject")["lines"] = ["TYPE:BASIC", "LAYERS:5"]
    skill(document, "GoToDropZone")["inputs"] = ["SE:RADOBJ"]
    found = checked(document, collect, before)
    ids = {name: skill(document, name)["id"] for name in ("GoToObject", "GoToDropZone", "Avoid")}
    said = {at: one["text"] for one in found.findings for at in [one["at"]]}
    assert "do not fit any more" in said[ids["GoToObject"]]
    assert "input 1 was SE:RADDZ" in said[ids["GoToDropZone"]]
    assert found.weights[ids["GoToObject"]]["fits"] is False
    assert found.weights[ids["Avoid"]]["fits"] is True
    assert found.weights[ids["Avoid"]]["had"] == found.weights[ids["Avoid"]]["size"]


def test_a_mind_is_made_from_nothing(tmp_path):
    assert saved(checked_shape(ROVER), tmp_path / "rover", None) == []
    mind = MindDescription.load(tmp_path / "rover")
    assert mind.actuators["MotL"].neutral == 0.25
    assert mind.variables["N"].regulation.maximum == 5
    assert mind.skills["Go"].genome_size == 5 * (2 + 1) + 3 * (5 + 1)
    assert opened(tmp_path / "rover")["skills"][0]["inputs"] == ["SE:EYE", "VD:N"]


def test_yaml_is_opened_saved_and_left_alone_where_nothing_changed(collect, tmp_path):
    mind = MindDescription.load(collect)
    mind.save(tmp_path / "robot.yaml")
    text = "# by hand\n" + (tmp_path / "robot.yaml").read_text()
    (tmp_path / "robot.yaml").write_text(text)
    document = opened(tmp_path / "robot.yaml")
    assert saved(document, tmp_path / "robot.yaml", tmp_path / "robot.yaml") == []
    assert (tmp_path / "robot.yaml").read_text() == text
    document["variables"].append(
        {"id": "x", "name": "MOOD", "kind": "VariableModule", "fields": ["0.5"], "position": None}
    )
    saved(document, tmp_path / "robot.yaml", tmp_path / "robot.yaml")
    again = MindDescription.load(tmp_path / "robot.yaml")
    assert again.variables["MOOD"].default == 0.5
    assert again.skills["Avoid"].genome.tolist() == mind.skills["Avoid"].genome.tolist()


def moved(document, places):
    """A document with parts elsewhere, by their identities."""
    found = copy.deepcopy(document)
    for what in SECTIONS:
        for one in found[what]:
            one["position"] = places.get(one["id"], one["position"])
    return found


COORDINATES = st.integers(-(2**31), 2**31 - 1)
PLACES = st.dictionaries(
    st.sampled_from(["s0", "a0", "v0", "v1", "k0"]),
    st.tuples(COORDINATES, COORDINATES).map(list),
    min_size=1,
    max_size=5,
)


@pytest.mark.parametrize("form", ["mind", "mind.yaml"])
@settings(max_examples=4)
@given(places=PLACES, further=PLACES)
def test_what_is_dragged_stands_there_and_the_mind_is_as_it_was(form, places, further):
    with TemporaryDirectory() as home:
        folder = Path(home) / form
        saved(checked_shape(ROVER), folder, None)
        mind, before, untouched = MindDescription.load(folder), opened(folder), tree_of(folder)
        for wanted in (moved(before, places), moved(moved(before, places), further)):
            assert saved(checked_shape(wanted), folder, folder) == []
            assert opened(folder) == wanted
            files = tree_of(folder)
            layout = files.pop(layout_file(folder).name)
            assert files == untouched
            assert MindDescription.load(folder) == mind
        # Saved as it stands, and elsewhere, it is the same file; dragged back, there is none.
        assert saved(wanted, folder, folder) == []
        assert tree_of(folder)[layout_file(folder).name] == layout
        saved(wanted, Path(home) / "copy", folder)
        assert opened(Path(home) / "copy") == wanted
        assert saved(before, folder, folder) == []
        assert tree_of(folder) == untouched


def test_places_go_with_names_and_comments_stay(collect):
    layout = layout_file(collect)
    layout.write_text("# by hand\nSKILLS\nAvoid : 1 : 2  # left\nGone:3:4\n")
    document = opened(collect)
    assert skill(document, "Avoid")["position"] == [1, 2]
    assert saved(document, collect, collect) == []
    assert layout.read_text() == "# by hand\nSKILLS\nAvoid : 1 : 2  # left\nGone:3:4\n"
    # What is said of a module that is gone goes when places are written.
    skill(document, "Collect")["position"] = [5, 6]
    saved(document, collect, collect)
    assert set(layout.read_text().splitlines()) == {
        "# by hand", "SKILLS", "Avoid : 1 : 2  # left", "Collect:5:6"
    }  # fmt: skip
    # A mind of another name takes its file along.
    document = opened(collect)
    document["name"] = "Gather"
    saved(document, collect, collect)
    assert not layout.exists()
    assert opened(collect) == {**document, "name": "Gather"}


def test_a_file_of_the_name_that_is_something_else_is_not_lost(tmp_path):
    (tmp_path / "rover.layout").write_text("width: 80\n")
    with pytest.raises(SocialmindError, match=r"rover\.layout:1: found 'width: 80'"):
        saved(checked_shape(ROVER), tmp_path / "rover.yaml", None)
    assert [one.name for one in tmp_path.iterdir()] == ["rover.layout"]


def test_places_that_cannot_be_read_are_said_with_the_line(collect):
    layout_file(collect).write_text("SKILLS\nAvoid:left\n")
    with pytest.raises(SocialmindError, match=r"Collect\.layout:2: found 'Avoid:left'"):
        opened(collect)
    with pytest.raises(SocialmindError, match="two whole numbers"):
        checked_shape({**EMPTY, "sensors": [{"id": "s", "name": "E", "kind": "prox", "fields": [],
                                             "position": [1, 2.5]}]})  # fmt: skip


@pytest.mark.parametrize(
    ("change", "said"),
    [
        (lambda d: skill(d, "Avoid")["inputs"].append("SE:NONE"), "unknown sensor"),
        (lambda d: skill(d, "Avoid")["outputs"].append("SK:Collect"), "influences itself"),
        (lambda d: skill(d, "Avoid")["lines"].append("LAYERS:many"), "LAYERS"),
        (lambda d: skill(d, "Avoid").update(name="a:b"), "name"),
        (lambda d: skill(d, "Avoid").update(name="GoToObject"), "a second skill"),
        (lambda d: d["actuators"][0].update(fields=["2"]), "0 … 1"),
        (lambda d: d["variables"][0].update(kind="Variable"), "VariableModule"),
        (lambda d: skill(d, "ClawControl").update(program="x = 1"), "claw_control"),
        (lambda d: d["sensors"].append({**d["sensors"][0], "id": "x"}), "a second sensor"),
        (lambda d: d["sensors"][0].update(kind="a\nb"), "control"),
    ],
)
def test_what_is_wrong_is_said_where_it_is_and_not_saved(collect, change, said):
    before = tree_of(collect)
    document = opened(collect)
    change(document)
    found = checked(document, collect, opened(collect))
    wrong = [one for one in found.findings if one["wrong"]]
    assert any(said in one["text"] for one in wrong), wrong
    assert all(one["at"] for one in wrong)
    with pytest.raises(SocialmindError, match="not saved"):
        saved(document, collect, collect)
    assert tree_of(collect) == before


@pytest.mark.parametrize("name", ["../evil", "/tmp/evil", "a\\b", "..", "", "a:b", " a", "a\nb"])
def test_no_name_leads_out_of_the_folder(name, collect, tmp_path):
    with pytest.raises(SocialmindError, match=r"not saved: .* as the name of the mind"):
        saved({**EMPTY, "name": name}, tmp_path / "new", None)
    document = opened(collect)
    skill(document, "Collect")["name"] = name
    with pytest.raises(SocialmindError, match=r"not saved: .* as the name of a skill"):
        saved(document, collect, collect)
    assert sorted(one.name for one in tmp_path.iterdir()) == ["mind"]


def test_the_linter_speaks_where_its_findings_belong(collect):
    document = opened(collect)
    extra = {"id": "new", "name": "EXTRA", "kind": "prox", "fields": [], "position": None}
    document["sensors"].append(extra)
    found = checked(document, collect, opened(collect))
    assert {
        "at": "new",
        "wrong": False,
        "text": "unused sensor: no skill reads it",
    } in found.findings


def test_an_empty_document_is_a_mind_with_nothing():
    assert checked(checked_shape(EMPTY), None).findings == []


def test_lines_that_stay_are_as_they_were_written():
    old = b"\xef\xbb\xbfSENSORS\r\n\r\n# left\r\nS1 : prox  # near\r\nS2:prox\r\nACTUATORS\r\n"
    assert patched(old, ["SENSORS", "S1:prox", "S2:prox", "ACTUATORS"]) == old
    new = patched(old, ["SENSORS", "S1:prox", "S3:far", "ACTUATORS", "M:wheel"])
    assert new == old.replace(b"S2:prox", b"S3:far") + b"M:wheel\r\n"


TEXTS = st.lists(st.sampled_from(["a:1", "b", "c:2:3", "", "# said", "d # note"]), max_size=8)
SAID = st.lists(st.sampled_from(["a:1", "b", "c:2:3", "d", "e:5"]), max_size=8)


@given(TEXTS, SAID)
def test_a_patched_file_says_what_it_is_to_say(old, new):
    text = patched("".join(f"{one}\n" for one in old).encode(), new).decode()
    assert [one.text for one in Lines(text, "x").rest()] == new
    for comment in ("# said",):
        assert text.count(comment) <= old.count(comment)
