"""Groups in groups: by hand, and against a plain account in Python."""

import random

import numpy as np
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
    Society,
)


def culturon(name, start, **influence):
    return Culturon(
        name, start, influence=influence, conditional=tuple(influence), reinforcement=influence
    )


PEOPLE = Group("people", (Role("tribe", (culturon("Pride", 1.5, sing=2),)), Role("king")))
CLAN = Group(
    "clan",
    (Role("member", (culturon("Law", 3, work=1, sing=0.5),)), Role("chief")),
    {"grain": 4},
    ("people", "tribe"),
)
FAMILY = Group("family", (Role("parent", (culturon("Love", 2, rest=1),)), Role("child")),
               within=("clan", "member"))  # fmt: skip
GUILD = Group("guild", (Role("master"),), within=("clan", "chief"))
FOLK = CognitiveScheme(
    "folk",
    (Cogniton("Hunger", start_value=0.5, influence={"work": 1}, conditional=("work",)),),
    (FAMILY, CLAN, GUILD, PEOPLE),
)
LORDS = CognitiveScheme(
    "lords",
    groups=(
        Group("court", (Role("lord"),)),
        Group("people", (Role("king", (culturon("Pride", 1.5, boast=3),)), Role("tribe"))),
        Group("clan", (Role("chief", (culturon("Law", 3, rule=4),)),), within=("people", "tribe")),
    ),
)


def test_a_family_is_under_its_clan_and_the_clan_under_its_people_by_hand():
    culture = Culture((LORDS, FOLK), seed=1)
    king, chief = (culture.breeds[0].new_mind() for _ in range(2))
    mother, child, master = (culture.breeds[1].new_mind() for _ in range(3))
    king.create_and_join_group("people", "king")
    chief.create_and_join_group("clan", "chief")
    people, clan = king.get_group_id("people"), chief.get_group_id("clan")
    mother.create_and_join_group("family", "parent")
    family = mother.get_group_id("family")
    child.join_group("family", "child", family)
    # Nobody lies in anything yet: love alone opens rest, hunger work.
    assert mother.plan_weights() == {"work": 0.5, "rest": 2.0}
    assert (mother.get_enclosing_group_id("family"), mother.get_group_id("clan")) == (-1, -1)
    assert mother.get_culturon_value("clan", "Law") == 0.0
    assert child.enclose_group("family", clan)
    assert not mother.enclose_group("family", clan)  # it lies there already
    assert mother.get_enclosing_group_id("family") == clan
    assert mother.get_group_id("clan") == -1  # herself she is in none
    # Of the Law's 3, work 1 and sing 0.5, times the participation in the family.
    assert mother.plan_weights() == {"work": 3.5, "sing": 1.5, "rest": 2.0}
    child.set_participation("family", 0.5)
    assert child.plan_weights() == {"work": 2.0, "sing": 0.75}
    assert chief.plan_weights() == {"rule": 12.0}
    # The clan enters the people: its chief and the families in it sing of Pride's 1.5.
    assert chief.enclose_group("clan", people)
    assert mother.plan_weights() == {"work": 3.5, "sing": 1.5 + 3.0, "rest": 2.0}
    assert child.plan_weights() == {"work": 2.0, "sing": 0.75 + 1.5}
    assert king.plan_weights() == {"boast": 4.5}
    # The receipt says what the weights say.
    told = {one.name: one for one in child.explain().influences}
    assert (told["Pride"].value, told["Pride"].participation, told["Pride"].acts) == (
        1.5,
        0.5,
        True,
    )
    plans = FOLK.plans
    assert dict(zip(plans, told["Law"].contributions, strict=True)) == {
        "work": 1.5, "rest": 0.0, "sing": 0.75,
    }  # fmt: skip
    # Members of the family reach what is around it, and feed back into it.
    mother.add_to_culturon_value("clan", "Law", 1.0)
    mother.add_to_group_attribute("clan", "grain", 2.0)
    assert chief.get_culturon_value("clan", "Law") == 4.0
    assert chief.get_group_attribute("clan", "grain") == 6.0
    mother.feed_back_from_plan("sing", 1.0)
    assert king.get_culturon_value("people", "Pride") == 3.5
    assert chief.get_culturon_value("clan", "Law") == 4.5
    # What she founds now lies in the clan too, by her family; the master is out of it all.
    assert mother.create_and_join_group("guild", "master")
    assert mother.get_enclosing_group_id("guild") == clan
    assert master.create_and_join_group("guild", "master")
    assert master.get_enclosing_group_id("guild") == -1
    # Herself in another clan, she is under that one alone.
    master.create_and_join_group("clan", "member")
    mother.join_group("clan", "member", master.get_group_id("clan"))
    assert mother.plan_weights() == {"work": 3.5, "sing": 1.5, "rest": 2.0}
    mother.leave_group("clan")
    # Without members of its own a clan lives while groups lie in it.
    chief.die()
    assert mother.get_culturon_value("clan", "Law") == 4.5
    mother.die()
    assert child.get_enclosing_group_id("family") == clan
    members = culture.breeds[0].minds.members
    assert members[king.society.minds.group_slot[king.slot, 1]] == 2
    child.release_group("family")
    assert child.plan_weights() == {"work": 0.5}
    with pytest.raises(MindError, match="no living group of the type around it has this id"):
        child.enclose_group("family", clan)
    assert members[king.society.minds.group_slot[king.slot, 1]] == 1


