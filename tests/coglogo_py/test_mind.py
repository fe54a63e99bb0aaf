"""The commands of a mind, what is kept of CogLogo's behaviour, and each thing that is mended."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from coglogo_py import (
    BiasedWeightedStochastic,
    CognitiveScheme,
    Cogniton,
    Culturon,
    DecisionMaker,
    Group,
    MaximumWeight,
    MindError,
    Role,
    SchemeError,
    Society,
    WeightedStochastic,
)

FIGURE_3_1 = (
    Cogniton("A", start_value=3, influence={"Plan 1": 4, "Plan 2": -1}, conditional=("Plan 1",)),
    Cogniton("B", start_value=2, influence={"Plan 2": 6}, conditional=("Plan 2",)),
)
COGNITONS = (
    Cogniton(
        "hunger",
        start_value=5.0,
        influence={"eat": 1},
        conditional=("eat",),
        reinforcement={"eat": -2},
    ),
    Cogniton("tired", False, 3.0, influence={"rest": 1}, conditional=("rest",)),
)
LEAD = Culturon("lead", 2.0, influence={"eat": 0.5}, reinforcement={"eat": 1})
FOLLOW = Culturon("follow", 4.0, conditional=("follow",), reinforcement={"eat": 10})
CRAFT = Culturon("craft", 3.0, influence={"make": 2, "eat": -1}, conditional=("make",))
HERD = Group("herd", (Role("leader", (LEAD,)), Role("follower", (FOLLOW,))))
GUILD = Group("guild", (Role("master", (CRAFT,)),))
SCHEME = CognitiveScheme("cows", COGNITONS, (HERD, GUILD))
MAKERS = [MaximumWeight(), WeightedStochastic(), BiasedWeightedStochastic(2.6)]


def mind_of(*cognitons, groups=(), maker=None, seed=1):
    scheme = CognitiveScheme("test", cognitons, groups, maker or MaximumWeight())
    return Society(scheme, seed).new_mind()


@pytest.fixture
def society():
    return Society(SCHEME, seed=1)


@pytest.fixture
def mind(society):
    return society.new_mind()


class TestWeightsOfTheThesis:
    def test_figure_3_1(self):
        assert mind_of(*FIGURE_3_1).plan_weights() == {"Plan 1": 12.0, "Plan 2": 9.0}

    def test_five_against_three(self):
        """Section 3.3.2: 5 against 3 is chosen with 0.625 and 0.375."""
        drives = (
            Cogniton("one", start_value=5, influence={"first": 1}, conditional=("first",)),
            Cogniton("two", start_value=3, influence={"second": 1}, conditional=("second",)),
        )
        mind = mind_of(*drives, maker=WeightedStochastic())
        assert mind.plan_probabilities() == {"first": 0.625, "second": 0.375}

    def test_formula_3_2_with_two_groups(self):
        def culturon(name, value, **influence):
            return Culturon(name, value, influence=influence)

        trust, norm = culturon("trust", 2, trade=3), culturon("norm", 4, trade=-1, rest=2)
        craft = culturon("craft", 5, trade=0.5)
        groups = (
            Group("town", (Role("citizen", (trust, norm)), Role("guest", (culturon("g", 9),)))),
            Group("guild", (Role("master", (craft,)),)),
        )
        own = Cogniton("own", start_value=1, influence={"trade": 10}, conditional=("trade", "rest"))
        mind = mind_of(own, groups=groups)
        mind.create_and_join_group("town", "citizen")
        mind.create_and_join_group("guild", "master")
        mind.set_participation("town", 0.5)
        mind.set_participation("guild", -2)
        # trade: 1·10 + 0.5·(2·3 + 4·(−1)) + (−2)·(5·0.5); rest: 0.5·(4·2)
        assert mind.plan_weights() == {"trade": 10 + 1 - 5, "rest": 4.0}


class TestCognitons:
    def test_starting_ones_have_their_value_and_the_rest_are_inactive(self, mind):
        assert mind.cognitons() == {"hunger": 5.0, "tired": None}

    def test_activation_begins_at_zero_and_leaves_active_ones_alone(self, mind):
        mind.activate_cogniton("tired")
        mind.activate_cogniton("hunger")
        assert mind.cognitons() == {"hunger": 5.0, "tired": 0.0}

    def test_deactivation_forgets_the_value(self, mind):
        mind.deactivate_cogniton("hunger")
        assert mind.get_cogniton_value("hunger") == 0.0
        mind.activate_cogniton("hunger")
        assert mind.cognitons()["hunger"] == 0.0

    def test_setting_and_adding_leave_inactive_ones_inactive(self, mind):
        mind.set_cogniton_value("tired", 4)
        mind.add_to_cogniton_value("tired", 4)
        mind.set_cogniton_value("hunger", np.float32(1.5))
        mind.add_to_cogniton_value("hunger", 2)
        assert mind.cognitons() == {"hunger": 3.5, "tired": None}

    def test_a_value_of_zero_opens_plans_and_an_inactive_cogniton_does_not(self, mind):
        assert mind.plan_weights() == {"eat": 5.0}
        mind.activate_cogniton("tired")
        assert mind.plan_weights() == {"eat": 5.0, "rest": 0.0}


class TestDecisions:
    @pytest.mark.parametrize("maker", MAKERS)
    def test_no_available_plan_is_none_and_nobody_dies_of_it(self, maker):
        """Mended: the original returns "" or "die"."""
        mind = mind_of(Cogniton("A", influence={"Plan": 4}), maker=maker)
        assert mind.choose_next_plan() is None
        assert mind.plan_weights() == {} and mind.plan_probabilities() == {}
        assert mind.alive

    def test_ties_go_by_the_order_of_first_appearance(self):
        """Mended: the original goes by a hash, and "BB" and "Aa" collide there."""
        first = Cogniton("first", influence={"zzz": 1}, conditional=("BB",))
        second = Cogniton("second", conditional=("zzz", "Aa"))
        assert mind_of(first, second).choose_next_plan() == "zzz"
        assert mind_of(second, first).plan_weights().keys() == {"zzz", "Aa", "BB"}
        assert list(mind_of(first, second).plan_weights()) == ["zzz", "BB", "Aa"]
        assert list(mind_of(second, first).plan_weights()) == ["zzz", "Aa", "BB"]

    @pytest.mark.parametrize("bias", [0, -1, math.inf])
    def test_a_bias_must_be_above_zero(self, bias):
        """Mended: the original takes 0 for the last rank and answers "die" to negative ones."""
        with pytest.raises(SchemeError, match="above 0"):
            BiasedWeightedStochastic(bias)

    @pytest.mark.parametrize("maker", MAKERS)
    def test_plans_come_as_often_as_their_probabilities_say(self, maker):
        mind = mind_of(*FIGURE_3_1, maker=maker, seed=11)
        n = 20_000
        counts = dict.fromkeys(("Plan 1", "Plan 2"), 0)
        for _ in range(n):
            counts[mind.choose_next_plan()] += 1
        for plan, p in mind.plan_probabilities().items():
            assert abs(counts[plan] - n * p) <= 5 * math.sqrt(n * p * (1 - p))

    def test_the_next_choice_is_told_without_taking_it(self):
        mind = mind_of(*FIGURE_3_1, maker=WeightedStochastic())
        for _ in range(50):
            told = mind.next_choice()
            assert mind.next_choice() == told
            assert mind.choose_next_plan() == told[1]
            assert mind.next_choice()[0] != told[0]

    def test_a_modellers_own_decision_maker_decides(self):
        class Middle(DecisionMaker):
            """The plan in the middle for a low draw, else the first."""

            name = "Middle"

            @staticmethod
            def choose(weights, bias, u):
                return len(weights) // 2 if u < 0.25 else 0

            @staticmethod
            def probabilities(weights, bias):
                chances = np.zeros(len(weights))
                chances[0] = 0.75
                chances[len(weights) // 2] += 0.25
                return chances

        mind = mind_of(*FIGURE_3_1, maker=Middle(), seed=4)
        assert mind.plan_probabilities() == {"Plan 1": 0.75, "Plan 2": 0.25}
        for _ in range(100):
            draw, told = mind.next_choice()
            assert told == ("Plan 2" if draw < 0.25 else "Plan 1")
            assert mind.choose_next_plan() == told
        mind.deactivate_cogniton("A")
        mind.deactivate_cogniton("B")
        assert mind.choose_next_plan() is None

    def test_a_modellers_own_decision_maker_that_points_nowhere_is_named(self):
        class Beyond(DecisionMaker):
            """Points behind the last plan."""

            name = "Beyond"

            @staticmethod
            def choose(weights, bias, u):
                return len(weights)

            @staticmethod
            def probabilities(weights, bias):
                return np.full(len(weights), 1 / len(weights))

        mind = mind_of(*FIGURE_3_1, maker=Beyond())
        draw = mind.society.minds.draws[0]
        with pytest.raises(MindError, match=r"Beyond\.choose\(\) returned 2; .* 0 … 1"):
            mind.choose_next_plan()
        assert mind.society.minds.draws[0] == draw


class TestFeedBack:
    def test_active_cognitons_and_all_roles_culturons_change_unscaled(self, mind):
        mind.create_and_join_group("herd", "leader")
        mind.set_participation("herd", 0.25)
        mind.feed_back_from_plan("eat", 0.5)
        assert mind.cognitons() == {"hunger": 4.0, "tired": None}
        assert mind.get_culturon_value("herd", "lead") == 2.5
        assert mind.get_culturon_value("herd", "follow") == 9.0

    def test_groups_one_is_not_in_do_not_change(self, society, mind):
        other = society.new_mind()
        other.create_and_join_group("herd", "leader")
        mind.feed_back_from_plan("eat", 1)
        assert other.get_culturon_value("herd", "lead") == 2.0


class TestGroups:
    def test_creating_joining_and_leaving(self, society, mind):
        other = society.new_mind()
        assert mind.get_group_id("herd") == -1
        assert mind.create_and_join_group("herd", "leader") is True
        assert other.join_group("herd", "follower", mind.get_group_id("herd")) is True
        assert other.get_group_id("herd") == 0
        assert mind.get_group_role_id("herd", "leader") == 0
        assert mind.get_group_role_id("herd", "follower") == -1
        mind.set_culturon_value("herd", "follow", 11)
        assert other.get_culturon_value("herd", "follow") == 11.0
        mind.leave_group("herd")
        assert mind.get_group_id("herd") == mind.get_group_role_id("herd", "leader") == -1
        assert other.get_culturon_value("herd", "follow") == 11.0

    def test_a_member_of_the_type_cannot_join_or_create_another(self, society, mind):
        other = society.new_mind()
        other.create_and_join_group("herd", "leader")
        mind.create_and_join_group("herd", "follower")
        assert mind.create_and_join_group("herd", "leader") is False
        assert mind.join_group("herd", "leader", 0) is False
        assert mind.get_group_id("herd") == 1
        assert society.minds.counters[1] == 2

    def test_one_role_opens_and_weighs_by_participation(self, mind):
        mind.create_and_join_group("guild", "master")
        assert mind.plan_weights() == {"eat": 2.0, "make": 6.0}
        mind.set_participation("guild", 0)
        assert mind.plan_weights() == {"eat": 5.0, "make": 0.0}
        mind.add_to_participation("guild", -1.5)
        assert mind.plan_weights() == {"eat": 9.5, "make": -9.0}
        mind.create_and_join_group("herd", "leader")
        assert "follow" not in mind.plan_weights()

    def test_outside_the_group_values_are_zero_and_setting_has_no_effect(self, mind):
        mind.set_participation("herd", 5)
        mind.add_to_participation("herd", 5)
        mind.set_culturon_value("herd", "lead", 5)
        mind.add_to_culturon_value("herd", "lead", 5)
        assert mind.get_participation("herd") == 0.0
        assert mind.get_culturon_value("herd", "lead") == 0.0
        mind.create_and_join_group("herd", "leader")
        assert mind.get_participation("herd") == 1.0
        assert mind.get_culturon_value("herd", "lead") == 2.0

    def test_leaving_all_groups_works(self, mind):
        """Mended: the original fails if the scheme has groups."""
        mind.create_and_join_group("herd", "leader")
        mind.create_and_join_group("guild", "master")
        mind.leave_all_groups()
        assert mind.get_group_id("herd") == mind.get_group_id("guild") == -1

    def test_joining_checks_that_the_group_is_of_the_type(self, society, mind):
        """Mended: the original lets a mind join a guild as a herd."""
        society.new_mind().create_and_join_group("guild", "master")
        with pytest.raises(MindError, match="no group 'herd' with id 0 lives; those that do: none"):
            mind.join_group("herd", "leader", 0)
        assert mind.get_group_id("herd") == -1

    @pytest.mark.parametrize("identity", [-1, 7])
    def test_an_unknown_id_is_an_error(self, society, mind, identity):
        """Mended: the original ignores it."""
        society.new_mind().create_and_join_group("herd", "leader")
        with pytest.raises(MindError, match=f"id {identity} lives; those that do: 0"):
            mind.join_group("herd", "leader", identity)

    def test_the_dead_leave_at_once(self, society, mind):
        """Mended: the original leaves them in until a wall clock's minute is over."""
        mind.create_and_join_group("herd", "leader")
        mind.die()
        with pytest.raises(MindError, match="no group 'herd' with id 0"):
            society.new_mind().join_group("herd", "leader", 0)

    def test_a_culturon_named_by_two_roles_is_one(self):
        shared = Group(
            "team",
            (
                Role("one", (Culturon("norm", 1, influence={"work": 2}, conditional=("work",)),)),
                Role("two", (Culturon("norm", 5, influence={"rest": 3}, conditional=("rest",)),)),
            ),
        )
        mind = mind_of(groups=(shared,))
        mind.create_and_join_group("team", "one")
        assert mind.plan_weights() == {"work": 10.0, "rest": 15.0}


