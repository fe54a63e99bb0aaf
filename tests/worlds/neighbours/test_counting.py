"""Sums over agents on patches that have room for one are counted while looking."""

import pytest

from socialmind import Agent, Grid, Model, Population, each, parameter


class Cat(Agent):
    kind: int = 0
    weight: float = 1.0
    counts: int = 0


class Dog(Cat):
    pass


def appear(animal, model, rng):
    animal.kind = animal.id % 3
    animal.weight = rng.random()
    place = model.world.one_free(rng)
    model.world.move_to(animal, place.x, place.y)


def look(cat, model, rng):
    others = model.dogs
    steps = rng.integers(0, 4)
    found = sum(1 for one in model.cats.neighbours(cat, steps) if one.kind == cat.kind)
    found = 31 * found + sum(1 for one in others.neighbours(cat, steps) if one.weight < cat.weight)
    found = 31 * found + sum(1 for one in model.cats.neighbours4(cat) if one.kind != cat.kind)
    found = 31 * found + sum(1 for _ in others.neighbours4(cat))
    found = 31 * found + sum(1 for one in model.cats.on(cat) if one.kind == cat.kind)
    found = 31 * found + sum(one.kind > 0 for one in others.neighbours(cat, 2))
    patch = model.world.patch(cat.x, cat.y)
    found = 31 * found + sum(1 for one in model.cats.on(patch) if one.kind == cat.kind)
    found = 31 * found + sum(1 for one in model.cats.neighbours(patch, steps) if one.kind == 1)
    cat.counts = (31 * cat.counts + found) % 1000003


def live(cat, model, rng):
    if rng.random() < 0.1:
        cat.die()  # and looks around where it was
    elif rng.random() < 0.2 and model.world.free_count > 0:
        child = cat.hatch()
        look(child, model, rng)  # on the patch of its parent, where it does not stand
        appear(child, model, rng)
    elif model.world.free_count > 0:
        appear(cat, model, rng)
    look(cat, model, rng)


class Round(Model):
    width: int = parameter(5, low=1)
    height: int = parameter(5, low=1)
    n_cats: int = parameter(6, low=0)
    n_dogs: int = parameter(4, low=0)
    world = Grid("width", "height", True, one_per_patch=True)
    cats = Population(Cat, "n_cats")
    dogs = Population(Dog, "n_dogs")
    setup = (each(cats, appear), each(dogs, appear))
    schedule = (each(cats, live),)


class Walled(Round):
    world = Grid("width", "height", False, one_per_patch=True)


class Pipe(Round):
    world = Grid("width", "height", "x", one_per_patch=True)


@pytest.mark.parametrize("kind", [Round, Walled, Pipe])
def test_both_speeds_count_the_same(kind):
    counted = 0
    for seed in range(15):
        width, height = 1 + seed * 7 % 11, 1 + seed * 5 % 9
        room = width * height
        fast, slow = (
            kind(
                seed=seed, width=width, height=height, n_cats=room // 3, n_dogs=room // (2 + seed),
                compiled=compiled,
            )
            for compiled in (True, False)
        )  # fmt: skip
        for society in (fast, slow):
            society.advance(8)
        for name in ("id", "x", "y", "counts"):
            assert getattr(fast.cats, name).tolist() == getattr(slow.cats, name).tolist(), seed
        counted += sum(fast.cats.counts.tolist())
    assert counted > 0


def test_none_are_counted_where_none_are():
    lonely = Walled(n_cats=4, n_dogs=0)
    lonely.advance(3)
    assert lonely.tick == 3
