"""Pictures of planes: which colour is seen where."""

import math
from dataclasses import replace

import numpy as np
import pytest
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.colors import to_rgb
from matplotlib.figure import Figure
from matplotlib.patches import Patch

from socialmind.drawing.look import PAPER, THESIS
from socialmind.drawing.plane import RINGS, Picture, key_of, sensed_key
from socialmind.worlds.plane.scene import RobotSeen, Scene

PIXELS = 400


def scene(tick=0, x=0.0, y=0.0, half_width=20.0, **changes):
    """A robot at the middle that looks up; a square, a cylinder, a ball and a zone."""
    robot = RobotSeen(
        "robots", 0, x, y, math.pi / 2, 1.0,
        rays=np.array([[[x + 1, y], [x + 6, y]]]), lines=np.array([[[x, y], [-12.0, 12.0]]]),
    )  # fmt: skip
    content = {
        "robots": (robot,),
        "objects": {"balls": np.array([[-12.0, 12.0, 1.0]])},
        "zones": {"zones": np.array([[-12.0, -12.0, math.pi / 4, 3.0]])},
        "obstacles": np.array([[12.0, 12.0, math.pi / 4, 2.0, 0.0], [12.0, -12.0, 0.0, 2.0, 1.0]]),
    }
    return Scene(tick, half_width, **(content | changes))


def picture(of, look=THESIS, **settings):
    figure = Figure(figsize=(4, 4.4), dpi=PIXELS / 4, facecolor=look.page)
    FigureCanvasAgg(figure)
    return Picture(figure.add_axes((0, 0.4 / 4.4, 1, 4 / 4.4)), of, look, **settings)


def shows(drawn, colour, x, y):
    """Whether a place of the plane, or a pixel beside it, has a colour."""
    canvas = drawn.ax.figure.canvas
    canvas.draw()
    pixels = np.asarray(canvas.buffer_rgba())
    column, row = drawn.ax.transData.transform((x, y))
    row, column = len(pixels) - 1 - int(row), int(column)
    near = pixels[row - 1 : row + 2, column - 1 : column + 2, :3] / 255
    return np.abs(near - to_rgb(colour)).max(axis=2).min() < 0.12


def texts(drawn):
    return [text.get_text() for text in drawn.ax.texts]


@pytest.mark.parametrize("look", [THESIS, PAPER])
def test_everything_has_its_colour_in_its_place(look):
    drawn = picture(scene(), look)
    assert shows(drawn, look.robots[0], 0.5, -0.5)
    assert shows(drawn, look.heading, 0.0, 0.5)
    assert shows(drawn, look.objects[0], -12, 12)
    assert shows(drawn, look.ground, 5, -15)
    assert shows(drawn, look.border, 20.15, 0)
    assert shows(drawn, look.ray, 4, 0.0)
    assert shows(drawn, look.ground, 7, 0.0)
    # The square stands on a corner: 2.5 aside is in it, though its half-width is 2.
    assert shows(drawn, look.obstacle, 14.5, 12)
    assert shows(drawn, look.ground, 13.8, 13.8)
    assert shows(drawn, look.obstacle, 12, -10.2)
    assert shows(drawn, look.ground, 13.7, -10.3)
    assert not shows(drawn, look.ground, -12, -12)
    assert not shows(drawn, look.ground, -12, -8.5)


def test_a_line_leads_to_the_target():
    drawn = picture(scene())
    assert shows(drawn, THESIS.line, -6, 6)
    drawn.show(scene(robots=(RobotSeen("robots", 0, 0.0, 0.0, 0.0, 1.0),)))
    assert shows(drawn, THESIS.ground, -6, 6)


def test_rings_are_around_a_robot_that_emits_a_signal():
    silent = scene()
    (robot,) = silent.robots
    radius = RINGS[1] * 1.0
    drawn = picture(silent, PAPER)
    assert not shows(drawn, PAPER.path, -radius, 0.0)
    drawn.show(replace(silent, robots=(replace(robot, emits=True),)))
    assert shows(drawn, PAPER.path, -radius, 0.0)
    drawn.show(silent)
    assert not shows(drawn, PAPER.path, -radius, 0.0)


def test_what_moves_is_shown_where_it_has_gone():
    drawn = picture(scene())
    drawn.show(scene(1, x=5.0, y=-5.0, objects={"balls": np.array([[3.0, 3.0, 1.0]])}))
    assert shows(drawn, THESIS.robots[0], 5.5, -5.5)
    assert shows(drawn, THESIS.objects[0], 3.0, 3.0)
    assert shows(drawn, THESIS.ground, 0.5, 0.5)
    drawn.show(scene(2, robots=(), obstacles=np.array([[0.0, 0.0, 0.0, 2.0, 0.0]])))
    assert shows(drawn, THESIS.obstacle, 0.0, 0.0)
    assert shows(drawn, THESIS.ground, 5.5, -5.5)
    assert shows(drawn, THESIS.ground, 12, 12)


def test_the_path_is_blue_and_breaks_where_the_robot_was_moved():
    drawn = picture(scene())
    path = np.array([[-5, -18], [0, -18], [math.nan, math.nan], [10, -18], [15, -18]], float)
    drawn.show(scene(), {("robots", 0): path})
    assert shows(drawn, THESIS.path, -2, -18)
    assert shows(drawn, THESIS.ground, 5, -18)
    assert shows(drawn, THESIS.path, 12, -18)


