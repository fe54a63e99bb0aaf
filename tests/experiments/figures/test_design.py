"""What designs call for: what varies, in which order, and where effects begin."""

import pandas as pd
import pytest

from socialmind.errors import SocialmindError
from socialmind.experiments import designs
from socialmind.experiments.figures.design import Varying, baseline_of, design_of

GRID = {"n": [1, 2, 3], "x": [0.5, 1.0], "kind": ["b", "a", "c", "d"], "same": [4]}


def test_numbers_come_before_names_and_many_values_before_few():
    found = design_of(designs.grid(GRID), list(GRID))
    assert [one.name for one in found.columns] == ["n", "x", "kind"]
    assert found.columns[2].values == ("b", "a", "c", "d") and not found.columns[2].numeric
    assert found.crossed and found.names == ["n", "x", "kind"]


def test_samples_and_too_many_columns_are_not_crossed():
    ranges = {"x": (0.0, 1.0), "y": (0.0, 1.0)}
    assert not design_of(designs.lhs(ranges, 8), ["x", "y"]).crossed
    many = designs.grid({name: [0, 1] for name in "abcde"})
    assert not design_of(many, list("abcde")).crossed
    one_missing = designs.grid({"x": [1, 2], "y": [1, 2]}).iloc[:3]
    assert not design_of(one_missing, ["x", "y"]).crossed


def test_truth_values_are_no_numbers():
    assert not design_of(pd.DataFrame({"on": [True, False]}), ["on"]).columns[0].numeric


@pytest.mark.parametrize(
    ("values", "logarithmic"),
    [
        ((50.0, 100.0, 200.0, 400.0), True),
        ((1.0, 2.0, 3.0), False),
        ((1.0, 5.0, 9.0), False),
        ((-1.0, 1.0, 100.0), False),
    ],
)
def test_ratios_make_an_axis_of_ratios(values, logarithmic):
    assert Varying("x", values, True).logarithmic is logarithmic


def test_the_baseline_has_what_is_given_and_else_the_defaults_or_comes_first():
    design = design_of(designs.grid({"n": [1, 2, 3], "kind": ["a", "b"]}), ["n", "kind"])
    assert baseline_of(design, {}, {}) == {"n": 1, "kind": "a"}
    assert baseline_of(design, {}, {"n": 2, "kind": "b", "other": 5}) == {"n": 2, "kind": "b"}
    assert baseline_of(design, {}, {"n": 9, "kind": "b"}) == {"n": 1, "kind": "b"}
    assert baseline_of(design, {"n": "3.0"}, {"n": 2, "kind": "b"}) == {"n": 3, "kind": "b"}
    assert baseline_of(design_of(pd.DataFrame({"n": [1]}), ["n"]), {}, {}) is None
    with pytest.raises(SocialmindError, match="kinds does not vary; did you mean 'kind'"):
        baseline_of(design, {"kinds": "1"}, {})
    with pytest.raises(SocialmindError, match="no point with n = 7; values of n: 1, 2, 3"):
        baseline_of(design, {"n": "7"}, {})
