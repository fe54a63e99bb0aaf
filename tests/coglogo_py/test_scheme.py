"""Schemes as descriptions: what they settle, what they refuse, how they compare."""

import copy
import math
import pickle
from dataclasses import FrozenInstanceError, replace

import numpy as np
import pytest

from coglogo_py import (
    BiasedWeightedStochastic,
    CognitiveScheme,
    Cogniton,
    Culturon,
    Group,
    Role,
    SchemeError,
)


def herd():
    """A scheme in which every kind of link names plans, in an order worked out by hand."""
    hunger = Cogniton("hunger", influence={"eat": 1}, conditional=["eat", "beg"])
    fear = Cogniton("fear", influence={"flee": 2}, reinforcement={"eat": -1, "hide": 1})
    lead = Culturon("lead", 1, influence={"guide": 1}, conditional=("guide",))
    trust = Culturon("trust", conditional=("follow",), reinforcement={"guide": 1, "rest": 1})
    group = Group("herd", (Role("leader", (lead,)), Role("follower", (trust, lead))))
    return CognitiveScheme("cows", (hunger, fear), (group,))


def test_plans_come_in_the_order_of_first_appearance():
    assert herd().plans == ("eat", "beg", "flee", "hide", "guide", "follow", "rest")


def test_plan_positions_do_not_count_for_the_order():
    assert replace(herd(), plan_positions={"rest": (0, 0)}).plans == herd().plans


def test_an_order_written_out_overrides_and_the_unnamed_follow():
    scheme = replace(herd(), plan_order=("rest", "eat", "sing"))
    assert scheme.plans == ("rest", "eat", "sing", "beg", "flee", "hide", "guide", "follow")


def test_numbers_and_sequences_are_settled():
    cogniton = Cogniton(
        "a", True, np.int64(3), [1, 2, 3], [4, 5], {"p": 1}, ["p", "q", "p"], {"q": np.float32(2)}
    )
    assert cogniton == Cogniton(
        "a", True, 3.0, (1, 2, 3), (4, 5), {"p": 1.0}, ("p", "q"), {"q": 2.0}
    )
    assert type(cogniton.start_value) is float
    assert type(cogniton.influence["p"]) is float


def test_descriptions_cannot_be_changed():
    links = {"p": 1.0}
    cogniton = Cogniton("a", influence=links)
    links["p"] = 5.0
    assert cogniton.influence["p"] == 1.0
    with pytest.raises(TypeError):
        cogniton.influence["p"] = 2.0
    with pytest.raises(FrozenInstanceError):
        cogniton.start_value = 1.0


def test_a_culturon_of_several_roles_is_one():
    first = Culturon("k", 1.0, (1, 1, 1), (3, 4), {"p": 1.0}, ("p",), {"p": 0.5})
    second = Culturon("k", 5.0, (2, 2, 2), None, {"p": 3.0, "q": 2.0}, ("q", "p"), {})
    group = Group("g", (Role("r1", (first,)), Role("r2", (Culturon("other"), second))))
    one = group.roles[0].culturons[0]
    assert one == group.roles[1].culturons[1]
    assert one == Culturon(
        "k", 5.0, (2, 2, 2), (3, 4), {"p": 3.0, "q": 2.0}, ("p", "q"), {"p": 0.5}
    )


