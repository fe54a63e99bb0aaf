"""Division of labour and specialised agents, against values worked out by hand."""

import math

import numpy as np
import pandas as pd
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from socialmind.errors import SocialmindError
from socialmind.experiments.measures.division import (
    Division,
    division_by_chance,
    division_of_labour,
    share_specialised,
    works_of,
)

works = arrays(
    np.int64, st.tuples(st.integers(1, 5), st.integers(1, 4)), elements=st.integers(0, 9)
)


def test_work_is_counted_by_agent_and_task_with_amounts():
    table = pd.DataFrame(
        {"tick": [5, 1, 9], "agent": [4, 4, 2], "task": ["B", "A", "B"], "amount": [2.5, 1.0, 4.0]}
    )
    found = works_of(table, since=5)
    assert found.to_dict("index") == {2: {"A": 0.0, "B": 4.0}, 4: {"A": 0.0, "B": 2.5}}


def test_an_amount_that_nobody_knows_is_refused():
    table = pd.DataFrame({"tick": [1, 2], "agent": 0, "task": "A", "amount": [1.0, math.nan]})
    with pytest.raises(SocialmindError, match="an amount that is not finite"):
        works_of(table)


def test_the_first_tick_counts_and_the_last_does_not():
    table = pd.DataFrame({"tick": [3, 5, 9], "agent": [0, 0, 0], "task": list("ABB")})
    assert works_of(table, since=3, until=9).to_dict("index") == {0: {"A": 1.0, "B": 1.0}}
    assert works_of(table, since=3.5).to_dict("index") == {0: {"A": 0.0, "B": 2.0}}


def test_the_mutual_information_by_hand():
    # p = [[3/8, 1/8], [1/8, 3/8]]: I = 6/8 log2(3/2) + 2/8 log2(1/2); both entropies are 1 bit.
    found = division_of_labour([[3, 1], [1, 3]])
    expected = 0.75 * math.log2(1.5) - 0.25
    assert found.information == pytest.approx(expected)
    assert found.agents_to_tasks == pytest.approx(expected)
    assert found.tasks_to_agents == pytest.approx(expected)


def test_unequal_margins_by_hand():
    # One agent does three quarters of all work, all of it A; the other's is half A, half B.
    found = division_of_labour([[6, 0], [1, 1]])
    information = (
        6 / 8 * math.log2((6 / 8) / (6 / 8 * 7 / 8))
        + 1 / 8 * math.log2((1 / 8) / (2 / 8 * 7 / 8))
        + 1 / 8 * math.log2((1 / 8) / (2 / 8 * 1 / 8))
    )
    tasks = -(7 / 8 * math.log2(7 / 8) + 1 / 8 * math.log2(1 / 8))
    agents = -(6 / 8 * math.log2(6 / 8) + 2 / 8 * math.log2(2 / 8))
    assert found.agents_to_tasks == pytest.approx(information / tasks)
    assert found.tasks_to_agents == pytest.approx(information / agents)


def test_a_little_division_is_not_none():
    # Both do half of all, 51 and 50 of 101 pieces of either: 1 bit less the entropy of 51/101.
    found = division_of_labour([[51, 50], [50, 51]])
    shares = [51 / 101, 50 / 101]
    expected = 1 + sum(one * math.log2(one) for one in shares)
    assert (
        found.information == pytest.approx(expected, abs=1e-12) == pytest.approx(7.07e-5, rel=1e-2)
    )


def test_specialists_are_not_divided_more_than_wholly():
    # Rounded, the information is a hair above the entropy.
    assert division_of_labour([[1, 0], [0, 9]]).agents_to_tasks == 1.0


def test_nine_specialists_share_two_tasks():
    found = division_of_labour([[7, 0]] * 3 + [[0, 7]] * 6)
    assert found.agents_to_tasks == pytest.approx(1.0)
    assert found.tasks_to_agents == pytest.approx(found.information / math.log2(9))


