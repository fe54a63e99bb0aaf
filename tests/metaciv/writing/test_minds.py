"""Cognitons, attributes and decisions of imported models, worked out by hand."""

import pytest

from socialmind.errors import IdleWarning

from ..reading.folders import flat
from .folders import files_of, followed, imported

WILL = (True, "Work", {"Work": 5})


def values(model, ticks, *names):
    """The values of cognitons at the end of each tick from the third on; None for none."""
    society = model(seed=1, compiled=False)
    society.advance(2)
    found = []
    for _ in range(ticks):
        society.advance(1)
        mind = society.humans[0].mind
        found.append(tuple(mind.cognitons()[name] for name in names))
    return found


def test_cognitons_come_with_what_is_added_and_go_near_nothing(tmp_path):
    model = imported(
        tmp_path,
        files_of(
            plans={
                "Work": """
A_ChangeCognitonWeight,c(Cogniton Joy),n(Double -0.5)
A_ChangeCognitonWeightInteger,c(Cogniton Joy),n(Double 2.0)
A_ReplaceCognitonWeight,c(Cogniton Joy),n(Double 0.25)
A_ChangeCognitonWeight,c(Cogniton Joy),n(Double -0.25)
A_AddCogniton,c(Cogniton Joy)
A_AddCogniton,c(Cogniton Joy)
A_ChangeCognitonWeightOneTick,c(Cogniton Joy),n(Double 3.0)
L_OwnCogniton,c(Cogniton Joy)
  A_EmitCogniton,c(Cogniton Joy),n(Double 1.0)
L_CompareCogniton,c(Cogniton Grief),c(Comparator <),n(Double 1.0)
  A_ReplaceCognitonWeight,c(Cogniton Grief),n(Double 9.0)
  A_ReplaceCognitonWeight,c(Cogniton Grief),n(Double 2.0)
"""
            },
            cognitons={"Will": WILL, "Joy": (False, "", {}), "Grief": (False, "", {})},
        ),
    )
    assert values(model, 9, "Joy", "Grief") == [
        (-0.5, None), (1.5, None), (0.25, None), (None, None), (1.0, None), (1.0, None),
        (1.0, None), (1.0, None), (1.0, 2.0),
    ]  # fmt: skip


def test_a_self_plan_that_raises_for_a_tick_sways_the_decision_of_that_tick(tmp_path):
    model = imported(
        tmp_path,
        files_of(
            plans={
                "Wake": """
L_CompareAttribute,a(Attribute age),c(Comparator ==),n(Double 2.0)
  A_ChangeCognitonWeightOneTick,c(Cogniton Joy),n(Double 9.0)
A_ChangeAttributeDouble,a(Attribute age),n(Double 1.0)
""",
                "Work": "A_AddItem,o(Objet Coin),n(Integer 1)",
                "Play": "A_AddItem,o(Objet Song),n(Integer 1)",
            },
            kinds={"Wake": "self"},
            cognitons={"Will": WILL, "Joy": (True, "Play", {"Play": 1})},
            attributes={"age": 0},
            objects=("Coin", "Song"),
        ),
    )
    assert followed(model, 4, "coin", "song") == [(1, 0), (2, 0), (2, 1), (3, 1)]


