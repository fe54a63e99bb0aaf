"""Tutorials want what their models need, step by step, and say what is missing or too much."""

import copy

import pytest

from coglogo_py import CognitiveScheme
from socialmind.errors import SocialmindError
from socialmind.sources.folders import model_folder
from socialmind.studio.schemes.document import EMPTY, document_of, scheme_of
from socialmind.studio.server.first_hour import TUTORIALS, missing, shown
from socialmind.studio.skills.document import EMPTY as EMPTY_MIND
from socialmind.studio.tutorials.goals import Called, Cogniton, Decides, Link, Plan
from socialmind.studio.tutorials.mind_goals import Module, Plain, Wired
from socialmind.studio.tutorials.turtle import TURTLE
from socialmind.studio.tutorials.vehicle import VEHICLE


def built(goals):
    """A document that meets some goals and holds nothing else."""
    if any(isinstance(one, Module) for one in goals):
        return built_mind(goals)
    made = copy.deepcopy(EMPTY)
    cognitons = {}
    for one in goals:
        match one:
            case Called(name):
                made["name"] = name
            case Decides(maker):
                made["decision_maker"]["name"] = maker
            case Plan(name):
                made["plans"].append({"id": name, "name": name, "position": None, "listed": True})
            case Cogniton(name, start):
                whole = document_of(CognitiveScheme("one", (_cogniton(name, start),)))
                cognitons[name] = {**whole["cognitons"][0], "id": f"c {name}"}
    for one in goals:
        if isinstance(one, Link):
            to = one.plan if one.weight is None else [one.plan, one.weight]
            cognitons[one.cogniton][one.kind].append(to)
    made["cognitons"] = list(cognitons.values())
    return made


def built_mind(goals):
    made = copy.deepcopy(EMPTY_MIND)
    for one in goals:
        if isinstance(one, Module):
            links = {"inputs": [], "outputs": [], "function": "neural", "lines": []}
            made[one.what].append({"id": one.name, "name": one.name, **links})
    skills = {one["name"]: one for one in made["skills"]}
    for one in goals:
        if isinstance(one, Plain):
            skills[one.skill]["lines"] = ["TYPE:BASIC", "layers:0"]
        elif isinstance(one, Wired):
            skills[one.skill] |= {"inputs": [f"SE:{one.sensor}"], "outputs": [f"MO:{one.motor}"]}
    return made


def _cogniton(name, start):
    from coglogo_py import Cogniton as Real

    return Real(name, start_value=start)


@pytest.fixture(params=list(TUTORIALS.values()), ids=lambda one: one.word)
def tutorial(request):
    return request.param


def test_each_step_is_done_by_its_goals_and_not_before(tutorial):
    before = copy.deepcopy(EMPTY_MIND if tutorial is VEHICLE else EMPTY)
    for number, step in enumerate(tutorial.steps):
        assert (tutorial.missing(before, number) != []) == bool(step.goals), step.title
        before = built(tutorial.goals_of(number))
        assert tutorial.missing(before, number) == [], step.title


def test_what_is_left_out_is_told(tutorial):
    last = len(tutorial.steps) - 1
    whole = tutorial.goals_of(last)
    for goal in whole:
        if isinstance(goal, Link | Plain | Wired):
            said = tutorial.missing(built([one for one in whole if one != goal]), last)
            assert len(said) == 1
            assert (goal.plan if isinstance(goal, Link) else goal.skill) in said[0]


def test_slips_are_told():
    document = built(TURTLE.goals_of(3))
    assert TURTLE.missing(document, 3) == []
    document["cognitons"][0]["influence"][1][1] = 1.0
    assert TURTLE.missing(document, 3) == [
        "The influence link from wantRed to goto-blue weighs 1: let it weigh -1."
    ]
    document["cognitons"][0]["influence"][1][1] = -1.0
    document["cognitons"][0]["conditional"].append("goto-blue")
    document["plans"].append({"id": "p", "name": "plan", "position": None, "listed": True})
    assert TURTLE.missing(document, 3) == [
        "The plan 'plan' is not wanted here: delete or rename it.",
        "The conditional link between wantRed and goto-blue is not wanted here: delete it.",
    ]
    document = built(TURTLE.goals_of(2))
    document["cognitons"][0]["starting"] = False
    assert TURTLE.missing(document, 2) == ["wantRed is not there at birth: tick 'at birth'."]


