"""Groups that breeds with different schemes form: against a plain account in Python."""

import random

import pytest

from coglogo_py import (
    CogLogoError,
    CognitiveScheme,
    Cogniton,
    Culture,
    Culturon,
    Group,
    MindError,
    Role,
    SchemeError,
)


def culturon(name, start, **influence):
    return Culturon(name, start, influence=influence, conditional=tuple(influence))


COWS = CognitiveScheme(
    "cows",
    (Cogniton("Hunger", start_value=1.5, influence={"eat": 2}, conditional=("eat",)),),
    (
        Group("herd", (Role("leader", (culturon("Trust", 3, lead=2),)), Role("follower"))),
        Group("pair", (Role("one", (culturon("Love", 1, eat=0.5),)),)),
    ),
)
BULLS = CognitiveScheme(
    "bulls",
    (),
    (
        Group("field", (Role("owner", (culturon("Pride", 2, stand=1),)),)),
        Group("herd", (Role("guard", (culturon("Trust", 3, stand=4),)), Role("leader"))),
    ),
)
DOGS = CognitiveScheme("dogs", tuple(Cogniton(name, starting=False) for name in "abc"))
SCHEMES = (COWS, BULLS, DOGS)
ROLES = {"herd": ("leader", "follower", "guard"), "pair": ("one",), "field": ("owner",)}
STARTS = {"herd": {"Trust": 3.0}, "pair": {"Love": 1.0}, "field": {"Pride": 2.0}}


class Account:
    """Who is in what, in dictionaries."""

    def __init__(self):
        self.place = {}  # mind -> group -> [instance, role, participation]
        self.groups = {}  # instance -> (group, culturons)
        self.next = 0

    def members(self, instance):
        return sum(
            held[0] == instance for places in self.place.values() for held in places.values()
        )

    def create(self, mind, group, role):
        if group in self.place[mind]:
            return False
        self.groups[self.next] = group, dict(STARTS[group])
        self.place[mind][group] = [self.next, role, 1.0]
        self.next += 1
        return True

    def join(self, mind, group, role, instance):
        if group in self.place[mind]:
            return False
        self.place[mind][group] = [instance, role, 1.0]
        return True

    def leave(self, mind, group):
        held = self.place[mind].pop(group, None)
        if held is not None and not self.members(held[0]):
            del self.groups[held[0]]

    def die(self, mind):
        for group in list(self.place[mind]):
            self.leave(mind, group)
        del self.place[mind]

    def weights(self, mind, scheme):
        own = mind.cognitons()
        found = {}
        for plan in scheme.plans:
            weight, opened = 0.0, False
            for one in scheme.cognitons:
                if own[one.name] is not None:
                    weight += one.influence.get(plan, 0.0) * own[one.name]
                    opened |= plan in one.conditional
            for group in ("herd", "pair", "field"):
                described = [one for one in scheme.groups if one.name == group]
                if described and group in self.place[mind]:
                    instance, role, share = self.place[mind][group]
                    for one in described[0].roles:
                        for held in one.culturons if one.name == role else ():
                            value = self.groups[instance][1][held.name]
                            weight += held.influence.get(plan, 0.0) * share * value
                            opened |= plan in held.conditional
            if opened:
                found[plan] = weight
        return found


def check(culture, minds, account):
    for breed in culture.breeds:
        assert list(breed) == [mind for mind in minds if mind.society is breed]
    for mind in minds:
        for group in ROLES:
            held = account.place[mind].get(group, [-1, None, 0.0])
            assert mind.get_group_id(group) == held[0]
            assert mind.get_participation(group) == held[2]
            for role in ROLES[group]:
                expected = held[0] if held[1] == role else -1
                assert mind.get_group_role_id(group, role) == expected
            for name in STARTS[group]:
                value = account.groups[held[0]][1][name] if held[0] >= 0 else 0.0
                assert mind.get_culturon_value(group, name) == value
        assert mind.plan_weights() == pytest.approx(account.weights(mind, mind.society.scheme))
    arrays = culture.breeds[0].minds
    living = {
        int(i): int(n) for i, n in zip(arrays.instance_id, arrays.members, strict=True) if i >= 0
    }
    assert living == {one: account.members(one) for one in account.groups}


def act(culture, minds, account, luck):
    what = luck.choice(("born", "create", "create", "join", "join", "join", "leave", "die", "hatch",
                        "share", "move", "move"))  # fmt: skip
    group = luck.choice(tuple(ROLES))
    role = luck.choice(ROLES[group])
    if what == "born" or not minds:
        mind = luck.choice(culture.breeds).new_mind()
        account.place[mind] = {}
        minds.append(mind)
        return
    mind = luck.choice(minds)
    held = account.place[mind].get(group)
    alive = [one for one, (kind, _) in account.groups.items() if kind == group]
    if what == "create":
        assert mind.create_and_join_group(group, role) == account.create(mind, group, role)
    elif what == "join" and alive:
        one = luck.choice(alive)
        assert mind.join_group(group, role, one) == account.join(mind, group, role, one)
    elif what == "leave":
        mind.leave_group(group)
        account.leave(mind, group)
    elif what == "die":
        mind.die()
        account.die(mind)
        minds.remove(mind)
    elif what == "hatch":
        keep = luck.random() < 0.5
        child = mind.hatch(keep_groups=keep)
        account.place[child] = {
            name: list(one) for name, one in account.place[mind].items() if keep
        }
        minds.append(child)
    elif what == "share":
        mind.set_participation(group, 0.25)
        if held:
            held[2] = 0.25
    elif what == "move":
        name = luck.choice(tuple(STARTS[group]))
        mind.add_to_culturon_value(group, name, 0.5)
        if held:
            account.groups[held[0]][1][name] += 0.5


