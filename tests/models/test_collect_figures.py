"""The figures of the collecting robots, drawn from short runs."""

import warnings

import matplotlib as mpl
import numpy as np
import pytest
from matplotlib.text import Text

from socialmind.catalogue import load_figures, load_model
from socialmind.drawing import style as paper
from socialmind.experiments import Run, run
from socialmind.sources.folders import model_folder
from socialmind.sources.loading import load_file

FIGURES = load_file(model_folder("collect") / "figures.py")
MIND = model_folder("collect") / "mind"
LEGENDS = {
    "collect": ["looking for an object", "carrying one home", "drop zone"],
    "collect_retrained": ["looking for an object", "carrying one home", "drop zone"],
    "collect_power": ["looking for an object", "carrying one home", "drop zone", "power supply"],
}


@pytest.fixture(scope="module")
def recorded(tmp_path_factory):
    """A run of the robot up to its first delivery, every fifth tick recorded."""
    out = tmp_path_factory.mktemp("runs") / "run"
    return Run(run(load_model("collect"), 1000, 4, every=5, agents_every=5, out=out))


@pytest.fixture(scope="module")
def course(recorded):
    return FIGURES.course_of(recorded)


@pytest.mark.parametrize("name", LEGENDS)
@pytest.mark.parametrize("ticks", [120, 1])
def test_figures_are_drawn_at_journal_width_and_legible(name, ticks, tmp_path):
    # One of the robots' minds will do for all: nothing is read of what it lacks.
    recorded = Run(run(load_model(name), ticks, 2, hierarchy=MIND, out=tmp_path / "run"))
    before = dict(mpl.rcParams)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        figures = load_figures(model_folder(name)).draw(recorded)
        for one, figure in figures.items():
            figure.savefig(tmp_path / f"{one}.pdf")
    assert list(figures) == ["path", "deliveries"]
    for figure in figures.values():
        assert 84.9 <= figure.get_size_inches()[0] * 25.4 <= 180.1
        texts = [text for text in figure.findobj(Text) if text.get_text().strip()]
        assert min(text.get_fontsize() for text in texts) >= 7
    legend = figures["path"].legends[0]
    assert [text.get_text() for text in legend.get_texts()] == LEGENDS[name]
    labels = [axes.get_ylabel() for axes in figures["deliveries"].axes]
    panels = ["objects delivered (number)", "battery (0 … 1)"]
    assert labels == panels[: 2 if name == "collect_power" else 1]
    assert dict(mpl.rcParams) == before


def test_the_repeated_run_is_the_recorded_one(recorded, course):
    table = recorded.agents
    assert course.tick.tolist() == table["tick"].tolist()
    assert course.x.tolist() == table["x"].tolist()
    assert course.y.tolist() == table["y"].tolist()
    assert course.carrying.tolist() == (table["carrying"] >= 0).tolist()
    assert course.delivered.tolist() == table["delivered"].tolist()
    assert course.delivered[-1] == 1
    assert course.battery.tolist() == [1.0] * len(table)


def test_every_step_is_drawn_once_in_the_colour_of_what_the_robot_does(course):
    figure = FIGURES.path(course)
    lines = {
        line.get_color(): line
        for line in figure.axes[0].lines
        if line.get_color() in (FIGURES.SEARCHES, FIGURES.CARRIES) and line.get_marker() == "None"
    }
    steps = {}
    for colour, line in lines.items():
        x, y = line.get_data()
        drawn = np.isfinite(x[:-1]) & np.isfinite(x[1:])
        steps[colour] = drawn
        assert np.array_equal(x[np.isfinite(x)], course.x[np.isfinite(x)])
        assert np.array_equal(y[np.isfinite(y)], course.y[np.isfinite(y)])
    carries = course.carrying[:-1]
    # A line between two stretches of its own colour may be one step long.
    assert (steps[FIGURES.CARRIES] >= carries).all()
    assert (steps[FIGURES.SEARCHES] >= ~carries).all()
    both = steps[FIGURES.CARRIES] & steps[FIGURES.SEARCHES]
    assert both.sum() <= 1
    (gripped,) = [line for line in figure.axes[0].lines if line.get_marker() == "o"]
    assert len(gripped.get_xdata()) == 1
    first = int(np.argmax(course.carrying))
    assert (*gripped.get_xdata(), *gripped.get_ydata()) == (course.x[first], course.y[first])


def test_deliveries_are_steps_and_name_what_ended_the_run(course):
    axes = FIGURES.deliveries(course).axes[0]
    (line,) = axes.lines
    assert line.get_ydata().tolist() == course.delivered.tolist()
    assert axes.get_title(loc="left") == axes.get_title() == ""


def test_a_collision_is_named(tmp_path):
    model = load_model("collect")
    mind = model_folder("collect") / "mind_constant"
    for seed in range(90, 120):  # until one collides early
        society = model(seed, hierarchy=mind)
        society.advance(2500)
        if society.over:
            break
    assert society.over == "collision"
    recorded = Run(run(model, 3000, seed, hierarchy=mind, out=tmp_path / "run"))
    course = FIGURES.course_of(recorded)
    assert course.tick[-1] < 2505
    with paper.style():
        axes = FIGURES.deliveries(course).axes[0]
    assert axes.get_title(loc="left").startswith("ended by: collision, at tick ")
