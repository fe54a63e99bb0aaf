"""Panels: what is drawn where, with which numbers, intervals and words."""

import io
import itertools

import matplotlib as mpl
import numpy as np
import pandas as pd
import pytest
from matplotlib.colors import to_rgb

from socialmind.drawing import style
from socialmind.experiments.figures import palette
from socialmind.experiments.figures.design import Varying
from socialmind.experiments.figures.estimates import effects, estimates
from socialmind.experiments.figures.labels import Labels, value_name, with_unit
from socialmind.experiments.figures.panels import (
    draw_bands,
    draw_effects,
    draw_response,
    draw_scatter,
    draw_surface,
    smooth,
)

LABELS = Labels({"y": "yield"}, {"y": "sacks", "x": "euros"})


def table(**columns):
    """Runs over the product of some values, four each, with `y` the sum of the numbers."""
    index = pd.MultiIndex.from_product([*columns.values(), range(4)], names=[*columns, "seed"])
    runs = index.to_frame(index=False)
    numbers = [name for name in columns if runs[name].dtype.kind in "if"]
    runs["y"] = runs[numbers].sum(axis=1) + np.array([0.0, 1.0, 2.0, 3.0])[runs["seed"]]
    return runs


def panel(width=style.COLUMN, height=60):
    return style.figure(width, height).subplots()


def test_a_curve_goes_through_the_means_with_their_intervals():
    found = estimates(table(x=[4.0, 1.0, 2.0]), ["x"], "y")
    axes = panel()
    assert draw_response(axes, found, "x", labels=LABELS) is axes
    assert axes.get_xlabel() == "x (euros)" and axes.get_ylabel() == "yield (sacks)"
    (bars,) = axes.containers
    line, caps, _ = bars.lines
    assert line.get_xdata().tolist() == [1.0, 2.0, 4.0]
    assert line.get_ydata().tolist() == [2.5, 3.5, 5.5]
    ordered = found.table.sort_values("x")
    assert caps[0].get_ydata().tolist() == pytest.approx(ordered["low"].tolist())
    assert caps[1].get_ydata().tolist() == pytest.approx(ordered["high"].tolist())
    assert line.get_linestyle() == "-"
    low, high = axes.get_ylim()
    assert low < ordered["low"].min() and high > ordered["high"].max()


def test_many_whole_numbers_stand_at_whole_ticks():
    axes = panel()
    many = [0, 2, 4, 6, 8, 9, 10, 11, 12, 16, 20]
    draw_response(axes, estimates(table(x=many), ["x"], "y"), "x")
    assert [tick for tick in axes.get_xticks() if 0 <= tick <= 20] == [0, 5, 10, 15, 20]


def test_lines_are_told_apart_by_colour_marker_and_dashes():
    found = estimates(table(x=[1.0, 2.0], kind=["a", "b", "c"]), ["x", "kind"], "y")
    axes = draw_response(panel(), found, "x", "kind", LABELS)
    lines = [one.lines[0] for one in axes.containers]
    assert [one.get_label() for one in axes.containers] == ["a", "b", "c"]
    for looks in ("get_color", "get_marker", "get_linestyle"):
        assert len({str(getattr(one, looks)()) for one in lines}) == 3


def test_names_get_places_and_dots_without_a_line():
    found = estimates(table(kind=["wild", "tame"]), ["kind"], "y")
    axes = draw_response(panel(), found, "kind")
    assert [one.get_text() for one in axes.get_xticklabels()] == ["wild", "tame"]
    assert axes.containers[0].lines[0].get_linestyle() == "None"


def test_one_run_a_point_has_no_bars():
    runs = table(x=[1.0, 2.0])
    axes = draw_response(panel(), estimates(runs[runs["seed"] == 0], ["x"], "y"), "x")
    line, caps, _ = axes.containers[0].lines
    assert caps[0].get_ydata().tolist() == line.get_ydata().tolist()


