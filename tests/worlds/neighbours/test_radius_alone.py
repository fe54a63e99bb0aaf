"""Agents that are looked for within a radius alone are all looked at, as long as they are few."""

import pytest

from socialmind import Agent, Grid, Model, Population, Torus, each, once, parameter
from socialmind.worlds.neighbours.few import FEW
from tests.worlds.neighbours.test_random_worlds import (
    CROWDS,
    SIZES,
    Naive,
    Pipe,
    Round,
    Walled,
    arrange,
    found,
    met,
    place,
    stir,
)


def watch(model, rng):
    """Ask who is near, of birds and of cats, and change who is found on the way."""
    for bird in model.flock:
        bird.mark = met(bird.mark, len(model.flock.near(bird, model.radius)))
        for other in model.flock.near(bird, model.radius):
            bird.mark = met(bird.mark, other.id)
            stir(other, bird, model)
            for third in model.flock.near(other, 1.0):
                bird.mark = met(bird.mark, third.id)
                if third.id % 5 == 0:
                    break
        one = model.flock.near(bird, model.radius).one_of(rng)
        if one is not None:
            stir(one, bird, model)
    for cat in model.cats:
        for other in model.flock.near(cat, 2.0):
            cat.mark = met(cat.mark, other.id)


RULES = (arrange, watch)


class RoundWatch(Round):
    schedule = tuple(once(rule) for rule in RULES)


class WalledWatch(Walled):
    schedule = tuple(once(rule) for rule in RULES)


class PipeWatch(Pipe):
    schedule = tuple(once(rule) for rule in RULES)


@pytest.mark.parametrize(
    ("kind", "wraps"), [(RoundWatch, True), (WalledWatch, False), (PipeWatch, "y")]
)
def test_all_find_the_same(kind, wraps):
    for seed, (width, height) in enumerate(SIZES):
        for least, most, ticks in CROWDS:
            given = {"width": width, "height": height, "least": least, "most": most}
            fast, slow = (kind(seed=seed, compiled=one, **given) for one in (True, False))
            naive = Naive(fast, wraps, RULES)
            for tick in range(ticks // 4):
                fast.advance()
                naive.advance()
                assert found(fast) == found(naive), (given, tick)
                if tick < ticks // 20:
                    slow.advance()
                    assert found(slow) == found(naive), (given, tick)


class Midge(Agent):
    mark: int = 0


def appear(midge, model, rng):
    place(midge, model, rng)


def dance(midge, model, rng):
    for other in model.midges.near(midge, 0.6):
        midge.mark = met(midge.mark, other.id)
    place(midge, model, rng)
    chance = rng.random()
    if chance < model.deaths:
        midge.die()
    elif chance < model.deaths + model.births:
        midge.hatch()


class Swarm(Model):
    births: float = 0.2
    deaths: float = 0.0
    size: int = parameter(9, low=1)
    world = Torus("size")
    midges = Population(Midge, FEW - 60)
    setup = (each(midges, appear),)
    schedule = (each(midges, dance),)


class SwarmInAYard(Swarm):
    world = Grid("size", "size", wraps=False)


@pytest.mark.parametrize("kind", [Swarm, SwarmInAYard])
def test_there_may_be_more_or_fewer_than_few(kind):
    fast, slow = kind(seed=4), kind(seed=4, compiled=False)
    sizes = []
    for births, deaths in ((0.2, 0.0), (0.0, 0.2)):
        for society in (fast, slow):
            society.births, society.deaths = births, deaths
            society.advance(2)
        sizes.append(len(fast.midges))
        for name in ("id", "x", "y", "mark"):
            assert getattr(fast.midges, name).tolist() == getattr(slow.midges, name).tolist()
    assert sizes[0] > FEW > sizes[1]
