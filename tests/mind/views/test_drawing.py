"""Drawings of hierarchies: what they show, and that it can be read."""

import random
import subprocess
import sys
from itertools import combinations, pairwise
from pathlib import Path

import matplotlib as mpl
import pytest
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.colors import to_hex
from matplotlib.figure import Figure
from matplotlib.patches import Ellipse, FancyBboxPatch, PathPatch
from random_minds import MASTER, random_mind, sensor_values
from small_minds import constant, mind, wired

from socialmind.mind import Hierarchy
from socialmind.mind.views.drawing import EDGE, FILL, INFLUENCE, UNKNOWN, draw_hierarchy
from socialmind.mind.views.plan import planned, wrapped

CHECKOUT = Path(__file__).parents[3]


@pytest.fixture
def two_skills():
    """The master gives A 0.5 and B 0.25; A passes 0.8 of it on to Low, which commands a motor."""
    return Hierarchy(
        mind(
            [
                constant("Master", {"SK:A": 0.5, "SK:B": 0.25}),
                constant("A", {"SK:Low": 0.8}),
                wired("B", {"VA:X": "SE:S"}),
                wired("Low", {"MO:M": "VA:X"}),
            ],
            ["X", "Unused"],
        )
    )


def random_hierarchy(seed, skills, depth=5):
    description = random_mind(random.Random(seed), skills, depth, programs=False)
    hierarchy = Hierarchy(description, MASTER)
    for values in sensor_values(description, random.Random(seed), 2):
        hierarchy.evaluate(values)
    return hierarchy


def texts(ax):
    return [text.get_text() for text in ax.texts]


def lines(ax):
    """The colours of all links, thick before thin."""
    found = [patch for patch in ax.patches if isinstance(patch, PathPatch)]
    found.sort(key=lambda patch: -patch.get_linewidth())
    return [to_hex(patch.get_edgecolor()) for patch in found]


def green(value):
    return to_hex(INFLUENCE(value))


# What is shown ---------------------------------------------------------------------------------


def test_values_stand_under_names_and_beside_links(two_skills):
    two_skills.evaluate({"S": 0.7})
    shown = texts(draw_hierarchy(two_skills))
    assert {"Master\n1.00", "A\n0.50", "B\n0.25", "Low\n0.40"} <= set(shown)
    assert {"S 0.70", "X\n0.00", "M\n0.00"} <= set(shown)
    # On the links of influence, what they transmit: 0.5, 0.25 and 0.5 · 0.8.
    assert {"0.50", "0.25", "0.40"} <= set(shown)
    assert not any("Unused" in text for text in shown)


def test_a_link_shows_what_is_transmitted_and_in_its_centre_what_is_given(two_skills):
    two_skills.evaluate({"S": 0.7})
    plan = planned(two_skills, key=False)
    ax = draw_hierarchy(two_skills, key=False)
    # Readings, then for each link the edge and the centre.
    colours = {to_hex(EDGE["SE"]), to_hex(EDGE["VA"])}
    paths = [to_hex(patch.get_edgecolor()) for patch in ax.patches if isinstance(patch, PathPatch)]
    drawn = [colour for colour in paths if colour not in colours]
    pairs = dict(zip(plan.routes, zip(drawn[::2], drawn[1::2], strict=True), strict=True))
    assert pairs == {
        ("SK:Master", "SK:A"): (green(0.5), green(0.5)),
        ("SK:Master", "SK:B"): (green(0.25), green(0.25)),
        ("SK:A", "SK:Low"): (green(0.4), green(0.8)),
        ("SK:B", "VA:X"): (green(0.7 * 0.25), green(0.7)),
        ("SK:Low", "MO:M"): (green(0.0), green(0.0)),
    }


