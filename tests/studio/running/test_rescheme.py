"""A scheme edited while a society runs reaches the living minds, and the capsule repeats it."""

import copy

import pytest

from coglogo_py import CognitiveScheme
from socialmind.catalogue import load_model
from socialmind.experiments import Run, replay, run
from socialmind.interventions.change import Change
from socialmind.interventions.following import advanced
from tests.studio.running.test_stage import Told

OWN = CognitiveScheme.load("models/tutorial/scheme.yaml")


@pytest.fixture
def stage():
    made = Told()
    made.do({"do": "setup", "model": "tutorial", "seed": 4, "parameters": {"n_turtles": 5}})
    return made


def schemes(stage):
    """The document of the turtles' scheme, as it was last told; one's own to change."""
    told = [one for one in stage.heard.said if "schemes" in one]
    return copy.deepcopy(told[-1]["schemes"]["turtles"])


def rescheme(stage, document):
    stage.do({"do": "rescheme", "population": "turtles", "document": document, "token": 7})


def test_a_weight_takes_effect_at_the_next_tick_and_is_replayed(stage, tmp_path):
    stage.do({"do": "step", "ticks": 30})
    document = schemes(stage)
    document["cognitons"][2]["reinforcement"][0][1] = 0.5
    rescheme(stage, document)
    assert stage.heard.last("changed")["token"] == 7
    stage.do({"do": "step", "ticks": 200})
    stage.do({"do": "save", "folder": str(tmp_path / "kept")})
    kept = Run(tmp_path / "kept")
    assert [one["tick"] for one in kept.manifest.interventions] == [30]
    assert replay(tmp_path / "kept").equal
    # It is the change that `branch --scheme` makes.
    green = OWN.cognitons[2]
    links = dict(green.reinforcement) | {"goto-red": 0.5}
    other = CognitiveScheme(
        OWN.name,
        (*OWN.cognitons[:2], type(green)(**{**vars_of(green), "reinforcement": links})),
        plan_order=OWN.plans,
    )
    society = load_model("tutorial")(seed=4, n_turtles=5)
    society = advanced(society, 230, [Change(30, {}, {"turtles": other})])
    assert society.visits == kept.series["visits"].iloc[-1]


def vars_of(cogniton):
    return {name: getattr(cogniton, name) for name in type(cogniton).__dataclass_fields__}


def test_cognitons_come_and_go_by_name_and_undo_is_a_change_too(stage, tmp_path):
    first = schemes(stage)
    stage.do({"do": "step", "ticks": 20})
    values = [one.mind.get_cogniton_value("wantGreen") for one in stage.run.society.turtles]
    more = copy.deepcopy(first)
    more["cognitons"].append({**first["cognitons"][0], "id": "n", "name": "Hope", "start": 3.0})
    rescheme(stage, more)
    society = stage.run.society
    assert [one.mind.get_cogniton_value("Hope") for one in society.turtles] == [3.0] * 5
    assert [one.mind.get_cogniton_value("wantGreen") for one in society.turtles] == values
    stage.do({"do": "step", "ticks": 20})
    rescheme(stage, first)
    assert "Hope" not in stage.run.society.turtles[0].mind.cognitons()
    stage.do({"do": "step", "ticks": 20})
    stage.do({"do": "save", "folder": str(tmp_path / "kept")})
    assert len(Run(tmp_path / "kept").manifest.interventions) == 2
    assert replay(tmp_path / "kept").equal


def test_what_is_moved_or_coloured_is_no_change(stage):
    document = schemes(stage)
    document["cognitons"][0]["position"] = [100, 3]
    document["cognitons"][1]["colour"] = "#000000"
    rescheme(stage, document)
    assert stage.run.interventions == []


def test_a_plan_without_a_rule_is_left_out_and_nobody_chooses_it(stage):
    document = schemes(stage)
    document["plans"].append({"id": "n", "name": "dance", "position": None, "listed": True})
    document["cognitons"][0]["conditional"].append("n")
    document["cognitons"][0]["influence"].append(["n", 1000.0])
    rescheme(stage, document)
    assert stage.run.interventions == []  # without it, the scheme is the one before
    document["cognitons"][0]["influence"][0][1] = 2.0
    rescheme(stage, document)
    stage.do({"do": "step", "ticks": 5})
    assert stage.run.society.schemes["turtles"].plans == OWN.plans


def test_a_deleted_plan_is_carried_out_until_the_next_decision_and_never_again(stage, tmp_path):
    stage.do({"do": "step", "ticks": 3})
    society = stage.run.society
    assert {one.plan for one in society.turtles} == {"goto-blue"}
    document = schemes(stage)
    document["plans"] = [one for one in document["plans"] if one["name"] != "goto-blue"]
    for one in document["cognitons"]:
        for field in ("influence", "reinforcement"):
            one[field] = [link for link in one[field] if link[0] != "p1"]
        one["conditional"] = [plan for plan in one["conditional"] if plan != "p1"]
    rescheme(stage, document)
    society = stage.run.society
    assert {one.plan for one in society.turtles} == {"goto-blue"}
    for _ in range(20):
        stage.do({"do": "step"})
        assert "goto-blue" not in {one.plan for one in stage.run.society.turtles}
    stage.do({"do": "save", "folder": str(tmp_path / "kept")})
    assert replay(tmp_path / "kept").equal


def test_what_does_not_fit_is_said_and_the_society_goes_on(stage):
    stage.do({"do": "go"})
    document = schemes(stage)
    document["cognitons"][0]["name"] = "other"
    rescheme(stage, document)
    said = stage.heard.last("unfit")
    assert said["token"] == 7
    assert "'wantRed'" in said["text"]
    assert stage.running
    rescheme(stage, {"nonsense": 1})
    assert "no document" in stage.heard.last("unfit")["text"]
    assert stage.running


def test_a_society_gone_back_behind_a_change_tells_the_scheme_of_then(stage):
    first = schemes(stage)
    stage.do({"do": "step", "ticks": 10})
    changed = copy.deepcopy(first)
    changed["cognitons"][0]["start"] = 9.0
    rescheme(stage, changed)
    stage.do({"do": "step", "ticks": 10})
    stage.do({"do": "go_to", "tick": 5})
    stage.do({"do": "seen"})
    stage._next_frame = 0.0
    stage.go_on()
    assert schemes(stage)["cognitons"][0]["start"] == 0.0


def test_a_model_is_set_up_with_an_edited_scheme(stage, tmp_path):
    document = schemes(stage)
    document["cognitons"][2]["influence"][0][1] = 40.0
    stage.do({"do": "setup", "model": "tutorial", "seed": 2, "documents": {"turtles": document}})
    stage.do({"do": "step", "ticks": 100})
    stage.do({"do": "save", "folder": str(tmp_path / "kept")})
    file = tmp_path / "other.yaml"
    stage.run.society.schemes["turtles"].save(file)
    told = run(load_model("tutorial"), 100, 2, scheme=file, out=tmp_path / "told", progress=False)
    assert Run(tmp_path / "kept").series.equals(Run(told).series)
    assert replay(tmp_path / "kept").equal
