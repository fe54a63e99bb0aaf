"""The ways of figures 7.2 and 7.3: where they begin and end, and how they are drawn."""

from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest

from socialmind.experiments.studies import studies_in
from socialmind.sources.loading import load_file

FOLDER = Path(__file__).parents[2] / "analysis" / "target_variable"
TRAJECTORIES = load_file(FOLDER / "trajectories.py")
COMPARISON = load_file(FOLDER / "comparison.py")
TRAININGS = load_file(FOLDER / "trainings.py")


@pytest.fixture(scope="module")
def found():
    """The ways of a run with two objects."""
    for seed in TRAJECTORIES.SEEDS:
        legs = TRAJECTORIES.legs(2, seed)
        if len(legs) == 4:
            return legs
    pytest.fail("the trained robot brings two objects home in none of the runs")


def test_its_studies_are_found():
    assert [one.name for one in studies_in(FOLDER)] == [
        "figure-7.2", "figure-7.3", "target-functions",
    ]  # fmt: skip


def test_each_way_begins_where_the_one_before_ends(found):
    assert [(one.number, one.carrying) for one in found] == [
        (1, False), (1, True), (2, False), (2, True),
    ]  # fmt: skip
    assert found[0].ticks[0] == 0
    for one, following in pairwise(found):
        assert one.ticks[-1] == following.ticks[0]
        assert np.array_equal(one.places[-1], following.places[0])
    for one in found:
        assert np.array_equal(one.ticks, np.arange(one.ticks[0], one.ticks[-1] + 1))
        assert one.end.tick == one.ticks[-1]
        assert one.length >= one.straight > 0
        (robot,) = one.end.robots
        assert np.allclose((robot.x, robot.y), one.places[-1])


def test_the_figure_has_a_panel_for_each_way(found):
    figure = TRAJECTORIES.draw(found)
    assert [axes.get_title().split(":")[0] for axes in figure.axes] == [
        "to object 1", "home with object 1", "to object 2", "home with object 2",
    ]  # fmt: skip
    tops = [axes.get_position().y0 for axes in figure.axes]
    assert tops[0] == tops[1] > tops[2] == tops[3]


def row(training, attempt, ratio, objects):
    return {
        "training": training, "attempt": attempt, "worlds": 10, "seed": 1, "path_ratio": ratio,
        "path": 160.0, "objects": objects, "survived": 0.5, "path_ratio_low": ratio - 0.1,
        "path_ratio_high": ratio + 0.1,
    }  # fmt: skip


def test_attempts_that_bring_nothing_home_are_told_apart():
    rows = [row("selecting", 1, 1.1, 4.0), row("selecting", 2, 1.4, 2.0),
            row("linear", 1, np.nan, 0.0), row("linear", 2, np.nan, 0.0)]  # fmt: skip
    text = "\n".join(COMPARISON.lines_of(rows))
    assert "1.25 (1.10 to 1.40) times those of the plain hierarchy; 1 of 2 attempts" in text
    assert "15 weights: no attempt brings an object home." in text
    (axes,) = COMPARISON.draw(rows).axes
    assert sum(line.get_marker() == "x" for line in axes.lines) == 2
    assert sum(line.get_marker() == "o" for line in axes.lines) == 2
    low, high = axes.get_ylim()
    assert low < 1.0 < COMPARISON.MARK < high


def test_each_function_has_a_training_above_the_same_skills():
    minds = [plan.mind() for plan in TRAININGS.PLANS.values()]
    assert [one.skills["CollectVariable"].genome for one in minds] == [None] * 4
    for name in TRAININGS.LESSONS.BELOW:
        first, *others = (one.skills[name].genome for one in minds)
        assert all(np.array_equal(first, other) for other in others)