@pytest.mark.parametrize("part", range(10))
def test_random_sequences_against_a_plain_account(part):
    for seed in range(100 * part, 100 * part + 100):
        luck = random.Random(seed)
        culture, account, minds = Culture(SCHEMES, seed=seed), Account(), []
        for step in range(40):
            act(culture, minds, account, luck)
            if step % 10 == 9:
                check(culture, minds, account)
            if step == 20:
                culture.breeds[luck.randrange(3)].restore(culture.breeds[luck.randrange(3)].state())


def test_a_mind_of_another_breed_is_not_this_breeds():
    culture = Culture(SCHEMES, seed=1)
    cow, bull = culture.breeds[0].new_mind(), culture.breeds[1].new_mind()
    assert [len(breed) for breed in culture.breeds] == [1, 1, 0]
    with pytest.raises(CogLogoError, match="slot 1 of the society is of another breed"):
        culture.breeds[0].mind_in(bull.slot)
    with pytest.raises(MindError, match="no cogniton 'Hunger' in scheme 'bulls'"):
        bull.get_cogniton_value("Hunger")
    culture.breeds[2].reset()
    assert not cow.alive
    assert [len(breed) for breed in culture.breeds] == [0, 0, 0]


def test_decisions_draw_apart_whatever_the_breed():
    culture = Culture(SCHEMES, seed=1)
    minds = [culture.breeds[number % 2].new_mind() for number in range(40)]
    culture.breeds[2].reserve(500)
    assert [mind.id for mind in minds] == list(range(40))
    assert [mind.cognitons() for mind in minds[:2]] == [{"Hunger": 1.5}, {}]


def test_wrong_cultures_are_refused():
    with pytest.raises(CogLogoError, match="a culture needs a CognitiveScheme of each breed"):
        Culture(("cows.yaml",), seed=1)
    with pytest.raises(CogLogoError, match="a culture without breeds"):
        Culture((), seed=1)
    other = CognitiveScheme("sheep", groups=(Group("herd", (Role("a", (Culturon("Trust", 1),)),)),))
    with pytest.raises(SchemeError, match=r"'Trust' of group 'herd' starts at 1 in scheme 'sheep'"):
        Culture((COWS, other), seed=1)


VILLAGE = Group("village", (Role("member"),), {"treasury": 10, "size of land": 2.5})


def test_attributes_are_numbers_that_members_share_by_hand():
    lords = CognitiveScheme("lords", groups=(Group("village", (Role("chief"),), {"grain": 1}),))
    folk = CognitiveScheme("folk", (Cogniton("a"),), (VILLAGE,))
    culture = Culture((lords, folk, COWS), seed=1)
    lord, peasant, stranger = (breed.new_mind() for breed in culture.breeds)
    lord.create_and_join_group("village", "chief")
    assert peasant.get_group_attribute("village", "treasury") == 0.0
    peasant.add_to_group_attribute("village", "treasury", 3)
    peasant.join_group("village", "member", 0)
    peasant.add_to_group_attribute("village", "treasury", 3)
    peasant.set_group_attribute("village", "grain", 7)
    assert lord.get_group_attribute("village", "treasury") == 13.0
    assert lord.get_group_attribute("village", "grain") == 7.0
    assert stranger.get_culturon_value("herd", "Trust") == 0.0
    for mind in (lord, peasant):
        mind.die()
    stranger.create_and_join_group("village", "chief")
    assert stranger.get_group_attribute("village", "treasury") == 10.0
    with pytest.raises(MindError, match="no attribute 'gold' in group 'village'; there are: "):
        stranger.set_group_attribute("village", "gold", 1)
    with pytest.raises(MindError, match="set_group_attribute of 'grain'"):
        stranger.set_group_attribute("village", "grain", float("nan"))


def test_files_of_schemes_with_attributes(tmp_path):
    scheme = CognitiveScheme("folk", groups=(VILLAGE, Group("pair", (Role("one"),))))
    scheme.save(tmp_path / "folk.yaml")
    assert CognitiveScheme.load(tmp_path / "folk.yaml") == scheme
    with pytest.raises(SchemeError, match="'village'; expected none: a Cog"):
        scheme.save(tmp_path / "folk.cogscheme")
    (tmp_path / "odd.yaml").write_text(
        "name: a\ngroups:\n  b: {c: {}}\ngroup_attributes: {d: {e: 1}}\n"
    )
    with pytest.raises(SchemeError, match=r"odd.yaml:4: found attributes of a group 'd'"):
        CognitiveScheme.load(tmp_path / "odd.yaml")
    with pytest.raises(SchemeError, match="attributes of group 'b'"):
        Group("b", (), 3)
    with pytest.raises(SchemeError, match="'e' among the attributes of group 'b'"):
        Group("b", (), {"e": "much"})
