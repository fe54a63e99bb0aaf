"""What panels show of agents is what their tables hold."""

import numpy as np
import pytest

from socialmind.catalogue import load_model
from socialmind.errors import SocialmindError
from socialmind.studio.running.plots import panel_of, table_of


@pytest.fixture(scope="module")
def village():
    society = load_model("farmer_artisan")(seed=1, compiled=False)
    society.advance(30)
    return society


def test_a_histogram_counts_everybody_once(village):
    panel = {"kind": "histogram", "population": "humans", "x": "field wheat"}
    found = panel_of(village, panel)
    assert found.columns["counts"].sum() == len(village.humans)
    assert found.said["low"] == pytest.approx(village.humans.wheat.min(), rel=1e-6)


def test_a_histogram_of_words_counts_each(village):
    found = panel_of(village, {"kind": "histogram", "population": "humans", "x": "plan"})
    plans = village.plans(village.humans)
    assert found.columns["counts"].tolist() == [plans.count(one) for one in found.said["words"]]


def test_a_histogram_of_few_whole_numbers_has_a_bar_for_each():
    society = load_model("schelling")(seed=1, compiled=False)
    found = panel_of(society, {"kind": "histogram", "population": "people", "x": "field kind"})
    assert found.columns["counts"].tolist() == [500, 500]
    assert (found.said["low"], found.said["high"]) == (-0.5, 1.5)


def test_a_scatter_has_a_point_for_each_in_the_order_of_x(village):
    panel = {"kind": "scatter", "population": "humans", "x": "field wheat", "y": "cogniton Farmer"}
    found = panel_of(village, panel).columns
    order = np.argsort(village.humans.wheat, kind="stable")
    assert found["x"] == pytest.approx(village.humans.wheat[order], rel=1e-6)
    assert found["y"] == pytest.approx(village.humans.cogniton("Farmer")[order], rel=1e-6)


def test_a_table_has_all_with_their_identities(village):
    panel = {"kind": "scatter", "population": "humans", "x": "field wheat", "y": "field tools"}
    found = table_of(village, panel, {})
    assert list(found) == ["agent", "wheat", "tools"]
    assert found["agent"] == village.humans.id.tolist()
    series = {"kind": "series", "names": ["wheat", "nothing"]}
    assert table_of(village, series, {"tick": [0], "wheat": [1.0]}) == {"tick": [0], "wheat": [1.0]}


@pytest.mark.parametrize(
    "wrong",
    [
        {"kind": "histogram", "population": "people", "x": "field wheat"},
        {"kind": "histogram", "population": "humans", "x": "field whaet"},
        {"kind": "scatter", "population": "humans", "x": "field wheat"},
    ],
)
def test_what_there_is_not_is_refused(village, wrong):
    with pytest.raises(SocialmindError):
        panel_of(village, wrong)
