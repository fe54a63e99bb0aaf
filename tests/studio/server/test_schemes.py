"""The routes of the room of schemes: what they open and save, and what they refuse."""

import asyncio
import json
import shutil

import pytest
from starlette.applications import Starlette

from coglogo_py import CognitiveScheme
from socialmind.sources.folders import catalogue
from socialmind.studio.server.folders import Folders
from socialmind.studio.server.schemes import routes


@pytest.fixture
def home(tmp_path):
    home = tmp_path / "home"
    home.mkdir()
    shutil.copy("models/tutorial/scheme.yaml", home / "turtle.yaml")
    (home / "table.yaml").write_text("a: 1\n")
    (tmp_path / "outside.yaml").write_text("name: a\n")
    return home


@pytest.fixture
def client(home):
    folders = Folders(home, readable=tuple(catalogue().values()))
    return Starlette(routes=routes(folders, catalogue))


def answer(client, method, what, body=b""):
    """The status and the data of an answer."""
    scope = {
        "type": "http", "method": method, "path": f"/api/schemes/{what}", "raw_path": b"",
        "query_string": b"", "headers": [], "http_version": "1.1", "scheme": "http",
    }  # fmt: skip
    said = []

    async def receive():
        return {"type": "http.request", "body": body}

    async def send(message):
        said.append(message)

    asyncio.run(client(scope, receive, send))
    return said[0]["status"], json.loads(b"".join(one.get("body", b"") for one in said[1:]))


def ask(client, what, **asked):
    return answer(client, "POST", what, json.dumps(asked).encode())


def test_files_that_hold_schemes_are_listed(client, home):
    (home / "runs").mkdir()
    shutil.copy(home / "turtle.yaml", home / "runs" / "kept.yaml")
    (home / "deep").mkdir()
    (home / "deep" / "herd.cogscheme").write_text("STARTCS\n")
    found = answer(client, "GET", "files")
    assert found == (200, {"files": ["deep/herd.cogscheme", "turtle.yaml"]})


def test_a_file_saved_unchanged_is_not_touched(client, home):
    before = (home / "turtle.yaml").read_bytes(), (home / "turtle.yaml").stat().st_mtime_ns
    _, found = ask(client, "open", file="turtle.yaml")
    assert found["writable"]
    status, _ = ask(
        client, "save", document=found["document"], file="turtle.yaml", base=found["base"]
    )
    assert status == 200
    assert (
        (home / "turtle.yaml").read_bytes(),
        (home / "turtle.yaml").stat().st_mtime_ns,
    ) == before


def test_a_change_is_saved_twice_and_comments_stay(client, home):
    _, found = ask(client, "open", file="turtle.yaml")
    document, base = found["document"], found["base"]
    text = (home / "turtle.yaml").read_text()
    for value, name in ((2.0, "turtle.yaml"), (3.0, "turtle.yaml"), (3.0, "new/other.yaml")):
        document["cognitons"][1]["start"] = value
        status, saved = ask(client, "save", document=document, file=name, base=base)
        assert (status, saved["notes"]) == (200, [])
        base = saved["base"]
        assert (home / name).read_text() == text.replace("start: 1", f"start: {value:.0f}")


def test_a_file_of_somebody_else_is_not_overwritten_unasked(client, home):
    _, found = ask(client, "open")
    assert found["document"]["cognitons"] == []
    asked = {"document": found["document"], "file": "turtle.yaml", "base": found["base"]}
    status, said = ask(client, "save", **asked)
    assert (status, said["exists"]) == (400, True)
    assert ask(client, "save", **asked, replace=True)[0] == 200
    assert CognitiveScheme.load(home / "turtle.yaml").name == "scheme"
    _, found = ask(client, "open", file="turtle.yaml")
    (home / "turtle.yaml").write_text("name: meanwhile\n")
    status, said = ask(
        client, "save", document=found["document"], file="turtle.yaml", base=found["base"]
    )
    assert "was changed by another program" in said["error"]


def test_a_models_scheme_is_opened_and_belongs_to_the_model(client):
    assert ask(client, "populations", model="wolf_cow")[1] == {"populations": ["cows", "wolves"]}
    _, found = ask(client, "open", model="tutorial", population="turtles")
    assert found["document"]["name"] == "turtles"
    assert not found["writable"]


def test_a_running_scheme_has_the_identities_of_its_models_file(client):
    _, own = ask(client, "open", model="tutorial", population="turtles")
    running = own["document"] | {"cognitons": own["document"]["cognitons"][::-1]}
    ids = {one["id"]: f"x{one['id']}" for one in running["cognitons"]}
    running = running | {
        "cognitons": [one | {"id": ids[one["id"]]} for one in running["cognitons"]]
    }
    _, found = ask(client, "open", model="tutorial", population="turtles", running=running)
    assert [one["id"] for one in found["document"]["cognitons"]] == ["c2", "c1", "c0"]
    assert found["base"]["text"].startswith("# The turtle")


def test_checking_tells_findings_plans_without_rules_and_makers(client):
    _, found = ask(client, "open", model="tutorial", population="turtles")
    document = found["document"]
    document["plans"].append({"id": "n", "name": "dance", "position": None, "listed": True})
    _, said = ask(client, "check", document=document, model="tutorial", population="turtles")
    assert said["unruled"] == ["n"]
    assert {one["at"] for one in said["findings"]} == {"n"}
    assert "WeightedStochastic" in said["makers"]


@pytest.mark.parametrize(
    ("what", "asked"),
    [
        ("open", {"file": "../outside.yaml"}),
        ("open", {"file": "/etc/passwd"}),
        ("open", {"file": "nowhere.yaml"}),
        ("open", {"file": "table.yaml"}),
        ("open", {"model": "/tmp/evil", "population": "x"}),
        ("open", {"model": "tutorial", "population": "sheep"}),
        ("populations", {"model": ["tutorial"]}),
        ("save", {"file": "../outside.yaml", "document": {}}),
        ("save", {"file": "a.txt", "document": {}}),
        ("save", {"file": "a.yaml", "document": {"name": "a"}}),
        ("save", {"document": {}}),
    ],
)
def test_what_cannot_be_is_refused_in_a_sentence(client, home, what, asked):
    status, said = ask(client, what, **asked)
    assert status == 400
    assert said["error"] and "\n" not in said["error"] and "Traceback" not in said["error"]
    assert not (home / "a.yaml").exists()


@pytest.mark.parametrize("body", [b"[1]", b"{", b"\xff"])
def test_nonsense_is_refused_too(client, body):
    assert answer(client, "POST", "open", body)[0] == 400
