"""Robots that look for objects together and bring them home (thesis, 8.1).

Objects lie in clusters, and a robot sees them from near by only. Four robots of one mind spread out
to search; one that sees objects gives a signal that is heard far away, and the others come. When
nothing of a cluster lies about any more, another one appears elsewhere.
"""

import math

from socialmind import Agent, Model, Population, each, parameter
from socialmind.catalogue import load_file, model_folder
from socialmind.worlds.plane import (
    BALL,
    Body,
    Disc,
    Measure,
    Obstacle,
    Plane,
    RangeFinder,
    Zone,
    active,
    carrying,
    claw,
    emitter,
    in_zone,
    noise,
    orientation,
    paid,
    signal_active,
    signal_orientation,
    total,
    wheel,
)

COLLECT = load_file(model_folder("collect") / "model.py")

SIDE = 8  # obstacles along a side of the arena, before some are left out
JITTER = 6.0  # units that an obstacle stands off the middle of its cell at most
SMALLEST, LARGEST = 1.0, 3.0  # half-widths of obstacles
FREE = 12.0  # units around the middle, where the drop zone is, without obstacles
START = 9.0  # units from the middle within which robots start
FROM_WALLS, FROM_ZONE = 15.0, 50.0  # units that the middle of a cluster keeps away
FROM_OBSTACLES = 2.0  # units that objects keep away
TRIES = 50  # places that are tried for an object before it lies where it may
SQUARES = 24  # along a side of the map on which what was seen is noted
EVERY = 10  # ticks between two looks at what the robots see
UNSEEN = -1  # the tick of the first find before there was one


class Forager(COLLECT.Collector):
    """A robot, the objects it has delivered, and the signal that it emits."""

    signal: list[float] = [0.0]


class Ball(Body):
    """An object, and the identity of the robot that has picked it up, -1 for none."""

    lifter: int = -1


class Cluster(Agent):
    """The place where objects lie, and how many there have been."""

    number: int = 0


class Chart(Agent):
    """A map of the arena: which of its squares some robot has seen."""

    seen: list[bool] = [False] * (SQUARES * SQUARES)


# Setup --------------------------------------------------------------------------------------------