class TestHatching:
    def test_a_child_has_its_parents_values_and_no_group(self, mind):
        """Mended: the original's child remembers groups that it is no member of."""
        mind.set_cogniton_value("hunger", 8)
        mind.create_and_join_group("herd", "leader")
        child = mind.hatch()
        assert child.cognitons() == mind.cognitons() == {"hunger": 8.0, "tired": None}
        assert child.get_group_id("herd") == -1
        child.feed_back_from_plan("eat", 1)
        assert mind.get_culturon_value("herd", "lead") == 2.0

    def test_a_child_that_keeps_groups_is_a_true_member(self, society, mind):
        mind.create_and_join_group("herd", "follower")
        mind.set_participation("herd", 0.5)
        child = mind.hatch(keep_groups=True)
        mind.die()
        assert child.get_group_role_id("herd", "follower") == 0
        assert child.get_participation("herd") == 0.5
        assert "follow" in child.plan_weights()
        assert society.new_mind().join_group("herd", "leader", 0)

    def test_a_child_draws_its_own_numbers(self):
        parent = mind_of(*FIGURE_3_1, maker=WeightedStochastic())
        child = parent.hatch()
        assert parent.next_choice()[0] != child.next_choice()[0]


COMMANDS = {
    "set_cogniton_value": ("hungre", 1.0),
    "add_to_cogniton_value": ("hungre", 1.0),
    "get_cogniton_value": ("hungre",),
    "activate_cogniton": ("Hunger",),
    "deactivate_cogniton": ("hungre",),
    "feed_back_from_plan": ("Eat", 1.0),
    "create_and_join_group": ("herd", "leder"),
    "join_group": ("hurd", "leader", 0),
    "set_participation": ("hurd", 1.0),
    "add_to_participation": ("hurd", 1.0),
    "get_participation": ("hurd",),
    "get_group_id": ("hurd",),
    "get_group_role_id": ("herd", "leder"),
    "leave_group": ("hurd",),
    "set_culturon_value": ("herd", "lad", 1.0),
    "add_to_culturon_value": ("herd", "craft", 1.0),
    "get_culturon_value": ("herd", "lad"),
}


