"""The room of trainings answers, and begins, resumes and pauses nothing that it should not."""

import asyncio
import json

import pytest
from starlette.applications import Starlette

from socialmind.studio.server import learning
from socialmind.studio.server.folders import Folders


class Noted:
    """What would have been begun, resumed and paused."""

    def __init__(self):
        self.done = []

    def begin(self, model, options):
        self.done.append((model, options))
        return self.home / "trainings" / f"{model}-001"

    def resume(self, folder):
        self.done.append(("resume", folder))

    def pause(self, folder):
        self.done.append(("pause", folder))

    def told(self, folder):
        return {"here": False, "pausing": False, "failure": None}

    def begun(self):
        return []


@pytest.fixture
def room(tmp_path):
    noted = Noted()
    noted.home = tmp_path
    app = Starlette(routes=learning.routes(Folders(tmp_path), noted))

    def ask(path, asked=None):
        sent, (place, _, query) = [], path.partition("?")
        body = b"" if asked is None else json.dumps(asked).encode()

        async def receive():
            return {"type": "http.request", "body": body, "more_body": False}

        async def send(message):
            sent.append(message)

        scope = {
            "type": "http", "method": "GET" if asked is None else "POST", "path": place,
            "query_string": query.encode(), "headers": [],
        }  # fmt: skip
        asyncio.run(app(scope, receive, send))
        return sent[0]["status"], json.loads(sent[1]["body"])

    ask.noted = noted
    return ask


def test_where_there_is_none_it_says_where_it_looked_and_what_can_learn(room, tmp_path):
    status, said = room("/api/learning")
    assert (status, said["trainings"], said["home"]) == (200, [], str(tmp_path))
    assert "collect" in said["models"]
    assert "farmer_artisan" not in said["models"]


def test_a_folder_that_is_none_is_said_to_be_none(room, tmp_path):
    (tmp_path / "empty").mkdir()
    status, said = room("/api/learning/training?folder=empty")
    assert (status, said["status"]) == (200, "broken")
    assert "not a training's folder" in said["error"]


@pytest.mark.parametrize(
    "path",
    ["training?folder=../x", "training?folder=/etc", "training", "training?folder=.&known=-1"],
)
def test_what_lies_elsewhere_is_not_read(room, path):
    status, said = room(f"/api/learning/{path}")
    assert status == 400
    assert said["error"]


def test_a_training_is_begun_with_what_the_command_line_takes(room):
    asked = {"model": "collect", "attempts": 3, "seed": 0, "lesson": "Avoid", "generations": ""}
    assert room("/api/learning/begin", asked)[1] == {"folder": "trainings/collect-001"}
    ((model, options),) = room.noted.done
    assert model == "collect"
    assert options == {"attempts": 3, "seed": 0, "generations": None, "lesson": "Avoid"}


@pytest.mark.parametrize(
    ("path", "asked"),
    [
        ("begin", {"model": "/tmp/evil"}),
        ("begin", {"model": "collect", "attempts": 0}),
        ("begin", {"model": "collect", "attempts": "--trust"}),
        ("begin", {"model": "collect", "seed": True}),
        ("begin", {"model": "collect", "lesson": "/etc/x.simbatch"}),
        ("begin", []),
        ("resume", {"folder": "../elsewhere"}),
        ("resume", {}),
        ("pause", {"folder": "/etc"}),
    ],
)
def test_nothing_else_is(room, path, asked):
    status, said = room(f"/api/learning/{path}", asked)
    assert status == 400
    assert said["error"]
    assert room.noted.done == []
