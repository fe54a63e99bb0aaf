"""Measures as expressions: what they come to, and what they refuse."""

import math

import numpy as np
import pytest

from socialmind.errors import SocialmindError
from socialmind.experiments.sweeps.measures.expressions import Expression


class Source:
    series = {  # noqa: RUF012
        "tick": np.arange(5),
        "farmers": np.array([1, 2, 3, 4, 5]),
        "mean": np.array([1.0, 2.0]),
        "odd name": np.array([7.0]),
    }
    fields = {"wheat": np.array([0.0, 0.0, 0.0, 1.0])}  # noqa: RUF012

    def column(self, name):
        if name not in self.series:
            raise KeyError(list(self.series))
        return self.series[name]

    def agents(self, population, field):
        if population not in (None, "humans") or field not in self.fields:
            raise KeyError(list(self.fields))
        return self.fields[field]


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("mean(farmers[-2:])", 4.5),
        ("farmers[-1] - first(farmers)", 4),
        ("gini(agents.wheat)", 0.75),
        ('gini(agents("humans").wheat)', 0.75),
        ("last(farmers) > 3 and not min(farmers) > 3", True),
        ("0 < last(farmers) < 5", False),
        ("quantile(farmers, 0.5)", 3.0),
        ("std(farmers)", math.sqrt(2.5)),
        ("count(farmers >= 3)", 3),
        ("sum(farmers * farmers)", 55),
        ("max(farmers) if last(tick) == 4 else 0", 5),
        ("max(1, 2, 3)", 3),
        ("2 ** 3 + 7 // 2 - 7 % 4", 8.0),
        ('series("odd name")[0]', 7.0),
        ("mean(mean)", 1.5),
        ("median(farmers[::2])", 3.0),
        ("-farmers[0]", -1),
        ("9 ** 9 ** 9", math.inf),
    ],
)
def test_values(text, value):
    assert Expression("m", text).value(Source()) == value


def test_the_mean_of_nothing_is_nan():
    assert math.isnan(Expression("m", "mean(farmers[10:])").value(Source()))


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("meen(farmers)", r"column 1: no function meen\(\); did you mean 'mean'\?"),
        ("1 + __import__('os')", r"column 5: no function __import__\(\)"),
        ("farmers.__class__", r"an attribute \.__class__; only agents have fields"),
        ("agents.wheat.real", r"an attribute \.real"),
        ("[one for one in farmers]", "a loop, which measures do not have"),
        ("lambda: 1", "a lambda"),
        ("(one := 1)", "an assignment"),
        ("'text'", "a text"),
        ("mean(", r"column 5: not an expression"),
        ("farmers[1.5]", "column 9: a place that is no whole number"),
        ("farmers[farmers]", "a place that is no whole number"),
        ("farmers[::0]", "a step of 0"),
        ("mean(farmers, axis=0)", "an argument by its name"),
        ("mean(1, 2)", "mean of 2; expected 1"),
        ("mean(*farmers)", "a star"),
        ("a" * 2000, "2000 characters"),
        ("-" * 300 + "1", "operators or calls in more than 100 others"),
        ("-" * 995 + "1", "expected|more than 100"),
    ],
)
def test_what_is_refused_when_read(text, said):
    with pytest.raises(SocialmindError, match=said):
        Expression("m", text)


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("mean(farmerz)", r"column 6: no column 'farmerz' of the series; did you mean 'farmers'"),
        ("agents.wheet", "no column 'wheet' of the agents; did you mean 'wheat'"),
        ("farmers", r"gives 5 values; expected one: write last\(farmers\)"),
        ("farmers[99]", "index 99 is out of bounds"),
        ("farmers + mean", "could not be broadcast"),
    ],
)
def test_what_is_refused_of_a_run(text, said):
    with pytest.raises(SocialmindError, match=said):
        Expression("m", text).value(Source())
