"""Receipts: contributions, reasons, the draw, and the smallest change that makes a difference."""

import json
import math
from dataclasses import FrozenInstanceError

import numpy as np
import pytest
from hypothesis import assume, example, given, settings
from hypothesis import strategies as st

from coglogo_py import (
    BiasedWeightedStochastic,
    CognitiveScheme,
    Cogniton,
    Culturon,
    DecisionMaker,
    Group,
    MaximumWeight,
    PositiveStochastic,
    Role,
    Society,
    WeightedStochastic,
)
from coglogo_py.receipts.counterfactual import most_probable

PLANS = ("eat", "rest", "trade")
HERD = Group(
    "herd",
    (
        Role("leader", (Culturon("lead", 3.0, influence={"eat": 2.0}, conditional=("flee",)),)),
        Role("follower", (Culturon("follow", 1.0, conditional=("flee", "trade")),)),
    ),
)
HUNGER = Cogniton("hunger", start_value=5.0, influence={"eat": 2, "rest": -1}, conditional=("eat",))
TIRED = Cogniton("tired", False, influence={"rest": 1}, conditional=("rest",))


def mind_of(*cognitons, maker=None, groups=(), seed=1):
    scheme = CognitiveScheme("cows", cognitons, groups, maker or MaximumWeight())
    return Society(scheme, seed).new_mind()


def top_of(mind):
    weights = mind.plan_weights()
    position = most_probable(mind.society.scheme.decision_maker, np.array(list(weights.values())))
    return list(weights)[position]


class TestWhatAReceiptHolds:
    def test_every_value_and_contribution(self):
        mind = mind_of(HUNGER, TIRED, groups=(HERD,))
        mind.create_and_join_group("herd", "leader")
        mind.set_participation("herd", 0.5)
        receipt = mind.explain()
        assert [plan.name for plan in receipt.plans] == ["eat", "rest", "flee", "trade"]
        rows = {i.name: (i.group, i.value, i.acts, i.contributions) for i in receipt.influences}
        assert rows == {
            "hunger": (None, 5.0, True, (10.0, -5.0, 0.0, 0.0)),
            "tired": (None, None, False, (0.0, 0.0, 0.0, 0.0)),
            "lead": ("herd", 3.0, True, (3.0, 0.0, 0.0, 0.0)),
            "follow": ("herd", 1.0, False, (0.0, 0.0, 0.0, 0.0)),
        }
        assert [i.participation for i in receipt.influences] == [None, None, 0.5, 0.5]
        mind.leave_all_groups()
        mind.set_cogniton_value("hunger", 0.0)
        receipt = mind.explain()
        assert [i.participation for i in receipt.influences] == [None] * 4
        assert [i.value for i in receipt.influences] == [0.0, None, None, None]
        # Zero times the link of -1 to resting is no minus zero.
        assert str(receipt.influences[0].contributions) == "(0.0, 0.0, 0.0, 0.0)"

    def test_why_a_plan_is_or_is_not_available(self):
        mind = mind_of(HUNGER, TIRED, groups=(HERD,))
        plans = {plan.name: plan for plan in mind.explain().plans}
        assert plans["eat"].opened_by == ("cogniton 'hunger'",)
        assert not plans["rest"].available
        assert plans["rest"].weight is None and plans["rest"].probability == 0.0
        assert plans["rest"].would_open == ("cogniton 'tired'",)
        assert plans["flee"].would_open == (
            "culturon 'lead' of group 'herd'",
            "culturon 'follow' of group 'herd'",
        )
        mind.create_and_join_group("herd", "leader")
        plans = {plan.name: plan for plan in mind.explain().plans}
        assert plans["flee"].opened_by == ("culturon 'lead' of group 'herd'",)
        assert plans["trade"].would_open == ("culturon 'follow' of group 'herd'",)

    @pytest.mark.parametrize(
        "maker", [MaximumWeight(), WeightedStochastic(), BiasedWeightedStochastic(2.6)]
    )
    def test_it_tells_the_decision_that_follows_and_takes_none(self, maker):
        mind = mind_of(HUNGER, TIRED, groups=(HERD,), maker=maker)
        mind.create_and_join_group("herd", "follower")
        for count in range(1, 30):
            receipt = mind.explain()
            assert receipt == mind.explain()
            assert receipt.decision == count
            weights = {p.name: p.weight for p in receipt.plans if p.available}
            assert weights == mind.plan_weights()
            chances = {p.name: p.probability for p in receipt.plans if p.available}
            assert chances == mind.plan_probabilities()
            assert mind.choose_next_plan() == receipt.choice

    def test_contributions_add_up_to_the_weights(self):
        mind = mind_of(HUNGER, TIRED, groups=(HERD,))
        mind.activate_cogniton("tired")
        mind.set_cogniton_value("tired", 0.1)
        mind.create_and_join_group("herd", "leader")
        receipt = mind.explain()
        sums = np.sum([i.contributions for i in receipt.influences], axis=0)
        for plan, total in zip(receipt.plans, sums, strict=True):
            if plan.available:
                assert math.isclose(plan.weight, total)

    def test_without_a_plan(self):
        receipt = mind_of(TIRED).explain()
        assert receipt.choice is None and receipt.smallest_change is None
        assert "rest is not available: it takes cogniton 'tired'" in str(receipt)
        assert "choice: no plan is available" in str(receipt)

    def test_it_is_frozen_and_ready_for_json(self):
        mind = mind_of(HUNGER, TIRED, groups=(HERD,), maker=BiasedWeightedStochastic(2.6))
        mind.activate_cogniton("tired")
        receipt = mind.explain()
        with pytest.raises(FrozenInstanceError):
            receipt.choice = "eat"
        data = receipt.to_dict()
        assert json.loads(json.dumps(data)) == data
        assert data["influences"][0]["contributions"]["eat"] == 10.0
        assert data["bias"] == 2.6
        assert data["smallest_change"]["change"] == receipt.smallest_change.change
        for maker in (MaximumWeight(), WeightedStochastic()):
            assert mind_of(HUNGER, maker=maker).explain().to_dict()["bias"] is None


