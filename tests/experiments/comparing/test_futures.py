"""Futures side by side: differences by hand, intervals by the bootstrap, pairs by seeds."""

import re

import matplotlib as mpl
import numpy as np
import pandas as pd
import pytest
from matplotlib.colors import to_rgb

from socialmind.drawing import style as paper
from socialmind.errors import SocialmindError
from socialmind.experiments.comparing.figure import draw_difference, draw_futures, figure_of
from socialmind.experiments.comparing.futures import futures
from socialmind.experiments.measures.effects import compared


class Manifest:
    branch = None

    def __init__(self, identity):
        self._identity = identity

    def identity(self):
        return self._identity


class Stored:
    """A run as comparing asks for it."""

    def __init__(self, seed, ticks, **columns):
        self.seed = seed
        self.series = pd.DataFrame({"tick": ticks, **columns})
        self.manifest = Manifest(f"{seed}")


def several(seeds, shift, ticks=(0, 10, 20)):
    """Runs whose wheat is drawn by their seed, moved by a shift."""
    drawn = {seed: np.random.default_rng(seed).normal(size=len(ticks)) for seed in seeds}
    return [Stored(one, ticks, wheat=drawn[one] + shift, word=["a"] * len(ticks)) for one in seeds]


def test_two_runs_differ_by_what_they_differ():
    one = Stored(1, [0, 5, 10], wheat=[1.0, 2.0, 4.0], farmers=[3, 3, 2])
    other = Stored(1, [0, 10, 20], wheat=[1.0, 7.0, 9.0], farmers=[3, 5, 5])
    found = futures({"before": [one], "after": [other]})
    assert found.columns == ("wheat", "farmers") and found.paired
    rows = found.of("wheat", "after")
    assert rows["tick"].tolist() == [0, 10]
    assert rows["mean"].tolist() == [1.0, 7.0] and rows["difference"].tolist() == [0.0, 3.0]
    assert rows["difference_low"].isna().all() and rows["low"].isna().all()
    assert found.of("farmers", "after")["difference"].tolist() == [0.0, 3.0]
    assert found.of("farmers", "before")["difference"].tolist() == [0.0, 0.0]


def test_groups_have_the_intervals_of_the_bootstrap():
    first, second = several(range(6), 0.0), several(range(10, 15), 2.0)
    found = futures({"a": first, "b": second})
    assert not found.paired and found.columns == ("wheat",)
    for place in range(3):
        values = [[run.series["wheat"][place] for run in group] for group in (second, first)]
        expected = compared(*values, paired=False)
        row = found.of("wheat", "b").iloc[place]
        assert row["mean"] == expected.first.mean and row["low"] == expected.first.low
        assert (row["difference_low"], row["difference_high"]) == (
            expected.difference.low,
            expected.difference.high,
        )


def test_equal_seeds_make_pairs_in_any_order():
    found = futures({"a": several(range(6), 0.0), "b": several([3, 1, 5, 0, 2, 4], 2.0)})
    assert found.paired
    rows = found.of("wheat", "b")
    assert np.allclose(rows[["difference", "difference_low", "difference_high"]], 2.0)
    assert (rows["high"] - rows["low"] > 0.1).all()  # although runs differ far more


def test_a_missing_value_leaves_the_interval_out():
    first, second = several(range(4), 0.0), several(range(4), 1.0)
    second[2].series.loc[1, "wheat"] = np.nan
    rows = futures({"a": first, "b": second}).of("wheat", "b")
    assert rows["difference_low"].isna().tolist() == [False, True, False]


def test_what_cannot_be_compared_is_said():
    one, other = several([1], 0.0)[0], several([2], 0.0, (1, 11))[0]
    with pytest.raises(SocialmindError, match="no tick that all runs recorded"):
        futures({"a": [one], "b": [other]})
    with pytest.raises(SocialmindError, match=r"no column 'whaet' of numbers .* mean 'wheat'"):
        futures({"a": [one], "b": several([2], 0.0)}, ["whaet"])
    with pytest.raises(SocialmindError, match="two groups of runs"):
        futures({"a": [one]})
    groups = {str(seed): several([seed], 0.0) for seed in range(6)}
    with pytest.raises(SocialmindError, match="6 groups in one figure"):
        figure_of(futures(groups))


def test_panels_take_and_give_axes_with_units():
    found = futures({"a": several(range(4), 0.0), "b": several(range(4), 1.0)})
    axes = paper.figure(90, 60).subplots()
    assert draw_futures(axes, found, "wheat", "bushels") is axes
    assert axes.get_ylabel() == "wheat (bushels)" and axes.get_xlabel() == "time (ticks)"
    assert len(axes.lines) == 2 and len(axes.collections) == 2
    below = paper.figure(90, 60).subplots()
    assert draw_difference(below, found, "wheat") is below
    assert below.lines[-1].get_ydata().tolist() == pytest.approx([1.0] * 3)


def test_a_unit_that_is_the_columns_name_is_said_once():
    found = futures({"a": several(range(4), 0.0), "b": several(range(4), 1.0)})
    above, below = figure_of(found, {"wheat": "wheat"}).axes
    assert above.get_ylabel() == "wheat" and below.get_ylabel() == "difference (wheat)"


def test_panels_have_letters_row_by_row_and_say_what_differences_are_from():
    groups = {name: several([1], shift) for name, shift in (("all_bound", 0.0), ("free", 1.0))}
    for runs in groups.values():
        runs[0].series["more"] = 1.0
    figure = figure_of(futures(groups))
    heads = [axes.get_title(loc="left") for axes in figure.axes]
    assert [re.search(r"bf{(\w)}", head)[1] for head in heads] == list("abcd")
    assert ["difference from all bound" in head for head in heads] == [False, False, True, True]
    assert [text.get_text() for text in figure.legends[0].texts] == ["all bound", "free"]


def grey(colour):
    """How light a colour is in print without colours."""
    return float(np.dot([0.299, 0.587, 0.114], to_rgb(colour)))


def test_lines_that_are_alike_in_grey_have_other_dashes():
    groups = {str(seed): several([seed], seed) for seed in range(5)}
    lines = figure_of(futures(groups)).axes[0].lines
    looks = [(grey(line.get_color()), line._dash_pattern) for line in lines]
    for place, (light, dashes) in enumerate(looks):
        for other, others in looks[:place]:
            assert abs(light - other) > 0.12 or dashes != others


def test_a_figure_is_as_wide_as_a_column_or_a_page(tmp_path):
    one = {name: several([1], shift) for name, shift in (("a", 0.0), ("b", 1.0))}
    before = dict(mpl.rcParams)
    figure = figure_of(futures(one))
    assert figure.get_size_inches()[0] * 25.4 == pytest.approx(paper.COLUMN)
    for runs in one.values():
        runs[0].series["more"] = 1.0
    assert figure_of(futures(one)).get_size_inches()[0] * 25.4 == pytest.approx(paper.PAGE)
    assert dict(mpl.rcParams) == before
    paper.write_figure(figure, tmp_path / "one.svg")
    assert re.search(r"time \(ticks\)", (tmp_path / "one.svg").read_text())
