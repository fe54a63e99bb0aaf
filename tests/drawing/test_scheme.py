"""Drawings of cognitive schemes."""

from matplotlib.figure import Figure

from coglogo_py import CognitiveScheme, Cogniton, Culturon, Group, Role
from socialmind.drawing import style as paper
from socialmind.drawing.scheme import (
    FEEDBACK,
    NEGATIVE,
    POSITIVE,
    draw_scheme,
    key,
    lines_of,
)

SCHEME = CognitiveScheme(
    "cows",
    (
        Cogniton("Hunger", influence={"eat": 2.0, "sleep": -0.5}, conditional=("eat",)),
        Cogniton("Habit", reinforcement={"eat": 0.25}),
        Cogniton("Idle"),
    ),
)


def drawn(scheme):
    with paper.style():
        figure = paper.figure(90, 60)
        axes = figure.subplots()
        draw_scheme(scheme, axes)
        figure.canvas.draw()
    return axes


def test_each_link_stands_with_its_weight_in_the_colour_of_its_kind():
    found = {text.get_text(): text.get_color() for text in drawn(SCHEME).texts}
    assert {"Hunger", "Habit", "Idle", "eat", "sleep"} <= set(found)
    assert found["+2"] == POSITIVE
    assert found["−0.5"] == NEGATIVE
    assert found["+0.25"] == FEEDBACK
    assert found["opens"] == paper.GREY


def test_nothing_lies_outside_of_the_lines_that_it_takes():
    axes = drawn(SCHEME)
    assert axes.get_ylim() == (lines_of(SCHEME), 0)
    places = [text.get_position()[1] for text in axes.texts]
    assert min(places) > 0
    assert max(places) < lines_of(SCHEME)
    assert lines_of(SCHEME) > lines_of(CognitiveScheme("none", SCHEME.cognitons[2:]))


def test_a_scheme_without_links_is_boxes():
    axes = drawn(CognitiveScheme("still", (Cogniton("Rest"),)))
    assert [text.get_text() for text in axes.texts] == ["Rest"]


def test_types_are_marked_and_explained_where_there_are_some():
    plain = Cogniton("Hunger", influence={"eat": 1})
    typed = Cogniton("Fashion", influence={"eat": 1}, type="meme")
    figure = Figure()
    axes = figure.subplots(1, 2)
    for one, cogniton in zip(axes, (plain, typed), strict=True):
        draw_scheme(CognitiveScheme("cows", (cogniton,)), one)
    lines = [sum(line.get_marker() == "P" for line in one.lines) for one in axes]
    assert lines == [0, 1]
    scheme = CognitiveScheme("cows", (plain, typed))
    assert [one.get_label() for one in key(scheme)] == ["meme", *(k.get_label() for k in key())]
    assert key(CognitiveScheme("cows", (plain,)))[0].get_label() == key()[0].get_label()


LAW = Culturon("Law", 3, influence={"work": 1.0}, conditional=("work",))
GROUPED = CognitiveScheme(
    "folk",
    SCHEME.cognitons,
    (
        Group("clan", (Role("member", (LAW,)), Role("chief"))),
        Group("family", (Role("kin"),), within=("clan", "member")),
    ),
)


def test_roles_hold_their_culturons_and_groups_say_what_they_lie_in():
    axes = drawn(GROUPED)
    found = {text.get_text(): text for text in axes.texts}
    assert {"clan", "family", "member", "chief", "kin", "Law", "work"} <= set(found)
    assert " in a clan, as member" in found
    heights = [found[one].get_position()[1] for one in ("Idle", "clan", "member", "Law", "chief")]
    assert heights == sorted(heights)
    assert found["kin"].get_position()[1] < lines_of(GROUPED)
    dashed = {patch.get_linestyle() for patch in axes.patches}
    assert "-." in dashed
    assert "-." not in {patch.get_linestyle() for patch in drawn(SCHEME).patches}
    assert len(key(GROUPED)) == len(key()) + 1
