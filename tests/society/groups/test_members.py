"""Who is in a group: compiled, interpreted and naive rules find the same, whoever joins or dies."""

import numpy as np
import pytest

from coglogo_py import CognitiveScheme, Cogniton, Group, MindError, Role
from socialmind import Agent, Model, ModelError, Population, each, once, parameter
from socialmind.society.groups import lists

VILLAGE = Group("village", (Role("member"), Role("chief")))
GUILD = Group("guild", (Role("master"),))
LORDS = CognitiveScheme("lords", (Cogniton("Pride"),), (GUILD, VILLAGE))
FOLK = CognitiveScheme("folk", (), (VILLAGE,))


class Human(Agent):
    mark: int = 0


def met(mark, identity):
    return (mark * 31 + identity + 1) % 1000003


def wander(human, model, rng):
    """Found, join or leave a village, be born or die."""
    village = human.mind.get_group_id("village")
    chance = rng.random()
    if village < 0:
        if chance < 0.15:
            human.mind.create_and_join_group("village", "chief")
            model.last = human.mind.get_group_id("village")
        elif model.folk.members_of("village", model.last).one_of(rng) is not None:
            human.mind.join_group("village", "member", model.last)
    elif chance < 0.1:
        human.mind.leave_group("village")
    elif chance < 0.15:
        human.mind.leave_all_groups()
    elif chance < 0.2:
        human.die()
    elif chance < 0.3 and len(model.folk) < model.most:
        human.hatch(keep_groups=True)


def look(human, model, rng):
    """Go over those of a village, and change who is in it on the way."""
    village = human.mind.get_group_id("village")
    human.mark = met(human.mark, len(model.folk.members_of("village", village)))
    for one in model.folk.members_of("village", village):
        human.mark = met(human.mark, one.id)
        for other in model.folk.members_of("village", one.mind.get_group_id("village")):
            human.mark = met(human.mark, other.id)
            if other.id % 3 == 0:
                stir(other, human, model)
            if other.id % 4 == 0:
                break
        if model.folk.contains(one.id):
            stir(one, human, model)
    drawn = model.folk.members_of("village", village).one_of(rng)
    if drawn is not None:
        human.mark = met(human.mark, drawn.id)
    human.mark = met(human.mark, first_even(village, model))
    marks = sum(o.mark for o in model.lords.members_of("village", village) if o.id != human.id)
    human.mark = met(human.mark, marks)
    human.mark = met(human.mark, sum(1 for o in model.folk.members_of("village", village)))


def stir(one, human, model):
    chance = (one.mark + human.id) % 13
    if chance == 0:
        one.die()
    elif chance == 1:
        one.mind.leave_group("village")
    elif chance == 2 and len(model.folk) < model.most:
        one.hatch(keep_groups=True)


def first_even(village, model):
    for one in model.folk.members_of("village", village):
        for other in model.lords.members_of("village", one.mind.get_group_id("village")):
            if (one.mark + other.mark) % 2 == 0:
                return one.id + other.id
    return -1


def rule(lord, model, rng):
    if lord.mind.get_group_id("village") < 0 and rng.random() < 0.5:
        lord.mind.create_and_join_group("village", "chief")
        model.last = lord.mind.get_group_id("village")
    elif rng.random() < 0.1:
        lord.mind.leave_group("village")


def people(model):
    while len(model.folk) < model.least:
        model.folk.create()


class Realm(Model):
    least: int = parameter(4, low=0)
    most: int = parameter(30, low=0)
    last: int = -1
    lords = Population(Human, 3, mind=LORDS, culture="realm")
    folk = Population(Human, 12, mind=FOLK, culture="realm")
    schedule = (once(people), each(lords, rule), each(folk, wander), each(lords, look),
                each(folk, look))  # fmt: skip


def facts(realm):
    found = []
    for table in (realm.lords, realm.folk):
        found += [table.id.tolist(), table.mark.tolist()]
        found += [one.mind.get_group_id("village") for one in table]
    return found


def naive(table, identity):
    """The members as a plain account says."""
    return [one for one in table if identity >= 0 and one.mind.get_group_id("village") == identity]


@pytest.mark.parametrize("seed", range(25))
def test_both_speeds_and_a_resumed_society_agree(seed):
    fast, slow = Realm(seed=seed), Realm(seed=seed, compiled=False)
    sizes = []
    for tick in range(16):
        fast.advance(1 if tick % 2 else 3)
        slow.advance(1 if tick % 2 else 3)
        assert facts(fast) == facts(slow)
        for identity in range(-1, slow.last + 2):
            for table in (slow.lords, slow.folk):
                found = table.members_of("village", identity)
                assert found == naive(table, identity)
                sizes.append(len(found))
        if tick % 5 == 0:
            # What is between ticks done by hand, compiled rules know.
            for one, other in zip(fast.folk, slow.folk, strict=True):
                if one.id % 3 == tick % 3:
                    one.mind.leave_all_groups()
                    other.mind.leave_all_groups()
        if tick == 8:
            fast = Realm(seed=seed)
            fast.restore(slow.state())
    assert max(sizes) > 2


def test_a_class_that_does_not_ask_has_no_lists():
    class Plain(Model):
        folk = Population(Human, 2, mind=FOLK)
        schedule = ()

    society = Plain(seed=1)
    assert not any("members_heads" in name for name in society.contexts.dtype.names)
    assert len(society.folk.members_of("village", 0)) == 0
    assert any("members_heads" in name for name in Realm(seed=1).contexts.dtype.names)


def test_lists_follow_against_sets():
    rng = np.random.default_rng(1)
    heads, entries = np.full(5, -1, np.int32), np.full((24, 3), -1, np.int32)
    held = {}
    for _ in range(2000):
        spot, row = int(rng.integers(24)), int(rng.integers(-1, 5))
        if entries[spot, lists.ROW] >= 0:
            lists.take_out(heads, entries, spot)
            del held[spot]
        if row >= 0:
            lists.put(heads, entries, spot, row)
            held[spot] = row
        for one in range(5):
            walked, at = [], heads[one]
            while at >= 0:
                walked.append(int(at))
                at = entries[at, lists.NEXT]
            assert sorted(walked) == [spot for spot, row in sorted(held.items()) if row == one]


def test_wrong_questions_are_refused_with_their_line():
    def misspelt(human, model):
        human.mark = len(model.folk.members_of("vilage", 0))

    def by_number(human, model):
        human.mark = len(model.folk.members_of(1, 0))

    def without_identity(human, model):
        human.mark = len(model.folk.members_of("village"))

    for rule, refusal in (
        (misspelt, r"test_members.py:\d+: the group 'vilage'"),
        (by_number, r"test_members.py:\d+: .*as the name of a group"),
        (without_identity, r"test_members.py:\d+: .*members_of\(\) like this"),
    ):

        class Wrong(Model):
            folk = Population(Human, 1, mind=FOLK)
            schedule = (each(folk, rule),)

        with pytest.raises(ModelError, match=refusal):
            Wrong(seed=1)

    class Mindless(Model):
        folk = Population(Human, 1)
        schedule = (each(folk, misspelt),)

    with pytest.raises(ModelError, match=r"members_of\(\) of .*, which has no minds"):
        Mindless(seed=1)
    with pytest.raises(MindError, match="no group 'vilage' in scheme 'folk'"):
        Realm(seed=1).folk.members_of("vilage", 0)
