"""Drawings of cognitive schemes."""

import pytest
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.colors import to_rgba
from matplotlib.figure import Figure

from coglogo_py import CognitiveScheme, Cogniton, Culturon, Group, Role
from socialmind.drawing import style as paper
from socialmind.drawing.scheme import (
    AGAINST,
    FEEDBACK,
    FOR,
    LOOKS,
    NEGATIVE,
    POSITIVE,
    WEAKENED,
    draw_scheme,
    key,
    lines_of,
    scheme_figure,
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
    assert [one.get_label() for one in key(scheme)] == ["meme", FOR]
    assert [one.get_label() for one in key(CognitiveScheme("cows", (plain,)))] == [FOR]
    assert [one.get_label() for one in key()] == list(LOOKS)


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
    diamonds = [
        [line.get_marker() for line in one.lines].count("D") for one in (axes, drawn(SCHEME))
    ]
    assert diamonds == [2, 0]  # the influence of Law, and what it opens
    assert key(GROUPED)[0].get_label() == "of a role"


SIGNED = CognitiveScheme(
    "signed",
    (Cogniton("Mood", influence={"go": 1.0, "stay": -1.0}, reinforcement={"go": -0.5}),),
)


def test_what_is_negative_is_dashed_and_only_that():
    lines = [one for one in drawn(SIGNED).patches if one.get_facecolor()[3] == 0]
    dashed = [one for one in lines if one.get_linestyle() not in ("-", "solid")]
    assert len(lines) == 3
    assert {one.get_edgecolor() for one in dashed} == {
        to_rgba(NEGATIVE),
        to_rgba(FEEDBACK),
    }
    assert [one.get_label() for one in key(SIGNED)] == [FOR, AGAINST, WEAKENED]


def test_reinforcement_leads_back_to_the_cogniton():
    assert [one.get_marker() for one in drawn(SIGNED).lines].count("<") == 1


LONG = CognitiveScheme(
    "long",
    (
        Cogniton(
            "AVeryLongNameOfACognitonThatNobodyShouldWrite",
            influence={"AndAPlanWhoseNameIsAsLong": -1234.567, "b": 0.000012345},
            type="belief",
        ),
        Cogniton("$x_1$", conditional=("b",)),
    ),
    (Group("AGroupOfSomeLength", (Role("ARoleOfSomeLength", (LAW,)),)),),
)


@pytest.mark.parametrize("scheme", [SCHEME, GROUPED, SIGNED, LONG])
def test_no_text_is_cut_off_or_lies_on_another(scheme):
    figure = scheme_figure(scheme)
    canvas = FigureCanvasAgg(figure)
    canvas.draw()
    renderer = canvas.get_renderer()
    (axes,) = figure.axes
    texts = [*axes.texts, *figure.legends[0].get_texts()]
    boxes = [one.get_window_extent(renderer).padded(-0.5) for one in texts if one.get_text()]
    for number, one in enumerate(boxes):
        assert figure.bbox.x0 <= one.x0 and one.x1 <= figure.bbox.x1
        assert figure.bbox.y0 <= one.y0 and one.y1 <= figure.bbox.y1
        assert not any(one.overlaps(other) for other in boxes[number + 1 :])


def test_a_scheme_is_a_column_wide_unless_its_names_are_too_long():
    widths = [scheme_figure(one).get_figwidth() * 25.4 for one in (GROUPED, LONG)]
    assert widths == pytest.approx([paper.COLUMN, paper.PAGE])
    assert scheme_figure(GROUPED, 120).get_figwidth() * 25.4 == pytest.approx(120)
