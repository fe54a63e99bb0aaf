"""Wrong questions are refused with the line of the rule and what to write; so are wrong numbers."""

import math

import pytest

from socialmind import Agent, Model, ModelError, Population, RuleError, Torus, each, once
from socialmind.errors import SocialmindError, ValueRefusedError


class Bird(Agent):
    seen: int = 0


def without_radius(bird, model):
    bird.seen = len(model.flock.near(bird))


def too_much(bird, model):
    bird.seen = len(model.flock.on(bird, 2))


def of_a_number(bird, model):
    bird.seen = len(model.flock.near(3, 2.0))


def kept(bird, model):
    found = model.flock.near(bird, 2.0)
    bird.seen = len(found)


def asked_for_truth(bird, model):
    if model.flock.near(bird, 2.0):
        bird.seen = 1


def drawn_without_luck(bird, model):
    other = model.flock.near(bird, 2.0).one_of()
    if other is not None:
        bird.seen = other.id


def as_netlogo(bird, model):
    bird.seen = len(model.flock.in_radius(bird, 2.0))


def as_mesa(bird, model):
    for other in model.world.get_neighbors(bird):
        bird.seen = other.id


def counted(bird, model):
    bird.seen = model.flock.near(bird, 2.0).count()


def none_as_condition(bird, model):
    other = model.flock.nearest(bird)
    if other:
        bird.seen = 1


def none_among_numbers(bird):
    best = None
    best = 3
    bird.seen = best


REFUSED = [
    (without_radius, "arguments for model.flock.near()", "write `model.flock.near(who, radius)`"),
    (too_much, "2 arguments for model.flock.on()", "write `model.flock.on(who)`"),
    (of_a_number, "model.flock.near() of a whole number", "of an agent or a patch"),
    (kept, "a set of agents of 'flock' as the variable 'found'", "write it where it is used"),
    (asked_for_truth, "a set of agents of 'flock' as a condition", "write `len(…) > 0`"),
    (drawn_without_luck, "one_of() without the random stream", "one_of(rng)"),
    (as_netlogo, "in_radius() of the population", "model.flock.near(bird, radius)"),
    (as_mesa, "get_neighbors()", "model.flock.neighbours(bird)"),
    (counted, "count() of a set of agents", "write len(…)"),
    (none_as_condition, "may be None as a condition", "write `is not None`"),
    (none_among_numbers, "None as a value", "-1 for none"),
]


def model_with(rule, **parts):
    flock = Population(Bird, 3)
    given = {"world": Torus(5), "flock": flock, "schedule": (each(flock, rule),), **parts}
    return type("Wrong", (Model,), {"__module__": __name__, **given})


@pytest.mark.parametrize(("rule", "found", "remedy"), REFUSED)
def test_rules_are_refused_with_their_line(rule, found, remedy):
    with pytest.raises(ModelError) as error:
        model_with(rule)()
    first = rule.__code__.co_firstlineno
    assert error.value.line in range(first, first + 5)
    assert found in str(error.value) and remedy in str(error.value)


def near_one(bird, model):
    bird.seen = len(model.flock.near(bird, 1.0))


def test_a_world_without_places_has_no_neighbours():
    class Nowhere(Model):
        flock = Population(Bird, 3)
        schedule = (each(flock, near_one),)

    with pytest.raises(ModelError, match=r"without places; declare a world: `world = Torus"):
        Nowhere()


def below_zero(model):
    for bird in model.flock:
        bird.seen = len(model.flock.near(bird, -0.5))


def of_nobody(model):
    for bird in model.flock:
        alone = model.flock.nearest(bird, 0.0)
        bird.seen = alone.id


@pytest.mark.parametrize("compiled", [True, False])
def test_a_radius_below_zero_and_nobody_raise_with_their_line(compiled):
    class Below(Model):
        world = Torus(5)
        flock = Population(Bird, 3)
        schedule = (once(below_zero),)

    line = below_zero.__code__.co_firstlineno + 2
    with pytest.raises(RuleError, match=rf"test_wrong_calls.py:{line}: .*below 0"):
        Below(compiled=compiled).advance()


@pytest.mark.parametrize("compiled", [True, False])
def test_nobody_where_an_agent_is_needed_raises(compiled):
    class Alone(Model):
        world = Torus(5)
        flock = Population(Bird, 1)
        schedule = (once(of_nobody),)

    line = of_nobody.__code__.co_firstlineno + 3
    with pytest.raises(RuleError, match=rf":{line}: .*None was used; ask `is not None`"):
        Alone(compiled=compiled).advance()


def test_users_are_told_what_is_wrong():
    society = model_with(near_one)(compiled=False)
    bird = society.flock[0]
    assert len(society.flock.near(bird, math.inf)) == 2
    for radius in (-1, math.nan, "2"):
        with pytest.raises(ValueRefusedError, match="expected 0 or more"):
            society.flock.near(bird, radius)
    with pytest.raises(ValueRefusedError, match="expected an agent or a patch"):
        society.flock.near((1, 2), 3.0)
    with pytest.raises(SocialmindError, match="no field"):
        society.flock.nigh(bird, 3.0)
