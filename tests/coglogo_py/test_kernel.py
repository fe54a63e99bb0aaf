"""The compiled operations against the makers, against their own text interpreted, and by hand."""

import importlib.util
import itertools
import math
import sys

import numba
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from coglogo_py import (
    BiasedWeightedStochastic,
    CognitiveScheme,
    Cogniton,
    Culturon,
    Group,
    MaximumWeight,
    Role,
    WeightedStochastic,
    kernel,
)
from coglogo_py.decision import BUILT_IN, weight_shares
from coglogo_py.groups import instances
from coglogo_py.laying_out import grown, maker_code, mind_arrays, scheme_arrays
from coglogo_py.streams import uniforms

PLANS = ("eat", "rest", "trade", "flee")
ALMOST_ONE = math.nextafter(1.0, 0.0)

numbers = st.floats(-1e6, 1e6) | st.sampled_from([0.0, 1.0, -1.0, 1e300, -1e300, 1e-300])
links = st.dictionaries(st.sampled_from(PLANS), st.floats(-10, 10), max_size=4)
conditions = st.lists(st.sampled_from(PLANS), unique=True, max_size=3).map(tuple)
makers = st.one_of(
    st.floats(0.05, 20).map(kind) if kind.biased else st.just(kind()) for kind in BUILT_IN
)


@st.composite
def schemes(draw):
    """A scheme of up to four cognitons and two groups, the first of two roles."""
    cognitons = tuple(
        Cogniton(
            f"cogniton {i}",
            starting=draw(st.booleans()),
            start_value=draw(st.floats(-100, 100)),
            influence=draw(links),
            conditional=draw(conditions),
            reinforcement=draw(links),
        )
        for i in range(draw(st.integers(0, 4)))
    )

    def culturon(name):
        return Culturon(
            name,
            draw(st.floats(-100, 100)),
            influence=draw(links),
            conditional=draw(conditions),
            reinforcement=draw(links),
        )

    groups = (
        Group(
            "herd",
            (
                Role("leader", (culturon("lead"), culturon("fear"))),
                Role("follower", (culturon("fear"), culturon("follow"))),
            ),
        ),
        Group(
            "guild",
            (Role("master", (culturon("craft"),)),),
            within=("herd", "leader") if draw(st.booleans()) else None,
        ),
    )[: draw(st.integers(0, 2))]
    return CognitiveScheme("random", cognitons, groups, decision_maker=draw(makers))


