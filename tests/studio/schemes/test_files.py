"""Schemes opened, changed and saved: only what changed is another, and comments stay."""

import re
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from coglogo_py import CognitiveScheme, SchemeError
from socialmind.studio.schemes.document import document_of, scheme_of
from socialmind.studio.schemes.files import opened, written
from tests.studio.schemes.edits import ADDING, drag, edited

HERD = """\
# A herd.
name: cows                # by its breed

decision_maker: {name: BiasedWeightedStochastic, bias: 2}
breeds: [cows,  calves]

plans:   # in this order
  - eat
  - look-for-group   # when alone
  - lead
  - follow
plan_positions: {eat: [97, -20], lead: [120, 40]}

cognitons:
  # What it has in store.
  energy:
    at_birth: yes
    start: 50.0
    colour: '#ffff33'
    position: [10, 20]
    influence: {eat: -0.10, lead: 1e-2}   # small
    conditional: [eat]
    reinforcement:
      # Eating feeds.
      eat: 0.5

  # Alone?
  loneliness: {influence: {look-for-group: 1}, conditional: [look-for-group]}

  hunger:
    at_birth: false
    deactivated_when: [energy > full, x == 1]
    conditional:
      - eat
      - lead  # at need
    type: need

# The herd, and the clan around it.
groups:
  herd:
    leader:
      trust:   # of the others
        start: 1
        influence: {lead: 10, follow: 10}
        conditional: [lead]
    follower:
      trust:
      calm:
        influence: {follow: 1}
        conditional: [follow]
  clan: {elder: {peace: {start: 3}}}
group_attributes:
  herd: {milk: 0, land: 2.50}
nested_groups: {herd: {clan: elder}}
# The end.
"""
PLAIN = "name: a\ncognitons:\n    A: {influence: {x: 1}, conditional: [x]}\n    B:\n    C: {}"
TEXTS = {"herd": HERD, "plain": PLAIN, "name alone": "name: nothing"}
TEXTS |= {
    path.parent.name: path.read_text()
    for path in sorted(Path("models").glob("*/scheme.yaml"))
    if path.parent.name in ("farmer_artisan", "tutorial", "civil_norms", "herds")
}


def parsed(text):
    return CognitiveScheme.parsed(text, "a.yaml")


@pytest.mark.parametrize("text", TEXTS.values(), ids=TEXTS)
def test_what_is_saved_unchanged_is_the_same_text(text):
    assert written(document_of(parsed(text)), ".yaml", text, ".yaml").text == text


@settings(max_examples=50)
@given(st.data())
def test_what_was_edited_is_read_again_and_nothing_is_written_anew(data):
    text = data.draw(st.sampled_from(list(TEXTS.values())))
    document = data.draw(edited(document_of(parsed(text))))
    found = written(document, ".yaml", text, ".yaml")
    scheme = scheme_of(document)
    assert found.notes == ()
    assert parsed(found.text) == scheme
    # The names of scheme and parts are the document's, whatever YAML takes such words for.
    assert parsed(found.text).name == document["name"]


@settings(max_examples=50)
@given(st.data())
def test_comments_stay_where_nothing_is_removed(data):
    document = data.draw(edited(document_of(parsed(HERD)), ADDING))
    found = written(document, ".yaml", HERD, ".yaml").text
    comments = re.compile(r"(?<![\\w'\"])# ?[A-Za-z ,?.]+$", re.M)
    wanted = [
        c
        for c in comments.findall(HERD)
        if c not in ("# at need", "# when alone", "# in this order")
    ]
    assert [c for c in comments.findall(found) if c in wanted] == wanted


@settings(max_examples=50)
@given(st.data())
def test_edits_that_are_taken_back_leave_the_text(data):
    before = document_of(parsed(HERD))
    after = data.draw(edited(before))
    assert written(after, ".yaml", HERD, ".yaml").text == HERD or after != before
    assert written(before, ".yaml", HERD, ".yaml").text == HERD


@settings(max_examples=30)
@given(st.data())
def test_what_is_dragged_stands_there_and_dragged_back_the_text_is_as_it_was(data):
    text = data.draw(st.sampled_from(list(TEXTS.values()))).replace("C: {}", "C:") + "\n"
    before = document_of(parsed(text))
    after = data.draw(edited(before, (drag,)))
    found = written(after, ".yaml", text, ".yaml")
    assert found.notes == ()
    assert document_of(parsed(found.text)) == after
    assert written(before, ".yaml", found.text, ".yaml").text == text


