"""Agents that are looked for by patches alone are kept in lists of their patches."""

import pytest

from socialmind import Agent, Grid, Model, Patch, Population, each, parameter


class Mouse(Agent):
    mark: int = 0


def appear(mouse, model, rng):
    world = model.world
    world.move_to(
        mouse,
        world.low_x - 0.5 + rng.uniform(0, world.width),
        world.low_y - 0.5 + rng.uniform(0, world.height),
    )


def scurry(mouse, model, rng):
    world = model.world
    if rng.random() < 0.1:
        appear(mouse, model, rng)
    dx, dy = rng.uniform(-2, 2), rng.uniform(-2, 2)
    if world.is_inside(mouse.x + dx, mouse.y + dy):
        world.move_to(mouse, mouse.x + dx, mouse.y + dy)
    mouse.mark = (31 * mouse.mark + len(model.mice.on(mouse))) % 1000003
    for other in model.mice.neighbours(mouse, 1 + rng.integers(0, 2)):
        mouse.mark = (31 * mouse.mark + other.id + 1) % 1000003
        if rng.random() < 0.05:
            other.die()
        elif rng.random() < 0.05:
            mouse.hatch()
        elif rng.random() < 0.05 and world.is_inside(other.x + 1, other.y):
            other.x = other.x + 1
    one = model.mice.neighbours4(mouse).one_of(rng)
    if one is not None:
        one.mark += 1
    if len(model.mice) < model.least:
        appear(model.mice.create(), model, rng)


class Round(Model):
    width: int = parameter(5, low=1)
    height: int = parameter(5, low=1)
    least: int = parameter(12, low=0)
    world = Grid("width", "height", True, Patch)
    mice = Population(Mouse, 12)
    setup = (each(mice, appear),)
    schedule = (each(mice, scurry),)


class Walled(Round):
    world = Grid("width", "height", False, Patch)


class Pipe(Round):
    world = Grid("width", "height", "x", Patch)


@pytest.mark.parametrize("kind", [Round, Walled, Pipe])
def test_both_speeds_find_the_same(kind):
    for seed in range(20):
        width, height = 1 + seed * 7 % 11, 1 + seed * 5 % 9
        if seed == 0:
            width, height = 90, 70  # more patches than the lists have room for
        fast, slow = (
            kind(seed=seed, width=width, height=height, least=5 + seed, compiled=compiled)
            for compiled in (True, False)
        )
        for society in (fast, slow):
            society.advance(12)
        for name in ("id", "x", "y", "mark"):
            assert getattr(fast.mice, name).tolist() == getattr(slow.mice, name).tolist(), seed
    assert fast.mice.id.max() > 40
