"""Splits into roles and their distance to the wanted one."""

import numpy as np
import pandas as pd
import pytest
from hypothesis import given
from hypothesis import strategies as st

from socialmind.errors import SocialmindError
from socialmind.experiments.measures.split import distance_to, role_of, split_of, wanted_shares

RATIO = {"A": 1, "B": 2}


def roles(*records):
    """A table of roles: each record (tick, "ABB…")."""
    rows = [(tick, n, role) for tick, line in records for n, role in enumerate(line)]
    return pd.DataFrame(rows, columns=["tick", "agent", "role"])


def test_the_threshold_itself_is_the_second_role():
    assert role_of([0.4999, 0.5], ("wheat", "tools")).tolist() == ["wheat", "tools"]
    assert role_of([0.1, 0.2, 0.3], threshold=0.2).tolist() == ["A", "B", "B"]


def test_nine_agents_collapsing_and_redrawing():
    split = split_of(roles((0, "AAABBBBBB"), (10, "BBBBBBBBB"), (20, "AAAAABBBB")))
    assert split["A"].tolist() == [3, 0, 5]
    assert distance_to(split, RATIO).tolist() == [0, 3, 2]


def test_ticks_and_roles_are_in_order_whatever_that_of_the_rows():
    split = split_of(roles((20, "BCA"), (0, "CCB")))
    assert (split.index.tolist(), split.columns.tolist()) == ([0, 20], ["A", "B", "C"])
    assert split.to_numpy().tolist() == [[0, 1, 2], [1, 1, 1]]


def test_the_wanted_split_goes_with_the_number_of_agents():
    # A third of eight is 8/3: two A are 2/3 away, three 1/3.
    split = split_of(roles((0, "AABBBBBB"), (1, "AAABBBBB")))
    assert distance_to(split, RATIO).tolist() == pytest.approx([2 / 3, 1 / 3])


def test_a_role_that_nobody_wants_or_nobody_has_counts():
    # Three wanted roles of which one is missing, and one agent undecided: two have to change.
    split = split_of(roles((0, ["A", "A", "A", "B", "B", "undecided"])))
    assert distance_to(split, {"A": 1, "B": 1, "C": 1}).tolist() == [2.0]


def test_the_ratio_may_be_turned():
    split = split_of(roles((0, "ABB"), (50, "ABB"), (100, "ABB")))
    turned = pd.DataFrame({"tick": [50, 0], "A": [2, 1], "B": [1, 2]})  # in any order
    assert distance_to(split, turned).tolist() == pytest.approx([0, 1, 1])


@given(
    st.lists(st.integers(0, 12), min_size=2, max_size=4).filter(sum),
    st.lists(st.integers(0, 5), min_size=2, max_size=4).filter(sum),
)
def test_it_is_what_a_search_over_changes_of_role_finds(numbers, parts):
    names = list("ABCD")
    split = pd.DataFrame([dict(zip(names, numbers, strict=False))], index=[0])
    ratio = dict(zip(names, parts, strict=False))
    found = distance_to(split, ratio).item()
    total, aim = sum(numbers), {name: part / sum(parts) for name, part in ratio.items()}
    too_many = [
        max(0.0, count - aim.get(name, 0.0) * total)
        for name, count in zip(names, numbers, strict=False)
    ]
    assert found == pytest.approx(sum(too_many))
    assert 0 <= found <= total + 1e-9


@given(st.permutations(range(9)))
def test_who_has_which_role_makes_no_difference(order):
    line = np.array(list("AAAABBBBB"))[list(order)]
    assert split_of(roles((0, line))).to_dict("records") == [{"A": 4, "B": 5}]


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda: split_of(pd.DataFrame({"tick": [1]})), "without the column 'agent'"),
        (lambda: split_of(roles((4, ["A", None]))), "agent 1 has none at tick 4"),
        (lambda: wanted_shares({"A": 0, "B": 0}, [0]), "not all 0"),
        (lambda: wanted_shares({"A": -1, "B": 2}, [0]), "0 or more"),
        (lambda: wanted_shares({}, [0]), "parts of roles"),
        (
            lambda: wanted_shares(pd.DataFrame({"tick": [10], "A": [1]}), [9, 10, 11]),
            "no ratio is wanted at tick 9; the first is at 10",
        ),
    ],
)
def test_what_cannot_be_measured_is_refused(call, message):
    with pytest.raises(SocialmindError, match=message):
        call()