class TestTheTable:
    def test_columns_are_aligned_and_say_what_is_closed(self):
        mind = mind_of(HUNGER, TIRED, groups=(HERD,))
        mind.create_and_join_group("herd", "leader")
        assert str(mind.explain()).splitlines()[:-1] == [
            "Decision 1 of mind 0, scheme 'cows', MaximumWeight",
            "                                 value  eat    rest  flee   trade",
            "hunger                               5  +10      -5     .       .",
            "tired                         inactive    .       .     .       .",
            "herd (participation 1)",
            "  lead                               3   +6       .     .       .",
            "  follow                1 (other role)    .       .     .       .",
            "weight                                   16  closed     0  closed",
            "probability                               1             0",
            "rest is not available: it takes cogniton 'tired'",
            "trade is not available: it takes culturon 'follow' of group 'herd'",
            f"draw: {mind.explain().draw:.6g}, choice: eat",
        ]

    def test_a_tie_that_does_not_suffice_is_told(self):
        mind = mind_of(HUNGER, TIRED, groups=(HERD,))
        mind.create_and_join_group("herd", "leader")
        line = str(mind.explain()).splitlines()[-1]
        assert line == (
            "Smallest change: hunger from 5 to just beyond -3 (-8) makes flee the most probable."
        )

    def test_the_number_next_to_0_is_told_as_0(self):
        wandering = Cogniton("Alive", start_value=1, influence={"wander": 2, "rest": 1},
                             conditional=("wander", "rest"))  # fmt: skip
        line = str(mind_of(wandering, maker=PositiveStochastic()).explain()).splitlines()[-1]
        assert "Alive from 1 to just beyond 0 (-1) makes rest the most probable" in line

    def test_many_plans_continue_below(self):
        plans = [f"a plan with a long name {i}" for i in range(9)]
        mind = mind_of(Cogniton("all", influence=dict.fromkeys(plans, 1.0), conditional=plans))
        text = str(mind.explain())
        assert max(map(len, text.splitlines())) <= 100
        assert all(text.count(f"name {i}") >= 1 for i in range(9))
        assert text.count("probability") == 3


