"""The order within a tick: phases in turn, agents one after another in a fresh random order."""

import itertools
from collections import Counter

import pytest

from socialmind import Agent, Model, ModelError, Population, each, once
from socialmind.errors import RuleError


class Runner(Agent):
    place: int = 0
    seen: int = 0
    early: int = 0
    sum: float = 0.0


def start(model):
    model.finished = 0


def run(runner, model):
    runner.place = model.finished
    model.finished += 1


def look(runner, model):
    runner.seen = model.finished
    runner.early += runner.place == 0


def count(model, rng):
    model.rounds += 1
    model.luck = rng.random()


def prepare(runner, model):
    runner.seen = -model.rounds


def shake(runner, rng):
    runner.sum += rng.random()


class Race(Model):
    finished: int = 0
    rounds: int = 0
    luck: float = 0.0
    runners = Population(Runner, 6)
    setup = (once(count), each(runners, prepare))
    schedule = (once(start), each(runners, run), each(runners, look), once(count))


class Queue(Model):
    finished: int = 0
    runners = Population(Runner, 6)
    schedule = (once(start), each(runners, run, shuffled=False))


def test_phases_run_in_their_order():
    for compiled in (True, False):
        race = Race(1, compiled=compiled)
        assert (race.tick, race.rounds) == (0, 1)
        assert race.runners.seen.tolist() == [-1] * 6  # the setup ran in its order too
        race.advance(1)
        assert race.runners.seen.tolist() == [6] * 6
        assert sorted(race.runners.place.tolist()) == list(range(6))
        assert (race.tick, race.rounds) == (1, 2)


def test_orders_are_fresh_random_and_reproducible():
    races = [Race(1), Race(1, compiled=False), Race(1), Race(2)]
    orders = [[], [], [], []]
    for _ in range(60):
        for race, kept in zip(races, orders, strict=True):
            race.advance(1)
            kept.append(tuple(race.runners.place.tolist()))
    assert orders[0] == orders[1] == orders[2]
    assert orders[0] != orders[3]
    assert len(set(orders[0])) > 50


def test_every_order_is_as_likely_as_another():
    class Three(Model):
        finished: int = 0
        runners = Population(Runner, 3)
        schedule = (once(start), each(runners, run))

    race = Three(4)
    met = Counter()
    for _ in range(3000):
        race.advance(1)
        met[tuple(race.runners.place.tolist())] += 1
    assert set(met) == set(itertools.permutations(range(3)))
    assert sum((n - 500) ** 2 / 500 for n in met.values()) < 20.5  # chi-square, p = 0.001


def test_the_order_of_birth_on_request():
    for compiled in (True, False):
        queue = Queue(1, compiled=compiled)
        queue.advance(3)
        assert queue.runners.place.tolist() == list(range(6))


def test_steps_and_stretches_are_alike():
    one, two = Race(7), Race(7)
    one.advance(50)
    for _ in range(10):
        two.advance(5)
    two.advance(0)
    assert one.runners.place.tolist() == two.runners.place.tolist()
    assert (one.luck, one.rounds) == (two.luck, two.rounds)


def test_a_phase_prints_as_what_it_does():
    assert [str(phase) for phase in Race.schedule] == [
        "once: start",
        "each of runners, random order: run",
        "each of runners, random order: look",
        "once: count",
    ]
    assert str(Queue.schedule[1]) == "each of runners, order of birth: run"


def test_wrong_schedules_are_refused():
    with pytest.raises(ModelError, match=r"each\(3, …\)"):
        each(3, run)
    with pytest.raises(ModelError, match="each\\(population, rule\\) or once\\(rule\\)"):
        type("Wrong", (Model,), {"schedule": (run,)})


def stumble(runner, model):
    if model.tick == 2 and runner.id == 3:
        runner.sum = 1 / runner.sum


class Stumbling(Model):
    runners = Population(Runner, 6)
    schedule = (each(runners, stumble, shuffled=False),)


@pytest.mark.parametrize("compiled", [True, False])
def test_an_error_says_where_and_for_whom(compiled):
    society = Stumbling(1, compiled=compiled)
    with pytest.raises(RuleError) as caught:
        society.advance(10)
    assert society.tick == 2
    assert "ZeroDivisionError" in str(caught.value)
    assert f"{__file__}:{stumble.__code__.co_firstlineno + 2}" in str(caught.value)
    assert "in tick 2, agent 3 of 'runners'" in str(caught.value)
    assert isinstance(caught.value.__cause__, ZeroDivisionError)
