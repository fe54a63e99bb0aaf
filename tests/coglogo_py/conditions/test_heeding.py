"""Minds without agents are told what conditions compare; both speeds agree with an account."""

import math

import numba
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from coglogo_py import CognitiveScheme, Cogniton, MindError, Society
from coglogo_py.conditions import heeding
from coglogo_py.conditions.condition import OPERATORS

HUNGER = Cogniton(
    "Hunger", starting=False, start_value=2, activated_when="energy < 5",
    deactivated_when="energy > full",
)  # fmt: skip
COLD = Cogniton("Cold", start_value=1, active_while=["warmth <= 0", "age >= 2"])
SCHEME = CognitiveScheme("humans", (HUNGER, COLD))


def told(mind, energy=6.0, full=8.0, warmth=1.0, age=3.0):
    mind.update({"energy": energy, "full": full, "warmth": warmth, "age": age})
    return mind.cognitons()


def test_thresholds_with_hysteresis():
    mind = Society(SCHEME, seed=1).new_mind()
    found = [told(mind, energy)["Hunger"] for energy in (6, 5, 4, 6, 8, 9, 6, 4)]
    assert found == [None, None, 2.0, 2.0, 2.0, None, None, 2.0]


def test_what_makes_inactive_wins():
    mind = Society(SCHEME, seed=1).new_mind()
    assert told(mind, 4)["Hunger"] == 2
    assert told(mind, 4, full=3)["Hunger"] is None


def test_active_exactly_while_all_hold_from_its_start_each_time():
    mind = Society(SCHEME, seed=1).new_mind()
    assert mind.is_active("Cold") and told(mind)["Cold"] is None
    assert told(mind, warmth=0)["Cold"] == 1
    mind.set_cogniton_value("Cold", 7)
    assert told(mind, warmth=-1)["Cold"] == 7
    assert told(mind, warmth=-1, age=1)["Cold"] is None
    assert told(mind, warmth=-1)["Cold"] == 1


def test_values_that_are_missing_or_no_numbers_change_nothing():
    mind = Society(SCHEME, seed=1).new_mind()
    with pytest.raises(MindError, match="update: no value for 'full', of the condition energy > f"):
        mind.update({"energy": 4, "warmth": 0, "age": 3})
    with pytest.raises(MindError, match="update, 'age': found nan"):
        told(mind, age=math.nan)
    assert mind.cognitons() == {"Hunger": None, "Cold": 1}


numbers = st.sampled_from([-1.0, 0.0, 0.5, 1.0, math.nan])
groups = st.tuples(
    st.sampled_from(heeding.KINDS), st.lists(st.sampled_from(OPERATORS), min_size=1, max_size=3)
)
compiled = numba.njit(lambda *arguments: heeding.heed(*arguments))


@settings(max_examples=200)
@given(st.data())
def test_both_speeds_agree_with_a_plain_account(data):
    cognitons, comparisons = [], []
    for place in range(data.draw(st.integers(1, 3))):
        kinds = dict(data.draw(st.lists(groups, max_size=3)))
        if "active_while" in kinds:
            kinds = {"active_while": kinds["active_while"]}
        written = {k: [f"f {op} 0" for op in operators] for k, operators in kinds.items()}
        cognitons.append(Cogniton(f"c{place}", start_value=place + 2, **written))
        comparisons.append(kinds)
    conditions, sides, found = heeding.laid_out_conditions(CognitiveScheme("a", tuple(cognitons)))
    for row in range(len(found)):
        sides[row, :2] = data.draw(numbers), data.draw(numbers)
    values = np.array([[data.draw(numbers) for _ in cognitons]])
    expected, row = values[0].tolist(), 0
    for place, kinds in enumerate(comparisons):
        met = {}
        for kind in heeding.KINDS:
            for operator in kinds.get(kind, []):
                left, right = sides[row, :2].tolist()
                there = not math.isnan(left) and not math.isnan(right)
                one = there and eval(f"left {operator} right")
                met[kind] = met.get(kind, True) and one
                row += 1
        if met.get("deactivated_when") or met.get("active_while") is False:
            expected[place] = math.nan
        elif (met.get("activated_when") or met.get("active_while")) and math.isnan(expected[place]):
            expected[place] = place + 2.0
    for heed in (heeding.heed, compiled):
        copy = values.copy()
        heed(conditions, sides, copy, 0)
        np.testing.assert_array_equal(copy[0], expected)