def test_bands_are_the_intervals_over_time():
    runs = table(tick=[0, 10, 20], x=[1.0, 2.0])
    found = estimates(runs, ["x", "tick"], "y")
    axes = draw_bands(panel(), found, "x", LABELS)
    assert axes.get_xlabel() == "time (ticks)" and axes.get_ylabel() == "yield (sacks)"
    assert [line.get_label() for line in axes.lines] == ["1", "2"]
    own = found.only({"x": 2.0}).table
    assert axes.lines[1].get_ydata().tolist() == own["middle"].tolist()
    band = axes.collections[1].get_paths()[0].vertices
    assert band[:, 1].min() == pytest.approx(own["low"].min())
    assert band[:, 1].max() == pytest.approx(own["high"].max())
    alone = draw_bands(panel(), estimates(runs[runs["seed"] == 0], ["x", "tick"], "y"), "x")
    assert not alone.collections


def test_a_surface_has_a_cell_a_point_with_its_numbers():
    runs = table(x=[1.0, 2.0, 3.0], z=[10.0, 20.0])
    axes = draw_surface(panel(style.PAGE, 80), estimates(runs, ["x", "z"], "y"), "x", "z", LABELS)
    assert axes.collections[0].get_array().shape == (2, 3)
    assert axes.collections[0].get_array().tolist() == [[12.5, 13.5, 14.5], [22.5, 23.5, 24.5]]
    assert [one.get_text() for one in axes.get_xticklabels()] == ["1", "2", "3"]
    assert [one.get_text() for one in axes.get_yticklabels()] == ["10", "20"]
    first = axes.texts[0].get_text().splitlines()
    assert first[0] in ("12", "12.5") and "–" in first[1]
    beside = axes.figure.axes[1]
    assert beside.get_ylabel() == "yield (sacks)"
    inks = {to_rgb(one.get_color()) for one in axes.texts}
    assert len(inks) == 2  # white on dark, dark on light


def test_a_point_without_runs_is_an_empty_cell():
    runs = table(x=[1.0, 2.0], z=[10.0, 20.0])
    some = runs[(runs["x"] == 1.0) | (runs["z"] == 10.0)]
    axes = draw_surface(panel(), estimates(some, ["x", "z"], "y"), "x", "z")
    assert np.ma.getmaskarray(axes.collections[0].get_array()).sum() == 1
    assert len(axes.texts) == 3


def test_a_map_of_many_cells_writes_no_numbers_into_them():
    runs = table(x=[float(n) for n in range(30)], z=[1.0, 2.0])
    axes = draw_surface(panel(), estimates(runs, ["x", "z"], "y"), "x", "z")
    assert not axes.texts
    assert axes.get_xticklabels()[0].get_rotation() == 90


def test_effects_are_dots_with_intervals_beside_zero():
    runs = table(x=[1.0, 2.0, 4.0])
    found = effects(runs, ["x"], "y", {"x": 1.0})
    axes = draw_effects(panel(), found, LABELS)
    assert axes.get_xlabel() == "difference of yield (sacks)"
    assert [one.get_text() for one in axes.get_yticklabels()] == ["2", "4"]
    dots = axes.collections[-1]
    assert dots.get_offsets().tolist() == [[1.0, 0.0], [3.0, 1.0]]
    # Their intervals leave 0 out, so they are filled.
    assert {tuple(one[:3]) for one in dots.get_facecolors()} == {to_rgb(style.BLUE)}


def test_points_that_fill_a_space_get_dots_and_a_smooth_line():
    rng = np.random.default_rng(3)
    runs = pd.DataFrame({"x": rng.uniform(0, 1, 80), "w": rng.uniform(0, 1, 80)})
    runs["y"] = 3 * runs["x"] + 0.1 * rng.normal(size=80)
    axes = draw_scatter(panel(), estimates(runs, ["x", "w"], "y"), "x", LABELS)
    assert len(axes.collections[0].get_offsets()) == 80
    at, line = axes.lines[0].get_data()
    inside = (at > 0.1) & (at < 0.9)
    assert np.abs(line - 3 * at)[inside].max() < 0.15
    assert axes.get_xlabel() == "x (euros)"