class TestTheSmallestChange:
    def test_figure_3_1(self):
        """Plan 2 gains 6 for each of B and lacks 3; it would take 0.6 of A."""
        mind = mind_of(
            Cogniton("A", start_value=3, influence={"Plan 1": 4, "Plan 2": -1}),
            Cogniton("B", start_value=2, influence={"Plan 2": 6}, conditional=("Plan 1", "Plan 2")),
        )
        change = mind.explain().smallest_change
        assert (change.cogniton, change.value, change.plan, change.exact) == (
            "B",
            2,
            "Plan 2",
            True,
        )
        # At 2.5 the plans are equal and the first still wins.
        assert change.new_value == math.nextafter(2.5, 3)

    def test_a_plan_that_ranks_first_takes_over_at_the_tie(self):
        mind = mind_of(
            Cogniton("A", start_value=1, influence={"first": 2}, conditional=("first",)),
            Cogniton("B", start_value=5, influence={"second": 1}, conditional=("second",)),
        )
        change = mind.explain().smallest_change
        assert (change.cogniton, change.new_value, change.plan) == ("A", 2.5, "first")

    def test_from_a_tie_the_least_change_there_is(self):
        mind = mind_of(
            Cogniton("A", start_value=3, influence={"first": 1}, conditional=("first",)),
            Cogniton("B", start_value=3, influence={"second": 1}, conditional=("second",)),
            maker=BiasedWeightedStochastic(2.6),
        )
        change = mind.explain().smallest_change
        assert change.plan == "second"
        # Downwards the numbers are as dense as upwards or denser; the shares must tell them apart.
        assert 0 < abs(change.change) < 1e-14

    @pytest.mark.parametrize(
        "cognitons",
        [
            (Cogniton("A", influence={"only": 1}, conditional=("only",)),),
            (Cogniton("A", influence={"a": 2, "b": 2}, conditional=("a", "b")),),
            (Cogniton("A", conditional=("a", "b")),),
        ],
    )
    def test_none_when_no_value_makes_a_difference(self, cognitons):
        receipt = mind_of(*cognitons).explain()
        assert receipt.smallest_change is None
        assert "No change of one cogniton's value" in str(receipt)

    def test_inactive_cognitons_and_closed_plans_take_no_part(self):
        mind = mind_of(
            Cogniton("A", start_value=4, influence={"a": 1, "closed": 9}, conditional=("a", "b")),
            Cogniton("off", False, influence={"b": 100}),
            Cogniton("B", start_value=1, influence={"b": 1}),
        )
        change = mind.explain().smallest_change
        assert (change.cogniton, change.plan) == ("A", "b")
        assert change.new_value == math.nextafter(1.0, 0)

    def test_for_a_modellers_own_maker_it_is_searched_and_says_so(self):
        class Lightest(DecisionMaker):
            """The plan of the least weight."""

            name = "Lightest"

            @staticmethod
            def choose(weights, bias, u):
                return int(np.argmin(weights))

            @staticmethod
            def probabilities(weights, bias):
                chances = np.zeros(len(weights))
                chances[np.argmin(weights)] = 1.0
                return chances

        mind = mind_of(
            Cogniton("A", start_value=3, influence={"a": 1}, conditional=("a",)),
            Cogniton("B", start_value=4, influence={"b": 2}, conditional=("b",)),
            maker=Lightest(),
        )
        receipt = mind.explain()
        change = receipt.smallest_change
        assert (change.cogniton, change.plan, change.exact) == ("B", "b", False)
        assert change.new_value == math.nextafter(1.5, 0)
        assert "found by search" in str(receipt)

    def test_a_bias_below_one_can_favour_a_weaker_plan(self):
        """Shares 0.5, 0.3, 0.2 and bias 0.5: 0.25, 0.39, 0.36; so the second leads.

        With the first's weight w and the others 3 and 2 it has w²/(w + 5)², the second
        (w + 3)²/(w + 5)² less that, the third the rest. The second leads while
        (w + 3)² > 2 w²: up to w = 3 (1 + √2); it stays ahead of the third while
        2 (w + 3)² − w² > (w + 5)², always for w above 3.5.
        """
        mind = mind_of(
            Cogniton("A", start_value=5, influence={"a": 1}, conditional=("a",)),
            Cogniton("rest", start_value=1, influence={"b": 3, "c": 2}, conditional=("b", "c")),
            maker=BiasedWeightedStochastic(0.5),
        )
        assert top_of(mind) == "b"
        change = mind.explain().smallest_change
        candidates = {}
        for cogniton in ("A", "rest"):
            start = mind.get_cogniton_value(cogniton)
            for step in np.arange(1, 400) / 100:
                for new in (start - step, start + step):
                    mind.set_cogniton_value(cogniton, new)
                    if top_of(mind) != "b" and cogniton not in candidates:
                        candidates[cogniton] = step
            mind.set_cogniton_value(cogniton, start)
        nearest = min(candidates.values())
        assert nearest - 0.01 <= abs(change.change) <= nearest
        mind.set_cogniton_value("rest", 1)
        mind.set_cogniton_value("A", 3 * (1 + math.sqrt(2)) - 1e-9)
        assert top_of(mind) == "b"
        mind.set_cogniton_value("A", 3 * (1 + math.sqrt(2)) + 1e-9)
        assert top_of(mind) == "a"


