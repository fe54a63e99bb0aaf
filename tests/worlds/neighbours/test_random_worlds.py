"""Ten thousand random worlds: compiled, interpreted and naive rules find the same, whatever moves.

Each tick is a world: all are placed anew, half of them on the ends of patches and of the world. In
the middle of loops some die, are born or move. The naive society runs the same rules, over lists.
"""

import numpy as np
import pytest

from socialmind import Agent, Grid, Model, Patch, Population, each, once, parameter
from socialmind.streams import Stream
from tests.worlds.neighbours.naive import NaiveFlock, NaiveWorld


class Bird(Agent):
    mark: int = 0
    way: float = 0.0


class Cat(Agent):
    mark: int = 0


def place(agent, model, rng):
    world = model.world
    x = world.low_x - 0.5 + rng.uniform(0, world.width)
    y = world.low_y - 0.5 + rng.uniform(0, world.height)
    if rng.random() < 0.5:
        x = world.low_x - 0.5 + rng.integers(0, 2 * world.width) / 2
        y = world.low_y - 0.5 + rng.integers(0, 2 * world.height) / 2
    elif rng.random() < 0.1:
        x = world.low_x - 0.5 + world.width - 1e-15 * world.width
    world.move_to(agent, x, y)


def step(agent, model, dx, dy):
    if model.world.is_inside(agent.x + dx, agent.y + dy):
        model.world.move_to(agent, agent.x + dx, agent.y + dy)


def met(mark, identity):
    return (mark * 31 + identity + 1) % 1000003


def drawn_radius(model, rng):
    kind = rng.integers(0, 6)
    if kind == 0:
        return 0.0
    if kind == 1:
        return rng.uniform(0, 0.1)
    if kind == 2:
        return rng.integers(0, 5) / 2
    if kind == 3:
        return 3.0 * (model.world.width + model.world.height)
    return rng.uniform(0, 4)


def arrange(model, rng):
    """Make a new world of the old one."""
    while len(model.flock) < model.least:
        model.flock.create()
    for bird in model.flock:
        place(bird, model, rng)
    for cat in model.cats:
        place(cat, model, rng)
    model.radius = drawn_radius(model, rng)


def look(model, rng):
    """Ask every question of everybody, and change who is found on the way."""
    for bird in model.flock:
        radius = model.radius
        bird.mark = met(bird.mark, len(model.flock.near(bird, radius)))
        for other in model.flock.near(bird, radius):
            bird.mark = met(bird.mark, other.id)
            dx, dy = model.world.offset(bird, other)
            bird.way += dx + 0.5 * dy
            stir(other, bird, model)
            for third in model.flock.near(other, 1.0):
                bird.mark = met(bird.mark, third.id)
                if third.id % 5 == 0:
                    break
        bird.mark = met(bird.mark, close_one(bird, model))
        nearest = model.flock.nearest(bird)
        if nearest is not None:
            bird.mark = met(bird.mark, nearest.id)
            step(nearest, model, -0.5, 0.25)
        closest = model.cats.nearest(bird, radius=radius)
        if closest is None:
            bird.mark = met(bird.mark, 0)
        else:
            closest.mark = met(closest.mark, bird.id)
        one = model.flock.near(bird, radius).one_of(rng)
        if one is not None:
            bird.mark = met(bird.mark, one.id)
            stir(one, bird, model)
    for cat in model.cats:
        ask_of_patches(cat, model)


def stir(other, bird, model):
    chance = (other.mark + bird.id) % 11
    if chance == 0:
        other.die()
        step(other, model, 0.5, 0.0)
    elif chance == 1 and len(model.flock) < model.most:
        child = other.hatch()
        step(child, model, 0.5, -1.0)
    elif chance < 5:
        step(other, model, 0.75 * (chance - 2), 0.5)


def close_one(bird, model):
    for other in model.flock.near(bird, 2.0):
        for third in model.flock.neighbours4(other):
            if third.mark % 2 == 0:
                return third.id
    return -1


def ask_of_patches(cat, model):
    patch = model.world.patch(cat.x, cat.y)
    marked = None
    for other in model.flock.on(cat):
        cat.mark = met(cat.mark, other.id)
    for other in model.flock.on(patch):
        cat.mark = met(cat.mark, other.id)
    for other in model.flock.neighbours(cat):
        cat.mark = met(cat.mark, other.id)
        if marked is None or other.mark > marked.mark:
            marked = other
    if marked is not None:
        cat.mark = met(cat.mark, marked.mark)
    for other in model.flock.neighbours(patch, steps=2):
        cat.mark = met(cat.mark, other.id)
        other.die()
    cat.mark = met(cat.mark, len(model.flock.neighbours4(patch)))
    cat.mark = met(cat.mark, len(model.cats.neighbours(cat, 0)))
    for mate in model.cats.near(patch, model.radius):
        cat.mark = met(cat.mark, mate.id)
    for near in model.world.neighbours(cat, 2):
        cat.mark = met(cat.mark, 7 * near.x + near.y + 1000)
    for near in model.world.neighbours4(patch):
        cat.mark = met(cat.mark, 7 * near.x + near.y + 1000)
    cat.mark = met(cat.mark, len(model.world.neighbours(patch)))


def walk(model, rng):
    for cat in model.cats:
        if model.world.width * model.world.height > 1:
            spot = model.world.neighbours(cat).one_of(rng)
            model.world.move_to(cat, spot.x, spot.y)
            cat.mark = met(cat.mark, len(model.cats.on(cat)))


