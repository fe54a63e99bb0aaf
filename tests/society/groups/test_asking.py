"""Asking, granting, refusing and expelling in rules: both speeds and a resumed run agree."""

import pytest

from coglogo_py import CognitiveScheme, Group, Role
from socialmind import Agent, Model, ModelError, Population, each

VILLAGE = Group("village", (Role("member"), Role("elder")))
LORDS = CognitiveScheme("lords", groups=(Group("guild"), Group("village", (Role("chief"),))))
FOLK = CognitiveScheme("folk", groups=(VILLAGE,))


class Lord(Agent):
    mark: int = 0


class Peasant(Agent):
    asks: int = -1


def found(lord, model, rng):
    if lord.mind.create_and_join_group("village", "chief"):
        model.last = lord.mind.get_group_id("village")
    elif rng.random() < 0.1:
        lord.mind.leave_all_groups()


def ask(peasant, model, rng):
    if rng.random() < 0.5:
        role = rng.random() < 0.5
        if role:
            peasant.mind.ask_to_join("village", "member", rng.integers(0, model.last + 1))
        else:
            peasant.mind.ask_to_join("village", "elder", rng.integers(0, model.last + 1))
    elif rng.random() < 0.05:
        peasant.die()
        return
    elif rng.random() < 0.05 and len(model.folk) < 40:
        peasant.hatch(keep_groups=True)
    elif rng.random() < 0.05:
        peasant.mind.create_and_join_group("village", "elder")
    peasant.asks = peasant.mind.get_asked_group_id("village")


def judge(lord, model, rng):
    mine = lord.mind.get_group_role_id("village", "chief")
    lord.mark = 31 * lord.mark % 1000003 + len(model.folk.asking("village", mine))
    for one in model.folk.asking("village", mine):
        lord.mark = 31 * lord.mark % 1000003 + one.id
        if rng.random() < 0.3:
            lord.mind.grant_entry("village", one.mind)
        elif rng.random() < 0.3:
            lord.mind.refuse_entry("village", one.mind)
    for one in model.folk.members_of("village", mine):
        lord.mark = 31 * lord.mark % 1000003 + one.id
        if rng.random() < 0.1 and lord.mind.expel("village", one.mind):
            lord.mark += 1
    drawn = model.folk.asking("village", mine).one_of(rng)
    if drawn is not None:
        lord.mark += drawn.id
    rival = model.lords.one_of(rng)
    if rng.random() < 0.1 and lord.mind.expel("village", rival.mind):
        lord.mark += 7


class Realm(Model):
    last: int = 0
    lords = Population(Lord, 3, mind=LORDS, culture="realm")
    folk = Population(Peasant, 25, mind=FOLK, culture="realm")
    schedule = (each(lords, found), each(folk, ask), each(lords, judge))


def facts(realm):
    found = [realm.lords.mark.tolist(), realm.folk.id.tolist(), realm.folk.asks.tolist()]
    for table in (realm.lords, realm.folk):
        found += [one.mind.get_group_id("village") for one in table]
        found += [one.mind.get_asked_group_id("village") for one in table]
    return found


@pytest.mark.parametrize("seed", range(10))
def test_both_speeds_and_a_resumed_society_agree(seed):
    fast, slow = Realm(seed=seed), Realm(seed=seed, compiled=False)
    asked = joined = 0
    for tick in range(14):
        fast.advance(2)
        slow.advance(2)
        assert facts(fast) == facts(slow)
        for identity in range(-1, slow.last + 2):
            askers = [
                one
                for one in slow.folk
                if identity >= 0 and one.mind.get_asked_group_id("village") == identity
            ]
            assert slow.folk.asking("village", identity) == askers
            asked += len(askers)
            joined += len(slow.folk.members_of("village", identity))
        if tick == 6:
            fast = Realm(seed=seed)
            fast.restore(slow.state())
    assert asked > 10
    assert joined > 10


def test_populations_that_share_no_groups_are_named_with_the_line():
    def throw_out(lord, model):
        for one in model.folk:
            lord.mind.expel("village", one.mind)

    class Apart(Model):
        lords = Population(Lord, 1, mind=LORDS)
        folk = Population(Peasant, 1, mind=FOLK)
        schedule = (each(lords, throw_out),)

    message = r"test_asking.py:\d+: expel\(\) of minds of 'folk' by those of 'lords', which share"
    with pytest.raises(ModelError, match=message):
        Apart(seed=1)


def test_the_other_must_be_a_mind():
    def wrong(lord, model):
        lord.mind.expel("village", lord)

    class Wrong(Model):
        lords = Population(Lord, 1, mind=LORDS)
        schedule = (each(lords, wrong),)

    with pytest.raises(ModelError, match=r"mind.expel\(\); write the other's mind"):
        Wrong(seed=1)
