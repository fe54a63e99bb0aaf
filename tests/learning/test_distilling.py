"""Readable schemes distilled from minds that weigh plans."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from coglogo_py import CognitiveScheme, MaximumWeight, WeightedStochastic
from socialmind.errors import ModelError, SocialmindError
from socialmind.learning.distilling import (
    Agreement,
    agreement,
    available,
    choices,
    distilled,
    states_of,
    weights_by_hierarchy,
    weights_by_links,
)
from socialmind.mind import MindDescription, Perceptron, Programmed, Skill, Variable
from socialmind.sources.loading import load_file

GRAZING = load_file(Path(__file__).parent / "grazing.py")
SCHEME, MIND, WEIGHING = GRAZING.SCHEME, GRAZING.MIND, GRAZING.WEIGHING


@pytest.fixture(scope="module")
def states():
    """States within reach, a third of them without fear."""
    rng = np.random.default_rng(1)
    found = rng.uniform([-40, -35, 0], [45, 38, 10], (600, 3))
    found[rng.random(600) < 1 / 3, 2] = np.nan
    return found


def test_a_linear_hierarchy_weighs_as_the_links_do(states):
    by_mind = weights_by_hierarchy(states, SCHEME, MIND, WEIGHING)
    np.testing.assert_allclose(by_mind, weights_by_links(states, SCHEME), atol=1e-9)


def test_plans_are_open_by_conditional_links():
    states = np.array([[1.0, 1.0, np.nan], [np.nan, 1.0, np.nan], [np.nan, np.nan, 0.0]])
    assert available(states, SCHEME).tolist() == [
        [True, True, True], [False, True, False], [False, False, True]
    ]  # fmt: skip


def test_choices_are_those_that_a_mind_says():
    model = GRAZING.Grazing(seed=2)
    model.advance(40)
    states = states_of(model, "cows", [40])
    found = choices(weights_by_links(states, SCHEME), available(states, SCHEME), SCHEME)
    for place, cow in enumerate(model.cows):
        said = cow.mind.plan_probabilities()
        expected = [said.get(plan, 0.0) for plan in SCHEME.plans]
        assert found[place].tolist() == pytest.approx(expected)


def test_states_are_those_of_all_minds_at_each_tick():
    model = GRAZING.Grazing(seed=2)
    states = states_of(model, "cows", [10, 30])
    assert states.shape == (24, 3)
    assert model.tick == 30
    np.testing.assert_array_equal(states[12:, 0], model.cows.cogniton("Hunger"))


@pytest.mark.parametrize("maker", [SCHEME.decision_maker, MaximumWeight(), WeightedStochastic()])
def test_the_links_of_a_scheme_come_back(states, maker):
    scheme = replace(SCHEME, decision_maker=maker)
    found = distilled(states, weights_by_links(states, SCHEME), scheme)
    assert found.links <= 5  # of 12; the scheme has five
    assert found.agreement.overlap > 0.97
    assert found.unpruned.overlap > 0.99
    assert found.agreement.overlap >= found.unpruned.overlap - 0.01
    # All but the links is as it was, and it can be written and read.
    for one, old in zip(found.scheme.cognitons, scheme.cognitons, strict=False):
        assert (one.conditional, one.starting) == (old.conditional, old.starting)


def test_a_society_with_the_distilled_scheme_lives_alike(states, tmp_path):
    found = distilled(states, weights_by_hierarchy(states, SCHEME, MIND, WEIGHING), SCHEME)
    found.scheme.save(tmp_path / "scheme.yaml")
    again = CognitiveScheme.load(tmp_path / "scheme.yaml")
    by_links, alike = GRAZING.Grazing(seed=4, scheme=again), GRAZING.Weighed(seed=4)
    by_links.advance(200)
    alike.advance(200)
    first, second = by_links.series(), alike.series()
    assert first["meals"] == pytest.approx(second["meals"], rel=0.1)
    assert first["naps"] == pytest.approx(second["naps"], rel=0.1)


def test_a_habit_is_a_cogniton(states):
    weights = weights_by_links(states, SCHEME) + np.array([0.0, 300.0, 0.0])
    found = distilled(states, weights, replace(SCHEME, decision_maker=WeightedStochastic()))
    habit = found.scheme.cognitons[-1]
    assert (habit.name, habit.start_value) == ("Habit", 1.0)
    assert habit.influence["rest"] - habit.influence.get("eat", 0.0) == pytest.approx(300, rel=0.1)
    assert found.agreement.overlap > 0.98


def test_what_no_scheme_can_do_agrees_less(states):
    crooked = np.column_stack([np.abs(states[:, 0]), np.abs(states[:, 1]), np.full(600, 20.0)])
    found = distilled(states, crooked, replace(SCHEME, decision_maker=MaximumWeight()))
    assert found.agreement.same < 0.9


def test_agreement_by_hand():
    found = agreement([[0.6, 0.4, 0.0], [0.0, 0.0, 0.0], [0.2, 0.3, 0.5]],
                      [[0.1, 0.8, 0.1], [1.0, 0.0, 0.0], [0.2, 0.2, 0.6]])  # fmt: skip
    assert found == Agreement(pytest.approx((0.5 + 0.9) / 2), 0.5)


@given(arrays(float, (4, 3), elements=st.floats(0.01, 1)))
def test_everybody_agrees_with_themselves(weights):
    shares = weights / weights.sum(axis=1, keepdims=True)
    found = agreement(shares, shares)
    assert found.overlap == pytest.approx(1.0)
    assert found.same == 1.0
    other = shares[:, ::-1]
    assert agreement(shares, other).overlap == pytest.approx(agreement(other, shares).overlap)


def remember(gone):
    """Remember."""
    return gone, 0.0, 0.0, 0.0


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda: agreement([[1.0]], [[0.5, 0.5]]), "expected the same"),
        (lambda: agreement([[0.0]], [[1.0]]), "no state in which both"),
        (lambda: distilled(np.zeros((5, 3)), np.zeros((5, 3)), SCHEME), "ten states or more"),
        (lambda: distilled(np.zeros((20, 3)), np.zeros((20, 2)), SCHEME), "weights of 3 plans"),
        (
            lambda: weights_by_hierarchy(
                np.zeros((1, 3)), SCHEME, MindDescription(
                    "m", [], SCHEME.plans, [Variable("GONE")],
                    [Skill("S", ["VA:GONE"], ["VA:GONE", "MO:eat", "MO:rest", "MO:wander"],
                           Programmed(remember))]), WEIGHING),
            "one without memory",
        ),
        (
            lambda: weights_by_hierarchy(
                np.zeros((1, 3)), SCHEME, MindDescription(
                    "m", ["Rain"], SCHEME.plans, skills=[
                        Skill("S", ["SE:Rain"], [f"MO:{plan}" for plan in SCHEME.plans],
                              Perceptron(layers=0), [0] * 6)]), WEIGHING),
            "the sensor 'Rain'",
        ),
    ],
)  # fmt: skip
def test_what_cannot_be_distilled_is_refused(call, message):
    with pytest.raises((ModelError, SocialmindError), match=message):
        call()