def lay(obstacle, model, rng):
    """Put an obstacle near the middle of its cell, unless the drop zone is there."""
    spacing = 2 * model.half_width / SIDE
    middle = 0.5 * spacing - model.half_width
    obstacle.x = (obstacle.id // SIDE) * spacing + middle + rng.uniform(-JITTER, JITTER)
    obstacle.y = (obstacle.id % SIDE) * spacing + middle + rng.uniform(-JITTER, JITTER)
    obstacle.angle = rng.uniform(0, math.pi)
    obstacle.half_width = rng.uniform(SMALLEST, LARGEST)
    if COLLECT.away(obstacle, 0, 0) < obstacle.half_width * 1.4143 + FREE:
        obstacle.die()


def start(robot, rng):
    """Put a robot somewhere in and around the drop zone, in a random direction."""
    far = rng.uniform(0, START)
    round_about = rng.uniform(-math.pi, math.pi)
    robot.x = far * math.cos(round_about)
    robot.y = far * math.sin(round_about)
    robot.angle = rng.uniform(-math.pi, math.pi)


# Objects ------------------------------------------------------------------------------------------


def renew(cluster, model, rng):
    """Let another cluster appear once no object lies about."""
    lying = 0
    for ball in model.objects:
        if ball.carrier < 0:
            lying += 1
    if lying == 0 and model.cluster_size > 0:
        cluster.number += 1
        choose(cluster, model, rng)
        for _ in range(model.cluster_size):
            ball = model.objects.create()
            place(ball, cluster, model, rng)


def choose(cluster, model, rng):
    """Find a place for a cluster, away from the walls and the drop zone."""
    edge = model.half_width - FROM_WALLS
    near = True
    while near:
        cluster.x = rng.uniform(-edge, edge)
        cluster.y = rng.uniform(-edge, edge)
        near = COLLECT.away(cluster, 0, 0) < FROM_ZONE


def place(ball, cluster, model, rng):
    """Put an object into the circle of its cluster, clear of obstacles."""
    blocked = True
    tries = 0
    while blocked and tries < TRIES:
        tries += 1
        far = model.spread * math.sqrt(rng.random())
        round_about = rng.uniform(-math.pi, math.pi)
        ball.x = cluster.x + far * math.cos(round_about)
        ball.y = cluster.y + far * math.sin(round_about)
        blocked = False
        for stone in model.obstacles:
            if COLLECT.away(ball, stone.x, stone.y) < stone.half_width * 1.4143 + FROM_OBSTACLES:
                blocked = True


def deliver(ball, model):
    """Count an object that a robot lets go in the drop zone; it leaves the world."""
    if ball.carrier >= 0:
        for robot in model.robots:
            if robot.carrying == ball.id:
                ball.lifter = robot.id
    elif ball.lifter >= 0:
        home = False
        for zone in model.drop_zones:
            if in_zone(zone, ball.x, ball.y):
                home = True
        if home:
            if model.robots.contains(ball.lifter):
                model.robots[ball.lifter].delivered += 1
                model.robots[ball.lifter].earned += 1
            ball.die()
        else:
            ball.lifter = -1


# What is measured ---------------------------------------------------------------------------------


def survey(chart, model):
    """Note what the robots see: squares of the map, and whether there are objects."""
    if model.tick % EVERY == 0:
        for robot in model.robots:
            model.covered += look_around(robot, chart, model.sight, model.half_width)
            if model.first_find == UNSEEN and robot.readings[OBJECTS_SEEN] > 0.5:
                model.first_find = model.tick


def look_around(robot, chart, sight, half_width):
    """Note the squares whose middles a robot sees, and return how many nobody has seen before."""
    side = 2 * half_width / SQUARES
    first = max(0, math.floor((robot.x - sight + half_width) / side))
    last = min(SQUARES - 1, math.floor((robot.x + sight + half_width) / side))
    low = max(0, math.floor((robot.y - sight + half_width) / side))
    high = min(SQUARES - 1, math.floor((robot.y + sight + half_width) / side))
    found = 0
    for column in range(first, last + 1):
        for row in range(low, high + 1):
            x = (column + 0.5) * side - half_width
            y = (row + 0.5) * side - half_width
            place = row * SQUARES + column
            if math.hypot(x - robot.x, y - robot.y) <= sight and not chart.seen[place]:
                chart.seen[place] = True
                found += 1
    return found


def time_to_find(first_find, limit):
    """Return the tick of the first find; the limit where nothing was found."""
    return limit if first_find == UNSEEN else first_find


def share_covered(covered):
    """Return the share of the arena that some robot has seen."""
    return covered / SQUARES**2


# The world ----------------------------------------------------------------------------------------

SENSORS = {
    **{f"S{n}": RangeFinder(math.radians(a)) for n, a in enumerate(COLLECT.RANGE_FINDERS, 1)},
    **{name: COLLECT.SENSORS[name] for name in ("RADDZ", "SENSOBJ", "SENSDZ", "DOF")},
    "RADOBJ": orientation("objects", reach="sight"),
    "ACTOBJ": active("objects", reach="sight"),
    "HOLDS": carrying(),
    "RADBOT": orientation("robots", reach="company"),
    "ACTBOT": active("robots", reach="company"),
    "RADSIG": signal_orientation("robots", reach="hearing"),
    "ACTSIG": signal_active("robots", reach="hearing"),
    "NOISE": noise(every=30),
}
ACTUATORS = {
    "MotL": wheel(at=(0.0, 1.0)),
    "MotR": wheel(at=(0.0, -1.0)),
    "EMAG": claw("objects"),
    "SIGNAL": emitter(),
}
OBJECTS_SEEN = list(SENSORS).index("ACTOBJ")
BODY = Disc(meets=("objects",), seen=False)
MEASURES = {
    "objects": total("delivered"),
    "first_find": Measure(time_to_find),
    "area": Measure(share_covered),
    "collisions": total("collisions"),
}


class Foraging(Model):
    """Four robots, a cluster of objects, a drop zone in the middle and a field of obstacles."""

    ticks = 10_000

    half_width: float = parameter(120.0, unit="units", low=80.0, doc="from the middle to a border")
    n_robots: int = parameter(4, unit="robots", low=1, doc="that forage")
    cluster_size: int = parameter(8, unit="objects", low=0, doc="in a cluster; 0 for no objects")
    spread: float = parameter(10.0, unit="units", low=0.0, doc="radius of a cluster")
    sight: float = parameter(20.0, unit="units", low=0.0, doc="reach of the sensors of objects")
    company: float = parameter(
        100.0, unit="units", low=0.0, doc="reach of the sensors of robots; 0 for not seeing any"
    )
    hearing: float = parameter(
        200.0, unit="units", low=0.0, doc="reach of signals; 0 for hearing none"
    )
    covered: int = 0
    first_find: int = UNSEEN

    world = Plane("half_width")
    obstacles = Population(Obstacle, SIDE * SIDE)
    drop_zones = Population(Zone, 1)
    clusters = Population(Cluster, 1)
    charts = Population(Chart, 1)
    objects = Population(Ball, 0, body=BALL)
    robots = Population(
        Forager, "n_robots", body=BODY, sensors=SENSORS, actuators=ACTUATORS, hierarchy="mind"
    )

    rewards = {"delivered": paid()}
    measures = MEASURES

    setup = (each(obstacles, lay), each(robots, start), each(clusters, renew))
    schedule = (each(objects, deliver), each(clusters, renew), each(charts, survey))
