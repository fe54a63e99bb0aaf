"""What the linter finds, by hand and by brute force, and what it leaves alone."""

from dataclasses import replace

import numpy as np
import pytest

from coglogo_py import (
    BiasedWeightedStochastic,
    CognitiveScheme,
    Cogniton,
    Culturon,
    Group,
    MaximumWeight,
    Role,
    WeightedStochastic,
)
from coglogo_py.files.cogscheme_file import parse


def scheme(*cognitons, maker=WeightedStochastic(), **fields):  # noqa: B008
    return CognitiveScheme("s", cognitons, decision_maker=maker, **fields)


def found(scheme, plans=None):
    return [(finding.kind, finding.where) for finding in scheme.check(plans)]


def kinds(scheme, kind, plans=None):
    return [finding.where for finding in scheme.check(plans) if finding.kind == kind]


GOOD = Cogniton("hunger", influence={"eat": 1, "rest": -1}, conditional=("eat", "rest"))


def test_a_sound_scheme_has_no_findings():
    assert scheme(GOOD).check() == []
    assert scheme(GOOD).check(["eat", "rest"]) == []
    assert CognitiveScheme("empty").check() == []


def test_findings_print_as_one_line():
    (finding,) = scheme(GOOD, Cogniton("idle")).check()
    assert str(finding) == (
        "cogniton without effect: cogniton 'idle': it sways no plan that can be available"
    )


def test_plans_that_no_conditional_link_leads_to():
    lonely = Cogniton("a", influence={"dream": 2, "eat": 1}, reinforcement={"sing": 1})
    assert kinds(scheme(GOOD, lonely), "plan never available") == ["plan 'dream'", "plan 'sing'"]
    assert kinds(scheme(GOOD), "plan never available", ["eat", "rest", "fly"]) == ["plan 'fly'"]
    ordered = scheme(GOOD, plan_order=("rest", "eat", "fly"))
    assert kinds(ordered, "plan never available") == ["plan 'fly'"]
    by_culture = Group("g", (Role("r", (Culturon("k", conditional=("dream", "sing")),)),))
    assert kinds(scheme(GOOD, lonely, groups=(by_culture,)), "plan never available") == []


@pytest.mark.parametrize(
    ("links", "idle"),
    [
        ({"influence": {"eat": 0.0}}, True),
        ({"influence": {"dream": 1.0}}, True),  # a plan that is never available
        ({"reinforcement": {"eat": 1.0}}, True),
        ({"influence": {"eat": 0.1}}, False),
        ({"conditional": ("eat",)}, False),
    ],
)
def test_cognitons_and_culturons_without_effect(links, idle):
    kind = "cogniton without effect"
    assert kinds(scheme(GOOD, Cogniton("a", **links)), kind) == ["cogniton 'a'"] * idle
    group = Group("g", (Role("r", (Culturon("k", **links),)), Role("s", (Culturon("k"),))))
    where = ["culturon 'k' of group 'g'"] * idle
    assert kinds(scheme(GOOD, groups=(group,)), "culturon without effect") == where


def twins(eat, rest, order=None, maker=None):
    """Two plans that one cogniton makes available and pulls at."""
    base = Cogniton("base", influence={"eat": eat, "rest": rest}, conditional=("eat", "rest"))
    return scheme(base, plan_order=order, maker=maker or MaximumWeight())


def test_the_later_of_two_plans_with_the_same_links_always_loses():
    assert found(twins(2, 2)) == [("plan always loses", "plan 'rest'")]
    assert found(twins(2, 2, ("rest", "eat"))) == [("plan always loses", "plan 'eat'")]


@pytest.mark.parametrize(("eat", "rest", "loser"), [(2, 1, "rest"), (1, 2, "eat"), (1, -1, "rest")])
def test_a_plan_of_weaker_links_loses_at_values_above_0(eat, rest, loser):
    assert found(twins(eat, rest)) == [("plan loses at values above 0", f"plan {loser!r}")]