def test_where_nothing_is_divided_it_is_0_and_without_work_unknown():
    assert division_of_labour([[5, 0], [3, 0]]) == Division(0.0, 0.0, 0.0)
    assert division_of_labour([[5, 9]]) == Division(0.0, 0.0, 0.0)
    assert math.isnan(division_of_labour([[0, 0]]).agents_to_tasks)
    assert math.isnan(division_of_labour(np.zeros((0, 2))).agents_to_tasks)


@given(works.filter(lambda one: one.sum() > 0), st.randoms(use_true_random=False))
def test_it_lies_between_0_and_1_and_order_makes_no_difference(table, random):
    found = division_of_labour(table)
    assert 0 <= found.agents_to_tasks <= 1
    assert 0 <= found.tasks_to_agents <= 1
    rows = random.sample(range(len(table)), len(table))
    assert division_of_labour(table[rows]).information == pytest.approx(found.information)
    turned = division_of_labour(table.T)
    assert turned.agents_to_tasks == pytest.approx(found.tasks_to_agents)
    assert division_of_labour(3.5 * table).information == pytest.approx(found.information)


@given(st.lists(st.integers(1, 9), min_size=1, max_size=5), st.lists(st.integers(1, 9), min_size=2))
def test_agents_that_do_the_tasks_alike_divide_nothing(rows, columns):
    found = division_of_labour(np.outer(rows, columns))
    assert found.agents_to_tasks == pytest.approx(0, abs=1e-12)


def test_luck_alone_by_hand():
    # Three A and three B dealt to two agents of three: k = 0 … 3 A for the first with 1, 9, 9, 1
    # of 20; of 0 and 3 the division is 1, else that of [[1, 2], [2, 1]].
    expected = 0.1 + 0.9 * division_of_labour([[1, 2], [2, 1]]).agents_to_tasks
    found = division_by_chance([[3, 0], [0, 3]], draws=5000)
    assert found.agents_to_tasks == pytest.approx(expected, abs=0.015)
    assert found == division_by_chance([[3, 0], [0, 3]], draws=5000)
    assert found != division_by_chance([[3, 0], [0, 3]], draws=5000, seed=1)


def test_luck_deals_each_agent_as_many_pieces_as_it_did():
    # The one B of four pieces goes to the agent with two of them in half of all deals.
    to_two, to_one = [[1, 1], [1, 0], [1, 0]], [[2, 0], [1, 0], [0, 1]]
    one, other = division_of_labour(to_two), division_of_labour(to_one)
    found = division_by_chance([[2, 0], [1, 0], [0, 1]], draws=5000)
    for name in ("agents_to_tasks", "tasks_to_agents", "information"):
        expected = (getattr(one, name) + getattr(other, name)) / 2
        assert getattr(found, name) == pytest.approx(expected, abs=0.012)


def test_where_every_deal_is_alike_luck_gives_just_that():
    assert division_by_chance([[1, 0], [0, 1]]) == Division(1.0, 1.0, 1.0)


@settings(max_examples=20)
@given(st.integers(2, 9), st.integers(1, 4))
def test_much_work_without_preference_is_as_divided_as_luck_has_it(agents, seed):
    rng = np.random.default_rng(seed)
    table = rng.multinomial(40, [0.3, 0.7], size=agents)
    found = division_of_labour(table).agents_to_tasks
    chance = division_by_chance(table, seed=seed).agents_to_tasks
    assert found < chance + 0.1


def test_amounts_that_are_no_pieces_cannot_be_dealt_out():
    with pytest.raises(SocialmindError, match="pieces of work"):
        division_by_chance([[0.5, 1.0]])
    assert math.isnan(division_by_chance([[0, 0]]).information)


@pytest.mark.parametrize(
    "wrong", [[[-1, 2]], [[-0.5, 2]], [[math.nan, 1]], [1, 2], [[math.inf, 1]]]
)
def test_works_that_are_none_are_refused(wrong):
    with pytest.raises(SocialmindError, match="expected agents by tasks"):
        division_of_labour(wrong)


