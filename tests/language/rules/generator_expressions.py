"""Generator expressions in what adds up, compares and asks for any or all."""
# ruff: noqa

import statistics
from statistics import fmean

DIRECTIONS = ((0, 1), (1, 0), (0, -1), (-1, 0))
PRICES = (1.5, 2.5, 0.25)


def count_of_agents(person, model):
    person.i = sum(1 for other in model.persons if other.f > person.f)


def sum_of_truths(person, model):
    person.i = sum(other.b for other in model.persons)


def sum_of_numbers(person, model):
    person.f = sum(other.f for other in model.persons if other.b and other.id != person.id)


def sum_of_whole_numbers_then_numbers(person):
    total = 0
    total += sum(k for k in range(5))
    total += sum(k * 0.5 for k in range(5))
    person.f = total


def sum_with_several_conditions(person, model, rng):
    low = rng.integers(0, 3)
    person.i = sum(other.i for other in model.persons if other.i > low if other.i % 2 == 0)


def two_loops(person, model):
    person.i = sum(house.rooms * k for house in model.houses for k in range(3) if k != house.id)


def one_within_another(person, model):
    person.i = sum(sum(k for k in range(house.rooms)) for house in model.houses)


def over_an_array(person):
    person.f = sum(value for value in person.vf if value > 0)
    person.i = sum(1 for flag in person.vb if flag)


def over_constants(person):
    person.f = sum(price for price in PRICES if price > 1)
    person.i = sum(dx * dx + dy for dx, dy in DIRECTIONS)


def nothing_to_sum(person):
    person.i = sum(k for k in range(0))


def least(person, model):
    person.i = min(other.i for other in model.persons)
    person.f = max(other.f - other.i for other in model.persons if other.id > 2)


def least_of_nothing(person, model):
    person.i = min((house.rooms for house in model.houses if house.rooms > 99), default=-1)
    person.f = max((house.rent for house in model.houses if house.rooms > 99), default=0)
    person.g = max((house.rooms for house in model.houses if house.rooms > 99), default=0.5)


def first_of_equals(person, model):
    person.f = max(-0.0 if k == 0 else 0.0 for k in range(2))
    person.g = min(0.0 if k == 0 else -0.0 for k in range(2))


def any_of(person, model):
    person.b = any(other.f > 4 for other in model.persons)
    person.c = any(house.rooms for house in model.houses if house.id == 99)


def all_of(person, model):
    person.b = all(other.i > -6 for other in model.persons)
    person.c = all(0 < k and k < person.j for k in range(1, 4))


def any_of_an_array(person):
    person.b = any(person.vb)
    person.c = all(person.vi)


def mean(person, model):
    person.f = fmean(other.i for other in model.persons)
    person.g = statistics.fmean(house.rooms * 0.5 for house in model.houses)


def mean_of_an_array(person):
    person.f = fmean(person.vi)


def in_a_condition(person, model):
    if person.b and any(other.i == person.j for other in model.persons):
        person.i = 1
    while sum(k for k in range(person.j)) > 6 and person.j > 0:
        person.j -= 1


def in_the_order_of_python(person, model):
    person.f = _drawn(person) + sum(_drawn(person) for _ in range(3)) * 2 - _drawn(person)


def _drawn(person):
    person.i = person.i * 3 % 17 + 1
    return person.i


def with_draws(person, rng):
    person.f = sum(rng.random() < 0.5 for _ in range(6)) + rng.random()


def a_name_of_outside(person, model):
    one, found, count = 2, 3, 4
    person.i = sum(one * found + count + k for k in range(3)) + max(k * found for k in range(count))


def with_a_text(person, model):
    person.f = _valued(person, model, "Hunger")


def _valued(person, model, name):
    return sum(other.mind.get_cogniton_value(name) for other in model.persons if other.b)


def with_optional_fields(person, model):
    person.i = sum(other.oi for other in model.persons if other.oi is not None)


def in_what_is_added(person, model):
    person.i += sum(house.rooms for house in model.houses)
    person.vf[person.j % 4] += max(house.rent for house in model.houses)


def strongest(person, model):
    best = max(model.persons, key=lambda one: one.f)
    person.i = best.id
    person.f = min(model.houses, key=_value).rent


def _value(house):
    return house.rooms * 2 - house.id


def strongest_of_some(person, model):
    found = max(
        (other for other in model.persons if other.b and other.id != person.id),
        key=lambda other: other.f - person.f,
        default=None,
    )
    if found is not None:
        person.i = found.id


def strongest_of_none(person, model):
    found = min(
        (other for other in model.persons if other.id > 99), key=lambda p: p.f, default=None
    )
    person.b = found is None


def first_of_equals_by_key(person, model):
    person.i = max(model.persons, key=lambda one: one.id % 2).id
    person.j = min((one for one in model.persons), key=lambda one: one.id // 3).id