def test_who_is_ahead_is_not_held_back():
    assert TURTLE.missing(built(TURTLE.goals_of(7)), 1) == []


def test_the_turtles_mind_is_that_of_the_model():
    own = CognitiveScheme.load(model_folder("tutorial") / "scheme.yaml")
    made = scheme_of(built(TURTLE.goals_of(8)))
    assert made.name == own.name and made.plans == own.plans
    for one, other in zip(made.cognitons, own.cognitons, strict=True):
        assert (one.name, one.start_value, one.starting) == (
            other.name, other.start_value, other.starting
        )  # fmt: skip
        for links in ("influence", "conditional", "reinforcement"):
            assert dict.fromkeys(getattr(one, links)) == dict.fromkeys(getattr(other, links))
    assert missing({"tutorial": "turtle", "step": 8, "document": document_of(own)}) == {
        "missing": []
    }


def test_two_minds_are_shown_in_the_same_world():
    two = TUTORIALS["two-minds"]
    same = shown({"tutorial": "two-minds", "document": built(two.goals_of(0))})
    assert same["courses"][0] == same["courses"][1] and same["ticks"][-1] == 1000
    sooner = shown({"tutorial": "two-minds", "document": built(two.goals_of(1))})["courses"]
    # The page asks whether it is four times as often, and says that it is not.
    assert sooner[1][-1] < sooner[0][-1] < 4 * sooner[1][-1]
    alone = shown({"tutorial": "turtle", "document": built(TURTLE.goals_of(8))})
    assert alone["courses"] == [same["courses"][0]]


def test_straight_wires_flee_and_crossed_ones_seek():
    straight = shown({"tutorial": "vehicle", "document": built(VEHICLE.goals_of(2))})
    crossed = shown({"tutorial": "vehicle", "document": built(VEHICLE.goals_of(3))})
    assert crossed["names"] == ["your mind", "straight wires"]
    assert crossed["courses"][1] == straight["courses"][0]
    assert straight["courses"][0][0] == crossed["courses"][0][0]
    assert straight["courses"][0][-1] > 10 and crossed["courses"][0][-1] < 1


def test_slips_of_wires_are_told():
    document = built(VEHICLE.goals_of(3))
    document["skills"][0]["outputs"].insert(0, "MO:WHEEL_LEFT")
    assert VEHICLE.missing(document, 3) == [
        "LeftWire is to command WHEEL_RIGHT alone: take MO:WHEEL_LEFT out."
    ]
    document["skills"][1]["lines"] = ["TYPE:BASIC", "LAYERS:2"]
    assert VEHICLE.missing(document, 3)[0] == "RightWire has hidden layers: let it have 0."
    document["skills"][1]["function"] = "hardCoded"
    document["sensors"].append({"id": "S1", "name": "S1"})
    assert VEHICLE.missing(document, 3)[0].startswith("Inside RightWire is to be a perceptron")
    assert VEHICLE.missing(document, 3)[-1] == (
        "The sensor 'S1' is not wanted here: delete or rename it."
    )


def test_an_unfinished_mind_is_not_run():
    with pytest.raises(Exception, match=r"wantRed|goto"):
        shown({"tutorial": "turtle", "document": built(TURTLE.goals_of(1))})
    with pytest.raises(SocialmindError, match="LeftWire is no wire"):
        shown({"tutorial": "vehicle", "document": built(VEHICLE.goals_of(1))})
    with pytest.raises(SocialmindError, match="no tutorial 'other'; turtle, vehicle"):
        missing({"tutorial": "other", "step": 0, "document": EMPTY})
