"""All measures of one run, over a society whose course is known."""

import math

import numpy as np
import pandas as pd
import pytest

from socialmind.errors import SocialmindError
from socialmind.experiments.measures.division import division_of_labour
from socialmind.experiments.measures.specialisation import Course

EVERY, TICKS = 500, 40_000


def nine(plan):
    """Nine agents whose number of A follows a plan {tick: number}, the first ones being A."""
    ticks = np.arange(0, TICKS + 1, EVERY)
    since = np.array(sorted(plan))
    number = np.array([plan[one] for one in since])[np.searchsorted(since, ticks, "right") - 1]
    rows = [
        (tick, agent, "A" if agent < count else "B")
        for tick, count in zip(ticks, number, strict=True)
        for agent in range(9)
    ]
    return pd.DataFrame(rows, columns=["tick", "agent", "role"])


def working(roles):
    """Everybody delivers what its role is, at each record."""
    return roles.rename(columns={"role": "task"})


def test_a_society_that_settles_and_is_turned():
    roles = nine({0: 9, 4000: 3, 20_000: 4, 26_000: 6})
    turned = pd.DataFrame({"tick": [0, 20_000], "A": [1, 2], "B": [2, 1]})
    found = Course(roles, working(roles), turned, shocks=[20_000]).measures()
    # 0: 6 away for 8 records, then 0 for 32; then 2 away for 12, then 0 for 29.
    assert found["distance"] == pytest.approx((6 * 8 + 2 * 12) / 81)
    assert found["last_distance"] == 0.0
    assert found["within"] == 1.0
    assert found["settling_ticks"] == 4000
    assert found["recovery_ticks_1"] == 6000
    assert found["role_changes"] == 0.0
    # Two of nine changed at 26,000: 0.8 of the last 20 records are A from 33,500 on. The last
    # quarter has 21 records, 7 of them before that.
    assert found["specialised"] == pytest.approx((7 * 7 / 9 + 14) / 21)
    assert found["agents_to_tasks"] == pytest.approx(1.0)
    assert found["agents_to_tasks_by_chance"] < 0.1
    assert found["delivered"] == 81 * 9