def bytes_of(society):
    return {name: array.tobytes() for name, array in society.state().items()}


@pytest.mark.parametrize(("command", "arguments"), COMMANDS.items())
def test_an_unknown_name_is_an_error_that_names_what_there_is(society, command, arguments):
    """Mended: the original warns, does nothing, or does harm; capitals count in ours."""
    mind = society.new_mind()
    mind.create_and_join_group("herd", "leader")
    before = bytes_of(society)
    with pytest.raises(MindError, match=r"no (cogniton|plan|group|role|culturon) .*there are: "):
        getattr(mind, command)(*arguments)
    assert bytes_of(society) == before


def test_an_error_says_which_name_was_meant(mind):
    with pytest.raises(MindError, match="no cogniton 'hungre' in scheme 'cows'; did you mean 'hun"):
        mind.set_cogniton_value("hungre", 1)
    with pytest.raises(MindError, match="no role 'leder' in group 'herd'; did you mean 'leader'"):
        mind.create_and_join_group("herd", "leder")
    with pytest.raises(MindError, match="names are strings"):
        mind.get_cogniton_value(3)


@pytest.mark.parametrize("value", [math.nan, math.inf, -math.inf, "5", None, True])
@pytest.mark.parametrize(
    ("command", "names"),
    [
        ("set_cogniton_value", ("hunger",)),
        ("add_to_cogniton_value", ("tired",)),
        ("feed_back_from_plan", ("eat",)),
        ("set_participation", ("herd",)),
        ("add_to_participation", ("guild",)),
        ("set_culturon_value", ("herd", "lead")),
        ("add_to_culturon_value", ("herd", "lead")),
    ],
)
def test_what_is_no_finite_number_is_refused(society, command, names, value):
    mind = society.new_mind()
    mind.create_and_join_group("herd", "leader")
    before = bytes_of(society)
    with pytest.raises(MindError, match=f"{command} .*found .*; expected a finite number"):
        getattr(mind, command)(*names, value)
    assert bytes_of(society) == before