def test_a_plan_between_two_opposite_pulls_always_loses():
    mood = Cogniton("mood", influence={"sing": 2, "weep": -2}, conditional=("sing", "weep", "sit"))
    finding = scheme(mood, maker=MaximumWeight()).check()[-1]
    assert (finding.kind, finding.where) == ("plan always loses", "plan 'sit'")
    assert "'sing' or 'weep'" in finding.message


def test_a_plan_that_something_else_makes_available_too_may_win():
    alone = Cogniton("tired", influence={"rest": 1}, conditional=("rest",))
    assert found(scheme(*twins(2, 2).cognitons, alone, maker=MaximumWeight())) == []


@pytest.mark.parametrize("maker", [WeightedStochastic(), BiasedWeightedStochastic(3)])
def test_under_a_stochastic_maker_no_plan_always_loses(maker):
    assert found(twins(2, 2, maker=maker)) == []


def random_scheme(rng):
    names = [f"p{i}" for i in range(rng.integers(2, 5))]

    def links():
        pulled = {p: int(rng.integers(-1, 2)) for p in names if rng.random() < 0.7}
        return {"influence": pulled, "conditional": [p for p in names if rng.random() < 0.6]}

    cognitons = [Cogniton(f"c{i}", **links()) for i in range(rng.integers(1, 3))]
    roles = [Role(f"r{i}", (Culturon(f"k{i}", **links()),)) for i in range(rng.integers(0, 3))]
    return scheme(*cognitons, groups=(Group("g", roles),), maker=MaximumWeight())


def choice(scheme, rng, lowest):
    """Choose by equations 3.1 and 3.2 for values and a membership drawn at random.

    Returns the plan, or None, and what makes it available with its value times participation.
    """
    values = [(c, int(rng.integers(lowest, 4))) for c in scheme.cognitons if rng.random() < 0.7]
    roles = scheme.groups[0].roles
    if roles and rng.random() < 0.7:
        role = roles[rng.integers(len(roles))]
        participation = int(rng.integers(max(lowest, -1), 3))
        values += [(k, participation * int(rng.integers(lowest, 4))) for k in role.culturons]
    available = [p for p in scheme.plans if any(p in holder.conditional for holder, _ in values)]
    if not available:
        return None, []
    weights = [sum(v * holder.influence.get(p, 0.0) for holder, v in values) for p in available]
    plan = available[MaximumWeight.choose(np.array(weights, float), 1.0, 0.5)]
    return plan, [value for holder, value in values if plan in holder.conditional]


def test_what_is_said_to_lose_never_wins():
    rng = np.random.default_rng(1)
    losers = {"plan always loses": 0, "plan loses at values above 0": 0}
    for _ in range(150):
        example = random_scheme(rng)
        always = kinds(example, "plan always loses")
        above_0 = kinds(example, "plan loses at values above 0")
        losers["plan always loses"] += len(always)
        losers["plan loses at values above 0"] += len(above_0)
        for _ in range(100 if always else 0):
            plan, _ = choice(example, rng, lowest=-3)
            assert f"plan {plan!r}" not in always
        for _ in range(100 if above_0 else 0):
            plan, openers = choice(example, rng, lowest=0)
            assert f"plan {plan!r}" not in above_0 or not any(openers)
    assert min(losers.values()) > 20


def test_links_to_plans_that_are_not_written_out():
    typo = Cogniton("a", influence={"etat": 1, "eat": 1}, conditional=("eat",))
    kind = "link to unknown plan"
    assert kinds(scheme(GOOD, typo), kind) == []
    assert kinds(scheme(GOOD, typo), kind, ["eat", "rest"]) == ["cogniton 'a'"]
    assert kinds(scheme(GOOD, typo, plan_order=("eat", "rest")), kind) == ["cogniton 'a'"]
    positions = {"eat": (0, 0), "rest": (0, 1)}
    assert kinds(scheme(GOOD, typo, plan_positions=positions), kind) == ["cogniton 'a'"]
    ordered = scheme(GOOD, plan_order=("rest", "eat"), plan_positions={"eat": (0, 0)})
    assert ordered.check() == []
    messages = [f.message for f in scheme(GOOD, typo).check(["eat", "rest"]) if f.kind == kind]
    assert messages == [
        "its influence link leads to 'etat', which the model does not have; did you mean 'eat'?"
    ]
    lost = Culturon("k", conditional=("go",), reinforcement={"go": 1})
    group = Group("g", (Role("r", (lost,)),))
    assert (
        kinds(scheme(GOOD, groups=(group,)), kind, ["eat", "rest"])
        == ["culturon 'k' of group 'g'"] * 2
    )


