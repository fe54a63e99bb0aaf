"""What a sweep's design calls for, drawn: which figures, their numbers, labels and captions."""

import pytest

from socialmind.documents.labels import defaults_of, labels_of_sweep
from socialmind.drawing import style
from socialmind.errors import SocialmindError
from socialmind.experiments import designs
from socialmind.experiments.figures.estimates import Summary, effects, estimates
from socialmind.experiments.figures.of_sweeps import Wanted, draw_sweep
from socialmind.runs.sources import recorded_class

INFLOW = [0.5, 1.0, 2.0, 4.0]


def drawn(sweep, **wanted):
    model = recorded_class(sweep.capsule)
    labels = labels_of_sweep(sweep.manifest, model)
    return draw_sweep(sweep, Wanted(**wanted), labels, defaults_of(model))


def xlabels(figure):
    return {axes.get_xlabel() for axes in figure.axes if axes.get_visible()} - {""}


def test_one_number_calls_for_a_curve_effects_and_bands(swept):
    sweep = swept({"inflow": INFLOW}, common=True)
    found = drawn(sweep)
    assert list(found.figures) == ["response-late", "effects-late", "series-level"]
    (axes,) = found.figures["response-late"].axes
    assert axes.get_xlabel() == "what comes in (litres a tick)"
    assert " ".join(axes.get_ylabel().split()) == "level, mean of the last 4 ticks (litres)"
    expected = estimates(sweep.runs, ["inflow"], "late").table
    assert axes.containers[0].lines[0].get_ydata().tolist() == expected["middle"].tolist()
    assert axes.get_xscale() == "log"
    assert (
        found.captions["response-late"] == "Means, 95 % intervals by Student's t; 3 runs a point."
    )
    # The default of the inflow is 1.
    apart = effects(sweep.runs, ["inflow"], "late", {"inflow": 1.0}).table
    (axes,) = found.figures["effects-late"].axes
    assert axes.collections[-1].get_offsets()[:, 0].tolist() == apart["difference"].tolist()
    assert found.captions["effects-late"].startswith("Differences of means in pairs of equal seeds")
    assert found.captions["effects-late"].endswith("from what comes in 1.")
    (axes,) = found.figures["series-level"].axes
    assert axes.get_ylabel() == "level (litres)" and len(axes.lines) == len(INFLOW)
    last = sweep.runs.groupby("inflow")["level"].mean().tolist()
    assert [line.get_ydata()[-1] for line in axes.lines] == pytest.approx(last)


def test_names_call_for_dots(swept):
    found = drawn(swept({"rule": ["keep", "share"]}))
    (axes,) = found.figures["response-late"].axes
    assert [one.get_text() for one in axes.get_xticklabels()] == ["keep", "share"]
    assert "of all runs" in found.captions["effects-late"]


def test_two_numbers_call_for_a_map_and_curves_with_intervals(swept):
    sweep = swept(designs.grid({"inflow": [1.0, 2.0, 3.0], "leak": [0.0, 0.5]}))
    figure = drawn(sweep).figures["response-late"]
    surface, curves = figure.axes[:2]
    assert surface.collections[0].get_array().shape == (2, 3)
    assert surface.get_ylabel() == "leak (share a tick)"
    assert [one.get_label() for one in curves.containers] == ["0", "0.5"]
    wide = drawn(sweep, width=style.PAGE).figures["response-late"]
    assert wide.get_figwidth() * 25.4 == pytest.approx(180)
    assert figure.get_figwidth() * 25.4 == pytest.approx(85)


def test_many_values_of_two_numbers_call_for_two_maps(swept):
    design = designs.grid(
        {"inflow": [n / 2 for n in range(1, 8)], "leak": [n / 10 for n in range(7)]}
    )
    sweep = swept(design, seeds=range(2), every=0, measures={"late": "last(level)"})
    found = drawn(sweep)
    assert list(found.figures) == ["response-late", "effects-late"]
    assert "one thing" in found.captions["effects-late"]
    assert any("--every 0" in note for note in found.notes)
    first, second = (a.collections[0].get_array() for a in found.figures["response-late"].axes[:2])
    table = estimates(sweep.runs, ["inflow", "leak"], "late").table
    assert first.max() == table["middle"].max()
    assert second.max() == pytest.approx(((table["high"] - table["low"]) / 2).max())


