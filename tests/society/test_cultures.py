"""Populations with different schemes that share groups."""

import numpy as np
import pytest

from coglogo_py import CognitiveScheme, Cogniton, Culturon, Group, Role, SchemeError
from socialmind import Agent, Model, ModelError, Population, each, once

LAW = Culturon("Law", 2.0, influence={"work": 3.0}, conditional=("work",))
HONOUR = Culturon("Honour", 1.0, influence={"rule": 4.0}, reinforcement={"rule": 0.5})
LORDS = CognitiveScheme(
    "lords",
    (Cogniton("Pride", start_value=5.0, influence={"rule": 1.0}, conditional=("rule",)),),
    (
        Group("court", (Role("king"),)),
        Group("village", (Role("chief", (HONOUR,)),)),
    ),
)
FOLK = CognitiveScheme(
    "folk",
    (
        Cogniton("Hunger", start_value=7.0, influence={"eat": 1.0}, conditional=("eat",)),
        Cogniton("Sleep", start_value=1.0, influence={"eat": -1.0}),
    ),
    (Group("village", (Role("member", (LAW,)), Role("elder")), {"grain": 4}),),
)


class Lord(Agent):
    village: int = -1
    rules: int = 0


class Peasant(Agent):
    works: int = 0
    eats: int = 0


def found(lord, model):
    if lord.id % 2 == 0 and lord.mind.get_group_id("village") < 0:
        lord.mind.create_and_join_group("village", "chief")
        model.last = lord.mind.get_group_id("village")


def enter(peasant, model, rng):
    if model.last >= 0 and rng.random() < 0.5:
        peasant.mind.join_group("village", "member", model.last)
    if rng.random() < 0.1:
        peasant.mind.leave_group("village")
    if rng.random() < 0.05:
        peasant.die()
    elif rng.random() < 0.06:
        peasant.hatch(keep_groups=True)


def command(lord, model):
    lord.plan = lord.mind.choose_next_plan()
    lord.mind.add_to_culturon_value("village", "Law", 0.5)
    lord.mind.feed_back_from_plan("rule", 2.0)
    if lord.mind.get_group_attribute("village", "grain") < 20.0:
        lord.mind.add_to_group_attribute("village", "grain", 1.5)
    lord.village = lord.mind.get_group_id("village")
    if model.tick_count == 6 and lord.id == 0:
        lord.die()


def live(peasant):
    peasant.plan = peasant.mind.choose_next_plan()
    if peasant.plan == "work":
        peasant.works += 1
    elif peasant.plan == "eat":
        peasant.eats += 1


def count(model):
    model.tick_count += 1


class Realm(Model):
    last: int = -1
    tick_count: int = 0
    lords = Population(Lord, 3, mind=LORDS, culture="realm")
    folk = Population(Peasant, 40, mind=FOLK, culture="realm")
    schedule = (once(count), each(lords, found), each(folk, enter), each(lords, command),
                each(folk, live))  # fmt: skip


def test_a_culturon_of_one_breed_acts_on_another_by_hand():
    realm = Realm(seed=1, compiled=False)
    lord, peasant = realm.lords[0].mind, realm.folk[3].mind
    assert lord.create_and_join_group("village", "chief")
    identity = lord.get_group_id("village")
    assert peasant.plan_weights() == {"eat": 6.0}
    assert peasant.join_group("village", "member", identity)
    # Eat 7 − 1; work 3 × the Law's 2.
    assert peasant.plan_weights() == {"eat": 6.0, "work": 6.0}
    lord.add_to_culturon_value("village", "Law", 1.5)
    peasant.set_participation("village", 0.5)
    assert peasant.plan_weights() == {"eat": 6.0, "work": 3.0 * 0.5 * 3.5}
    # Pride 5, and 4 × Honour's 1; a peasant that is no chief does not feel Honour, but knows it.
    assert lord.plan_weights() == {"rule": 9.0}
    # The receipt says so too: of the Law, which the lord's scheme does not name, and of Honour.
    told = {one.name: one for one in peasant.explain().influences}
    assert told["Law"].contributions == (0.0, 5.25)
    assert (told["Honour"].value, told["Honour"].acts) == (1.0, False)
    assert {one.name: one.contributions for one in lord.explain().influences} == {
        "Pride": (5.0,), "Honour": (4.0,), "Law": (0.0,),
    }  # fmt: skip
    lord.feed_back_from_plan("rule", 2.0)
    assert peasant.get_culturon_value("village", "Honour") == 2.0
    # A role that only the other breed's scheme names can be played; its culturons are for those
    # whose scheme links them.
    other = realm.lords[1].mind
    assert other.join_group("village", "elder", identity)
    assert other.plan_weights() == {"rule": 5.0}
    assert realm.lords.society.minds.members[0] == 3
    lord.die()
    assert peasant.get_group_id("village") == identity  # the founder's death ends nothing
    peasant.leave_group("village")
    other.die()
    assert not (realm.folk.society.minds.instance_id >= 0).any()