def test_duplicate_names():
    text = "STARTCS\ns\nMaximumWeight\n" + "COG\na\n1\ntrue\nINFLUENCE\nDEPENDENCY\neat\n" * 2
    assert found(parse(text, "s.cogscheme", CognitiveScheme)) == [
        ("duplicate name", "cogniton 'a' (line 11)")
    ]
    group = Group("g", (Role("r", (Culturon("hunger", conditional=("eat",)),)),))
    assert found(scheme(GOOD, groups=(group,))) == [
        ("duplicate name", "culturon 'hunger' of group 'g'")
    ]


def test_a_culturon_may_be_a_cogniton_that_a_role_lends():
    links = {"influence": GOOD.influence, "conditional": GOOD.conditional}
    lent = Culturon(GOOD.name, 1, **links, reinforcement=GOOD.reinforcement)
    assert found(scheme(GOOD, groups=(Group("g", (Role("r", (lent,)),)),))) == []


def test_names_that_are_alike_or_odd():
    assert kinds(scheme(GOOD, replace(GOOD, name="Hunger ")), "names alike") == [
        "cogniton 'Hunger '"
    ]
    assert kinds(scheme(GOOD, breeds=("Cows", "cows")), "names alike") == ["breed 'cows'"]
    blank = Cogniton("a", conditional=("", " eat"), influence={"": 1, " eat": -1})
    assert kinds(scheme(blank), "odd name") == ["plan ''", "plan ' eat'"]
    assert kinds(CognitiveScheme(""), "odd name") == ["scheme ''"]


@pytest.mark.parametrize(
    "name",
    [
        "farmer_artisan",
        "farmers_artisans_traders",
        "herd_cows",
        "wolf_cow_cows",
        "wolf_cow_wolves",
    ],
)
def test_the_original_models_have_no_findings(shared_data, name):
    assert CognitiveScheme.load(shared_data(f"cogscheme/{name}.cogscheme")).check() == []


def test_types_and_conditions_that_are_hardly_meant():
    cognitons = (
        Cogniton("Light", conditional=("go",), reinforcement={"go": 1}, type="percept"),
        Cogniton("Tall", conditional=("go",), reinforcement={"go": 1, "eat": 0}, type="trait"),
        Cogniton("Seen", conditional=("go",), active_while="x > 0", type="percept"),
        Cogniton("Hunger", conditional=("go",), reinforcement={"go": 1}, type="need"),
        Cogniton("Late", conditional=("go",), activated_when="x > 0"),
        Cogniton("Later", starting=False, conditional=("go",), activated_when="x > 0"),
    )
    scheme = CognitiveScheme("cows", cognitons)
    kinds = ("not as its type", "condition without effect")

    def found(written):
        return [str(one) for one in scheme.check(written=written) if one.kind in kinds]

    assert found(None) == [
        "condition without effect: activated_when of cogniton 'Late': active at birth and made "
        "inactive by no condition; write at_birth: false",
        "not as its type: percept 'Light': feed-back from 'go' changes what is perceived; drop the "
        "link or the type",
        "not as its type: trait 'Tall': feed-back from 'go' changes what stays for life; drop the "
        "link or the type",
    ]
    assert found(["Light"]) == found(None)
    (more,) = set(found([])) - set(found(None))
    assert more.startswith("not as its type: percept 'Light': no rule and no condition sets it")