def test_the_last_of_the_innermost_ends_all_around():
    society = Society(FOLK, seed=1)
    one = society.new_mind()
    for group, role in (("people", "tribe"), ("clan", "member"), ("family", "parent")):
        one.create_and_join_group(group, role)
    for group in ("people", "clan"):
        one.leave_group(group)
    assert (society.minds.instance_id >= 0).sum() == 3
    assert one.plan_weights() == {"work": 3.5, "sing": 4.5, "rest": 2.0}
    one.die()
    assert not (society.minds.instance_id >= 0).any()
    assert (society.minds.within == -1).all()


def test_what_lies_in_what_is_state():
    society = Society(FOLK, seed=1)
    one = society.new_mind()
    one.create_and_join_group("clan", "member")
    one.create_and_join_group("family", "parent")
    state = society.state()
    one.release_group("family")
    society.reserve(100)
    society.restore(state)
    assert one.get_enclosing_group_id("family") == 0
    for odd in (99, 1):
        with pytest.raises(CogLogoError, match="within in the state"):
            society.restore({**state, "within": np.full_like(state["within"], odd)})
    with pytest.raises(CogLogoError, match="the state of a society lacks within"):
        society.restore({name: array for name, array in state.items() if name != "within"})
    plain = Society(CognitiveScheme("plain", groups=(Group("pair", (Role("one"),)),)), seed=1)
    assert "within" not in plain.state()
    assert plain.minds.within.size == plain.arrays.group_within.size == 0
    lone = plain.new_mind()
    lone.create_and_join_group("pair", "one")
    lone.release_group("pair")
    assert lone.get_enclosing_group_id("pair") == -1
    with pytest.raises(MindError, match="groups of this type lie in no others"):
        lone.enclose_group("pair", 0)


def test_wrong_nesting_is_refused():
    for group, refusal in (
        (Group("a", (), (), ("b", "c")), "group 'a' within 'b'; expected a group of: a"),
        (Group("a", (Role("d"),), (), ("a", "c")), "within the role 'c' of 'a'; expected a role"),
        (Group("a", (Role("d"),), (), ("a", "d")), "groups within each other: a in a"),
    ):
        with pytest.raises(SchemeError, match=refusal):
            CognitiveScheme("odd", groups=(group,))
    with pytest.raises(SchemeError, match="write within="):
        Group("a", within=("clan",))
    one = CognitiveScheme("one", groups=(Group("clan", (Role("x"),)), Group("family", (Role("y"),),
                                         within=("clan", "x"))))  # fmt: skip
    two = CognitiveScheme("two", groups=(Group("family", (Role("y"),)), Group("clan", (Role("x"),),
                                         within=("family", "y"))))  # fmt: skip
    with pytest.raises(SchemeError, match="groups within each other: clan in family in clan"):
        Culture((one, two), seed=1)
    three = CognitiveScheme("three", groups=(Group("clan", (Role("z"),)), Group("family",
                                             within=("clan", "z"))))  # fmt: skip
    with pytest.raises(SchemeError, match="within clan as z in scheme 'three'"):
        Culture((one, three), seed=1)


