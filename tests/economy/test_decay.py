"""Decay models: their equations and properties, alike at both speeds."""

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from socialmind import Agent, Model, Population, each
from socialmind.economy import exponential_smoothing, proportional_decay, towards_neutral

numbers = st.floats(-1e9, 1e9)
shares = st.floats(0.0, 1.0)


@given(numbers, shares)
def test_proportional_decay_takes_a_share(value, rate):
    left = proportional_decay(value, rate)
    assert left == value * (1 - rate)
    assert abs(left) <= abs(value)
    assert left * value >= 0


@given(numbers)
def test_proportional_decay_takes_nothing_or_all(value):
    assert proportional_decay(value, 0.0) == value
    assert proportional_decay(value, 1.0) == 0


@given(st.floats(-1e6, 1e6), st.floats(0.001, 0.5), st.integers(1, 50))
def test_proportional_decay_is_geometric(value, rate, steps):
    left = value
    for _ in range(steps):
        left = proportional_decay(left, rate)
    assert left == pytest.approx(value * (1 - rate) ** steps, rel=1e-9, abs=1e-300)


@given(numbers, numbers, shares)
def test_smoothing_stays_between_the_estimate_and_what_is_observed(value, observed, weight):
    after = exponential_smoothing(value, observed, weight)
    slack = 1e-6 * (abs(value) + abs(observed))
    assert min(value, observed) - slack <= after <= max(value, observed) + slack


@given(numbers, numbers)
def test_smoothing_keeps_all_or_takes_all(value, observed):
    assert exponential_smoothing(value, observed, 0.0) == value
    assert exponential_smoothing(value, observed, 1.0) == pytest.approx(observed, abs=1e-6)


@given(st.floats(0.01, 1.0), st.integers(1, 40))
def test_smoothing_of_a_constant_comes_near_geometrically(weight, steps):
    estimate = 0.0
    for _ in range(steps):
        estimate = exponential_smoothing(estimate, 8.0, weight)
    assert estimate == pytest.approx(8.0 * (1 - (1 - weight) ** steps))


@given(numbers, shares, st.floats(-100, 100), st.floats(0.0, 1e6))
def test_towards_neutral_stays_within_the_bound_and_on_its_side(value, factor, neutral, bound):
    after = towards_neutral(value, factor, neutral, bound)
    slack = 1e-9 * (abs(value) + abs(neutral) + bound)
    assert abs(after - neutral) <= min(bound, abs(value - neutral)) + slack
    assert (after - neutral) * (value - neutral) >= -slack * (abs(value) + abs(neutral) + bound)


@given(st.floats(-100, 100), shares, st.floats(0.0, 50.0))
def test_towards_neutral_is_symmetric(distance, factor, bound):
    above = towards_neutral(distance, factor, 0.0, bound)
    assert towards_neutral(-distance, factor, 0.0, bound) == -above


@pytest.mark.parametrize(
    ("value", "after"),
    [(30.0, 15.0), (math.nextafter(30.0, 31.0), 30.0), (50.0, 30.0), (-50.0, -30.0), (0.0, 0.0)],
)
def test_a_value_beyond_the_bound_is_set_to_it_and_does_not_come_to_rest(value, after):
    assert towards_neutral(value, 0.5, 0.0, 30.0) == after


def test_coming_to_rest_by_hand():
    assert towards_neutral(21.0, 0.25, 5.0, 30.0) == 9.0  # 5 + 16 / 4
    assert towards_neutral(-11.0, 0.25, 5.0, 30.0) == 1.0
    assert towards_neutral(36.0, 0.25, 5.0, 30.0) == 35.0
    assert towards_neutral(-26.0, 0.25, 5.0, 30.0) == -25.0


class Store(Agent):
    food: float = 1000.0
    expected: float = 10.0
    calling: float = 45.0


def spoil(store, rng):
    store.food = proportional_decay(store.food, 0.003312)
    store.expected = exponential_smoothing(store.expected, rng.uniform(0, 20), 0.1)
    store.calling = towards_neutral(store.calling - 0.01, 0.999, 2.5, 30.0)


class Stores(Model):
    stores = Population(Store, 3)
    schedule = (each(stores, spoil),)


def test_in_rules_they_are_the_same_at_both_speeds():
    compiled, interpreted = Stores(1), Stores(1, compiled=False)
    for society in (compiled, interpreted):
        society.advance(500)
    for name in ("food", "expected", "calling"):
        assert list(getattr(compiled.stores, name)) == list(getattr(interpreted.stores, name))
    food = 1000.0
    for _ in range(500):
        food = food * (1 - 0.003312)
    assert list(compiled.stores.food) == [food] * 3
