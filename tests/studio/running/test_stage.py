"""A stage does what it is told, says what is wrong, and never sends a frame unasked."""

import json

import pytest

from socialmind.catalogue import load_model
from socialmind.studio.running.frames import unpacked
from socialmind.studio.running.performing import obey
from socialmind.studio.running.stage import FRAME, Stage


class Heard:
    """What a stage has sent."""

    def __init__(self):
        self.said, self.frames = [], []

    def __call__(self, message):
        if message[:1] == FRAME:
            self.frames.append(unpacked(message[1:])[0])
        else:
            self.said.append(json.loads(message[1:]))

    def last(self, what):
        return next(one for one in reversed(self.said) if one["said"] == what)


class Told(Stage):
    """A stage that can be told something."""

    def __init__(self):
        self.heard = Heard()
        super().__init__(self.heard)

    def do(self, command):
        obey(self, command)


@pytest.fixture
def stage():
    made = Told()
    made.do({"do": "setup", "model": "farmer_artisan", "seed": 4, "parameters": {"n_agents": 7}})
    return made


def seen(stage):
    stage._next_frame = 0.0
    stage.do({"do": "seen"})
    stage.go_on()
    return stage.heard.frames[-1]


def test_it_is_the_run_of_the_command_line(stage):
    stage.do({"do": "step", "ticks": 500})
    society = load_model("farmer_artisan")(seed=4, n_agents=7)
    society.advance(500)
    row = stage.heard.last("row")
    assert row["tick"] == 500
    assert row["wheat"] == society.series()["wheat"]


def test_frames_come_when_they_are_asked_for(stage):
    stage.go_on()
    assert stage.heard.frames == []
    assert seen(stage)["tick"] == 0
    stage.do({"do": "step"})
    stage.go_on()
    assert len(stage.heard.frames) == 1
    assert seen(stage)["tick"] == 1


def test_what_is_wrong_is_said_and_the_society_stands(stage):
    stage.do({"do": "step", "ticks": 10})
    for wrong in (
        {"do": "set", "tool_price": -4},
        {"do": "set", "no_such": 1},
        {"do": "setup", "model": "no_such_model"},
        {"do": "setup", "model": "farmer_artisan", "parameters": {"n_agents": 2.5}},
        {"do": "show", "patches": "no_such"},
        {"do": "dance"},
        {"do": "step", "many": 3},
        {"do": "edit", "population": "humans", "id": 99, "part": "field wheat", "value": 1},
    ):
        count = len(stage.heard.said)
        stage.do(wrong)
        assert any(one["said"] == "error" for one in stage.heard.said[count:])
    assert seen(stage)["tick"] == 10


def test_a_link_is_changed_while_it_runs_and_the_saved_run_replays(stage, tmp_path):
    from socialmind.experiments import replay

    stage.do({"do": "step", "ticks": 100})
    stage.do({"do": "set", "influence.WheatNeed.GrowWheat": 3.0, "tool_price": 90})
    stage.do(
        {"do": "edit", "population": "humans", "id": 2, "part": "cogniton Artisan", "value": 9}
    )
    stage.do({"do": "step", "ticks": 100})
    stage.do({"do": "save", "folder": str(tmp_path / "run")})
    folder = stage.heard.last("saved")["folder"]
    assert replay(folder).equal
    stage.do({"do": "open", "folder": folder})
    stage.do({"do": "go_to", "tick": 200})
    frame = seen(stage)
    assert (frame["tick"], frame["furthest"]) == (200, 200)


def test_a_watched_agent_comes_with_the_frames(stage):
    stage.do({"do": "watch", "population": "humans", "id": 3})
    assert seen(stage)["watched"]["id"] == 3
    stage.do({"do": "watch", "population": "humans", "id": 99})
    assert "99" in seen(stage)["watched"]["gone"]
    stage.do({"do": "watch"})
    assert "watched" not in seen(stage)


def test_an_edit_is_seen_at_once(stage):
    stage.do({"do": "step", "ticks": 50})
    stage.do({"do": "watch", "population": "humans", "id": 3})
    stage.do(
        {"do": "edit", "population": "humans", "id": 3, "part": "cogniton Farmer", "value": 25}
    )
    assert seen(stage)["watched"]["cognitons"]["Farmer"] == 25


