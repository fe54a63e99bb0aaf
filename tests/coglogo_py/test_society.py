"""Births, deaths, identities, draws and states of a society."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from coglogo_py import (
    CogLogoError,
    CognitiveScheme,
    Cogniton,
    Culturon,
    Group,
    MindError,
    Role,
    Society,
    WeightedStochastic,
    kernel,
)

HUNGER = Cogniton("hunger", start_value=5.0, influence={"eat": 1}, conditional=("eat", "rest"))
TIRED = Cogniton("tired", start_value=3.0, influence={"rest": 1}, conditional=("rest",))
LEAD = Culturon("lead", 2.0, influence={"eat": 0.5}, conditional=("flee",))
SCHEME = CognitiveScheme(
    "cows",
    (HUNGER, TIRED),
    (Group("herd", (Role("leader", (LEAD,)), Role("follower"))),),
    WeightedStochastic(),
)


def plans_of(mind, count=20):
    return [mind.choose_next_plan() for _ in range(count)]


def test_minds_are_counted_and_iterated_eldest_first():
    society = Society(SCHEME, seed=1)
    minds = [society.new_mind() for _ in range(40)]
    minds[3].die()
    minds.append(society.new_mind())
    living = [mind for mind in minds if mind.alive]
    assert len(society) == 40
    assert list(society) == living
    assert [mind.id for mind in society] == [*range(3), *range(4, 41)]


def test_several_minds_at_once_are_the_same_as_one_by_one():
    together, singly = Society(SCHEME, seed=1), Society(SCHEME, seed=1)
    for society in (together, singly):
        minds = [society.new_mind() for _ in range(6)]
        minds[1].create_and_join_group("herd", "leader")
        minds[1].die()
        minds[4].die()
    slots = together.new_minds(30)
    assert slots.tolist() == [singly.new_mind().slot for _ in range(30)]
    assert together.new_minds(0).tolist() == []
    assert together.minds.counters[kernel.NEXT_MIND] == singly.minds.counters[kernel.NEXT_MIND]
    assert [m.id for m in together] == [m.id for m in singly]
    assert [m.cognitons() for m in together] == [m.cognitons() for m in singly]
    assert [m.next_choice() for m in together] == [m.next_choice() for m in singly]


def test_minds_may_be_born_and_die_while_one_iterates():
    society = Society(SCHEME, seed=1)
    for _ in range(16):
        society.new_mind()
    seen = []
    for mind in society:
        seen.append(mind.id)
        mind.hatch()
        if mind.id == 2:
            next(iter(m for m in society if m.id == 5)).die()
    assert seen == [0, 1, 2, 3, 4, *range(6, 16)]


def test_identities_are_not_given_again_until_a_reset():
    society = Society(SCHEME, seed=1)
    first = society.new_mind()
    first.create_and_join_group("herd", "leader")
    first.die()
    second = society.new_mind()
    assert second.id == 1
    second.create_and_join_group("herd", "leader")
    assert second.get_group_id("herd") == 1
    society.reset()
    third = society.new_mind()
    third.create_and_join_group("herd", "leader")
    assert (third.id, third.get_group_id("herd")) == (0, 0)


def test_a_reset_gives_the_same_draws_again():
    society = Society(SCHEME, seed=1)
    before = plans_of(society.new_mind())
    society.reset()
    assert len(society) == 0
    assert plans_of(society.new_mind()) == before


def test_the_dead_and_those_before_a_reset_take_no_commands():
    society = Society(SCHEME, seed=1)
    mind, other = society.new_mind(), society.new_mind()
    mind.die()
    successor = society.new_mind()
    assert successor.slot == mind._slot
    for command in (
        *(mind.choose_next_plan, mind.plan_weights, mind.hatch, mind.die, mind.explain),
        *(mind.cognitons, mind.leave_all_groups),
        lambda: mind.set_cogniton_value("hunger", 1),
        lambda: mind.create_and_join_group("herd", "leader"),
    ):
        with pytest.raises(MindError, match="mind 0 of scheme 'cows' is dead"):
            command()
    society.reset()
    society.new_mind()
    society.new_mind()
    assert not other.alive
    with pytest.raises(MindError, match="dead"):
        other.get_cogniton_value("hunger")


def test_a_mind_stays_valid_when_the_arrays_grow():
    society = Society(SCHEME, seed=1)
    mind = society.new_mind()
    mind.set_cogniton_value("hunger", 7)
    mind.create_and_join_group("herd", "leader")
    arrays = society.minds
    society.reserve(1000)
    assert society.minds is not arrays
    assert len(society.minds.mind_id) >= 1001
    assert mind.get_cogniton_value("hunger") == 7
    mind.set_culturon_value("herd", "lead", 4)
    assert society.minds.culturons[0, 0] == 4
    arrays = society.minds
    society.reserve(1000)
    assert society.minds is arrays


events = st.lists(
    st.sampled_from(["birth", "death", "decision", "group", "hatch", "grow"]), max_size=25
)


@settings(max_examples=60)
@given(events, st.integers(0, 2**64 - 1))
def test_a_minds_decisions_do_not_depend_on_what_others_do(events, seed):
    quiet, busy = Society(SCHEME, seed), Society(SCHEME, seed)
    alone, among_others = quiet.new_mind(), busy.new_mind()
    others = []
    for event in events:
        if event == "birth":
            others.append(busy.new_mind())
        elif event == "hatch":
            others.append(among_others.hatch())
        elif event == "grow":
            busy.reserve(40)
        elif others:
            if event == "death":
                others.pop().die()
            elif event == "decision":
                others[-1].choose_next_plan()
            else:
                others[-1].create_and_join_group("herd", "leader")
        assert alone.choose_next_plan() == among_others.choose_next_plan()


@settings(max_examples=30)
@given(st.integers(0, 2**64 - 1), st.integers(0, 2**64 - 1), st.integers(0, 65535))
def test_draws_depend_on_seed_stream_mind_and_count(seed, other_seed, stream):
    def draws(society, mind):
        minds = [society.new_mind() for _ in range(mind + 1)]
        found = []
        for _ in range(10):
            found.append(minds[mind].explain().draw)
            minds[mind].choose_next_plan()
        return found

    first = draws(Society(SCHEME, seed), 0)
    assert len(set(first)) == 10 and all(0 <= u < 1 for u in first)
    assert draws(Society(SCHEME, seed, 0), 0) == first
    assert draws(Society(SCHEME, seed), 1) != first
    assert (draws(Society(SCHEME, other_seed), 0) == first) == (other_seed == seed)
    assert (draws(Society(SCHEME, seed, stream), 0) == first) == (stream == 0)


def test_all_groups_dissolve_with_their_last_member():
    society = Society(SCHEME, seed=1)
    founder, joiner = society.new_mind(), society.new_mind()
    for _ in range(200):
        founder.create_and_join_group("herd", "leader")
        joiner.join_group("herd", "follower", founder.get_group_id("herd"))
        founder.leave_group("herd")
        assert joiner.get_culturon_value("herd", "lead") == 2.0
        joiner.leave_all_groups()
    assert (society.minds.instance_id == -1).all()
    assert len(society.minds.mind_id) == 16


def test_a_state_brings_everything_back():
    society = Society(SCHEME, seed=2**50, stream=3)
    minds = [society.new_mind() for _ in range(20)]
    minds[0].create_and_join_group("herd", "leader")
    minds[4].die()
    plans_of(minds[1], 3)
    state = society.state()
    expected = plans_of(minds[1]), plans_of(society.new_mind())
    minds[0].add_to_culturon_value("herd", "lead", 9)
    society.reserve(500)

    society.restore(state)
    assert minds[0].get_culturon_value("herd", "lead") == 2.0
    assert len(society) == 19
    assert (plans_of(minds[1]), plans_of(society.new_mind())) == expected

    elsewhere = Society(SCHEME, seed=0)
    elsewhere.restore(state)
    assert (elsewhere.seed, elsewhere.stream) == (2**50, 3)
    assert plans_of(elsewhere.mind_in(1)) == expected[0]
    assert not np.array_equal(society.state()["draws"], state["draws"])


def test_a_state_is_a_copy():
    society = Society(SCHEME, seed=1)
    mind = society.new_mind()
    state = society.state()
    mind.set_cogniton_value("hunger", 100)
    society.restore(state)
    mind.set_cogniton_value("hunger", 200)
    assert state["values"][0, 0] == 5.0


def test_the_state_of_another_scheme_is_refused_and_nothing_changes():
    society = Society(SCHEME, seed=1)
    mind = society.new_mind()
    other = Society(CognitiveScheme("other", (HUNGER,)), seed=1).state()
    with pytest.raises(CogLogoError, match=r"values .* expected float64 of shape \(16, 2\)"):
        society.restore(other)
    with pytest.raises(CogLogoError, match="lacks mind_id"):
        society.restore({"values": other["values"]})
    assert mind.get_cogniton_value("hunger") == 5.0


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ((SCHEME, -1), r"seed of a society: found .*; expected a whole number, 0 … 2\*\*64"),
        (
            (SCHEME, 2**64),
            r"seed of a society: found .*; expected a whole number, 0 … 2\*\*64",
        ),
        ((SCHEME, 1.5), "seed of a society: found 1.5; expected a whole number"),
        (
            (SCHEME, 1, 65536),
            "stream of a society: found 65536; expected a whole number, 0 …",
        ),
        (("cows", 1), "needs a CognitiveScheme, found 'cows'"),
    ],
)
def test_a_society_of_anything_else_is_refused(arguments, message):
    with pytest.raises(CogLogoError, match=message):
        Society(*arguments)


def test_no_mind_in_a_free_slot():
    with pytest.raises(CogLogoError, match="no mind lives in slot 3"):
        Society(SCHEME, seed=1).mind_in(3)
