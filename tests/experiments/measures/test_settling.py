"""When a society has settled, and how often its agents change roles."""

import math
from itertools import pairwise

import numpy as np
import pandas as pd
import pytest
from hypothesis import given
from hypothesis import strategies as st

from socialmind.errors import SocialmindError
from socialmind.experiments.measures.settling import role_changes, settled_from, settlings


def away(*numbers, every=1000):
    return pd.Series(numbers, index=np.arange(len(numbers)) * every, dtype=float)


def test_it_is_settled_from_the_first_record_that_holds():
    #               0  1k 2k 3k 4k 5k 6k 7k 8k 9k
    course = away(3, 1, 2, 1, 1, 0, 0, 1, 1, 4)
    assert settled_from(course) == 3000  # 3k to 8k; 1k does not hold
    assert settled_from(course, hold=6000) == math.inf
    assert settled_from(course, hold=0) == 1000
    assert settled_from(course, within=0) == math.inf
    assert settled_from(course, within=0, hold=1000) == 5000


def test_a_run_that_ends_too_soon_has_not_settled():
    assert settled_from(away(0, 0, 0, 0, 0)) == math.inf
    assert settled_from(away(0, 0, 0, 0, 0, 0)) == 0


def test_one_agent_away_is_within_one_whatever_the_rounding():
    assert settled_from(away(*[0.1 + 0.9 + 1e-16] * 6)) == 0
    assert settled_from(away(*[1.01] * 6)) == math.inf


def test_after_each_shock_it_settles_anew():
    course = away(2, 0, 0, 0, 5, 3, 1, 1, 1, 6, 6, 6)
    found = settlings(course, shocks=[4000, 9000], hold=2000)
    assert found["settled"].tolist() == [1000, 6000, math.inf]
    assert found["ticks"].tolist() == [1000, 2000, math.inf]
    assert found["end"].tolist() == [4000, 9000, math.inf]


def test_after_shocks_as_many_agents_may_be_away_as_is_said():
    course = away(2, 2, 2, 5, 3, 2, 2, 2)
    assert settlings(course, [3000], within=2, hold=1000)["settled"].tolist() == [0, 5000]
    assert settlings(course, [3000], within=3, hold=1000)["settled"].tolist() == [0, 4000]
    assert settlings(course, [3000], hold=1000)["settled"].tolist() == [math.inf, math.inf]


def test_what_holds_past_the_next_shock_only_has_not_settled():
    course = away(2, 2, 0, 0, 0, 0, 0)
    assert settlings(course, shocks=[4000], hold=2000)["settled"].tolist() == [math.inf, 4000]


def test_records_need_not_be_regular():
    course = pd.Series([2.0, 0.0, 0.0, 0.0], index=[0, 7, 4000, 5007])
    assert settled_from(course) == 7


@given(st.lists(st.sampled_from([0.0, 1.0, 2.0]), min_size=1, max_size=30), st.integers(0, 12))
def test_it_agrees_with_the_definition_word_by_word(numbers, hold):
    course = away(*numbers, every=1)
    expected = math.inf
    for tick in reversed(course.index):
        if tick + hold <= course.index[-1] and (course.loc[tick : tick + hold] <= 1).all():
            expected = tick
    assert settled_from(course, hold=hold) == expected


@pytest.mark.parametrize("shocks", [[5, 3], [0], [4, 4], [5, 11]])
def test_shocks_out_of_order_are_refused(shocks):
    with pytest.raises(SocialmindError, match="expected ticks that rise"):
        settlings(away(1, 1, every=10), shocks)


def test_what_is_unknown_has_not_settled():
    assert settled_from(away(math.nan, math.nan, math.nan, every=10), hold=10) == math.inf
    assert settled_from(away(math.nan, 1, 1, every=10), hold=10) == 10
    assert settlings(pd.Series([], index=[], dtype=float)).empty


def test_ticks_that_stand_twice_are_refused():
    with pytest.raises(SocialmindError, match="one for each tick"):
        settled_from(pd.Series([1.0, 1.0], index=[3, 3]))


# Changes ----------------------------------------------------------------------------------------


def table(lines, every=1000):
    rows = [
        (place * every, agent, role)
        for agent, line in lines.items()
        for place, role in enumerate(line)
        if role != " "
    ]
    return pd.DataFrame(rows, columns=["tick", "agent", "role"])


def test_changes_are_counted_by_hand():
    # Two agents, each seen for 4,000 ticks: three changes in 8,000 agent ticks.
    assert role_changes(table({7: "AABAA", 3: "BBBBA"})) == pytest.approx(3 / 8000 * 10_000)


def test_agents_count_for_the_time_that_they_are_there():
    # The second comes at 2,000: one change in 4,000 + 2,000 ticks.
    assert role_changes(table({0: "AAAAB", 1: "  BBB"})) == pytest.approx(1 / 6000 * 10_000)


def test_only_what_happens_in_the_windows_counts():
    lines = {0: "ABABAAAA"}
    assert role_changes(table(lines), [(4000, math.inf)]) == 0
    assert role_changes(table(lines), [(0, 3000)]) == pytest.approx(2 / 2000 * 10_000)
    assert role_changes(table(lines), [(0, 2000), (3000, math.inf)], per=1000) == pytest.approx(
        (1 + 1) / (1000 + 4000) * 1000
    )


def test_a_society_that_never_settled_has_no_changes_after_settling():
    assert math.isnan(role_changes(table({0: "AB"}), [(math.inf, math.inf)]))
    assert math.isnan(role_changes(table({0: "A", 1: "B"})))


@given(st.lists(st.text("AB", min_size=2, max_size=12), min_size=1, max_size=4))
def test_it_is_the_count_of_a_plain_loop(lines):
    changes = sum(a != b for line in lines for a, b in pairwise(line))
    ticks = sum(1000 * (len(line) - 1) for line in lines)
    shuffled = table(dict(enumerate(lines))).sample(frac=1, random_state=1)
    assert role_changes(shuffled) == pytest.approx(changes / ticks * 10_000)
