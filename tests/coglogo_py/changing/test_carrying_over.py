"""Minds under another scheme: what both know stays, by its name."""

from dataclasses import replace

import numpy as np
import pytest

from coglogo_py import (
    CogLogoError,
    CognitiveScheme,
    Cogniton,
    Culture,
    Culturon,
    Group,
    Role,
    Society,
)
from coglogo_py.changing.carrying_over import carried_over

HUNGER = Cogniton("hunger", start_value=3, influence={"eat": 2}, conditional=("eat",))
FEAR = Cogniton("fear", influence={"flee": 1}, conditional=("flee",))
HERD = Group("herd", (Role("leader", (Culturon("alarm", 1, influence={"flee": 4}),)), Role("cow")))
SCHEME = CognitiveScheme("cows", (HUNGER, FEAR), (HERD,))


def a_herd(scheme=SCHEME):
    """Three minds, of which two are in a herd, and one that died."""
    society = Society(scheme, seed=4)
    first, second, third, fourth = (society.new_mind() for _ in range(4))
    first.create_and_join_group("herd", "leader")
    second.join_group("herd", "cow", first.get_group_id("herd"))
    first.set_culturon_value("herd", "alarm", 6)
    second.set_cogniton_value("fear", 5)
    third.deactivate_cogniton("hunger")
    fourth.die()
    return society


def under(society, scheme):
    made = Society(scheme, seed=4)
    made.restore(carried_over(society.state(), society, made))
    return made


def test_a_scheme_of_the_same_names_takes_the_state_as_it_is():
    society = a_herd()
    other = replace(SCHEME, cognitons=(replace(HUNGER, influence={"eat": 9.0}), FEAR))
    before, after = society.state(), under(society, other).state()
    assert all(
        np.array_equal(before[n], after[n], equal_nan=before[n].dtype.kind == "f") for n in before
    )


def test_cognitons_in_another_order_keep_their_values_and_new_ones_begin_as_at_birth():
    anger = Cogniton("anger", start_value=7, influence={"flee": 1})
    made = under(a_herd(), replace(SCHEME, cognitons=(anger, FEAR, HUNGER)))
    first, second, third = made
    assert second.cognitons() == {"anger": 7.0, "fear": 5.0, "hunger": 3.0}
    assert third.cognitons()["hunger"] is None
    assert first.get_culturon_value("herd", "alarm") == 6
    assert made.new_mind().id == 4  # identities are never used again


def test_a_cogniton_that_is_gone_is_forgotten():
    (first, *_), gone = under(a_herd(), replace(SCHEME, cognitons=(HUNGER,))), None
    assert first.cognitons() == {"hunger": 3.0} and gone is None


def test_chance_decides_on_a_new_cogniton_as_at_birth():
    luck = Cogniton("luck", start_value=1, influence={"eat": 1}, chance=0.5)
    scheme = replace(SCHEME, cognitons=(HUNGER, FEAR, luck))
    changed = [one.is_active("luck") for one in under(a_herd(), scheme)]
    assert changed == [one.is_active("luck") for one in a_herd(scheme)]


def test_there_may_be_more_groups_roles_and_culturons():
    law = Group("clan", (Role("elder", (Culturon("law", 2, influence={"eat": 1}),)),))
    calm = Culturon("calm", 8, influence={"eat": 1})
    herd = Group("herd", (Role("guest"), Role("cow", (calm,)), *HERD.roles[:1]))
    made = under(a_herd(), replace(SCHEME, groups=(law, herd)))
    first, second, third = made
    assert first.get_group_role_id("herd", "leader") == second.get_group_role_id("herd", "cow") >= 0
    assert first.get_culturon_value("herd", "alarm") == 6
    assert first.get_culturon_value("herd", "calm") == 8
    assert third.create_and_join_group("clan", "elder")
    assert third.get_culturon_value("clan", "law") == 2
    for one in made:
        one.create_and_join_group("clan", "elder")  # there is room for all


def test_groups_and_roles_that_minds_may_be_in_stay():
    with pytest.raises(CogLogoError, match="lacks the group 'herd'"):
        under(a_herd(), replace(SCHEME, groups=()))
    with pytest.raises(CogLogoError, match="lacks the role 'leader' of group 'herd'"):
        under(a_herd(), replace(SCHEME, groups=(Group("herd", (Role("cow"),)),)))


def test_each_breed_of_a_culture_has_a_scheme_of_its_own():
    lords = CognitiveScheme("lords", (HUNGER, FEAR), (HERD,))
    folk = CognitiveScheme("folk", (FEAR,), (HERD,))
    before = Culture((lords, folk), seed=2).breeds
    lord, peasant = (one.new_mind() for one in before)
    lord.set_cogniton_value("fear", 4)
    peasant.set_cogniton_value("fear", 6)
    after = Culture((replace(lords, cognitons=(FEAR, HUNGER)), folk), seed=2).breeds
    after[0].restore(carried_over(before[0].state(), before[0], after[0]))
    assert [one.cognitons() for breed in after for one in breed] == [
        {"fear": 4.0, "hunger": 3.0},
        {"fear": 6.0},
    ]