def test_three_call_for_small_multiples_with_one_scale(swept):
    design = designs.grid(
        {"inflow": [1.0, 2.0, 3.0], "leak": [0.0, 0.5], "rule": ["keep", "share"]}
    )
    found = drawn(swept(design))
    figure = found.figures["response-late"]
    assert [axes.get_title(loc="left") for axes in figure.axes] == ["rule keep", "rule share"]
    assert figure.axes[0].get_ylim() == figure.axes[1].get_ylim()
    assert xlabels(figure) == {"what comes in\n(litres a tick)"}
    bands = found.figures["series-level"]
    assert [axes.get_title(loc="left") for axes in bands.axes] == [
        "rule keep\nleak 0", "rule keep\nleak 0.5", "rule share\nleak 0", "rule share\nleak 0.5",
    ]  # fmt: skip


def test_points_that_fill_a_space_call_for_a_view_of_each_parameter(swept):
    ranges = {"inflow": (0.5, 3.0), "leak": (0.0, 1.0)}
    found = drawn(swept(designs.lhs(ranges, 20), seeds=range(1)))
    assert list(found.figures) == ["response-late"]
    figure = found.figures["response-late"]
    assert len(figure.axes) == 2 and all(len(axes.lines) == 1 for axes in figure.axes)
    assert "smoothing splines" in found.captions["response-late"]


def test_without_replicates_there_are_no_intervals_and_it_is_said(swept):
    found = drawn(swept({"inflow": INFLOW}, seeds=range(1)))
    assert found.captions["response-late"] == "One run a point: no intervals."
    assert found.captions["series-level"] == "One run a point: no intervals."
    assert not found.figures["series-level"].axes[0].collections


def test_medians_have_quantiles_and_say_so(swept):
    sweep = swept({"inflow": INFLOW})
    found = drawn(sweep, summary=Summary("median", 0.5))
    said = "Medians, quantiles that hold 50 % of the runs; 3 runs a point."
    assert found.captions["response-late"] == said
    (axes,) = found.figures["response-late"].axes
    middle = sweep.runs.groupby("inflow")["late"].median().tolist()
    assert axes.containers[0].lines[0].get_ydata().tolist() == middle


def test_what_failed_is_said_below_the_figure(swept):
    found = drawn(swept({"inflow": [0.1, 3.0]}, fixed={"broken": True}))
    assert found.captions["response-late"].endswith("of 6 runs 3 failed.")
    figure = found.figures["response-late"]
    assert "3 failed" in figure._supxlabel.get_text().replace("\n", " ")
    bare = drawn(swept({"inflow": [0.1, 3.0]}, fixed={"broken": True}), captions=False)
    assert bare.figures["response-late"]._supxlabel is None
    assert "effects-late" not in found.figures and "no effects" in found.notes[0]


def test_nothing_varies(swept):
    found = drawn(swept(None))
    assert list(found.figures) == ["series-level"]
    assert any("nothing varies" in note for note in found.notes)


def test_ends_of_series_are_drawn_without_measures(swept):
    found = drawn(swept({"inflow": INFLOW}, measures={}))
    assert list(found.figures) == ["response-level", "effects-level", "series-level"]
    (axes,) = found.figures["response-level"].axes
    assert axes.get_ylabel() == "level at the end (litres)"


def test_what_cannot_be_drawn_is_said(swept):
    sweep = swept({"inflow": INFLOW})
    with pytest.raises(
        SocialmindError, match=r"called 'lat' that holds numbers; did you .* 'late'"
    ):
        drawn(sweep, of=("lat",))
    with pytest.raises(SocialmindError, match="called 'state' that holds numbers"):
        drawn(sweep, of=("state",))
    with pytest.raises(SocialmindError, match="no point with inflow = 7"):
        drawn(sweep, baseline={"inflow": "7"})
    with pytest.raises(SocialmindError, match="no run is finished"):
        drawn(swept({"inflow": [3.0]}, fixed={"broken": True}))
