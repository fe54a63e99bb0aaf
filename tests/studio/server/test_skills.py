"""The room of skills opens, checks and saves minds, and reads and writes nowhere else."""

import asyncio
import json
import shutil

import pytest
from starlette.applications import Starlette

from socialmind.sources.folders import model_folder
from socialmind.studio.server import skills
from socialmind.studio.server.folders import Folders
from socialmind.studio.server.skills import WITH_PROGRAMS
from socialmind.studio.skills.files import tree_of


@pytest.fixture
def room(tmp_path):
    shutil.copytree(model_folder("collect") / "mind", tmp_path / "robot")
    folders = Folders(tmp_path, readable=(model_folder("collect"),))
    app = Starlette(routes=skills.routes(folders))

    def ask(what, asked=None):
        sent = []
        body = b"" if asked is None else json.dumps(asked).encode()

        async def receive():
            return {"type": "http.request", "body": body, "more_body": False}

        async def send(message):
            sent.append(message)

        scope = {
            "type": "http", "method": "GET" if asked is None else "POST",
            "path": f"/api/skills/{what}", "query_string": b"", "headers": [],
        }  # fmt: skip
        asyncio.run(app(scope, receive, send))
        return sent[0]["status"], json.loads(sent[1]["body"])

    return ask


def test_it_lists_the_minds_below_and_those_of_models(room, tmp_path):
    (tmp_path / "run").mkdir()
    (tmp_path / "run" / "manifest.json").write_text("{}")
    shutil.copytree(tmp_path / "robot", tmp_path / "run" / "minds" / "robots")
    shutil.copytree(tmp_path / "robot", tmp_path / "run" / "mind-attempt-1")
    (tmp_path / "other.yaml").write_text("name: x\ncognitons: []\n")
    status, said = room("files")
    assert (status, said["files"]) == (200, ["robot", "run/mind-attempt-1"])
    assert "collect: mind" in said["models"]


def test_a_mind_is_opened_checked_saved_and_found_changed(room, tmp_path):
    _, found = room("open", {"file": "robot"})
    assert found["writable"]
    status, said = room("check", {"document": found["document"], "base": found["base"]})
    assert (status, said["findings"], said["masters"]) == (200, [], ["Collect"])
    document = {**found["document"], "sensors": found["document"]["sensors"][::-1]}
    asked = {"document": document, "base": found["base"], "file": "robot"}
    status, said = room("save", asked)
    assert status == 200
    assert said["base"]["sha256"] != found["base"]["sha256"]
    # What another program writes in the meantime is not lost unasked.
    status, said = room("save", asked)
    assert (status, said["exists"]) == (400, True)
    assert "changed by another program" in said["error"]
    assert room("save", {**asked, "replace": True})[0] == 200


def test_the_mind_of_a_model_is_saved_elsewhere(room, tmp_path):
    mind = model_folder("collect") / "mind"
    _, found = room("open", {"file": str(mind)})
    assert not found["writable"]
    asked = {"document": found["document"], "base": found["base"], "file": str(mind)}
    assert room("save", asked)[0] == 400
    assert room("save", {**asked, "file": "minds/mine"})[0] == 200
    assert tree_of(tmp_path / "minds" / "mine") == tree_of(mind)


def test_a_folder_that_holds_something_else_is_left_alone(room, tmp_path):
    (tmp_path / "notes").mkdir()
    (tmp_path / "notes" / "a.txt").write_text("mine")
    _, found = room("open", {"file": "robot"})
    asked = {"document": found["document"], "base": found["base"], "file": "notes"}
    assert room("save", asked)[1]["exists"]
    status, said = room("save", {**asked, "replace": True})
    assert (status, "something else" in said["error"]) == (400, True)
    assert [one.name for one in (tmp_path / "notes").iterdir()] == ["a.txt"]


@pytest.mark.parametrize(
    ("what", "asked"),
    [
        ("open", {"file": "../elsewhere"}),
        ("open", {"file": "/etc"}),
        ("open", {"file": "nowhere"}),
        ("open", []),
        ("check", {"document": None}),
        ("check", {"document": {"name": "x"}}),
        ("check", {"document": {"name": "x", "sensors": [1]}}),
        ("save", {"document": None, "file": "x"}),
        ("save", {"file": "/etc/mind"}),
        ("save", {}),
    ],
)
def test_what_cannot_be_is_refused_in_a_sentence(room, what, asked):
    status, said = room(what, asked)
    assert status == 400
    assert said["error"]


def test_programs_are_saved_by_a_path_of_their_own_that_is_guarded(room, tmp_path):
    _, found = room("open", {"file": "robot"})
    skill = next(one for one in found["document"]["skills"] if one["program"] is not None)
    assert "def claw_control" in skill["program"]
    before = tree_of(tmp_path / "robot")
    skill["program"] += "# a word\n"
    asked = {"document": found["document"], "base": found["base"], "file": "robot"}
    status, said = room("save", asked)
    assert (status, said["error"]) == (
        400, "programs were changed; they are saved with the studio's token"
    )  # fmt: skip
    assert tree_of(tmp_path / "robot") == before
    status, said = room("save-with-programs", asked)
    assert (status, said["notes"]) == (200, [])
    assert tree_of(tmp_path / "robot") != before
    assert WITH_PROGRAMS == "/api/skills/save-with-programs"


@pytest.mark.parametrize("was", ["../other", "..", "", "a\\b", 7])
def test_the_folder_of_a_skill_is_one_of_its_mind(room, tmp_path, was):
    _, found = room("open", {"file": "robot"})
    found["document"]["skills"][0]["was"] = was
    for what in ("check", "save", "save-with-programs"):
        asked = {"document": found["document"], "base": found["base"], "file": "robot"}
        status, said = room(what, asked)
        assert (status, "folder" in said["error"]) == (400, True)