def test_links_of_influence_are_thicker_than_the_others(two_skills):
    two_skills.evaluate({"S": 0.7})
    found = {}
    for patch in draw_hierarchy(two_skills, key=False).patches:
        if isinstance(patch, PathPatch):
            found.setdefault(round(patch.get_linewidth(), 6), []).append(patch)
    # Edges and centres of three links of influence, of two commands; two readings.
    counts = [len(found[width]) for width in sorted(found, reverse=True)]
    assert counts == [3, 2, 3, 2, 2]


def test_skills_sensors_variables_and_actuators_have_their_colours(two_skills):
    ax = draw_hierarchy(two_skills)
    boxes = [patch for patch in ax.patches if isinstance(patch, FancyBboxPatch)]
    ellipses = [patch for patch in ax.patches if isinstance(patch, Ellipse)]
    assert [to_hex(patch.get_facecolor()) for patch in boxes] == [FILL["SK"]] * 4
    assert sorted(to_hex(patch.get_facecolor()) for patch in ellipses) == sorted(
        [FILL["MO"], FILL["SE"], FILL["VA"]]
    )


def test_influence_goes_from_black_to_green_and_grows_lighter():
    assert green(0.0) == "#000000"
    red, full, blue, _ = INFLUENCE(1.0)
    assert full > 2 * max(red, blue)
    luminances = [
        0.2126 * r + 0.7152 * g + 0.0722 * b
        for r, g, b, _ in (INFLUENCE(number / 10) for number in range(11))
    ]
    assert luminances == sorted(luminances)
    assert luminances[-1] > 0.4


def test_before_the_first_evaluation_the_structure_stands_alone(two_skills):
    ax = draw_hierarchy(two_skills)
    assert sorted(texts(ax)) == ["A", "B", "Low", "M", "Master", "S", "X"]
    assert set(lines(ax)[:5]) == {UNKNOWN}
    two_skills.evaluate({"S": 0.7})
    two_skills.reset()
    assert sorted(texts(draw_hierarchy(two_skills))) == sorted(texts(ax))


def test_the_method_draws_into_given_axes(two_skills):
    figure = Figure()
    ax = figure.subplots()
    assert two_skills.draw(ax) is ax
    assert two_skills.draw().figure is not figure


# That it can be read ---------------------------------------------------------------------------