def test_populations_have_colours_of_their_own():
    pair = (RobotSeen("foxes", 0, -5, 0, 0, 1), RobotSeen("geese", 0, 5, 0, 0, 1))
    drawn = picture(scene(robots=pair))
    assert shows(drawn, THESIS.robots[0], -5.5, 0)
    assert shows(drawn, THESIS.robots[1], 4.5, 0)
    # A population that is gone for a while keeps its colour.
    drawn.show(scene(robots=pair[1:]))
    assert shows(drawn, THESIS.robots[1], 4.5, 0)
    assert shows(drawn, THESIS.ground, -5.5, 0)


def test_a_part_of_the_plane_follows_the_robot():
    drawn = picture(scene(), around=8.0)
    assert drawn.ax.get_xlim() == (-8, 8)
    drawn.show(scene(1, x=12.0, y=-5.0))
    assert (drawn.ax.get_xlim(), drawn.ax.get_ylim()) == ((4, 20), (-13, 3))
    drawn.show(scene(2, robots=()))
    assert drawn.ax.get_xlim() == (4, 20)
    other = RobotSeen("robots", 1, 3.0, 3.0, 0.0, 1.0)
    both = scene(robots=(*scene().robots, other))
    assert picture(both, around=8.0, robot=("robots", 1)).ax.get_xlim() == (-5, 11)


def test_without_borders_all_that_was_in_use_is_shown():
    drawn = picture(scene(half_width=0.0))
    before = drawn.ax.get_xlim()
    assert before[0] < -16 < 15 < before[1]
    drawn.show(scene(x=1.0, half_width=0.0))
    assert drawn.ax.get_xlim() == before
    drawn.show(scene(x=60.0, y=5.0, half_width=0.0))
    after = drawn.ax.get_xlim()
    assert after[0] <= before[0]
    assert after[1] > 61
    bottom, top = drawn.ax.get_ylim()
    assert top - bottom == pytest.approx(after[1] - after[0])


def test_the_line_below_tells_tick_scale_and_end():
    drawn = picture(scene(1234))
    assert texts(drawn) == ["tick 1,234", "5 units", ""]
    drawn.show(scene(1300, over="collision"))
    assert texts(drawn)[0] == "tick 1,300 · collision"
    assert texts(picture(scene(), around=4.0))[1] == "1 unit"


def test_a_robot_in_a_wide_arena_can_still_be_seen():
    tiny = RobotSeen("robots", 0, 0.0, 0.0, 0.0, 0.05)
    drawn = picture(scene(robots=(tiny,), half_width=200.0))
    assert shows(drawn, THESIS.robots[0], -0.8, 0.0)


def test_colours_for_papers_are_told_apart_by_the_colour_blind():
    # Viénot, Brettel and Mollon (1999): how protanopes and deuteranopes see linear colours.
    blind = (
        [[0.11238, 0.88762, 0], [0.11238, 0.88762, 0], [0.00401, -0.00401, 1]],
        [[0.29275, 0.70725, 0], [0.29275, 0.70725, 0], [-0.02234, 0.02234, 1]],
    )
    names = {
        "robot": PAPER.robots[0], "object": PAPER.objects[0], "obstacle": PAPER.obstacle,
        "path": PAPER.path, "ground": PAPER.ground,
    }  # fmt: skip
    for matrix in blind:
        found = {
            name: (np.array(matrix) @ np.array(to_rgb(colour)) ** 2.2).clip(0, 1) ** (1 / 2.2)
            for name, colour in names.items()
        }
        for name, colour in found.items():
            for other, another in found.items():
                assert name == other or np.linalg.norm(colour - another) > 0.25, (name, other)


def test_kinds_of_zones_differ_without_colours():
    places = np.array([[0.0, 0.0, 0.0, 3.0]])
    marks = key_of(scene(zones={"drop_zones": places, "supplies": places}), robots=False)
    hatches = {mark.get_label(): mark.get_hatch() for mark in marks if isinstance(mark, Patch)}
    assert hatches["drop zones"] != hatches["supplies"]


def test_the_key_tells_of_what_is_drawn_around_robots():
    told = [mark.get_label() for mark in sensed_key([scene()])]
    assert told == ["range finders", "sensed targets"]


def test_the_key_tells_of_what_is_in_view_alone():
    places = np.array([[30.0, 0.0, 0.0, 3.0]])
    whole = scene(zones={"drop_zones": places})
    labels = [mark.get_label() for mark in key_of(whole, view=(0.0, 0.0, 27.5))]
    assert "drop zones" in labels
    assert "drop zones" not in [mark.get_label() for mark in key_of(whole, view=(0.0, 0.0, 26.5))]


def test_the_name_of_a_robot_stands_where_no_other_robot_does():
    one, above = (RobotSeen("robots", at, 0.0, 0.8 * at, 0.0, 0.2) for at in (0, 1))

    def beside(*robots):
        drawn = Picture(Figure((2, 2)).add_subplot(), scene(robots=robots), PAPER, named=True,
                        robot=("robots", 0))  # fmt: skip
        return drawn._name.get_position()

    assert beside(one)[1] > 0
    assert beside(one, above)[1] < 0