@pytest.fixture(scope="module")
def interpreted():
    """The kernel's own text, run by Python instead of numba."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(numba, "njit", lambda **options: lambda function: function)
        for of in (instances, kernel):
            place = importlib.util.spec_from_file_location("interpreted", of.__file__)
            module = importlib.util.module_from_spec(place)
            place.loader.exec_module(module)
            patch.setitem(sys.modules, of.__name__, module)
    return module


def scheme_of(maker=None, groups=()):
    """Two cognitons, the second inactive at birth, and perhaps groups."""
    hunger = Cogniton("hunger", True, 3.0, influence={"eat": 4, "rest": -1}, conditional=("eat",))
    tired = Cogniton(
        "tired", False, 9.0, influence={"rest": 6}, conditional=("rest",), reinforcement={"eat": 2}
    )
    return CognitiveScheme("cows", (hunger, tired), groups, maker or MaximumWeight())


HERD = Group(
    "herd",
    (
        Role("leader", (Culturon("lead", 1.0, influence={"eat": 10}, reinforcement={"eat": 0.5}),)),
        Role("follower", (Culturon("follow", 2.0, conditional=("follow",)),)),
    ),
)


def arrays_of(scheme, capacity=4, seed=5):
    arrays = scheme_arrays(scheme)
    return arrays, mind_arrays(arrays, capacity, seed)


def bytes_of(minds):
    return [array.tobytes() for array in minds]


@settings(max_examples=300)
@given(
    makers,
    st.lists(numbers, min_size=1, max_size=9),
    st.floats(0, 1, exclude_max=True) | st.sampled_from([0.0, ALMOST_ONE]),
)
def test_choose_decides_as_the_decision_makers_do(maker, weights, u):
    code, bias = maker_code(CognitiveScheme("any", decision_maker=maker))
    weights = np.array(weights)
    before = weights.copy()
    assert kernel.choose(int(code), bias, weights, u) == maker.choose(weights, maker.bias, u)
    assert np.array_equal(weights, before)


@pytest.mark.parametrize(
    "maker",
    [WeightedStochastic(), *(BiasedWeightedStochastic(bias) for bias in (0.4, 1.0, 2.6))],
)
@pytest.mark.parametrize("weights", [[12.0, 9.0], [5.0, -2.0, 5.0, 1.0], [0.0, 0.0, 0.0]])
def test_over_all_draws_each_plan_comes_as_often_as_its_probability_says(maker, weights):
    code, bias = maker_code(CognitiveScheme("any", decision_maker=maker))
    weights = np.array(weights)
    n = 20_000
    counts = np.zeros(len(weights))
    for i in range(n):
        counts[kernel.choose(int(code), bias, weights, (i + 0.5) / n)] += 1
    # Each plan's draws are one interval: its count is off by less than one at either end.
    assert np.abs(counts - n * maker.probabilities(weights, maker.bias)).max() <= 1


BORDERS = [
    [1.0, 3.0],
    [3.0, 3.0],
    [5.0, -2.0, 5.0, 1.0],
    [1.0, 2.0**53 + 2, 2.0**53],
    [-1.7e308, 0.0, 0.0],
    [4.3e299, 2.6e299, 7.4e299],
]


@pytest.mark.parametrize("weights", BORDERS, ids=str)
def test_a_draw_on_the_border_of_a_share_is_the_earlier_plan_s(weights):
    weights = np.array(weights)
    shares = weight_shares(weights)
    by_rank = np.argsort(-shares, kind="stable").tolist()
    for code, order in (
        (kernel.WEIGHTED_STOCHASTIC, range(len(weights))),
        (kernel.BIASED_WEIGHTED_STOCHASTIC, by_rank),
    ):
        border = 0.0
        for earlier, later in itertools.pairwise(order):
            border += shares[earlier]
            if border < ALMOST_ONE:
                assert kernel.choose(code, 1.0, weights, border) == earlier
                assert kernel.choose(code, 1.0, weights, math.nextafter(border, 1.0)) == later


@pytest.mark.parametrize(
    ("bias", "u", "n"), [(2.0, 0.5, 4), (0.5, 0.25, 2), (0.5, 0.0625, 4), (1.0, 0.5, 2)]
)
def test_a_biased_draw_on_the_border_counts(bias, u, n):
    # u to the power of the bias is 1 / n, the first of n equal shares.
    code, weights = kernel.BIASED_WEIGHTED_STOCHASTIC, np.full(n, 3.0)
    assert kernel.choose(code, bias, weights, u) == 0
    assert kernel.choose(code, bias, weights, math.nextafter(u, 1.0)) == 1


def test_a_draw_hangs_on_seed_stream_mind_and_decision():
    arrays = scheme_arrays(scheme_of())
    minds = mind_arrays(arrays, 4, 2**40 + 3)
    slot = kernel.new_mind(arrays, minds)
    minds.counters[kernel.STREAM] = 5
    minds.mind_id[slot] = 77
    minds.draws[slot] = 2**33 + 9
    expected = uniforms(9, 77, 2, 0x4D490005, 3, 2**8)[0]
    assert kernel.next_draw(minds, slot) == expected
    assert minds.draws[slot] == 2**33 + 9


def test_who_is_born_in_the_place_of_a_dead_mind_draws_from_the_first_number_on():
    arrays, minds = arrays_of(scheme_of(WeightedStochastic()))
    slot = kernel.new_mind(arrays, minds)
    kernel.choose_next_plan(arrays, minds, slot, np.empty(2), np.empty(2, np.int64))
    kernel.die(arrays, minds, slot)
    assert kernel.new_mind(arrays, minds) == slot
    assert (minds.draws[slot], minds.mind_id[slot]) == (0, 1)


OPERATIONS = st.lists(
    st.tuples(
        st.sampled_from(
            [
                *("new", "hatch", "die", "set", "add", "activate", "deactivate", "choose"),
                *("weights", "feed", "create", "join", "leave", "leave-all", "participate"),
                *("culturon", "add-culturon", "get", "ask", "grant", "refuse", "expel"),
                *("enclose", "release"),
            ]
        ),
        st.integers(0, 7),
        st.integers(0, 7),
        st.floats(-50, 50) | st.sampled_from([math.nan, math.inf, 1.7e308]),
    ),
    max_size=40,
)


def apply(module, scheme, minds, operation):
    """Carry out one operation where its positions make sense; return what came of it."""
    name, first, second, value = operation
    slot = first % len(minds.mind_id)
    if minds.mind_id[slot] < 0 and name != "new":
        return None
    cognitons, plans = len(scheme.start), scheme.influence.shape[1]
    roles, culturons = len(scheme.role_group), len(scheme.culturon_start)
    try:
        if name == "new":
            return module.new_mind(scheme, minds)
        if name == "hatch":
            return module.hatch(scheme, minds, slot, second % 2 == 0)
        if name == "die":
            return module.die(scheme, minds, slot)
        if name == "choose":
            return module.choose_next_plan(
                scheme, minds, slot, np.empty(plans), np.empty(plans, np.int64)
            )
        if name == "weights":
            weights, available = np.empty(plans), np.empty(plans, np.bool_)
            count = module.plan_weights(scheme, minds, slot, weights, available)
            return count, weights.tobytes(), available.tobytes()
        if name == "feed":
            return module.feed_back_from_plan(scheme, minds, slot, second - 1, value)
        if name == "leave-all":
            return module.leave_all_groups(minds, slot)
        if cognitons:
            c = second % cognitons
            if name == "set":
                return module.set_cogniton_value(minds, slot, c, value)
            if name == "add":
                return module.add_to_cogniton_value(minds, slot, c, value)
            if name == "activate":
                return module.activate_cogniton(minds, slot, c)
            if name == "deactivate":
                return module.deactivate_cogniton(minds, slot, c)
        if roles:
            role = second % roles
            group = int(scheme.role_group[role])
            culturon = int(scheme.group_culturons[group, 0])
            if name == "create":
                return bool(module.create_and_join_group(scheme, minds, slot, group, role))
            if name == "join":
                return bool(module.join_group(scheme, minds, slot, group, role, first // 2))
            if name == "leave":
                return module.leave_group(minds, slot, group)
            if name == "participate":
                return module.add_to_participation(minds, slot, group, value)
            if name == "ask":
                return bool(module.ask_to_join(scheme, minds, slot, group, role, first // 2))
            other = second % len(minds.mind_id)
            if name in ("grant", "refuse", "expel") and minds.mind_id[other] >= 0:
                called = {"grant": "grant_entry", "refuse": "refuse_entry"}.get(name, name)
                return bool(getattr(module, called)(minds, slot, group, other))
            if name == "enclose":
                return bool(module.enclose_group(scheme, minds, slot, group, first // 2))
            if name == "release":
                return module.release_group(minds, slot, group)
            if name == "culturon":
                return module.set_culturon_value(scheme, minds, slot, group, culturon, value)
            if name == "add-culturon":
                return module.add_to_culturon_value(scheme, minds, slot, group, culturon, value)
            if name == "get":
                return (
                    float(module.get_culturon_value(scheme, minds, slot, group, culturon)),
                    float(module.get_participation(minds, slot, group)),
                    int(module.get_group_id(minds, slot, group)),
                    int(module.get_asked_group_id(minds, slot, group)),
                    int(module.get_enclosing_group_id(minds, slot, group)),
                    int(module.get_group_role_id(minds, slot, group, role)),
                    culturons,
                )
    except ValueError as error:
        return str(error)
    return None


@settings(max_examples=150)
@given(schemes(), OPERATIONS)
def test_compiled_and_interpreted_operations_leave_the_same_bits(interpreted, scheme, operations):
    arrays = scheme_arrays(scheme)
    compiled_minds = mind_arrays(arrays, 4, seed=2**40 + 3)
    interpreted_minds = mind_arrays(arrays, 4, seed=2**40 + 3)
    for module, minds in ((kernel, compiled_minds), (interpreted, interpreted_minds)):
        module.new_mind(arrays, minds)
        module.new_mind(arrays, minds)
    with np.errstate(all="ignore"):
        for operation in operations:
            one = apply(kernel, arrays, compiled_minds, operation)
            other = apply(interpreted, arrays, interpreted_minds, operation)
            assert one == other, operation
            assert bytes_of(compiled_minds) == bytes_of(interpreted_minds), operation


@settings(max_examples=100)
@given(schemes(), OPERATIONS)
def test_an_operation_that_raises_changes_nothing(scheme, operations):
    arrays, minds = arrays_of(scheme)
    kernel.new_mind(arrays, minds)
    kernel.new_mind(arrays, minds)
    for operation in operations:
        before = bytes_of(minds)
        if isinstance(apply(kernel, arrays, minds, operation), str):
            assert bytes_of(minds) == before, operation


@settings(max_examples=100)
@given(schemes(), OPERATIONS)
def test_members_and_free_places_add_up(scheme, operations):
    arrays, minds = arrays_of(scheme)
    for operation in operations:
        apply(kernel, arrays, minds, operation)
    counters = minds.counters
    alive = minds.mind_id >= 0
    assert counters[kernel.ALIVE] == alive.sum()
    assert counters[kernel.ALIVE] + counters[kernel.FREE_MINDS] == len(minds.mind_id)
    living = minds.instance_id >= 0
    assert living.sum() + counters[kernel.FREE_INSTANCES] == len(minds.instance_id)
    for row in range(len(minds.instance_id)):
        parts = (minds.within == row).sum()
        assert minds.members[row] == (minds.group_slot == row).sum() + parts
        assert (minds.members[row] > 0) == living[row]
    assert not (minds.group_slot[~alive] >= 0).any()


def test_a_full_society_refuses_a_birth():
    arrays, minds = arrays_of(scheme_of(), capacity=1)
    assert kernel.new_mind(arrays, minds) == 0
    before = bytes_of(minds)
    assert kernel.new_mind(arrays, minds) == -1
    assert kernel.hatch(arrays, minds, 0, True) == -1
    assert bytes_of(minds) == before


def test_which_slots_are_taken_does_not_depend_on_when_the_arrays_grew():
    scheme = scheme_of(groups=(HERD,))
    arrays, small = arrays_of(scheme, capacity=2)
    large = mind_arrays(arrays, 8, seed=5)
    taken = []
    for minds in (small, large):
        slots = [kernel.new_mind(arrays, minds), kernel.new_mind(arrays, minds)]
        kernel.create_and_join_group(arrays, minds, 0, 0, 0)
        kernel.die(arrays, minds, 0)
        if len(minds.mind_id) == 2:
            minds = grown(arrays, minds, 8)
        slots += [kernel.new_mind(arrays, minds) for _ in range(5)]
        for slot in slots[2:]:
            kernel.create_and_join_group(arrays, minds, slot, 0, 0)
        taken.append((slots, minds.group_slot.tolist(), minds.mind_id.tolist()))
    assert taken[0] == taken[1]
    assert taken[0][0] == [0, 1, 0, 2, 3, 4, 5]


def test_the_arrays_of_a_scheme_are_read_only_and_keep_their_dimensions():
    arrays, minds = arrays_of(CognitiveScheme("empty"))
    assert arrays.influence.shape == (0, 0) and arrays.group_culturons.shape == (0, 2)
    assert minds.values.shape == (4, 0) and minds.culturons.shape == (1, 0)
    assert not any(array.flags.writeable for array in arrays)
    assert all(array.flags.c_contiguous for array in (*arrays, *minds))
    slot = kernel.new_mind(arrays, minds)
    assert kernel.choose_next_plan(arrays, minds, slot, np.empty(0), np.empty(0, np.int64)) == -1


def test_a_group_is_found_after_others_dissolved():
    arrays, minds = arrays_of(scheme_of(groups=(HERD,)))
    slots = [kernel.new_mind(arrays, minds) for _ in range(4)]
    for slot in slots[:3]:
        kernel.create_and_join_group(arrays, minds, slot, 0, 0)
    kernel.leave_group(minds, slots[0], 0)
    kernel.create_and_join_group(arrays, minds, slots[0], 0, 0)
    assert kernel.get_group_id(minds, slots[0], 0) == 3
    assert kernel.join_group(arrays, minds, slots[3], 0, 1, 3)
    assert minds.group_slot[slots[3], 0] == minds.group_slot[slots[0], 0]
    assert kernel.find_group(minds, 0, 0) == -1
    assert kernel.find_group(minds, 0, -1) == -1


def test_groups_are_found_whatever_began_and_ended():
    arrays, minds = arrays_of(scheme_of(groups=(HERD,)), capacity=8)
    slots = [kernel.new_mind(arrays, minds) for _ in range(8)]
    rng, longest = np.random.default_rng(1), 0
    for step in range(600):
        slot = slots[rng.integers(8)]
        if not kernel.create_and_join_group(arrays, minds, slot, 0, 0):
            kernel.leave_group(minds, slot, 0)
        if step == 300:
            minds = grown(arrays, minds, 20)
        rows = {int(one): row for row, one in enumerate(minds.instance_id) if one >= 0}
        newest = int(minds.counters[kernel.NEXT_GROUP])
        for identity in (*rows, int(rng.integers(-1, newest + 1))):
            assert kernel.find_group(minds, 0, identity) == rows.get(identity, -1)
        at, length = minds.instance_chains[rng.integers(len(minds.instance_chains)), 0], 0
        while at >= 0:
            at, length = minds.instance_chains[at, 1], length + 1
        longest = max(longest, length)
    assert 1 < longest < 6


@pytest.mark.parametrize("plan", [-1, 2])
def test_feed_back_from_no_plan_is_refused(plan):
    arrays, minds = arrays_of(scheme_of())
    kernel.new_mind(arrays, minds)
    with pytest.raises(ValueError, match="no such plan"):
        kernel.feed_back_from_plan(arrays, minds, 0, plan, 1.0)


def test_a_weight_beyond_the_largest_number_is_refused_and_no_draw_is_counted():
    arrays, minds = arrays_of(scheme_of())
    kernel.new_mind(arrays, minds)
    kernel.set_cogniton_value(minds, 0, 0, 1.7e308)
    with pytest.raises(ValueError, match="beyond the largest"):
        kernel.choose_next_plan(arrays, minds, 0, np.empty(2), np.empty(2, np.int64))
    assert minds.draws[0] == 0


def test_a_weight_beyond_the_largest_number_of_a_closed_plan_is_nobody_s():
    weigher = Cogniton("weigher", start_value=1e308, influence={"eat": 10}, conditional=("rest",))
    arrays, minds = arrays_of(CognitiveScheme("closed", (weigher,)))
    kernel.new_mind(arrays, minds)
    weights, available = np.empty(2), np.empty(2, np.bool_)
    assert kernel.plan_weights(arrays, minds, 0, weights, available) == 1
    assert available.tolist() == [False, True]
    assert weights[1] == 0.0


def test_a_decision_without_a_plan_counts_as_a_draw():
    arrays, minds = arrays_of(scheme_of(WeightedStochastic()))
    kernel.new_mind(arrays, minds)
    kernel.deactivate_cogniton(minds, 0, 0)
    assert kernel.choose_next_plan(arrays, minds, 0, np.empty(2), np.empty(2, np.int64)) == -1
    assert minds.draws[0] == 1