def test_a_plan_of_birth_runs_once_and_a_counter_counts_its_own_visits(tmp_path):
    model = imported(
        tmp_path,
        files_of(
            plans={
                "Born": """
A_ChangeAttribute,a(Attribute age),n(Integer 5)
L_Repeat,n(Integer 2)
  A_AddItem,o(Objet Coin),n(Integer 3)
""",
                "Work": """
L_EveryXTick,n(Integer 2)
  A_AddItem,o(Objet Song),n(Integer 1)
""",
            },
            kinds={"Born": "birth"},
            cognitons={"Will": WILL},
            attributes={"age": 1},
            objects=("Coin", "Song"),
        ),
    )
    assert followed(model, 7, "age", "coin", "song") == [
        (6.0, 6, k // 3) for k in range(1, 8)
    ]  # fmt: skip


def test_another_plan_takes_over_when_it_weighs_twice_as_much(tmp_path):
    model = imported(
        tmp_path,
        files_of(
            plans={
                "Age": "A_ChangeAttribute,a(Attribute age),n(Integer 1)",
                "Work": "\n".join(["A_AddItem,o(Objet Coin),n(Integer 1)"] * 9),
                "Flee": "A_AddItem,(Objet Song),n(Integer 1)\nA_GetObject,(Objet Song),(Integer 9)",
            },
            kinds={"Age": "self"},
            cognitons={
                "Will": WILL,
                "Fear": "Type : PERCEPT\nInitial : 0\nPermet : Flee\nInfluence : Flee,11\n"
                "Trigger : age,3.0,0,__NoConstant\n",
            },
            attributes={"age": 0},
            objects=("Coin", "Song"),
            maker="MaxWeightOx2_",
        ),
    )
    assert followed(model, 5, "coin", "song") == [(1, 0), (2, 0), (2, 1), (3, 1), (4, 1)]


def test_plans_are_drawn_by_the_weights_that_are_above_nothing(tmp_path):
    model = imported(
        tmp_path,
        files_of(
            plans={name: f"A_AddItem,o(Objet {name}),n(Integer 1)" for name in ("A", "B", "C")},
            cognitons={
                "Will": (True, "A B C", {"A": 1, "B": 3, "C": -2}),
                "Half": (True, "", {}),
            },
            objects=("A", "B", "C"),
            agents=400,
            maker="WeightedStochastic",
        ),
    )
    society = model(seed=1, compiled=False)
    society.advance(3)
    drawn = [int(getattr(society.humans, name).sum()) for name in "abc"]
    assert drawn[2] == 0 and sum(drawn) == 400
    assert 60 < drawn[0] < 140  # 100 expected, 8.7 the standard deviation


def test_an_agent_without_a_plan_idles(tmp_path):
    model = imported(
        tmp_path,
        files_of(
            plans={"Work": "A_AddItem,o(Objet Coin),n(Integer 1)\nA_DoNothing"},
            cognitons={"Will": (False, "Work", {"Work": 1})},
            objects=("Coin",),
        ),
    )
    with pytest.warns(IdleWarning):
        assert followed(model, 3, "coin", "plan") == [(0, None)] * 3


def test_what_actions_take_stays_away_until_the_threshold_is_crossed_again(tmp_path):
    model = imported(
        tmp_path,
        files_of(
            plans={
                "Age": "A_ChangeAttribute,a(Attribute age),n(Integer -1)",
                "Work": "A_DoNothing\nA_DoNothing\nA_ChangeCognitonWeight,c(Cogniton Hunger),"
                "n(Double -1.0)\nA_DoNothing\nA_ChangeAttribute,a(Attribute age),n(Integer 9)\n"
                "A_ChangeAttribute,a(Attribute age),n(Integer -9)",
            },
            kinds={"Age": "self"},
            cognitons={
                "Will": WILL,
                "Hunger": "Type : PERCEPT\nInitial : 0\nTrigger : age,5.0,-2,__NoConstant\n",
            },
            attributes={"age": 6},
        ),
    )
    assert values(model, 6, "Hunger") == [(None,), (1.0,), (None,), (None,), (None,), (1.0,)]


def test_two_triggers_are_a_range_or_the_last_crossing_decides(tmp_path):
    trigger = "Trigger : age,{},{},__NoConstant\n"
    model = imported(
        tmp_path,
        files_of(
            plans={"Work": "A_ChangeAttribute,a(Attribute age),n(Integer 2)"},
            cognitons={
                "Will": WILL,
                "Within": f"Initial : 0\n{trigger.format(3.0, 1)}{trigger.format(6.0, -1)}",
                "Beyond": f"Initial : 0\n{trigger.format(6.0, 1)}{trigger.format(2.0, -1)}",
            },
            attributes={"age": -1},
        ),
    )
    society = model(seed=1, compiled=False)
    society.advance(2)
    mind = society.humans[0].mind
    assert (mind.is_active("Within"), mind.is_active("Beyond")) == (False, True)
    assert values(model, 4, "Within", "Beyond") == [
        (None, 1.0), (1.0, None), (1.0, None), (None, 1.0)
    ]  # fmt: skip


def test_an_older_folder_has_cognitons_at_birth_by_their_chance(tmp_path):
    model = imported(tmp_path, flat())
    text = (model.folder() / "scheme.yaml").read_text()
    assert "chance: 0.4" in text
    society = model(seed=1, compiled=False, n_farmers=300)
    society.advance(2)
    by_chance = [one.mind.is_active("Hungry") for one in society.humans]
    assert all(by_chance)  # the civilisation begins with it
    society.advance(3)
    assert len(society.humans) == 300
