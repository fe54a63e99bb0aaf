"""The rule that each agent follows once, at birth: founders, children, and children of these."""

import numpy as np
import pytest

from socialmind import Agent, Model, ModelError, Population, RuleError, each, once, parameter
from socialmind.engine import engine


class Cow(Agent):
    age: int = 0
    mother: int = -1
    births: int = 0
    born_in: int = -1
    weight: float = 0.0


class Bird(Agent):
    cow: int = -1
    births: int = 0


def settle_down(cow):
    cow.mother = -2  # a founder


def come(cow, model, rng):
    cow.births += 1
    cow.born_in = model.tick
    cow.weight = 30.0 + rng.random() + (1.0 if cow.mother >= 0 else 0.0)
    if cow.weight > model.heavy:
        bird = model.birds.create()
        bird.cow = cow.id


def hatch_out(bird, model):
    bird.births += 1
    if bird.id == 0:
        calf = model.cows.create()
        calf.mother = 77


def calve(cow, model, rng):
    cow.age += 1
    if rng.random() < model.fertile:
        calf = cow.hatch()
        calf.mother = cow.id
        calf.births = 0
        calf.age = 0
        if rng.random() < 0.2:
            calf.die()
    if rng.random() < 0.1:
        cow.die()


def arrive(model):
    cow = model.cows.create()
    cow.mother = 55


class Herd(Model):
    heavy: float = parameter(30.5)
    fertile: float = parameter(0.2)
    birds = Population(Bird, 0, at_birth=hatch_out)
    cows = Population(Cow, 6, at_birth=come)
    setup = (each(cows, settle_down),)
    schedule = (each(cows, calve), once(arrive))


@pytest.fixture(scope="module")
def herds():
    made = Herd(seed=4), Herd(seed=4, compiled=False)
    for herd in made:
        herd.advance(30)
    return made


def content(model):
    return {
        (name, column): table.columns[column][table.slots]
        for name, table in model.tables.items()
        for column in table.dtype.names
    }


def test_founders_follow_it_at_the_end_of_the_setup():
    herd = Herd(seed=4)
    assert herd.cows.births.tolist() == [1] * len(herd.cows)
    assert herd.cows.mother[:6].tolist() == [-2] * 6
    assert set(herd.cows.born_in) == {0}
    assert (herd.cows.weight[:6] < 31).all()  # its field was set before
    # The birds that they brought followed theirs, and the calf of the first bird its own.
    assert herd.birds.births.tolist() == [1] * len(herd.birds)
    assert len(herd.birds) > 0
    assert herd.cows.mother[6] == 77
    assert herd.cows.weight[6] >= 31


def test_children_follow_it_once_at_the_end_of_their_tick(herds):
    slow = herds[1]
    assert set(slow.cows.births) == {1}
    assert set(slow.birds.births) <= {1}
    children = slow.cows.mother >= 0
    assert (slow.cows.weight[children] >= 31).all()
    # An agent acts from the tick after its birth on.
    assert (slow.cows.age[children] == 29 - slow.cows.born_in[children]).all()
    assert len(set(slow.cows.born_in)) > 5


def test_both_speeds_give_the_same(herds):
    fast, slow = map(content, herds)
    for name, column in fast.items():
        np.testing.assert_array_equal(column, slow[name], err_msg=str(name))


def test_a_compiled_setup_gives_the_same(monkeypatch):
    monkeypatch.setattr(engine, "INTERPRETED_SETUP", -1)
    fast, slow = Herd(seed=4), Herd(seed=4, compiled=False)
    for name, column in content(fast).items():
        np.testing.assert_array_equal(column, content(slow)[name], err_msg=str(name))


def test_a_run_goes_on_as_one_that_was_not_stopped(herds):
    _, slow = herds
    again = Herd(seed=4)
    again.restore(slow.state())
    slow.advance(5)
    again.advance(5)
    for name, column in content(again).items():
        np.testing.assert_array_equal(column, content(slow)[name], err_msg=str(name))


def fail(cow):
    cow.weight = 1 / (cow.age - 0)


def fine(cow):
    pass


def answer(cow):
    return 3


def test_what_fails_says_where_and_for_whom():
    cows = Population(Cow, 2, at_birth=fail)
    kind = type("Failing", (Model,), {"cows": cows, "schedule": (each(cows, fine),)})
    with pytest.raises(RuleError, match=r"test_at_birth.py:\d+: ZeroDiv.*in tick 0, agent 0 of"):
        kind()


def test_it_is_a_rule():
    with pytest.raises(ModelError, match="found at_birth=3 of 'cows'; expected a rule, or None"):
        type("Numbered", (Model,), {"cows": Population(Cow, 2, at_birth=3)})


def test_it_returns_nothing():
    cows = Population(Cow, 2, at_birth=answer)
    kind = type("Answering", (Model,), {"cows": cows, "schedule": (each(cows, fine),)})
    with pytest.raises(ModelError, match=r"test_at_birth.py:\d+: found the rule 'answer', which"):
        kind()
