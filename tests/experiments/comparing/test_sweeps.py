"""Sweeps side by side: differences at the points that they share, and figures of them."""

import math

import pandas as pd
import pytest

from socialmind.errors import SocialmindError
from socialmind.experiments.comparing.sweep_figures import comparison_figure
from socialmind.experiments.comparing.sweeps import compare_sweeps
from socialmind.experiments.figures.labels import Labels
from socialmind.experiments.measures.effects import compared
from socialmind.experiments.measures.intervals import interval_of

LABELS = Labels({"sold": "sold"}, {"sold": "loaves", "price": "euros"})


class Manifest:
    series_columns = ("stock",)

    def __init__(self, columns, counts=None, ticks=10):
        self.columns, self.counts, self.ticks = columns, counts or {}, ticks
        self.model, self.measures = {"name": "bakery"}, {"sold": {"expression": "last(sold)"}}


class Stored:
    """A sweep as comparing asks for it."""

    folder = "bakery"

    def __init__(self, rows, by=("price",), **more):
        self.runs = pd.DataFrame(rows, columns=[*by, "seed", "sold"]).assign(status="finished")
        self.runs["stock"] = 1.0
        design = self.runs[list(by)].drop_duplicates().reset_index(drop=True)
        self.design = design.assign(point=range(len(design)))
        self.varied = list(by)
        self.manifest = Manifest(list(by), **more)


FIRST = [
    (1.0, 5, 10.0),
    (1.0, 6, 20.0),
    (1.0, 7, 40.0),
    (2.0, 5, 5.0),
    (2.0, 6, 6.0),
    (2.0, 7, 9.0),
]
SECOND = [
    (1.0, 7, 44.0),
    (1.0, 5, 11.0),
    (1.0, 6, 25.0),
    (2.0, 1, 1.0),
    (2.0, 2, 3.0),
    (3.0, 1, 7.0),
]


def test_differences_are_of_pairs_where_seeds_pair_at_a_point():
    found = compare_sweeps({"calm": Stored(FIRST), "storm": Stored(SECOND)})
    assert found.outcomes == ("sold",) and found.by == ("price",)
    rows = found.table[found.table["sweep"] == "storm"].set_index("price")
    assert rows.index.tolist() == [1.0, 2.0]  # 3.0 is the storm's alone
    assert rows["paired"].tolist() == [True, False]
    first = rows.loc[1.0]
    assert first["difference"] == pytest.approx((1 + 5 + 4) / 3)
    expected = interval_of([4.0, 1.0, 5.0])
    assert first["difference_low"] == pytest.approx(expected.low)
    apart = compared([1.0, 3.0], [5.0, 6.0, 9.0], paired=False).difference
    second = rows.loc[2.0]
    assert (second["difference"], second["difference_low"]) == (apart.mean, apart.low)
    calm = found.table[found.table["sweep"] == "calm"]
    assert calm["difference"].tolist() == [0.0, 0.0]
    assert calm["low"].tolist()[0] == interval_of([10.0, 20.0, 40.0]).low
    assert found.paired == "in pairs of equal seeds where there are some"
    assert found.notes == ("storm: 1 of its 3 points are no other's",)


def test_single_runs_have_a_difference_and_no_interval():
    one, other = Stored([(1.0, 5, 3.0)]), Stored([(1.0, 5, 4.5)])
    row = compare_sweeps({"a": one, "b": other}).table.iloc[1]
    assert row["difference"] == 1.5 and math.isnan(row["difference_low"])


def test_what_else_tells_sweeps_apart_is_said():
    other = Stored(SECOND, counts={"finished": 6, "failed": 2}, ticks=20)
    found = compare_sweeps({"calm": Stored(FIRST), "storm": other})
    assert "storm: runs of 20 ticks, the first of 10" in found.notes
    assert "storm: 2 failed" in found.notes


@pytest.mark.parametrize(
    ("other", "said"),
    [
        (Stored([(1.0, 5, 1.0)], by=("size",)), "calm varies price, storm size: .* do not meet"),
        (Stored([(9.0, 5, 1.0)]), "no point that all sweeps have; calm has price 1.0, 2.0; storm"),
    ],
)
def test_designs_that_do_not_meet_are_refused(other, said):
    with pytest.raises(SocialmindError, match=said):
        compare_sweeps({"calm": Stored(FIRST), "storm": other})


def test_one_sweep_and_unknown_outcomes_are_refused():
    with pytest.raises(SocialmindError, match="one sweep alone"):
        compare_sweeps({"calm": Stored(FIRST)})
    with pytest.raises(SocialmindError, match="'soled' that holds numbers; did you mean 'sold'"):
        compare_sweeps({"a": Stored(FIRST), "b": Stored(SECOND)}, ["soled"])


def test_a_figure_has_the_curves_above_the_differences():
    found = compare_sweeps({"calm": Stored(FIRST), "storm": Stored(SECOND)})
    figure = comparison_figure(found, "sold", LABELS, 85)
    above, below = figure.axes
    assert above.get_ylabel() == "sold (loaves)" and below.get_ylabel() == "difference (loaves)"
    assert below.get_xlabel() == "price (euros)"
    assert [one.get_label() for one in above.containers] == ["calm", "storm"]
    drawn = below.containers[1].lines[0].get_ydata().tolist()
    assert drawn == found.table.loc[found.table["sweep"] == "storm", "difference"].tolist()
    assert "storm: 1 of its 3" in figure._supxlabel.get_text().replace("\n", " ")


def test_a_second_column_goes_beside():
    rows = [(p, k, s, p + s) for p in (1.0, 2.0) for k in "ab" for s in (1, 2)]
    sweeps = {one: Stored(rows, by=("price", "kind")) for one in ("calm", "storm")}
    figure = comparison_figure(compare_sweeps(sweeps), "sold", LABELS, 180)
    assert [axes.get_title(loc="left") for axes in figure.axes[:2]] == ["kind a", "kind b"]
    assert len(figure.axes) == 4


def test_where_nothing_varies_sweeps_stand_side_by_side():
    rows = [(1, 3.0), (2, 5.0)]
    moved = [(1, 4.0), (2, 7.0)]
    sweeps = {"calm": Stored(rows, by=()), "storm": Stored(moved, by=())}
    figure = comparison_figure(compare_sweeps(sweeps), "sold", LABELS, 85)
    above, below = figure.axes
    assert above.containers[0].lines[0].get_ydata().tolist() == [4.0, 5.5]
    assert below.containers[0].lines[0].get_ydata().tolist() == [0.0, 1.5]
    assert [one.get_text() for one in below.get_xticklabels()] == ["calm", "storm"]


def test_many_columns_give_a_row_a_point_or_a_view_of_each():
    rows = [(a, b, c, s, a + b + c) for a in (1, 2) for b in (1, 2) for c in (1, 2) for s in (1, 2)]
    sweeps = {one: Stored(rows, by=("price", "b", "c")) for one in ("calm", "storm")}
    figure = comparison_figure(compare_sweeps(sweeps), "sold", LABELS, 180)
    assert len(figure.axes[0].get_yticklabels()) == 8
    many = [(n / 60, (7 * n % 60) / 60, 1, 2.0) for n in range(60)]
    sweeps = {one: Stored(many, by=("price", "b")) for one in ("calm", "storm")}
    figure = comparison_figure(compare_sweeps(sweeps), "sold", LABELS, 180)
    assert [axes.get_xlabel() for axes in figure.axes] == ["price (euros)", "b"]