makers = st.one_of(
    st.just(MaximumWeight()),
    st.just(WeightedStochastic()),
    st.sampled_from([0.2, 0.5, 0.9, 1.0, 1.5, 2.6, 8.0]).map(BiasedWeightedStochastic),
)
slopes = st.dictionaries(st.sampled_from(PLANS), st.integers(-5, 5).map(float), max_size=3)
values = st.integers(-20, 20).map(float) | st.floats(-20, 20)


@settings(max_examples=250)
@given(makers, st.lists(st.tuples(values, slopes), min_size=1, max_size=3), st.booleans())
@example(BiasedWeightedStochastic(0.5), [(5.0, {"eat": 1.0}), (1.0, {"rest": 3.0})], False)
def test_no_smaller_change_makes_a_difference_and_this_one_does(maker, cognitons, joined):
    mind = mind_of(
        Cogniton("opens", conditional=PLANS),
        *(Cogniton(f"c{i}", start_value=v, influence=s) for i, (v, s) in enumerate(cognitons)),
        groups=(HERD,),
        maker=maker,
    )
    if joined:
        mind.create_and_join_group("herd", "leader")
    top = top_of(mind)
    change = mind.explain().smallest_change
    reach = 1000.0
    if change is not None:
        assert change.exact
        mind.set_cogniton_value(change.cogniton, change.new_value)
        assert top_of(mind) == change.plan != top
        # The very next number towards the present value makes no difference.
        nearer = math.nextafter(change.new_value, change.value)
        mind.set_cogniton_value(change.cogniton, nearer)
        assert top_of(mind) == top
        mind.set_cogniton_value(change.cogniton, change.value)
        reach = abs(change.change)
        assume(reach > 1e-9)
    for i, (value, _) in enumerate(cognitons):
        for part in (1e-6, 0.1, 0.37, 0.5, 0.73, 0.9, 0.99, 0.999999):
            for new in (value - part * reach, value + part * reach):
                mind.set_cogniton_value(f"c{i}", new)
                assert top_of(mind) == top
        mind.set_cogniton_value(f"c{i}", value)