RULES = (arrange, look, walk)


class Round(Model):
    width: int = parameter(5, low=1)
    height: int = parameter(5, low=1)
    least: int = parameter(6, low=0)
    most: int = parameter(14, low=0)
    radius: float = 0.0
    world = Grid("width", "height", True, Patch)
    flock = Population(Bird, 0)
    cats = Population(Cat, 2)
    schedule = tuple(once(rule) for rule in RULES)


class Walled(Round):
    world = Grid("width", "height", False, Patch)


class Pipe(Round):
    world = Grid("width", "height", "y", Patch)


class Naive:
    """The same society over lists."""

    def __init__(self, society, wraps, rules=RULES):
        self.society, self.rules = society, rules
        self.world = NaiveWorld(society.width, society.height, wraps)
        self.least, self.most, self.radius = society.least, society.most, 0.0
        self.flock = NaiveFlock(self.world, x=0.0, y=0.0, mark=0, way=0.0)
        self.cats = NaiveFlock(self.world, x=0.0, y=0.0, mark=0)
        for _ in range(2):
            self.cats.add()
        self.tick = 0

    def advance(self):
        rng = Stream(self.society.seed)
        for rule, phase in zip(self.rules, self.society.program.schedule, strict=True):
            rng.begin(phase.tag, 0, self.tick)
            rule(self, rng)
        self.tick += 1
        self.flock.agents = list(self.flock)


SIZES = [(1, 1), (1, 2), (2, 1), (2, 2), (2, 3), (3, 3), (4, 1), (5, 4), (3, 11), (9, 8), (20, 17)]
"""Of worlds; each is tried with few and with many agents."""
CROWDS = [(2, 4, 150), (6, 14, 150), (25, 60, 8)]
"""Of birds: at least, at most, and for how many ticks."""


def found(society):
    return {
        "birds": [(one.id, one.mark, one.way, one.x, one.y) for one in society.flock],
        "cats": [(one.id, one.mark, one.x, one.y) for one in society.cats],
    }


@pytest.mark.parametrize(("kind", "wraps"), [(Round, True), (Walled, False), (Pipe, "y")])
def test_all_find_the_same(kind, wraps):
    seed = 0
    for width, height in SIZES:
        for least, most, ticks in CROWDS:
            seed += 1
            given = {"width": width, "height": height, "least": least, "most": most}
            fast, slow = (kind(seed=seed, compiled=one, **given) for one in (True, False))
            naive = Naive(fast, wraps)
            for tick in range(ticks):
                fast.advance()
                naive.advance()
                assert found(fast) == found(naive), (given, tick)
                if tick < ticks // 10:
                    slow.advance()
                    assert found(slow) == found(naive), (given, tick)


def test_the_worlds_are_ten_thousand():
    assert 3 * len(SIZES) * sum(ticks for _, _, ticks in CROWDS) > 10_000


def test_a_resumed_run_is_the_run():
    given = {"width": 9, "height": 7, "least": 20, "most": 40}
    whole = Walled(seed=5, **given)
    whole.advance(12)
    part = Walled(seed=5, **given)
    for _ in range(4):
        part.advance(3)
        state = part.state()
        part = Walled(seed=5, **given)
        part.restore(state)
    assert found(part) == found(whole)
    for name, array in whole.state().items():
        np.testing.assert_array_equal(array, part.state()[name], err_msg=name)


def settle(citizen, model, rng):
    spot = model.world.one_free(rng)
    model.world.move_to(citizen, spot.x, spot.y)
    citizen.group = citizen.id % 2


def stay_or_move(citizen, model, rng):
    alike = 0
    for other in model.citizens.neighbours(citizen, 2):
        alike += int(other.group == citizen.group)
    citizen.alike = alike
    if alike < 6:
        spot = model.world.one_free(rng)
        model.world.move_to(citizen, spot.x, spot.y)


class Citizen(Agent):
    group: int = 0
    alike: int = 0


class Town(Model):
    world = Grid(12, 9, wraps=False, one_per_patch=True)
    citizens = Population(Citizen, 70)
    setup = (each(citizens, settle),)
    schedule = (each(citizens, stay_or_move),)


def test_those_who_move_in_one_step_are_found_where_they_are():
    fast, slow = Town(seed=2), Town(seed=2, compiled=False)
    for _ in range(5):
        fast.advance()
        slow.advance()
        assert fast.citizens.alike.tolist() == slow.citizens.alike.tolist()
        assert fast.citizens.x.tolist() == slow.citizens.x.tolist()


def test_users_find_what_rules_find():
    for kind, wraps in ((Round, True), (Walled, False), (Pipe, "y")):
        society = kind(seed=3, width=6, height=5, least=15, most=30, compiled=False)
        naive = Naive(society, wraps)
        for _ in range(5):
            society.advance()
            naive.advance()
            for bird, twin in zip(society.flock, naive.flock, strict=True):
                for radius in (0.0, 0.5, 2.0, 50.0):
                    near = [one.id for one in society.flock.near(bird, radius)]
                    assert near == [one.id for one in naive.flock.near(twin, radius)]
                for one, other in ((society.flock, naive.flock), (society.cats, naive.cats)):
                    nearest, same = one.nearest(bird), other.nearest(twin)
                    assert (nearest and nearest.id) == (same and same.id)
                    assert [a.id for a in one.on(bird)] == [a.id for a in other.on(twin)]
                    around = [a.id for a in one.neighbours(bird, 2)]
                    assert around == [a.id for a in other.neighbours(twin, 2)]