def test_what_would_be_decided_is_told_and_nothing_changes(stage):
    stage.do({"do": "step", "ticks": 50})
    edit = {"population": "humans", "id": 3, "part": "cogniton Farmer", "value": 500}
    stage.do({"do": "suppose", **edit})
    said = stage.heard.last("supposed")
    assert said["probabilities"]["GrowWheat"] > 0.8
    assert said["choice"] in said["text"]
    society = load_model("farmer_artisan")(seed=4, n_agents=7)
    society.advance(50)
    assert stage.run.society.series() == society.series()
    assert stage.run.society.humans[3].mind.cognitons() == society.humans[3].mind.cognitons()
    stage.do({"do": "suppose", **edit, "part": "cogniton Famer"})
    assert "Farmer" in stage.heard.last("error")["text"]
    stage.do({"do": "edit", **edit})
    stage.do({"do": "watch", "population": "humans", "id": 3})
    plans = seen(stage)["watched"]["receipt"]["plans"]
    assert said["probabilities"] == {one["name"]: one["probability"] for one in plans}


def test_a_tick_is_gone_through_turn_by_turn(stage):
    stage.do({"do": "step", "ticks": 10})
    stage.do({"do": "turn"})
    frame = seen(stage)
    assert (frame["tick"], frame["turn"]["number"]) == (10, 1)
    stage.do({"do": "turn"})
    assert seen(stage)["turn"]["number"] == 2
    stage.do({"do": "step"})
    frame = seen(stage)
    assert frame["tick"] == 11
    assert "turn" not in frame
    society = load_model("farmer_artisan")(seed=4, n_agents=7)
    society.advance(11)
    assert stage.run.society.series() == society.series()


def test_turns_are_a_speed_too(stage):
    stage.do({"do": "pace", "ticks": "turn"})
    stage.do({"do": "go"})
    seen(stage)
    for _ in range(3):
        stage._next_piece = 0.0
        frame = seen(stage)
    assert (frame["tick"], frame["turn"]["number"], frame["running"]) == (0, 4, True)


def test_saving_says_how_far_it_is(stage, tmp_path):
    stage.do({"do": "step", "ticks": 300})
    stage.do({"do": "save", "folder": str(tmp_path / "run")})
    told = [one["text"] for one in stage.heard.said if one["said"] == "busy"]
    assert told[-1] == "saving: tick 300 of 300"
    stage.do({"do": "copy", "folder": str(tmp_path / "copy")})
    assert stage.heard.last("preparing")["text"] == ""


def test_a_copy_is_opened_where_it_was_taken(stage, tmp_path):
    stage.do({"do": "step", "ticks": 40})
    stage.do({"do": "set", "tool_price": 90})
    stage.do({"do": "copy", "folder": str(tmp_path / "copy")})
    said = stage.heard.last("copied")
    other = Told()
    other.do({"do": "open", **{key: said[key] for key in ("folder", "tick", "source")}})
    assert other.run.tick == 40
    for one in (stage, other):
        one.do({"do": "step", "ticks": 60})
    assert other.run.society.series() == stage.run.society.series()


def test_who_has_died_is_named_with_the_tick(stage):
    stage.do({"do": "setup", "model": "wolves_sheep", "seed": 2})
    stage.do({"do": "watch", "population": "sheep", "id": 0})
    stage.do({"do": "step", "ticks": 1})
    assert seen(stage)["watched"]["id"] == 0
    stage.do({"do": "step", "ticks": 60})
    gone = seen(stage)["watched"]["gone"]
    died = int(gone.split("died at tick ")[1].split(";")[0])
    stage.do({"do": "go_to", "tick": died - 1})
    assert seen(stage)["watched"]["id"] == 0
    stage.do({"do": "press", "button": "Plage"})
    assert "there is Drought" in stage.heard.last("error")["text"]


def test_compiling_is_said_before_the_first_tick(stage):
    stage.do({"do": "go"})
    stage.go_on()
    said = [one["text"] for one in stage.heard.said if one["said"] == "preparing"]
    assert said[:2] == ["compiling the rules", ""]
