"""Figures of sensitivity: what is drawn, in which order, with luck as a band."""

import math

import pytest
from matplotlib.figure import Figure

from socialmind.drawing import style as paper
from socialmind.experiments import designs, sensitivity_of
from socialmind.experiments.figures.labels import Labels
from socialmind.experiments.sensitivity.figure import draw_indices, draw_pairs, figure_of

RANGES = dict.fromkeys("abc", (-math.pi, math.pi))


def labels(axes):
    return [one.get_text() for one in axes.get_yticklabels()]


def test_sobol_indices_with_their_pairs_fill_a_page(sobol_sweep):
    found = sensitivity_of(sobol_sweep, ["linear", "ishigami"])
    figure = figure_of(found)
    assert figure.get_figwidth() == pytest.approx(paper.PAGE / 25.4)
    above, beside, below, _ = figure.axes
    assert sorted(labels(above)) == ["a", "b", "c"] and above.get_ylim() == beside.get_ylim()
    assert labels(below)[0].count("×") == 1 and len(labels(below)) == 3
    assert above.get_xlabel() == "share of the variance"
    first, total = (line.get_xdata().tolist() for line in above.lines[:2])
    assert first == found.of("linear", "first")["value"].tolist()
    assert total == found.of("linear", "total")["value"].tolist()
    assert len({axes.get_xlim() for axes in figure.axes}) == 1
    (legend,) = figure.legends
    shown = [text.get_text() for text in legend.texts]
    assert {"first order", "total order", "second order", "interval of 95 %"} <= set(shown)
    assert len(shown) == len(set(shown))


def test_parameters_stand_by_what_they_do_to_all_outputs(sobol_sweep):
    found = sensitivity_of(sobol_sweep, ["linear", "square"])
    panel = figure_of(found, Labels({"a": "pace", "linear": "coins held"})).axes[0]
    assert labels(panel) == ["pace", "b", "c"]
    assert panel.get_title("left").endswith("coins held")


def test_axes_are_the_reader_s_own(sobol_sweep):
    found = sensitivity_of(sobol_sweep, ["ishigami"])
    axes = Figure().subplots()
    assert draw_indices(axes, found, "ishigami") is axes
    assert axes.get_ylim()[0] > axes.get_ylim()[1]
    assert draw_pairs(Figure().subplots(), found, "ishigami").lines


def test_effects_have_a_unit_and_luck_a_band(swept):
    design = designs.morris(RANGES, 8)
    found = sensitivity_of(swept(design, seeds=range(2), fixed={"luck": 1.0}), ["linear"])
    figure = figure_of(found, Labels(units={"linear": "coins"}))
    assert figure.get_figwidth() == pytest.approx(paper.COLUMN / 25.4)
    (axes,) = figure.axes
    assert axes.get_xlabel().replace("\n", " ") == "change over a parameter's range (coins)"
    floor = found.luck["floor"].item()
    assert axes.patches[0].get_extents().transformed(axes.transData.inverted()).x1 == (
        pytest.approx(floor)
    )
    assert "μ* by luck alone" in axes.get_legend_handles_labels()[1]


def test_names_stand_below_numbers(swept):
    table = designs.grid({"word": ["low", "high"], "a": [0.0, 1.0, 2.0, 3.0]})
    (axes,) = figure_of(sensitivity_of(swept(table), ["linear"])).axes
    assert labels(axes) == ["a", "word"]


def test_many_outputs_share_a_page(swept):
    found = sensitivity_of(swept(designs.lhs(RANGES, 12)))
    shown = [axes for axes in figure_of(found).axes if axes.get_visible()]
    assert len(shown) == len(found.outputs) == 5