@pytest.mark.parametrize(("seed", "skills"), [(seed, 1 + 29 * seed // 11) for seed in range(12)])
def test_nothing_overlaps_and_all_links_lead_down(seed, skills):
    plan = planned(random_hierarchy(seed, skills), key=True)
    for (name, one), (other, two) in combinations(plan.boxes.items(), 2):
        beside = abs(one.x - two.x) >= (one.width + two.width) / 2
        below = abs(one.y - two.y) >= (one.height + two.height) / 2
        assert beside or below, (name, other)
    for box in plan.boxes.values():
        assert 0.0 <= box.x - box.width / 2 < box.x + box.width / 2 <= plan.width
        assert 0.0 <= box.y - box.height / 2 < box.y + box.height / 2 <= plan.height
    for (source, target), curve in plan.routes.items():
        assert plan.boxes[source].y < plan.boxes[target].y
        heights = [y for _, y in curve]
        assert all(below > above - 1e-9 for above, below in pairwise(heights))


@pytest.mark.parametrize(("seed", "skills"), [(1, 8), (4, 30)])
def test_names_stay_within_their_nodes_and_values_off_them(seed, skills):
    ax = draw_hierarchy(random_hierarchy(seed, skills))
    renderer = FigureCanvasAgg(ax.figure).get_renderer()
    nodes = [patch for patch in ax.patches if isinstance(patch, FancyBboxPatch | Ellipse)]
    outlines = [node.get_window_extent(renderer).padded(1.0) for node in nodes]
    for text in ax.texts:
        extent = text.get_window_extent(renderer)
        inside = [box for box in outlines if box.contains(extent.x0, extent.y0)]
        if text.get_zorder() == 6:
            assert any(box.contains(extent.x1, extent.y1) for box in inside), text
        else:
            assert not inside, text


def test_type_shrinks_with_the_axes_and_grows_no_larger_than_a_caption(two_skills):
    sizes = []
    for inches in (1.5, 3.0, 20.0):
        figure = Figure(figsize=(inches, inches))
        ax = draw_hierarchy(two_skills, figure.add_axes((0, 0, 1, 1)))
        sizes.append(ax.texts[0].get_size())
    assert sizes[0] < sizes[1] <= sizes[2] == 9.0


def test_axes_take_the_size_that_their_layout_gives_them(two_skills):
    figure = Figure(figsize=(4, 4), layout="constrained")
    axes = figure.subplots(2, 2)
    drawn = draw_hierarchy(two_skills, axes[0, 0])
    alone = draw_hierarchy(two_skills, Figure(figsize=(4, 4), layout="constrained").subplots())
    assert drawn.texts[0].get_size() < alone.texts[0].get_size()


def test_crossed_links_are_untangled():
    hierarchy = Hierarchy(
        mind(
            [
                constant("Master", {"SK:A": 1.0, "SK:B": 1.0}),
                constant("A", {"SK:Y": 1.0}),
                constant("B", {"SK:X": 1.0}),
                constant("X", {"MO:M": 1.0}),
                constant("Y", {"MO:M": 1.0}),
            ]
        )
    )
    boxes = planned(hierarchy, key=False).boxes
    assert (boxes["SK:A"].x < boxes["SK:B"].x) == (boxes["SK:Y"].x < boxes["SK:X"].x)


def test_a_long_link_goes_round_the_skills_between():
    hierarchy = Hierarchy(
        mind(
            [
                constant("Master", {"SK:A": 1.0, "SK:B": 1.0}),
                constant("A", {"SK:B": 1.0}),
                constant("B", {"MO:M": 1.0}),
            ]
        )
    )
    plan = planned(hierarchy, key=False)
    between = plan.boxes["SK:A"]
    for x, y in plan.routes["SK:Master", "SK:B"]:
        within = abs(x - between.x) < between.width / 2
        assert not (within and abs(y - between.y) < between.height / 2)


@pytest.mark.parametrize(
    ("name", "expected"),
    [
        ("Avoid", ["Avoid"]),
        ("GoToObject+Avoid", ["GoToObject", "+Avoid"]),
        ("search_the_room", ["search_", "the_room"]),
        ("unbreakablename", ["unbreakablename"]),
        ("Collect+Validate+Signal+Report", ["Collect", "+Validate", "+Signal+Report"]),
    ],
)
def test_long_names_break_where_their_parts_meet(name, expected):
    assert wrapped(name) == expected


def test_a_dollar_is_a_dollar():
    hierarchy = Hierarchy(mind([constant("$a$", {"MO:M": 1.0})]))
    ax = draw_hierarchy(hierarchy)
    ax.figure.canvas.draw()
    assert "$a$" in texts(ax)
    assert not next(text for text in ax.texts if text.get_text() == "$a$").get_parse_math()


# That it leaves no trace -----------------------------------------------------------------------


def test_settings_of_matplotlib_are_as_before(two_skills):
    before = dict(mpl.rcParams)
    two_skills.evaluate({"S": 0.7})
    draw_hierarchy(two_skills)
    assert dict(mpl.rcParams) == before


def test_a_mind_needs_no_matplotlib_and_a_drawing_no_window():
    script = """
import sys
from socialmind.mind import Hierarchy, MindDescription, Programmed, Skill
def stop(): return 0.5
skill = Skill("A", (), ["MO:M"], Programmed(stop))
still = Hierarchy(MindDescription("m", (), ["M"], skills=[skill]))
still.evaluate({})
print(still.explain())
assert not {"matplotlib", "pandas"} & set(sys.modules)
still.draw()
assert "matplotlib.pyplot" not in sys.modules
"""
    ended = subprocess.run([sys.executable, "-c", script], cwd=CHECKOUT, capture_output=True)
    assert ended.returncode == 0, ended.stderr.decode()
