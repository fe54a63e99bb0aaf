"""Who decides about roles: the learned mind, a scheme, or a simple rule, and several at once."""

from types import SimpleNamespace

import numpy as np
import pytest

from coglogo_py import CognitiveScheme
from coglogo_py.society import Society
from socialmind.catalogue import load_model
from socialmind.mind import MindDescription
from socialmind.sources.folders import model_folder
from socialmind.sources.loading import load_file

FOLDER = model_folder("foraging_roles")
DECIDING = load_file(FOLDER / "deciding.py")
ForagingRoles = load_model("foraging_roles")
FIXED, CHANCE, GREEDY = 1, 2, 3
FLIP = np.zeros(39)
FLIP[[16, 38]] = 1.0  # the influence on what the perceptron says, which is always B


def always_b():
    """The mind that ships, but every robot that thinks of its role takes to B."""
    mind = MindDescription.load(FOLDER / "mind")
    return mind.with_modules(skills=[mind.skill("ForageRole").changed(genome=FLIP)])


def decisions(model, ticks):
    """Yield what each robot was before it delivered, its payoff, and what it was afterwards."""
    for _ in range(ticks):
        before = dict(zip(model.robots.id.tolist(), model.robots.is_b.tolist(), strict=True))
        model.advance(1)
        for robot in model.robots:
            if robot.paid:
                yield robot.id, before[robot.id], robot.payoff, robot.is_b


# Who decides --------------------------------------------------------------------------------------


def test_by_default_the_learned_mind_decides_in_all_and_no_scheme_wakes():
    model = ForagingRoles(seed=3, start=0, hierarchy=always_b())
    model.advance(3000)
    robots = model.robots
    assert robots.changes.tolist() == robots.is_b.tolist() == [1] * 9
    assert not robots.programmed.any()
    assert model.plans(robots) == [None] * 9
    for one in model.schemes["robots"].cognitons:
        assert not np.isfinite(robots.cogniton(one.name)).any()


@pytest.mark.parametrize(
    ("share", "programmed"), [(0.0, 0), (0.05, 0), (0.06, 1), (0.33, 3), (0.67, 6), (1.0, 9)]
)
def test_the_first_robots_are_programmed(share, programmed):
    model = ForagingRoles(seed=1, programmed=share)
    assert model.robots.programmed.tolist() == [True] * programmed + [False] * (9 - programmed)


def test_robots_that_are_added_keep_the_share():
    model = ForagingRoles(seed=1, programmed=0.33, add_at=3)
    model.advance(5)
    assert model.robots.programmed.tolist() == [True] * 3 + [False] * 6 + [False, True, False]


def test_a_programmed_robot_has_the_calling_of_its_role():
    model = ForagingRoles(seed=3, programmed=1.0, start=3)
    robots = model.robots
    assert 0 < robots.is_b.sum() < 9
    a, b = robots.cogniton("CallingA"), robots.cogniton("CallingB")
    assert (np.isfinite(b) == robots.is_b).all()
    assert (np.isfinite(a) != robots.is_b).all()
    assert model.plans(robots) == ["CollectB" if one else "CollectA" for one in robots.is_b]


def test_where_the_scheme_decides_the_learned_mind_does_not():
    mixed = ForagingRoles(seed=3, programmed=0.5, start=0, hierarchy=always_b(), tolerance=50.0)
    mixed.advance(4000)
    robots = mixed.robots
    assert robots.delivered_a.min() > 0
    assert (robots.is_b != robots.programmed).all()


# The scheme ---------------------------------------------------------------------------------------


def weights(calling, plenty=None):
    """The plans' weights of a robot that fetches A."""
    mind = Society(CognitiveScheme.load(FOLDER / "scheme.yaml"), seed=1).new_mind()
    mind.activate_cogniton("CallingA")
    mind.set_cogniton_value("CallingA", calling)
    if plenty is not None:
        mind.activate_cogniton("PlentyOfA")
        mind.set_cogniton_value("PlentyOfA", plenty)
    return mind.plan_weights()


def test_a_robot_thinks_of_another_role_where_there_is_plenty_alone():
    assert weights(50.0) == {"CollectA": 200.0}
    assert weights(50.0, 15.0) == {"CollectA": 200.0, "CollectB": 15.0}


def test_a_calling_is_an_average_of_what_deliveries_were_worth():
    model = ForagingRoles(seed=3, compiled=False, programmed=1.0, start=1, foragers=2)
    robot = model.robots[0]
    robot.payoff = 0.9
    DECIDING.reinforce(robot, "CollectB", "CallingB")
    assert robot.mind.get_cogniton_value("CallingB") == pytest.approx(0.8 * 25 + 0.2 * 90)
    for payoff, bound in ((3.0, 100.0), (-1.0, 0.0)):
        robot.payoff = payoff
        for _ in range(99):
            DECIDING.reinforce(robot, "CollectB", "CallingB")
        assert robot.mind.get_cogniton_value("CallingB") == pytest.approx(bound, abs=1e-6)


