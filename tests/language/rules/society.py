"""The society in which the constructs of the rule language are tried."""
# ruff: noqa

import numpy as np

from coglogo_py import CognitiveScheme, Cogniton, Culturon, Group, Role
from socialmind import Agent, Model, Patch, Population, Torus, each, parameter


class Person(Agent):
    f: float = 0.0
    g: float = 0.0
    i: int = 0
    j: int = 0
    b: bool = False
    c: bool = False
    small: np.int16 = 0
    tiny: np.int8 = 0
    of: float | None = None
    oi: int | None = None
    ob: bool | None = None
    vf: list[float] = [0.0, 0.0, 0.0, 0.0]
    vi: list[int] = [0, 0, 0, 0, 0]
    vb: list[bool] = [False, False, False]


class House(Agent):
    rent: float = 1.0
    rooms: int = 2
    owner: int | None = None


class Land(Patch):
    grass: float = 1.0
    visits: np.int16 = 0
    taken: bool = False
    owner: int | None = None


def grow(person, model, rng):
    person.f += rng.random()
    person.mind.feed_back_from_plan("grow", 1)


def trade(person):
    person.f -= 1


def rest(person, model):
    person.g = model.price


SCHEME = CognitiveScheme(
    "society",
    (
        Cogniton("Hunger", start_value=1.0, influence={"grow": 2.0, "trade": 0.5}),
        Cogniton("Greed", start_value=2.0, influence={"trade": 1.0}, reinforcement={"grow": 0.5}),
        Cogniton("Sloth", starting=False, influence={"rest": 3.0}),
        Cogniton("Means", start_value=1.0, conditional=("trade",)),
    ),
    (
        Group(
            "Family",
            (
                Role("Parent", (Culturon("Care", influence={"rest": 1.0}),)),
                Role("Child", (Culturon("Play", start_value=0.5, influence={"grow": 1.0}),)),
            ),
        ),
    ),
)


class Society(Model):
    """Persons with minds, houses, a small world, parameters and variables of every kind."""

    price: float = parameter(2.5, low=0.0)
    years: int = parameter(7)
    war: bool = parameter(False)
    case: int = parameter(0)
    total: float = 0.0
    count: int = 0
    open: bool = False
    last: int | None = None
    board: list[float] = [0.0, 1.0, 2.0]
    persons = Population(Person, 7, mind=SCHEME, plans={"grow": grow, "trade": trade, "rest": rest})
    houses = Population(House, 3)
    world = Torus(9, Land)


def begin(person, model, rng):
    """Give every field a value that differs from agent to agent and from tick to tick."""
    k = person.id * 3 + model.tick * 7
    person.f = k % 11 - 4.5
    person.g = rng.uniform(-3, 3)
    person.i = k % 13 - 5
    person.j = rng.integers(1, 9)
    person.b = k % 2 == 0
    person.c = k % 3 == 0
    person.small = k % 100
    person.tiny = k % 20
    if k % 4 == 0:
        person.oi = None
        person.of = None
    else:
        person.oi = k % 17
        person.of = k / 4
    person.ob = k % 5 == 0
    person.x = rng.uniform(-4, 4)
    person.y = rng.uniform(-4, 4)
    person.heading = rng.uniform(0, 360)
    for n in range(4):
        person.vf[n] = n * 0.75 - person.g
    for n in range(5):
        person.vi[n] = k % (n + 2) - n
    for n in range(3):
        person.vb[n] = (k + n) % 2 == 0