def test_a_dragged_group_and_its_roles_are_said_at_the_end():
    document = document_of(parsed(HERD))
    herd = document["groups"][0]
    herd["position"] = [-480, 0]
    herd["roles"][1]["position"] = [-290, 90]
    text = written(document, ".yaml", HERD, ".yaml").text
    end = "# The end.\n"
    lines = "group_positions:\n  herd: [-480, 0]\nrole_positions:\n  herd: {follower: [-290, 90]}\n"
    assert text == HERD.removesuffix(end) + lines + end
    # Renamed, they stay where they are; gone, so is what was said of them.
    herd["name"], herd["roles"][1]["name"] = "flock", "sheep"
    renamed = written(document, ".yaml", text, ".yaml").text
    assert "  flock: {sheep: [-290, 90]}\n" in renamed
    assert document_of(parsed(renamed)) == document_of(scheme_of(document))
    document["groups"] = document["groups"][1:]
    gone = written(document, ".yaml", text, ".yaml").text
    assert not re.search("_positions:.*herd|(group|role)_positions", gone)


def test_one_weight_changes_one_number():
    document = document_of(parsed(HERD))
    document["cognitons"][0]["influence"][0][1] = -0.2
    assert written(document, ".yaml", HERD, ".yaml").text == HERD.replace("eat: -0.10", "eat: -0.2")


def test_a_cogniton_goes_with_its_comment_and_no_other():
    document = document_of(parsed(HERD))
    del document["cognitons"][1]
    gone = HERD[HERD.index("  # Alone?") : HERD.index("  hunger:")]
    text = written(document, ".yaml", HERD, ".yaml").text
    assert text == HERD.replace(gone, "")


def test_lines_keep_their_ends():
    windows = HERD.replace("\n", "\r\n")
    document = document_of(parsed(windows))
    document["cognitons"][0]["start"] = 51.0
    assert written(document, ".yaml", windows, ".yaml").text == windows.replace("50.0", "51")


def test_a_text_with_anchors_is_written_anew_and_that_is_said():
    text = (
        "name: a\ncognitons:\n  A: {influence: &w {x: 1}, conditional: [x]}\n  B: {influence: *w}\n"
    )
    document = document_of(parsed(text))
    document["cognitons"][1]["influence"][0][1] = 2.0
    found = written(document, ".yaml", text, ".yaml")
    assert "comments could not be kept" in found.notes[0]
    assert parsed(found.text) == scheme_of(document)


def test_a_coglogo_file_unchanged_is_the_same_and_changed_keeps_places(tmp_path):
    path = tmp_path / "cows.cogscheme"
    text = (
        "STARTCS\ncows\nMaximumWeight\nPLANPOS\neat=97:-20\nrun=1:2\nBREEDS\nCOG\nhunger\n-256\n"
        "true\n2\n5:6\nINFLUENCE\neat=2\nDEPENDENCY\neat\nENDCS\n"
    )
    path.write_text(text)
    base, document = opened(path)
    assert written(document, ".cogscheme", base, ".cogscheme").text == text
    document["cognitons"][0]["influence"][0][1] = 3.0
    path.write_text(written(document, ".cogscheme", base, ".cogscheme").text)
    scheme = CognitiveScheme.load(path)
    assert scheme.cognitons[0].influence == {"eat": 3.0}
    assert (scheme.cognitons[0].position, scheme.cognitons[0].colour) == ((5, 6), (255, 255, 0))
    assert scheme.plan_positions == {"eat": (97, -20), "run": (1, 2)}


def test_that_coglogos_form_holds_no_places_of_groups_is_said(tmp_path):
    path = tmp_path / "cows.cogscheme"
    path.write_text(
        "STARTCS\ncows\nMaximumWeight\nBREEDS\nCOG\nhunger\n-256\ntrue\n2\nINFLUENCE\neat=2\n"
        "GRP\nherd\nROL\nleader\nCOG\ntrust\n-256\n2\nINFLUENCE\neat=1\nENDCS\n"
    )
    base, document = opened(path)
    (herd,) = document["groups"]
    herd["culturons"][0]["position"] = [7, 8]
    found = written(document, ".cogscheme", base, ".cogscheme")
    assert found.notes == ()
    assert document_of(CognitiveScheme.parsed(found.text, path)) == document
    herd["roles"][0]["position"] = [5, 6]
    told = written(document, ".cogscheme", found.text, ".cogscheme")
    assert told.notes == (
        "CogLogo's form holds no places of groups and roles: they are laid out anew",
    )
    assert told.text == found.text
    assert parsed(written(document, ".yaml").text).groups[0].roles[0].position == (5, 6)


def test_what_coglogos_form_cannot_hold_is_said():
    document = document_of(parsed(HERD))
    with pytest.raises(SchemeError, match=r"save it as \.yaml"):
        written(document, ".cogscheme")
    plain = document_of(parsed(PLAIN))
    plain["plans"].append({"id": "n", "name": "rest", "position": None, "listed": True})
    assert "rest" in written(plain, ".cogscheme").notes[0]


def test_other_files_are_refused(tmp_path):
    (tmp_path / "a.txt").write_text("name: a")
    with pytest.raises(SchemeError, match=r"ends in \.yaml"):
        opened(tmp_path / "a.txt")
