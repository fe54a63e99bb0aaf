"""What is wrong or odd is told at the part where it stands, and what cannot be run is left out."""

import pytest

from coglogo_py import CognitiveScheme, Cogniton, Culturon, Group, Role
from socialmind.catalogue import load_model
from socialmind.errors import SocialmindError
from socialmind.studio.schemes.checking import Bearers, checked, continued, runnable
from socialmind.studio.schemes.document import document_of, scheme_of


@pytest.fixture(scope="module")
def turtles():
    return Bearers.of(load_model("tutorial"), "turtles")


@pytest.fixture
def document():
    return document_of(CognitiveScheme.load("models/tutorial/scheme.yaml"))


def with_dance(document):
    document["plans"].append({"id": "n", "name": "dance", "position": None, "listed": True})
    document["cognitons"][0]["conditional"].append("n")
    document["cognitons"][0]["influence"].append(["n", 50.0])
    return document


def test_the_models_own_scheme_has_nothing_odd(document, turtles):
    found = checked(document, turtles)
    assert (found.wrong, found.odd, found.unruled) == ([], [], [])
    assert found.scheme == scheme_of(document)


def test_findings_of_the_linter_stand_at_their_parts(document):
    document["cognitons"][2]["conditional"] = []
    document["cognitons"][0]["type"] = "trait"
    document["cognitons"][0]["reinforcement"] = [["p0", 1.0]]
    said = {one.at: one.text for one in checked(document).odd}
    assert said["p2"].startswith("plan 'goto-green': no conditional link")
    assert said["c0"].startswith("trait 'wantRed': feed-back from 'goto-red'")


def test_an_error_is_told_at_its_part_in_a_sentence(document):
    document["cognitons"][1]["name"] = "wantRed"
    document["cognitons"][2]["chance"] = 3
    said = {one.at: one.text for one in checked(document).wrong}
    assert said["c1"] == "another cogniton is called 'wantRed'; rename one"
    assert "found 3 as chance of cogniton 'wantGreen'; expected a number, 0 … 1" in said["c2"]


def test_several_errors_are_told_at_once_and_nesting_at_its_group():
    groups = [
        {"id": g, "name": g, "attributes": [], "culturons": [], "position": None,
         "within": [o, f"{o}r"],
         "roles": [{"id": f"{g}r", "name": "r", "position": None, "culturons": []}]}
        for g, o in (("a", "b"), ("b", "a"))
    ]  # fmt: skip
    found = checked({**document_of(CognitiveScheme("x")), "groups": groups})
    assert found.wrong[0].at in ("a", "b")
    assert "groups within each other" in found.wrong[0].text


@pytest.mark.parametrize("damaged", [{}, {"name": 3}, {"plans": None}, {"cognitons": [{}]}])
def test_what_is_no_document_is_said_and_no_traceback(document, damaged):
    found = checked({**document, **damaged} if damaged else {})
    assert found.scheme is None
    assert found.wrong


def test_a_plan_without_a_rule_is_marked_and_not_run(document, turtles):
    found = checked(with_dance(document), turtles)
    assert found.unruled == ["n"]
    assert "tutorial has no rule of this name" in {one.at: one.text for one in found.odd}["n"]
    left = runnable(found.scheme, turtles)
    assert left == CognitiveScheme.load("models/tutorial/scheme.yaml")


def test_plans_that_have_rules_run_as_they_are(document, turtles):
    scheme = scheme_of(document)
    assert runnable(scheme, turtles) is scheme


def test_what_the_rules_name_must_be_there(document, turtles):
    document["cognitons"][0]["name"] = "wantCrimson"
    found = checked(document, turtles)
    assert any("'wantRed'" in one.text and one.at is None for one in found.odd)


def test_conditions_on_what_agents_lack_stand_at_the_cogniton(document, turtles):
    document["cognitons"][0]["active_while"] = ["energy < 5"]
    said = {one.at: one.text for one in checked(document, turtles).odd}
    assert "'energy' in the condition" in said["c0"]


def test_populations_without_minds_are_refused():
    with pytest.raises(SocialmindError, match="populations with schemes: none"):
        Bearers.of(load_model("schelling"), "people")


def test_groups_and_roles_that_are_deleted_stay_without_effect():
    trust = Culturon("trust", influence={"lead": 1.0})
    herd = Group(
        "herd", (Role("leader", (trust,)), Role("follower", (trust,))), within=("clan", "elder")
    )
    clan = Group("clan", (Role("elder"), Role("young")))
    mood = Cogniton("mood", influence={"rest": 1.0})
    before = CognitiveScheme("cows", (mood,), (herd, clan))
    left = CognitiveScheme("cows", (mood,), (Group("clan", (Role("young", (trust,)),)),))
    found = continued(left, before)
    assert found.groups == (
        Group("clan", (Role("young", (trust,)), Role("elder"))),
        Group("herd", (Role("leader"), Role("follower")), within=("clan", "elder")),
    )
    assert found.plans == ("rest", "lead")
    assert continued(before, before) == before