def test_culturons_of_different_groups_are_apart():
    groups = [
        Group(name, (Role("r", (Culturon("k", value),)),)) for name, value in [("g", 1), ("h", 2)]
    ]
    scheme = CognitiveScheme("s", groups=groups)
    assert [g.roles[0].culturons[0].start_value for g in scheme.groups] == [1.0, 2.0]


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: Cogniton(3), "3 as the name of a cogniton; expected text"),
        (lambda: Cogniton("\ud800"), "as the name of a cogniton; expected text"),
        (lambda: Cogniton("a", starting=1), "starting 1 of cogniton 'a'; expected True or False"),
        (lambda: Cogniton("a", start_value=math.nan), "nan as start_value of cogniton 'a'"),
        (lambda: Cogniton("a", start_value="2"), "'2' as start_value of cogniton 'a'"),
        (lambda: Cogniton("a", start_value=10**400), "expected a finite number"),
        (lambda: Cogniton("a", start_value=True), "True as start_value of cogniton 'a'"),
        (lambda: Cogniton("a", colour=(0, 0, 256)), "as the colour of cogniton 'a'"),
        (lambda: Cogniton("a", colour="red"), "'red' as the colour of cogniton 'a'"),
        (lambda: Cogniton("a", position=(1.5, 2)), "as the position of cogniton 'a'"),
        (lambda: Cogniton("a", influence={"p": math.inf}), "inf as influence links of cogniton"),
        (lambda: Cogniton("a", influence=["p"]), "expected plan → weight"),
        (lambda: Cogniton("a", conditional="eat"), "'eat' as conditional links of cogniton 'a'"),
        (lambda: Culturon("k", reinforcement={1: 2.0}), "1 as the name of a plan"),
        (lambda: Role("r", (Culturon("k"), Culturon("k"))), "two culturons called 'k'"),
        (lambda: Role("r", (Cogniton("k"),)), "expected a Culturon"),
        (lambda: Group("g", (Role("r"), Role("r"))), "group 'g' has two roles called 'r'"),
        (lambda: Group("g", Role("r")), "expected several roles"),
        (lambda: CognitiveScheme("s", (Cogniton("a"), Cogniton("a"))), "two cognitons called 'a'"),
        (lambda: CognitiveScheme("s", groups=(Group("g"), Group("g"))), "two groups called 'g'"),
        (lambda: CognitiveScheme("s", decision_maker="MaximumWeight"), "a decision maker such as"),
        (lambda: CognitiveScheme("s", breeds="cows"), "'cows' as breeds of scheme 's'"),
        (lambda: CognitiveScheme("s", plan_order=("p", "p")), "expected each plan once"),
        (lambda: CognitiveScheme("s", plan_positions={"p": (1,)}), "as the position of plan 'p'"),
        (lambda: CognitiveScheme("s", plan_positions={"p": (2**31, 0)}), "of 32 bits"),
    ],
)  # fmt: skip
def test_what_is_wrong_is_refused_by_name(make, message):
    with pytest.raises(SchemeError) as failure:
        make()
    assert message in str(failure.value)


def test_schemes_compare_by_description_and_order_of_plans():
    assert herd() == herd()
    assert hash(herd()) == hash(herd())
    assert herd() == replace(herd(), plan_order=herd().plans)
    assert herd() == replace(herd(), repeated=("cogniton 'a'",))
    assert herd() != replace(herd(), plan_order=tuple(reversed(herd().plans)))
    assert herd() != replace(herd(), decision_maker=BiasedWeightedStochastic(2))
    assert herd() != replace(herd(), breeds=("bulls",))
    assert herd() != "cows"


def test_schemes_pass_to_other_processes():
    scheme = replace(herd(), plan_order=("rest",), repeated=("cogniton 'a'",))
    assert pickle.loads(pickle.dumps(scheme)) == scheme
    assert pickle.loads(pickle.dumps(scheme)).repeated == scheme.repeated
    assert copy.deepcopy(scheme).groups == scheme.groups
    error = SchemeError("a", "b", "c", "d.yaml", 4)
    assert str(pickle.loads(pickle.dumps(error))) == "d.yaml:4: found a; expected b; c"


def test_loading_says_why_a_file_cannot_be_read(tmp_path):
    with pytest.raises(SchemeError, match=r"cows\.yaml: the file cannot be read \(No such file"):
        CognitiveScheme.load(tmp_path / "cows.yaml")
    with pytest.raises(SchemeError, match="cannot be read"):
        CognitiveScheme.load(tmp_path)


def test_saving_needs_a_suffix_that_says_the_form(tmp_path):
    with pytest.raises(SchemeError, match=r"'\.txt'; expected \.cogscheme, \.yaml or \.yml"):
        herd().save(tmp_path / "cows.txt")
    with pytest.raises(SchemeError, match="the file cannot be written"):
        herd().save(tmp_path / "nowhere" / "cows.yaml")


@pytest.mark.parametrize("name", ["cows.yaml", "cows.YML", "cows.cogscheme", "Cows.CogScheme"])
def test_the_suffix_names_the_form(tmp_path, name):
    herd().save(tmp_path / name)
    assert CognitiveScheme.load(tmp_path / name) == herd()
    first = (tmp_path / name).read_text().splitlines()[0]
    assert (first == "STARTCS") is ("scheme" in name.lower())


def test_a_scheme_that_cannot_be_saved_leaves_the_file_alone(tmp_path):
    path = tmp_path / "cows.cogscheme"
    herd().save(path)
    with pytest.raises(SchemeError):
        replace(herd(), name="two\nlines").save(path)
    assert CognitiveScheme.load(path) == herd()