def test_of_few_levels_the_line_joins_means():
    at, line = smooth(np.array([0, 1, 0, 1.0]), np.array([1.0, 2.0, 3.0, np.nan]))
    assert at.tolist() == [0.0, 1.0] and line.tolist() == [2.0, 2.0]


def test_panels_share_the_looks_of_lines_that_only_some_have():
    found = estimates(table(x=[1.0, 2.0], kind=["b"]), ["x", "kind"], "y")
    of_lines = Varying("kind", ("a", "b"), False)
    axes = draw_response(panel(), found, "x", "kind", of_lines=of_lines)
    assert axes.containers[1].lines[0].get_color() == palette.lines(2, False)[1].colour


def luminance(colour):
    """Relative luminance (WCAG), as a page printed in grey shows it."""
    linear = [c / 12.92 if c <= 0.04045 else ((c + 0.055) / 1.055) ** 2.4 for c in colour]
    return float(np.dot([0.2126, 0.7152, 0.0722], linear))


DEUTERANOPIA = np.array(
    [[0.367322, 0.860646, -0.227968], [0.280085, 0.672501, 0.047413], [-0.01182, 0.04294, 0.968881]]
)
"""Machado, Oliveira & Fernandes (2009), severity 1, on linear RGB."""
PROTANOPIA = np.array(
    [
        [0.152286, 1.052583, -0.204868],
        [0.114503, 0.786281, 0.099216],
        [-0.003882, -0.048116, 1.051998],
    ]
)


@pytest.mark.parametrize("matrix", [DEUTERANOPIA, PROTANOPIA])
def test_colours_of_lines_stay_apart_for_the_colour_blind(matrix):
    """As far as 0.1 in linear RGB, with marker and dashes beside."""
    for ordered, count in ((True, 4), (False, 4)):
        seen = []
        for one in palette.lines(count, ordered):
            rgb = np.array(to_rgb(one.colour))
            linear = np.where(rgb <= 0.04045, rgb / 12.92, ((rgb + 0.055) / 1.055) ** 2.4)
            seen.append(matrix @ linear)
        apart = [np.linalg.norm(a - b) for n, a in enumerate(seen) for b in seen[:n]]
        assert min(apart) > 0.05, (ordered, apart)


def test_ordered_colours_get_lighter_also_in_grey():
    steps = [luminance(to_rgb(one.colour)) for one in palette.lines(6, True)]
    assert all(b - a > 0.02 for a, b in itertools.pairwise(steps)), steps
    scale = [luminance(mpl.colormaps[palette.SURFACE](v)[:3]) for v in np.linspace(0, 1, 20)]
    assert scale == sorted(scale)


def test_values_are_written_short():
    assert value_name("/some/where/bold.yaml") == "bold"
    assert value_name("gatherer/mind_by_hand.yaml") == "by hand"
    assert value_name("gatherer/mind_learned") == "learned"
    assert value_name(np.float64(0.1 + 0.2)) == "0.3"
    assert value_name(123456.0) == "123,456" and value_name(1000) == "1,000"


def test_a_unit_that_the_name_says_is_not_said_again():
    labels = Labels({"n": "stones in the way"}, {"n": "stones", "share": "%"})
    assert labels.axis("n") == "stones in the way" and labels.axis("share") == "share (%)"
    assert with_unit("stonework", "stone") == "stonework (stone)"


def test_type_is_never_smaller_than_seven_points_and_settings_stay():
    before = dict(mpl.rcParams)
    with style.style():
        axes = panel(style.PAGE, 80)
        draw_surface(axes, estimates(table(x=[1.0, 2.0], z=[1.0, 2.0]), ["x", "z"], "y"), "x", "z")
        axes.figure.savefig(io.BytesIO())
        sizes = [one.get_fontsize() for one in axes.figure.findobj(mpl.text.Text)]
    assert min(sizes) >= 7 and dict(mpl.rcParams) == before