# Specialised agents -----------------------------------------------------------------------------


def tasks(**lines):
    """A piece of work each tick from 1 on: a0="AAB"."""
    rows = [
        (tick, int(name[1:]), task)
        for name, line in lines.items()
        for tick, task in enumerate(line, 1)
        if task != " "
    ]
    return pd.DataFrame(rows, columns=["tick", "agent", "task"])


def there(ticks, agents):
    rows = [(tick, agent) for tick in ticks for agent in agents]
    return pd.DataFrame(rows, columns=["tick", "agent"])


def test_only_recent_work_counts():
    # The window of four ticks holds AAAA, AAAB, AABB, ABBB, BBBB: specialised at 0.75 but for 6.
    found = share_specialised(tasks(a0="AAAABBBB"), there(range(4, 9), [0]), window=4, share=0.75)
    assert found.to_dict() == {4: 1.0, 5: 1.0, 6: 0.0, 7: 1.0, 8: 1.0}


def test_who_does_too_little_is_not_specialised_and_who_is_not_there_does_not_count():
    work = tasks(a0="AAAAAA", a1="A     ", a2="BBBBBB")
    assert share_specialised(work, there([6], [0, 1]), window=9).tolist() == [0.5]
    assert share_specialised(work, there([6], [0, 1]), window=9, least=1).tolist() == [1.0]
    assert share_specialised(work, there([6], [0, 5]), window=9).tolist() == [0.5]


def test_agents_that_come_and_go_are_counted_at_their_ticks():
    work = tasks(a0="AAAAAA", a1="ABABAB")
    present = pd.concat([there([3], [0]), there([6], [0, 1])])
    assert share_specialised(work, present, window=6).to_dict() == {3: 1.0, 6: 0.5}


def test_who_is_not_there_at_a_tick_is_not_counted_at_it():
    work = tasks(a0="AAAAAA", a1="ABABAB")
    present = pd.concat([there([3], [0]), there([6], [1])])
    assert share_specialised(work, present, window=6).to_dict() == {3: 1.0, 6: 0.0}


def test_the_order_of_the_rows_makes_no_difference():
    work = tasks(a0="AAAABBBB")
    turned = share_specialised(work[::-1], there(range(4, 9), [0]), window=4, share=0.75)
    assert turned.to_dict() == {4: 1.0, 5: 1.0, 6: 0.0, 7: 1.0, 8: 1.0}


def test_just_the_share_is_enough_whatever_the_rounding():
    # Six of eight pieces of 0.1 add up to a hair less than 0.75 of all.
    work = tasks(a0="AAAAAABB").assign(amount=0.1)
    found = share_specialised(work, there([8], [0]), window=9, share=0.75, least=0.8)
    assert found.tolist() == [1.0]


def test_amounts_are_weighed():
    work = tasks(a0="AAB").assign(amount=[1.0, 1.0, 0.25])
    assert share_specialised(work, there([3], [0]), window=9, least=2).tolist() == [1.0]
    assert share_specialised(work, there([3], [0]), window=9, least=2.5).tolist() == [0.0]


@given(st.text("AB ", min_size=1, max_size=15), st.integers(1, 8), st.sampled_from([0.6, 0.8, 1.0]))
def test_it_is_what_a_plain_count_finds(line, window, share):
    ticks = range(len(line) + 1)
    found = share_specialised(tasks(a0=line), there(ticks, [0]), window, share, least=2)
    for tick in ticks:
        recent = line[max(0, tick - window) : tick].replace(" ", "")
        most = max(recent.count("A"), recent.count("B"))
        expected = len(recent) >= 2 and most >= share * len(recent)
        assert found[tick] == float(expected)


@pytest.mark.parametrize("wrong", [{"share": 0.5}, {"share": 1.1}, {"window": 0}, {"least": 0}])
def test_what_means_nothing_is_refused(wrong):
    with pytest.raises(SocialmindError, match="expected a share above"):
        share_specialised(tasks(a0="A"), there([1], [0]), **wrong)