def test_files_of_schemes_with_nested_groups(tmp_path):
    FOLK.save(tmp_path / "folk.yaml")
    assert CognitiveScheme.load(tmp_path / "folk.yaml") == FOLK
    text = (tmp_path / "folk.yaml").read_text()
    assert text.endswith(
        "nested_groups:\n  family: {clan: member}\n  clan: {people: tribe}\n"
        "  guild: {clan: chief}\n"
    )
    with pytest.raises(SchemeError, match=r"group 'family' within 'clan'; expected none: a Cog"):
        CognitiveScheme("f", groups=(FAMILY, Group("clan", CLAN.roles))).save(
            tmp_path / "f.cogscheme"
        )
    for odd, refusal in (
        ("{d: {b: c}}", r"odd.yaml:4: found a nested group 'd'"),
        ("{b: {d: c}}", r"odd.yaml:4: found group 'b' within 'd'"),
        ("{b: {}}", r"odd.yaml:4: found 0 groups around 'b'"),
        ("{b: {b: c}}", r"groups within each other: b in b"),
    ):
        (tmp_path / "odd.yaml").write_text(
            f"name: a\ngroups:\n  b: {{c: {{}}}}\nnested_groups: {odd}\n"
        )
        with pytest.raises(SchemeError, match=refusal):
            CognitiveScheme.load(tmp_path / "odd.yaml")


# Against a plain account -------------------------------------------------------------------------

ORDER = ("court", "people", "clan", "family", "guild")
"""The types as the culture orders them: lords first."""
AROUND = {"family": ("clan", "member"), "guild": ("clan", "chief"), "clan": ("people", "tribe")}
ROLES = {"court": ["lord"], "people": ["king", "tribe"], "clan": ["chief", "member"],
         "family": ["parent", "child"], "guild": ["master"]}  # fmt: skip
LINKS = {
    ("folk", "people", "tribe"): ("Pride", {"sing": 2}),
    ("folk", "clan", "member"): ("Law", {"work": 1, "sing": 0.5}),
    ("folk", "family", "parent"): ("Love", {"rest": 1}),
    ("lords", "people", "king"): ("Pride", {"boast": 3}),
    ("lords", "clan", "chief"): ("Law", {"rule": 4}),
}
STARTS = {"people": ("Pride", 1.5), "clan": ("Law", 3.0), "family": ("Love", 2.0)}


class Account:
    """Each instance is [type, value of its culturon, the instance around it]."""

    def __init__(self):
        self.alive, self.born = {}, 0
        self.member = {}  # mind, type -> [instance, role, participation]
        self.asks = {}  # mind, type -> instance, role

    def found(self, mind, kind, role):
        if (mind, kind) in self.member:
            return False
        around = self.stands(mind, AROUND[kind][0])[0] if kind in AROUND else None
        self.alive[self.born] = [kind, STARTS.get(kind, (None, 0.0))[1], around]
        self.enter(mind, kind, role, self.born)
        self.born += 1
        return True

    def enter(self, mind, kind, role, one):
        self.member[mind, kind] = [one, role, 1.0]
        self.asks.pop((mind, kind), None)

    def stands(self, mind, kind):
        """The instance, the role and the participation of a mind in a type, itself or by parts."""
        if (mind, kind) in self.member:
            return tuple(self.member[mind, kind])
        for own in ORDER:
            if (mind, own) in self.member:
                one, _, share = self.member[mind, own]
                at, role = own, None
                while one is not None and at != kind:
                    one = self.alive[one][2]
                    at, role = AROUND.get(at, (None, None))
                    if at != kind and (mind, at) in self.member:
                        one = None
                if one is not None:
                    return one, role, share
        return None, None, 0.0

    def bury(self):
        """End what has neither members nor parts, until nothing else ends."""
        while True:
            held = {place[0] for place in self.member.values()}
            held |= {one[2] for one in self.alive.values()}
            gone = [one for one in self.alive if one not in held]
            if not gone:
                return
            for one in gone:
                del self.alive[one]
            self.asks = {key: ask for key, ask in self.asks.items() if ask[0] in self.alive}

    def leave(self, mind, kind):
        self.member.pop((mind, kind), None)
        self.bury()

    def size(self, one):
        inside = sum(place[0] == one for place in self.member.values())
        return inside + sum(other[2] == one for other in self.alive.values())

    def weights(self, mind):
        found, scheme = {}, mind.society.scheme.name
        if scheme == "folk":
            found["work"] = 0.5
        for kind in ORDER:
            one, role, share = self.stands(mind, kind)
            if one is not None and (scheme, kind, role) in LINKS:
                for plan, weight in LINKS[scheme, kind, role][1].items():
                    found[plan] = found.get(plan, 0.0) + weight * share * self.alive[one][1]
        return found


