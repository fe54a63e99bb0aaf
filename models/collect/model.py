"""A robot that collects objects: it picks one up and brings it to the drop zone (thesis, 6.1).

The world is the standard benchmark of this project: an arena with a field of square obstacles, an
object that reappears elsewhere when it was delivered, and a drop zone.
"""

import math

from socialmind import Model, Population, each, parameter
from socialmind.worlds.plane import (
    BALL,
    Body,
    Disc,
    Obstacle,
    Plane,
    RangeFinder,
    Robot,
    Zone,
    claw,
    collision,
    in_claw,
    in_zone,
    inside,
    moved,
    orientation,
    paid,
    wheel,
)

SPACING = 18.0  # units between the cells of the field of obstacles
SIDE = 8  # cells along a side
JITTER = 1.0  # units that an obstacle stands off the middle of its cell at most
SMALLEST, LARGEST = 1.0, 3.0  # half-widths of obstacles
ZONE_X, ZONE_Y, ZONE_HALF_WIDTH = -40.0, -40.0, 5.0
FREE = 2.0  # units around the start without obstacles
FROM_WALLS, FROM_OBSTACLES, FROM_ZONE = 10.0, 4.0, 50.0  # units that objects keep away
RANGE_FINDERS = (0.0, 22.5, 45.0, 90.0, 135.0, 180.0, 225.0, 270.0, 315.0, 337.5)  # degrees


class Collector(Robot):
    """The robot, and how many objects it has delivered."""

    delivered: int = 0


class Ball(Body):
    """The object, and whether the robot has picked it up."""

    lifted: bool = False


def strew(obstacle, model, rng):
    """Put an obstacle near the middle of its cell."""
    obstacle.x = (obstacle.id // SIDE) * SPACING - model.half_width + rng.uniform(-JITTER, JITTER)
    obstacle.y = (obstacle.id % SIDE) * SPACING - model.half_width + rng.uniform(-JITTER, JITTER)
    obstacle.angle = rng.uniform(0, math.pi)
    obstacle.half_width = rng.uniform(SMALLEST, LARGEST)


def lay(obstacle, model, rng):
    """Put an obstacle near the middle of its cell, unless start or drop zone are there."""
    strew(obstacle, model, rng)
    size = obstacle.half_width
    near_start = math.hypot(obstacle.x, obstacle.y) < size + FREE
    if near_start or away(obstacle, ZONE_X, ZONE_Y) < size + ZONE_HALF_WIDTH:
        obstacle.die()


def mark(zone):
    """Put the drop zone in its place."""
    zone.x = ZONE_X
    zone.y = ZONE_Y
    zone.half_width = ZONE_HALF_WIDTH


def start(robot, rng):
    """Turn the robot to a random direction."""
    robot.angle = rng.uniform(-math.pi, math.pi)


def place(ball, model, rng):
    """Put the object where it is free, and the robot has a way to go."""
    free = False
    while not free:
        edge = model.half_width - FROM_WALLS
        ball.x = rng.uniform(-edge, edge)
        ball.y = rng.uniform(-edge, edge)
        free = away(ball, ZONE_X, ZONE_Y) > FROM_ZONE
        for obstacle in model.obstacles:
            if away(ball, obstacle.x, obstacle.y) < obstacle.half_width * 1.4143 + FROM_OBSTACLES:
                free = False
    ball.vx = 0
    ball.vy = 0


def deliver(ball, model, rng):
    """Count an object that the robot lets go in the drop zone, and put it elsewhere."""
    if ball.carrier >= 0:
        ball.lifted = True
    elif ball.lifted:
        ball.lifted = False
        for zone in model.drop_zones:
            if in_zone(zone, ball.x, ball.y):
                for robot in model.robots:
                    robot.delivered += 1
                    robot.earned += 1
                    robot.restarted = True
                place(ball, model, rng)


def away(thing, x, y):
    """Return how far a thing is from a point."""
    return math.hypot(thing.x - x, thing.y - y)


SENSORS = {
    **{f"S{n}": RangeFinder(math.radians(angle)) for n, angle in enumerate(RANGE_FINDERS, 1)},
    "RADOBJ": orientation("objects"),
    "RADDZ": orientation("drop_zones"),
    "SENSOBJ": in_claw("objects"),
    "SENSDZ": inside("drop_zones"),
    "DOF": moved(),
}
ACTUATORS = {
    "MotL": wheel(at=(0.0, 1.0)),
    "MotR": wheel(at=(0.0, -1.0)),
    "EMAG": claw("objects"),
}


class Collect(Model):
    """A robot, an object, a drop zone and a field of obstacles."""

    ticks = 10_000

    half_width: float = parameter(70.0, unit="units", low=60.0, doc="from the middle to a border")

    world = Plane("half_width")
    obstacles = Population(Obstacle, SIDE * SIDE)
    drop_zones = Population(Zone, 1)
    objects = Population(Ball, 1, body=BALL)
    robots = Population(
        Collector,
        1,
        body=Disc(meets=("objects",)),
        sensors=SENSORS,
        actuators=ACTUATORS,
        hierarchy="mind",
    )

    rewards = {"delivered": paid()}
    interruptions = {"collision": collision()}

    setup = (
        each(obstacles, lay),
        each(drop_zones, mark),
        each(robots, start),
        each(objects, place),
    )
    schedule = (each(objects, deliver),)
