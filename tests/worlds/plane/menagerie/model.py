"""A world on a plane that has a bit of everything, small.

Two teams: collectors that carry balls, and scouts whose minds decide by a cogniton scheme and share
a variable. Balls are born and die, scouts hatch, a stone moves about; devices draw and remember.
"""

import math
from dataclasses import replace

from coglogo_py import CognitiveScheme, Cogniton
from coglogo_py.decision import WeightedStochastic
from socialmind import Model, Population, each, once, parameter
from socialmind.mind import MindDescription, Perceptron, Simple, Skill, Variable
from socialmind.mind.functions.cogniton_scheme import CognitonScheme
from socialmind.worlds.plane import (
    BALL,
    Body,
    Disc,
    Interruption,
    Obstacle,
    Plane,
    RangeFinder,
    Reward,
    Robot,
    Sense,
    Zone,
    claw,
    closing,
    distance_to,
    exploring,
    in_claw,
    in_zone,
    inside,
    moved,
    orientation,
    paid,
    wheel,
)


class Ball(Body):
    """What is carried about."""

    age: int = 0


class Collector(Robot):
    """A robot with a claw."""

    brought: int = 0


class Scout(Robot):
    """A robot that decides where to go."""

    generation: int = 0


def scatter(thing, model, rng):
    """Put something anywhere."""
    thing.x = rng.uniform(-0.9, 0.9) * model.half_width
    thing.y = rng.uniform(-0.9, 0.9) * model.half_width
    thing.angle = rng.uniform(-math.pi, math.pi)


def gather(scout, model, rng):
    """Put a scout anywhere, and let those of even identity be one group, the others another."""
    scatter(scout, model, rng)
    scout.hierarchy.join_group("band", scout.id % 2, 1.0 + scout.id)


def roll(stone, model, rng):
    """Move a stone now and then; obstacles are not bodies, a rule alone moves them."""
    if rng.random() < 0.02:
        scatter(stone, model, rng)


def live(ball, model, rng):
    """Let a ball be put down in a zone, grow old, and be born anew."""
    ball.age += 1
    for zone in model.zones:
        if ball.carrier_kind >= 0 and in_zone(zone, ball.x, ball.y):
            for collector in model.collectors:
                if collector.carrying == ball.id:
                    collector.brought += 1
                    collector.earned += 1
                    collector.restarted = True
    if ball.carrier_kind < 0 and (ball.age > 60 or rng.random() < 0.01):
        born = model.balls.create()
        scatter(born, model, rng)
        if rng.random() < 0.3:
            more = model.balls.create()
            scatter(more, model, rng)
            model.born += 1
        ball.die()


def breed(scout, model, rng):
    """Let a scout hatch now and then, and the old die."""
    if rng.random() < 0.01:
        child = scout.hatch()
        child.generation += 1
        scatter(child, model, rng)
    elif scout.generation > 1 and rng.random() < 0.05:
        scout.die()


def count(model):
    """Count the ticks."""
    model.clock += 0.5


def noise(robot, rng, memory, wide=0.1):
    """A sensor that draws and remembers."""
    memory[0] = 0.9 * memory[0] + wide * rng.random()
    return memory[0] + 0.01 * abs(robot.spin)


def crowded(found, distance, held, limit=0.2):
    """An interruption: a scout is in another one, which seldom happens."""
    return found and distance < limit and not held


def company(found, distance, reach_of=5.0):
    """A reward: for being near a collector."""
    return 0.01 * (reach_of - distance) if found and distance < reach_of else 0.0


CHOICE = CognitiveScheme(
    "choice",
    (
        Cogniton("NOISE", influence={"Left": 1.0, "Right": 0.5}, conditional=("Left", "Right")),
        Cogniton("Mood", influence={"Right": 2.0}),
    ),
    decision_maker=WeightedStochastic(),
)
WHEELS = ["MO:MotL", "MO:MotR"]
SCOUT = MindDescription(
    "scout",
    ["NOISE", "AHEAD"],
    ["MotL", "MotR"],
    [Variable("Mood", Simple(), 0.5, "band")],
    [
        Skill("Choose", ["SE:NOISE", "VA:Mood"], ["SK:Left", "SK:Right"], CognitonScheme(CHOICE)),
        Skill("Left", ["SE:AHEAD"], [*WHEELS, "VA:Mood"], Perceptron(layers=0),
              [0.5, 0.2, 0.0, 1.0, 0.3, 0.1]),
        Skill("Right", ["SH:AHEAD:3"], [*WHEELS, "VA:Mood"], Perceptron(layers=0),
              [0.2, 0.9, 0.5, 0.1, 0.9, -0.4]),
    ],
)  # fmt: skip
COLLECTOR = MindDescription(
    "collector",
    ["RADBALL", "GRIP", "RADZONE", "HOME"],
    ["MotL", "MotR", "EMAG"],
    skills=[
        Skill(
            "Collect",
            ["SE:RADBALL", "SE:GRIP", "SE:RADZONE", "SE:HOME"],
            [*WHEELS, "MO:EMAG"],
            Perceptron(layers=0),
        )
    ],
)


class Menagerie(Model):
    """Two teams, balls, zones and stones."""

    ticks = 150

    half_width: float = parameter(12.0, low=5.0)
    clock: float = 0.0
    born: int = 0

    world = Plane("half_width")
    stones = Population(Obstacle, 3)
    zones = Population(Zone, 1)
    balls = Population(Ball, 2, body=BALL)
    scouts = Population(
        Scout,
        3,
        body=Disc(radius=0.7, meets=("scouts", "collectors")),
        sensors={
            "NOISE": Sense(noise, memory=1),
            "AHEAD": RangeFinder(0.0),
            "MATE": distance_to("scouts", reach=10.0),
        },
        actuators={"MotL": wheel((0.0, 0.7)), "MotR": wheel((0.0, -0.7))},
        hierarchy=SCOUT,
        instances=2,
    )
    collectors = Population(
        Collector,
        2,
        body=Disc(meets=("balls",)),
        sensors={
            "RADBALL": orientation("balls"),
            "GRIP": in_claw("balls"),
            "LEFT": RangeFinder(1.0),
            "RADZONE": orientation("zones", reach=20.0),
            "HOME": inside("zones"),
            "DOF": moved(4, 5),
        },
        actuators={
            "MotL": wheel((0.0, 1.0)),
            "MotR": wheel((0.0, -1.0)),
            "EMAG": claw("balls"),
        },
        hierarchy=COLLECTOR,
        own_genomes=True,
    )

    rewards = {  # noqa: RUF012
        "closing": replace(closing("balls", 0.01), robots="collectors"),
        "brought": replace(paid(), robots="collectors"),
        "exploring": exploring(0.1, 4.0, 6),
        "company": Reward(company, of="collectors", robots="scouts"),
    }
    interruptions = {  # noqa: RUF012
        "crowded": Interruption(crowded, of="scouts", reach=1.0, robots="scouts")
    }

    setup = (
        each(stones, scatter),
        each(zones, scatter),
        each(balls, scatter),
        each(scouts, gather),
        each(collectors, scatter),
    )
    schedule = (each(balls, live), each(scouts, breed), each(stones, roll), once(count))
