"""Words of a scheme: each sets the part that it names and nothing else."""

from dataclasses import replace

import pytest
from hypothesis import given
from hypothesis import strategies as st

from coglogo_py import CognitiveScheme, Cogniton, Culturon, Group, Role, SchemeError
from coglogo_py.changing.words import is_word, with_word

ALARM = Culturon("alarm", 1, influence={"flee": 4}, conditional=("flee",))
HERD = Group("herd", (Role("leader", (ALARM,)), Role("member", (ALARM,))), (("stores", 2.0),))
PACK = Group("pack", (Role("wolf", (Culturon("alarm"),)),))
SCHEME = CognitiveScheme(
    "cows",
    (
        Cogniton("hunger", influence={"eat": 2}, conditional=("eat",), reinforcement={"eat": -1}),
        Cogniton("e.g. fear", influence={"flee": 1}),
    ),
    (HERD,),
)


def alarms(scheme):
    """The culturon as each of the roles holds it."""
    return [role.culturons[0] for role in scheme.groups[0].roles]


@pytest.mark.parametrize(
    ("word", "value", "found"),
    [
        ("influence.hunger.eat", "3.5", lambda s: s.cognitons[0].influence["eat"] == 3.5),
        ("influence.hunger.flee", 1, lambda s: s.cognitons[0].influence.get("flee") == 1.0),
        ("influence.e.g. fear.flee", 7, lambda s: s.cognitons[1].influence["flee"] == 7.0),
        ("reinforcement.hunger.eat", 0, lambda s: s.cognitons[0].reinforcement["eat"] == 0.0),
        ("start.hunger", "-2", lambda s: s.cognitons[0].start_value == -2.0),
        ("at_birth.hunger", "no", lambda s: not s.cognitons[0].starting),
        ("chance.hunger", 0.5, lambda s: s.cognitons[0].chance == 0.5),
        ("conditional.hunger.eat", "false", lambda s: s.cognitons[0].conditional == ()),
        ("conditional.hunger.flee", True, lambda s: "flee" in s.cognitons[0].conditional),
        ("decision_maker.bias", 2.6, lambda s: s.decision_maker.bias == 2.6),
        ("decision_maker.name", "WeightedStochastic", lambda s: "Stoch" in s.decision_maker.name),
        ("group_attributes.herd.stores", 9, lambda s: s.groups[0].attributes == (("stores", 9.0),)),
        ("start.alarm", 4, lambda s: {one.start_value for one in alarms(s)} == {4.0}),
        ("influence.herd.alarm.eat", 3, lambda s: alarms(s)[1].influence.get("eat") == 3.0),
        ("conditional.alarm.flee", False, lambda s: alarms(s)[0].conditional == ()),
    ],
)  # fmt: skip
def test_a_word_sets_what_it_names(word, value, found):
    assert not found(SCHEME)
    changed = with_word(SCHEME, word, value)
    assert found(changed)
    assert changed.plans == SCHEME.plans  # the order decides between plans of equal weight


@given(st.floats(-1e6, 1e6), st.floats(-1e6, 1e6))
def test_a_word_set_back_gives_the_same_scheme(weight, other):
    first = with_word(SCHEME, "influence.hunger.eat", weight)
    again = with_word(
        with_word(first, "influence.hunger.eat", other), "influence.hunger.eat", weight
    )
    assert again == first


@pytest.mark.parametrize(
    ("word", "value", "message"),
    [
        ("influence.hunter.eat", 1, "no cogniton or culturon 'hunter' in scheme 'cows'"),
        ("influence.hunger.eet", 1, "no plan 'eet' in scheme 'cows'; expected one of eat, flee"),
        ("at_birth.alarm", "yes", "no cogniton 'alarm'"),
        ("start.hunger", "much", "found start.hunger=much; expected a number"),
        ("at_birth.hunger", "perhaps", "expected true or false"),
        ("chance.hunger", 2, "chance"),
        ("decision_maker.colour", 2, "expected decision_maker.bias or decision_maker.name"),
        ("decision_maker.name", "Maximum", "decision maker 'Maximum'"),
        ("group_attributes.herd.milk", 2, "no attribute 'herd.milk'"),
        ("colour.hunger", 2, "as a word of a scheme"),
    ],
)
def test_what_is_no_word_is_refused_in_one_line(word, value, message):
    with pytest.raises(SchemeError, match=message) as caught:
        with_word(SCHEME, word, value)
    assert "\n" not in str(caught.value)


def test_a_name_of_two_needs_its_group():
    both = replace(SCHEME, groups=(HERD, PACK))
    with pytest.raises(SchemeError, match=r"may be of herd\.alarm or pack\.alarm"):
        with_word(both, "start.alarm", 3)
    assert with_word(both, "start.pack.alarm", 3).groups[1].roles[0].culturons[0].start_value == 3


def test_words_are_told_from_names_of_parameters():
    assert is_word("influence.a.b") and not is_word("influence") and not is_word("n_agents")