def test_identities_are_of_the_culture():
    realm = Realm(seed=1, compiled=False)
    assert realm.folk[0].mind.create_and_join_group("village", "elder")
    assert realm.lords[0].mind.create_and_join_group("village", "chief")
    assert realm.lords[0].mind.get_group_id("village") == 1
    assert (len(realm.lords.society), len(realm.folk.society)) == (3, 40)
    assert len({mind.id for breed in (realm.lords, realm.folk) for mind in breed.society}) == 43


@pytest.mark.parametrize("seed", [1, 2])
def test_both_speeds_and_a_resumed_society_agree(seed):
    fast, slow = Realm(seed=seed), Realm(seed=seed, compiled=False)
    fast.advance(25)
    slow.advance(12)
    half = slow.state()
    slow.advance(13)
    resumed = Realm(seed=seed)
    resumed.restore(half)
    resumed.advance(13)
    seen = set()
    for other in (fast, resumed):
        for name in ("lords", "folk"):
            one, two = getattr(slow, name), getattr(other, name)
            assert one.id.tolist() == two.id.tolist()
            assert slow.plans(one) == other.plans(two)
            for a, b in zip(one.society, two.society, strict=True):
                assert a.cognitons() == b.cognitons()
                for group in ("village", "court"):
                    assert a.get_group_id(group) == b.get_group_id(group)
                assert a.plan_weights() == b.plan_weights()
                grain = a.get_group_attribute("village", "grain")
                assert grain == b.get_group_attribute("village", "grain")
                seen.add(grain)
    assert slow.folk.works.sum() > 0
    assert 20.5 in seen  # 4 and 11 times 1.5
    assert len(slow.lords) == 2


def test_schemes_of_a_culture_must_agree_on_where_a_culturon_starts():
    law = Culturon("Law", 3.0)
    other = CognitiveScheme("odd", groups=(Group("village", (Role("member", (law,)),)),))

    class Odd(Model):
        folk = Population(Peasant, 1, mind=FOLK, culture="realm")
        lords = Population(Lord, 1, mind=other, culture="realm")
        schedule = ()

    with pytest.raises(SchemeError, match=r"'Law' of group 'village' starts at 3 in scheme 'odd'"):
        Odd(seed=1)


def test_without_a_culture_groups_of_the_same_name_are_apart():
    class Apart(Model):
        folk = Population(Peasant, 1, mind=FOLK)
        lords = Population(Lord, 1, mind=LORDS)
        schedule = ()

    apart = Apart(seed=1, compiled=False)
    assert apart.folk.society.minds is not apart.lords.society.minds
    assert np.shape(apart.folk.society.minds.values) == (16, 2)


def test_a_culture_needs_a_mind_and_a_name():
    for wrong in ({"culture": "realm"}, {"culture": 3, "mind": FOLK}):
        with pytest.raises(ModelError, match="culture="):

            class Wrong(Model):
                folk = Population(Peasant, 1, **wrong)
                schedule = ()


def test_a_group_attribute_that_no_scheme_has_is_named_with_its_line():
    def tax(lord):
        lord.mind.set_group_attribute("village", "gold", 1.0)

    class Taxed(Model):
        folk = Population(Peasant, 1, mind=FOLK, culture="realm")
        lords = Population(Lord, 1, mind=LORDS, culture="realm")
        schedule = (each(lords, tax),)

    with pytest.raises(ModelError, match=r"test_cultures.py:\d+: the attribute 'gold'"):
        Taxed(seed=1)


def test_linked_breeds_are_populations_that_name_one_file(tmp_path):
    trust = Culturon("Trust", 2.0, influence={"follow": 1.5}, conditional=("follow",))
    herd = Group("herd", (Role("leader"), Role("member", (trust,))))
    file = tmp_path / "herd.cogscheme"
    CognitiveScheme("cows", (Cogniton("Hunger"),), (herd,), breeds=("calves",)).save(file)
    other = CognitiveScheme("bulls", (Cogniton("Hunger"),), (herd,))

    class Pasture(Model):
        cows = Population(Peasant, 2, mind=file)
        calves = Population(Lord, 2, mind=file)
        bulls = Population(Lord, 1, mind=other)
        flies = Population(Lord, 1)
        schedule = ()

    pasture = Pasture(seed=1, compiled=False)
    cow, calf, bull = pasture.cows[0].mind, pasture.calves[1].mind, pasture.bulls[0].mind
    assert calf.create_and_join_group("herd", "leader")
    assert pasture.cows[1].mind.create_and_join_group("herd", "leader")
    assert pasture.cows[1].mind.get_group_id("herd") == 1  # one counter
    assert cow.join_group("herd", "member", calf.get_group_id("herd"))
    calf.set_culturon_value("herd", "Trust", 4.0)
    assert cow.plan_weights() == {"follow": 6.0}
    assert pasture.cows.members_of("herd", 0) == [pasture.cows[0]]
    assert pasture.calves.members_of("herd", 0) == [pasture.calves[1]]
    # Another scheme's herds are others, and a name in BREEDS gives nobody a mind.
    bull.create_and_join_group("herd", "leader")
    assert (bull.get_group_id("herd"), bull.get_culturon_value("herd", "Trust")) == (0, 2.0)
    assert pasture.flies.society is None
