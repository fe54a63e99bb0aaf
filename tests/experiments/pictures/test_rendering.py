"""Pictures of moments: what is said of each, and on which side the plane stands."""

import re
from pathlib import Path

import pytest

from socialmind.catalogue import load_model
from socialmind.errors import SocialmindError
from socialmind.experiments import run
from socialmind.experiments.pictures.picture_page import GAP, HIGHEST, Style
from socialmind.experiments.pictures.rendering import draw_moments, draw_steps

SEEKERS = Path(__file__).parents[2] / "worlds" / "plane" / "seekers"


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """A run of two robots that seek a ball."""
    out = tmp_path_factory.mktemp("seekers") / "run"
    return run(load_model(SEEKERS), 20, 3, out=out, compiled=False)


def test_each_moment_has_its_caption(folder, tmp_path):
    told = ["at the start", "later on"]
    plain = draw_moments(folder, tmp_path / "plain.svg", (0, 20)).read_text()
    text = draw_moments(folder, tmp_path / "told.svg", (0, 20), captions=told).read_text()
    assert not set(told) & set(re.findall("at the start|later on", plain))
    assert re.findall(">(at the start|later on)<", text) == told
    heights = [float(re.search(r'height="([\d.]+)pt"', one)[1]) for one in (plain, text)]
    assert heights[1] - heights[0] == pytest.approx(22, abs=0.1)


def test_captions_that_do_not_fit_are_refused(folder, tmp_path):
    with pytest.raises(SocialmindError, match="1 captions; expected one for each of 2"):
        draw_moments(folder, tmp_path / "x.svg", (0, 20), captions=["alone"])


def test_the_plane_stands_on_either_side_of_the_hierarchy(folder, tmp_path):
    lefts = []
    for first in (False, True):
        style = Style(mind=True, plane_first=first)
        text = draw_moments(folder, tmp_path / "x.svg", (20,), style).read_text()
        # The tick stands at the left of the plane.
        lefts.append(float(re.search(r'<text[^>]* x="([0-9.]+)"[^>]*>tick 20<', text)[1]))
    assert lefts[0] > 200
    assert lefts[1] == GAP


def test_of_several_robots_the_one_whose_mind_is_shown_is_named(folder, tmp_path):
    both = Style(mind=True, robot=("robots", 1))
    text = draw_moments(folder, tmp_path / "x.svg", (20,), both).read_text()
    assert ">1<" in text
    text = draw_moments(folder, tmp_path / "x.svg", (20,), Style(robot=("robots", 1))).read_text()
    assert ">1<" not in text


def test_steps_go_on_pages_that_fit_a_journal_with_a_key(folder, tmp_path):
    from PIL import Image

    style = Style(mind=True, inputs=False)
    told = ["first", "second", "third"]
    paths = draw_steps(folder, tmp_path / "steps", (0, 10, 20), style, told, rows=2)
    names = ["steps.pdf", "steps.png", "steps-2.pdf", "steps-2.png"]
    assert [path.name for path in paths] == names
    with Image.open(paths[1]) as image:
        assert image.mode == "P"
        assert image.size[1] / image.info["dpi"][1] * 25.4 <= HIGHEST + 0.1
    text = draw_moments(folder, tmp_path / "x.svg", (0, 20), style).read_text()
    assert {"robots", "path", "range finders", "influence 1 or more"} <= set(
        re.findall(">([^<>]+)<", text)
    )
    assert "RADBALL" not in text