def check(culture, minds, account):
    arrays = culture.breeds[0].minds
    living = zip(arrays.instance_id.tolist(), arrays.members.tolist(), strict=True)
    found = {one: size for one, size in living if one >= 0}
    assert found == {one: account.size(one) for one in account.alive}
    for mind in minds:
        assert mind.plan_weights() == pytest.approx(account.weights(mind))
        for kind in ORDER:
            one, role, share = account.member.get((mind, kind), (-1, None, 0.0))
            assert (mind.get_group_id(kind), mind.get_participation(kind)) == (one, share)
            assert role is None or mind.get_group_role_id(kind, role) == one
            assert mind.get_asked_group_id(kind) == account.asks.get((mind, kind), (-1,))[0]
            around = account.alive[one][2] if one >= 0 else None
            assert mind.get_enclosing_group_id(kind) == (-1 if around is None else around)
            if kind in STARTS:
                at = account.stands(mind, kind)[0]
                expected = 0.0 if at is None else account.alive[at][1]
                assert mind.get_culturon_value(kind, STARTS[kind][0]) == expected


def act(culture, minds, account, luck):
    what = luck.choice(("born", "found", "found", "found", "join", "join", "leave", "die", "ask",
                        "ask", "grant", "grant", "refuse", "expel", "enclose", "enclose",
                        "release", "move", "share", "hatch"))  # fmt: skip
    kind = luck.choice(ORDER)
    role = luck.choice(ROLES[kind])
    if what == "born" or not minds:
        minds.append(luck.choice(culture.breeds).new_mind())
        return
    mind, other = luck.choice(minds), luck.choice(minds)
    mine, its = account.member.get((mind, kind)), account.member.get((other, kind))
    alive = [one for one, (of, *_) in account.alive.items() if of == kind]
    if what == "found":
        assert mind.create_and_join_group(kind, role) == account.found(mind, kind, role)
    elif what == "join" and alive:
        one = luck.choice(alive)
        assert mind.join_group(kind, role, one) == (mine is None)
        if mine is None:
            account.enter(mind, kind, role, one)
    elif what == "leave":
        mind.leave_group(kind)
        account.leave(mind, kind)
    elif what == "die":
        mind.die()
        minds.remove(mind)
        for one in ORDER:
            account.asks.pop((mind, one), None)
            account.leave(mind, one)
    elif what == "ask":
        one = luck.randrange(-1, account.born + 1)
        may = mine is None and one in alive
        assert mind.ask_to_join(kind, role, one) == may
        if may:
            account.asks[mind, kind] = one, role
    elif what in ("grant", "refuse"):
        ask = account.asks.get((other, kind))
        may = mine is not None and ask is not None and ask[0] == mine[0]
        command = mind.grant_entry if what == "grant" else mind.refuse_entry
        assert command(kind, other) == may
        if may and what == "grant":
            account.enter(other, kind, ask[1], ask[0])
        elif may:
            del account.asks[other, kind]
    elif what == "expel":
        may = mine is not None and its is not None and mine[0] == its[0]
        assert mind.expel(kind, other) == may
        if may:
            account.leave(other, kind)
    elif what == "enclose" and kind in AROUND:
        of = AROUND[kind][0]
        choice = [one for one, held in account.alive.items() if held[0] == of]
        if choice:
            one = luck.choice(choice)
            may = mine is not None and account.alive[mine[0]][2] is None
            assert mind.enclose_group(kind, one) == may
            if may:
                account.alive[mine[0]][2] = one
    elif what == "release":
        mind.release_group(kind)
        if mine is not None:
            account.alive[mine[0]][2] = None
            account.bury()
    elif what == "move" and kind in STARTS:
        mind.add_to_culturon_value(kind, STARTS[kind][0], 0.5)
        at = account.stands(mind, kind)[0]
        if at is not None:
            account.alive[at][1] += 0.5
    elif what == "share":
        mind.set_participation(kind, 0.25)
        if mine is not None:
            mine[2] = 0.25
    elif what == "hatch":
        child = mind.hatch(keep_groups=True)
        minds.append(child)
        for one in ORDER:
            if (mind, one) in account.member:
                account.member[child, one] = list(account.member[mind, one])


@pytest.mark.parametrize("part", range(10))
def test_random_sequences_against_a_plain_account(part):
    deep = 0
    for seed in range(100 * part, 100 * part + 100):
        luck = random.Random(seed)
        culture, account, minds = Culture((LORDS, FOLK), seed=seed), Account(), []
        for step in range(60):
            act(culture, minds, account, luck)
            if step % 10 == 9:
                check(culture, minds, account)
            if step == 35:
                culture.breeds[0].restore(culture.breeds[1].state())
        deep += sum(held[2] is not None for held in account.alive.values())
    assert deep > 20
