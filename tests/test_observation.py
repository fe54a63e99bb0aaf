"""Minds as columns of a table, against what each mind says of itself."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from coglogo_py import CognitiveScheme, Cogniton, Culturon, Group, Role
from socialmind import Agent, Model, Population
from socialmind.observation import mind_columns

SCHEME = CognitiveScheme(
    "villagers",
    (
        Cogniton(
            "Hunger", start_value=2.0, influence={"eat": 1.5, "trade": -0.5}, conditional=("eat",)
        ),
        Cogniton("Greed", starting=False, influence={"trade": 3.0}, conditional=("trade",)),
        Cogniton("Sloth", start_value=0.0, influence={"rest": 7.0}),
    ),
    (
        Group(
            "village",
            (
                Role(
                    "chief",
                    (
                        Culturon("Law", 4.0, influence={"trade": -1.0}, conditional=("rest",)),
                        Culturon("Custom", 1.0, influence={"eat": 2.0}),
                    ),
                ),
                Role("member", (Culturon("Custom", 1.0, influence={"eat": 2.0}),)),
            ),
        ),
        Group("guild", (Role("smith", (Culturon("Craft", -3.0, influence={"trade": -2.5}),)),)),
    ),
)
COGNITONS = [one.name for one in SCHEME.cognitons]


class Village(Model):
    people = Population(Agent, 6, mind=SCHEME)


def compare(village):
    """Hold the columns against every mind's own account, name by name."""
    columns = mind_columns(village.people)
    assert list(columns) == [f"cogniton_{name}" for name in COGNITONS] + [
        f"weight_{plan}" for plan in SCHEME.plans
    ]
    for row, person in enumerate(village.people):
        values = {one.name: one.value for one in person.mind.explain().influences}
        for name in COGNITONS:
            found = columns[f"cogniton_{name}"][row]
            expected = values[name]
            assert math.isnan(found) if expected is None else found == expected
        weights = person.mind.plan_weights()
        for plan in SCHEME.plans:
            found = columns[f"weight_{plan}"][row]
            if plan in weights:
                assert found == pytest.approx(weights[plan], rel=1e-12, abs=1e-12)
            else:
                assert math.isnan(found)
    return columns


def test_fresh_minds():
    columns = compare(Village(compiled=False))
    assert columns["cogniton_Hunger"].tolist() == [2.0] * 6
    assert np.isnan(columns["cogniton_Greed"]).all()
    assert columns["weight_eat"].tolist() == [3.0] * 6
    assert np.isnan(columns["weight_trade"]).all()
    assert np.isnan(columns["weight_rest"]).all()


def test_groups_by_hand():
    village = Village(compiled=False)
    chief, member, smith, *_ = village.people
    assert chief.mind.create_and_join_group("village", "chief")
    assert member.mind.join_group("village", "member", chief.mind.get_group_id("village"))
    assert smith.mind.create_and_join_group("guild", "smith")
    member.mind.set_participation("village", 0.5)
    member.mind.activate_cogniton("Greed")
    member.mind.set_cogniton_value("Greed", 2.0)
    columns = compare(village)
    # Chief: 1.5 * 2 + 2 * 1; member: 3 + 2 * 0.5 * 1; the smith has no culturon that feeds.
    assert columns["weight_eat"][:3].tolist() == [5.0, 4.0, 3.0]
    # Law opens rest to the chief alone, whose weight is Sloth's 0.
    assert columns["weight_rest"][0] == 0.0
    assert np.isnan(columns["weight_rest"][1:]).all()
    # Greed opens trade to the member: 3 * 2 - 0.5 * 2, without the chief's Law.
    assert columns["weight_trade"][1] == 5.0


commands = st.lists(
    st.tuples(
        st.integers(0, 5),
        st.sampled_from(
            ["set", "activate", "deactivate", "found", "join", "leave", "part", "culture"]
        ),
        st.sampled_from([("village", "chief"), ("village", "member"), ("guild", "smith")]),
        st.sampled_from(COGNITONS),
        st.floats(-50, 50),
    ),
    max_size=25,
)


@given(commands)
@settings(max_examples=60)
def test_columns_are_the_minds_own_account(steps):
    village = Village(compiled=False)
    people = list(village.people)
    for who, what, (group, role), cogniton, value in steps:
        mind, other = people[who].mind, people[(who + 1) % 6].mind
        if what == "set":
            mind.set_cogniton_value(cogniton, value)
        elif what == "activate":
            mind.activate_cogniton(cogniton)
        elif what == "deactivate":
            mind.deactivate_cogniton(cogniton)
        elif what == "found":
            mind.create_and_join_group(group, role)
        elif (
            what == "join"
            and other.get_group_id(group) is not None
            and other.get_group_id(group) >= 0
        ):
            mind.join_group(group, role, other.get_group_id(group))
        elif what == "leave":
            mind.leave_group(group)
        elif what == "part":
            mind.set_participation(group, value)
        elif what == "culture":
            mind.set_culturon_value(group, {"village": "Custom", "guild": "Craft"}[group], value)
    people[0].die()
    village.people.settle()
    compare(village)


def test_rows_follow_births_and_deaths():
    village = Village(compiled=False)
    village.people[2].mind.set_cogniton_value("Hunger", 9.0)
    village.people[2].hatch()
    village.people[0].die()
    village.people.settle()
    columns = compare(village)
    assert columns["cogniton_Hunger"].tolist() == [2.0, 9.0, 2.0, 2.0, 2.0, 9.0]


def test_without_minds_there_are_no_columns():
    class Herd(Model):
        cows = Population(Agent, 3)

    assert mind_columns(Herd(compiled=False).cows) == {}


def test_without_agents_the_columns_are_empty():
    class Empty(Model):
        people = Population(Agent, 0, mind=SCHEME)

    columns = mind_columns(Empty(compiled=False).people)
    assert {len(column) for column in columns.values()} == {0}
