"""Estimates by hand: middles, intervals, quantiles, pairs; and what is refused."""

import math

import numpy as np
import pandas as pd
import pytest

from socialmind.errors import SocialmindError
from socialmind.experiments.figures.estimates import Summary, difference, effects, estimates
from socialmind.experiments.measures.effects import compared
from socialmind.experiments.measures.intervals import interval_of, share_interval


def runs(**columns):
    return pd.DataFrame(columns)


def test_means_have_the_interval_of_the_bootstrap():
    table = runs(price=[1.0] * 5 + [2.0], sold=[3.0, 4.0, 4.0, 5.0, 9.0, 7.0])
    found = estimates(table, ["price"], "sold")
    expected = interval_of([3.0, 4.0, 4.0, 5.0, 9.0])
    first, second = found.table.to_dict("records")
    assert (first["runs"], first["middle"]) == (5, 5.0)
    assert (first["low"], first["high"]) == (expected.low, expected.high)
    assert second["middle"] == 7.0 and math.isnan(second["low"]) and math.isnan(second["high"])
    assert found.has_intervals
    assert found.said == "means, 95 % intervals by Student's t"


def test_shares_of_runs_have_score_intervals():
    table = runs(price=[1.0] * 8 + [2.0] * 8, none_left=[1.0] * 8 + [0.0, 1.0] * 4)
    found = estimates(table, ["price"], "none_left")
    row = found.table.iloc[0]
    assert (row["middle"], row["low"], row["high"]) == tuple(vars(share_interval([1] * 8)).values())
    assert found.said == "shares of the runs, 95 % score intervals"


def test_a_caption_says_which_interval_points_have():
    table = runs(price=[1.0] * 8 + [2.0] * 3, sold=[float(n) for n in range(11)])
    found = estimates(table, ["price"], "sold")
    assert found.where(price=1.0).said == "means, 95 % bootstrap intervals"
    assert found.said == "means, 95 % bootstrap intervals (Student's t of fewer than 6 runs)"


def test_medians_have_the_quantiles_of_the_runs():
    table = runs(price=[1.0] * 11, sold=[float(n) for n in range(11)])
    found = estimates(table, ["price"], "sold", Summary("median", 0.8))
    row = found.table.iloc[0]
    # The tenth and the ninetieth hundredth of 0 … 10 are 1 and 9.
    assert (row["middle"], row["low"], row["high"]) == pytest.approx((5.0, 1.0, 9.0))
    assert found.said == "medians, quantiles that hold 80 % of the runs"


def test_a_mean_of_nine_and_eleven_by_hand():
    """Their standard error is 1, and Student's t of one degree of freedom 12.706."""
    row = estimates(runs(p=[1, 1], y=[9.0, 11.0]), ["p"], "y").table.iloc[0]
    assert (row["middle"], row["low"], row["high"]) == pytest.approx((10, -2.706, 22.706), abs=1e-3)


def test_runs_without_a_value_do_not_count_and_are_counted():
    table = runs(price=[1.0, 1.0, 2.0], sold=[3.0, math.nan, math.inf])
    found = estimates(table, ["price"], "sold")
    assert found.without == 2
    assert found.table[["price", "runs", "middle"]].values.tolist() == [[1.0, 1.0, 3.0]]
    assert not found.has_intervals


def test_nothing_may_vary():
    assert estimates(runs(sold=[2.0, 4.0]), [], "sold").table["middle"].tolist() == [3.0]


def test_effects_are_of_pairs_where_seeds_are_common_whatever_their_order():
    table = runs(price=[1, 1, 1, 2, 2, 2], seed=[7, 8, 9, 9, 7, 8],
                 sold=[1.0, 10.0, 100.0, 102.0, 2.0, 13.0])  # fmt: skip
    found = effects(table, ["price"], "sold", {"price": 1})
    (row,) = found.table.to_dict("records")
    assert row["paired"] and row["difference"] == pytest.approx(2.0)  # of 1, 3 and 2
    expected = interval_of([1.0, 3.0, 2.0])
    assert {round(row["low"], 9), round(row["high"], 9)} == {
        round(expected.low, 9), round(expected.high, 9),
    }  # fmt: skip
    assert found.said == "differences of means in pairs of equal seeds, 95 % intervals"


def test_effects_of_other_seeds_are_of_all_runs():
    table = runs(price=[1, 1, 1, 2, 2], seed=[1, 2, 3, 4, 5], sold=[1.0, 2.0, 6.0, 4.0, 8.0])
    found = effects(table, ["price"], "sold", {"price": 1}, level=0.9)
    (row,) = found.table.to_dict("records")
    expected = compared([4.0, 8.0], [1.0, 2.0, 6.0], paired=False, level=0.9).difference
    assert not row["paired"]
    assert (row["difference"], row["low"], row["high"]) == (
        expected.mean, expected.low, expected.high,
    )  # fmt: skip
    assert found.said == "differences of means of all runs, 90 % intervals"


def test_of_single_runs_there_is_a_difference_and_no_interval():
    one = runs(seed=[1], y=[5.0])
    found, paired = difference(one, runs(seed=[1], y=[3.0]), "y")
    assert found.mean == 2.0 and math.isnan(found.low) and paired


def test_a_failed_run_takes_its_partner_out_of_the_pairs():
    table = runs(p=[1, 1, 2, 2], seed=[1, 2, 1, 2], y=[1.0, np.nan, 4.0, 50.0])
    (row,) = effects(table, ["p"], "y", {"p": 1}).table.to_dict("records")
    assert row["difference"] == 3.0 and row["paired"]


def test_a_seed_that_both_happen_to_have_makes_no_pairs():
    seeds = [*range(20), *range(19, 39)]
    table = runs(p=[1] * 20 + [2] * 20, seed=seeds, y=[float(one) for one in range(40)])
    (row,) = effects(table, ["p"], "y", {"p": 1}).table.to_dict("records")
    assert row["difference"] == 20.0 and not row["paired"] and row["low"] > 10.0
    few = runs(p=[1, 1] + [2] * 5, seed=[1, 2, 1, 2, 3, 4, 5], y=[0.0, 1.0, *range(5)])
    (row,) = effects(few, ["p"], "y", {"p": 1}).table.to_dict("records")
    assert row["difference"] == 1.5 and not row["paired"]  # two of five have a partner


@pytest.mark.parametrize(
    ("call", "said"),
    [
        (lambda t: estimates(t, ["price"], "sould"), "no measure .* 'sould'; did you mean 'sold'"),
        (lambda t: estimates(t, ["prise"], "sold"), "no column 'prise' .* did you mean 'price'"),
        (lambda t: estimates(t, ["price"], "word"), "word holds 'a'; expected numbers"),
        (lambda t: effects(t, ["price"], "sold", {"price": 3}), "at the baseline price = 3"),
        (lambda t: Summary("mode"), "found 'mode'; expected mean or median"),
        (lambda t: Summary("mean", 95), "found 95; expected above 0 and below 1"),
    ],
)
def test_what_cannot_be_is_said(call, said):
    with pytest.raises(SocialmindError, match=said):
        call(runs(price=[1.0], sold=[2.0], word=["a"], seed=[1]))