@pytest.mark.parametrize(("payoff", "plenty"), [(0.6, None), (0.46, None), (0.4, 10.0), (-2, 50.0)])
def test_what_a_payoff_lacks_is_seen_beyond_the_tolerance(payoff, plenty):
    model = ForagingRoles(seed=3, compiled=False, programmed=1.0, start=1, foragers=2)
    robot = model.robots[0]
    robot.payoff = payoff
    DECIDING.perceive(robot, model, "PlentyOfB")
    value = model.robots.cogniton("PlentyOfB")[0]
    assert np.isnan(value) if plenty is None else value == pytest.approx(plenty)


def test_what_is_just_as_it_may_be_changes_nothing():
    """The tolerance, a payoff of 0.5 and half of an odd number of robots are on the near side."""
    model = ForagingRoles(
        seed=3, compiled=False, programmed=1.0, start=1, foragers=2, tolerance=25.0
    )
    robot = model.robots[0]
    for payoff, seen in ((0.25, False), (0.125, True)):
        robot.payoff = payoff
        DECIDING.perceive(robot, model, "PlentyOfB")
        assert np.isfinite(model.robots.cogniton("PlentyOfB")[0]) == seen
    roles = {}
    for payoff in (0.5, 0.499):
        greedy = SimpleNamespace(programmed=False, payoff=payoff, is_b=False)
        greedy.hierarchy = SimpleNamespace(
            set_variable=lambda _, role, at=payoff: roles.update({at: role})
        )
        DECIDING.decide(greedy, SimpleNamespace(unlearned=GREEDY), None)
    assert roles == {0.499: 1.0}
    assert [DECIDING.is_due(0.5, having, 9) for having in (3, 4)] == [True, False]


def test_who_takes_up_another_role_leaves_the_old_one():
    model = ForagingRoles(seed=3, compiled=False, programmed=1.0, start=1, foragers=2)
    robot = model.robots[0]
    DECIDING.collect_b(robot)
    assert model.robots.cogniton("CallingB").tolist() == [25.0, 25.0]
    DECIDING.collect_a(robot)
    assert robot.hierarchy.variable("ROLE") == 0.0
    for name, known in (("CallingA", True), ("CallingB", False), ("PlentyOfB", False)):
        assert np.isfinite(model.robots.cogniton(name)[0]) == known, name


def test_programmed_robots_decide_after_deliveries_alone_and_divide_the_work():
    model = ForagingRoles(seed=4, programmed=1.0, start=0)
    changed = 0
    for _, before, payoff, after in decisions(model, 6000):
        if before != after:
            changed += 1
            assert 100 * (0.5 - payoff) > model.tolerance
    assert changed == model.changed > 0
    model.advance(24_000)
    assert model.off <= 2.0
    assert (np.isfinite(model.robots.cogniton("CallingB")) == model.robots.is_b).all()


def test_the_decision_of_a_programmed_robot_is_explained():
    model = ForagingRoles(seed=4, programmed=1.0, start=0)
    model.advance(3000)
    changed = model.robots.id[model.robots.changes > 0].tolist()
    assert 0 < len(changed) < 9
    for robot in (changed[0], min(set(range(9)) - set(changed))):
        receipt = model.explain(robot, 3000)
        assert receipt.choice == model.plans(model.robots)[robot]
        assert [one.name for one in receipt.plans] == ["CollectA", "CollectB"]


def test_both_speeds_agree_with_both_minds(differences):
    given = {"programmed": 0.5, "start": 0, "add_at": 700}
    compiled, interpreted = ForagingRoles(6, **given), ForagingRoles(6, False, **given)
    for ticks in (1, 1099):
        compiled.advance(ticks)
        interpreted.advance(ticks)
        assert differences(compiled, interpreted) == []
    assert compiled.changed > 0


# Simple rules -------------------------------------------------------------------------------------


@pytest.mark.parametrize(("share", "in_b"), [(0.0, 6), (0.33, 4)])
def test_fixed_roles_begin_in_the_wanted_split_and_stay(share, in_b):
    model = ForagingRoles(seed=2, unlearned=FIXED, programmed=share, reverse_at=500, add_at=600)
    others = ~model.robots.programmed
    assert model.robots.is_b[others].sum() == in_b
    model.advance(3000)
    others = ~model.robots.programmed
    assert model.robots.changes[others].tolist() == [0] * others.sum()
    assert model.robots.is_b[others].sum() == in_b + 2 - (share > 0)
    assert model.robots.delivered_a.sum() > 0


def test_random_roles_are_drawn_by_the_wanted_ratio():
    model = ForagingRoles(seed=2, unlearned=CHANCE, wanted_b=0.8, start=0, foragers=18)
    found = [(before, after) for _, before, _, after in decisions(model, 6000)]
    assert len(found) > 60
    assert np.mean([after for _, after in found]) == pytest.approx(0.8, abs=0.15)
    assert {before for before, _ in found} == {True, False}


def test_the_greedy_leave_whatever_is_worth_less_than_it_should_be():
    model = ForagingRoles(seed=2, unlearned=GREEDY, start=3)
    found = list(decisions(model, 4000))
    assert {payoff < 0.5 for _, _, payoff, _ in found} == {True, False}
    for _, before, payoff, after in found:
        assert (before != after) == (payoff < 0.5)