def test_a_society_that_never_settles():
    roles = nine({tick: 9 * (tick // 1000 % 2) for tick in range(0, TICKS + 1, 1000)})
    found = Course(roles, working(roles), {"A": 1, "B": 2}).measures()
    assert found["within"] == 0.0
    assert found["settling_ticks"] == math.inf
    assert math.isnan(found["role_changes"])
    assert found["specialised"] == 0.0
    assert found["agents_to_tasks"] == pytest.approx(0.0, abs=1e-9)


def test_scores_are_numbers_even_where_a_society_never_settled():
    roles = nine({tick: 9 * (tick // 1000 % 2) for tick in range(0, TICKS + 1, 1000)})
    found = Course(roles, working(roles), {"A": 1, "B": 2}, shocks=[30_000]).scored()
    # Every agent changes every 1,000 ticks.
    assert found["role_changes"] == pytest.approx(10.0)
    assert found["settling_ticks"] == 10_000
    assert found["within_one"] == 0.0


def test_scores_count_from_the_last_shock():
    roles = nine({0: 9, 4000: 3, 20_000: 4, 26_000: 6})
    turned = pd.DataFrame({"tick": [0, 20_000], "A": [1, 2], "B": [2, 1]})
    found = Course(roles, working(roles), turned, shocks=[20_000]).scored()
    assert found == {"within_one": 1.0, "settling_ticks": 6000.0, "role_changes": 0.0}


def test_a_flicker_within_one_agent_is_settled_and_its_changes_count():
    roles = nine({tick: 3 + tick // 1000 % 2 for tick in range(0, TICKS + 1, 1000)})
    found = Course(roles, working(roles), {"A": 1, "B": 2}).measures()
    assert found["settling_ticks"] == 0
    # One agent of nine changes every 1,000 ticks.
    assert found["role_changes"] == pytest.approx(10 / 9)
    assert found["specialised"] == pytest.approx(8 / 9)


def four(**given):
    """Four agents from tick 2,000 to 6,000, half of which are wanted to be A.

    They are 2, 2, 0, 0, 0, 1, 2, 1 and 0 away; the last quarter begins at 5,000 with the last 2.
    """
    number = [4, 4, 2, 2, 2, 1, 4, 3, 2]
    rows = [
        (2000 + 500 * place, agent, "A" if agent < count else "B")
        for place, count in enumerate(number)
        for agent in range(4)
    ]
    pieces = {
        0: [(2100, "B"), (5000, "A"), (5600, "A")],
        1: [(2200, "A"), (5100, "A"), (5700, "A")],
        2: [(5000, "B"), (5300, "B"), (5800, "B"), (5900, "B")],
        3: [(5600, "A"), (5700, "A"), (5800, "B")],
    }
    tasks = [(tick, agent, task) for agent, some in pieces.items() for tick, task in some]
    return Course(
        pd.DataFrame(rows, columns=["tick", "agent", "role"]),
        pd.DataFrame(tasks, columns=["tick", "agent", "task"]),
        {"A": 1, "B": 1},
        **given,
    )


def test_the_last_quarter_is_one_of_the_time_that_was_recorded():
    found = four(within=2.0, hold=1000, window=600, share=0.6, least=2)
    assert found.last == 5000.0
    measures = found.measures()
    assert measures["distance"] == pytest.approx(8 / 9)
    assert measures["last_distance"] == pytest.approx(1.0)
    # In 600 ticks two pieces or more have been done at 5,500 by agent 2, at 6,000 by 2 and by 3,
    # two thirds of whose work is A.
    assert measures["specialised"] == pytest.approx((0 + 1 / 4 + 2 / 4) / 3)
    late = division_of_labour([[2, 0], [2, 0], [0, 4], [2, 1]])
    assert measures["agents_to_tasks"] == pytest.approx(late.agents_to_tasks)
    assert measures["tasks_to_agents"] == pytest.approx(late.tasks_to_agents)
    assert late.agents_to_tasks - late.tasks_to_agents > 0.2
    assert measures["delivered"] == 13


@pytest.mark.parametrize(
    ("within", "late", "settling"), [(2.0, 1.0, 0.0), (1.0, 0.0, 1000.0), (1.9, 0.0, 1000.0)]
)
def test_how_near_and_how_long_are_what_was_asked_for(within, late, settling):
    found = four(within=within, hold=1000).measures()
    assert (found["within"], found["settling_ticks"]) == (late, settling)
    assert four(within=within, hold=4001).measures()["settling_ticks"] == math.inf


def test_changes_count_while_it_is_settled():
    # From 3,000 on 1, 3, 1 and 1 agents of four change in 3,000 ticks; from 2,000 on two more.
    assert four(within=1.0, hold=1000).measures()["role_changes"] == pytest.approx(6 / 1.2)
    assert four(within=2.0, hold=1000).measures()["role_changes"] == pytest.approx(8 / 1.6)


def test_amounts_that_are_no_pieces_have_no_chance():
    roles = nine({0: 3})
    found = Course(roles, working(roles).assign(amount=0.3), {"A": 1, "B": 2}).measures()
    assert math.isnan(found["agents_to_tasks_by_chance"])
    assert found["agents_to_tasks"] == pytest.approx(1.0)


def test_a_course_without_records_is_refused():
    empty = pd.DataFrame({"tick": [], "agent": [], "role": []})
    with pytest.raises(SocialmindError, match="without a record"):
        Course(empty, empty, {"A": 1})


def test_an_agent_stands_once_at_a_tick():
    roles = pd.DataFrame({"tick": [0, 5, 5], "agent": [1, 1, 1], "role": ["A", "A", "B"]})
    tasks = pd.DataFrame({"tick": [1], "agent": [1], "task": ["A"]})
    with pytest.raises(SocialmindError, match="agent 1 twice at tick 5"):
        Course(roles, tasks, {"A": 1})
    with pytest.raises(SocialmindError, match="without the column 'agent'"):
        Course(roles.drop(columns="agent"), tasks, {"A": 1})