def test_sums_beyond_the_largest_number_are_refused(society):
    mind = society.new_mind()
    mind.create_and_join_group("herd", "leader")
    for setting, adding, names in (
        ("set_cogniton_value", "add_to_cogniton_value", ("hunger",)),
        ("set_participation", "add_to_participation", ("herd",)),
        ("set_culturon_value", "add_to_culturon_value", ("herd", "follow")),
    ):
        getattr(mind, setting)(*names, 1.7e308)
        with pytest.raises(MindError, match="beyond the largest number"):
            getattr(mind, adding)(*names, 1.7e308)
    before = bytes_of(society)
    with pytest.raises(MindError, match="mind 0: feed_back_from_plan: a result is beyond"):
        mind.feed_back_from_plan("eat", 1e308)
    with pytest.raises(MindError, match="mind 0: a plan's weight is beyond"):
        mind.choose_next_plan()
    assert bytes_of(society) == before


@settings(max_examples=60)
@given(st.lists(st.floats(-1e6, 1e6), min_size=2, max_size=2), st.sampled_from(MAKERS))
def test_probabilities_sum_to_one_over_the_available_plans(values, maker):
    mind = mind_of(*FIGURE_3_1, maker=maker)
    mind.set_cogniton_value("A", values[0])
    mind.set_cogniton_value("B", values[1])
    chances = mind.plan_probabilities()
    assert chances.keys() == mind.plan_weights().keys()
    assert math.isclose(sum(chances.values()), 1.0)
    assert min(chances.values()) >= 0
