"""What the robot learns, one lesson at a time (thesis, 5.3.3 and 6.1.2).

Each class is a world with its rewards and interruptions; `curriculum` says which skill learns in
which of them, in what order and for how long. The robot has the same body in all of them; a sensor
of what a world does not have reads as if there were none in sight.
"""

from socialmind import Model, Population, each, parameter
from socialmind.learning import Curriculum, Lesson
from socialmind.worlds.plane import (
    BALL,
    Disc,
    Obstacle,
    Plane,
    Zone,
    clear,
    closing,
    collision,
    collision_cost,
    exploring,
    forward,
    paid,
    reached,
    straight,
)

from .model import (
    ACTUATORS,
    RANGE_FINDERS,
    SENSORS,
    SIDE,
    Ball,
    Collector,
    away,
    deliver,
    lay,
    mark,
    place,
    start,
)

ARENA = 70.0  # units from the middle to a border
LEAP = 8.0  # units that a target is moved away from the robot at least
EDGE = 12.0  # units from the middle within which targets of an empty arena are
WIDE = 60.0  # and those among obstacles
OBJECT_SENSED = list(SENSORS).index("SENSOBJ")
ZONE_SENSED = list(SENSORS).index("SENSDZ")
AROUND = tuple(f"S{number}" for number in range(1, len(RANGE_FINDERS) + 1))


# Targets that move on when they are reached ------------------------------------------------------


def leap(target, model, rng, edge):
    """Put a target anywhere but near the robot."""
    near = True
    while near:
        target.x = rng.uniform(-edge, edge)
        target.y = rng.uniform(-edge, edge)
        near = False
        for robot in model.robots:
            if away(robot, target.x, target.y) < LEAP:
                near = True


def leap_clear(target, model, rng, margin):
    """Put a target where no obstacle is nearer than a margin, not near the robot."""
    blocked = True
    while blocked:
        leap(target, model, rng, WIDE)
        blocked = False
        for obstacle in model.obstacles:
            if away(target, obstacle.x, obstacle.y) < obstacle.half_width * 1.4143 + margin:
                blocked = True


def put_object(ball, model, rng):
    """Put the object somewhere in the empty arena."""
    leap(ball, model, rng, EDGE)


def put_zone(zone, model, rng):
    """Put the drop zone somewhere in the empty arena."""
    leap(zone, model, rng, EDGE)


def put_object_clear(ball, model, rng):
    """Put the object somewhere clear of obstacles."""
    leap_clear(ball, model, rng, 4.0)


def put_zone_clear(zone, model, rng):
    """Put the drop zone somewhere clear of obstacles."""
    leap_clear(zone, model, rng, zone.half_width)


def move_object(ball, model, rng):
    """Move an object that the claw can reach."""
    for robot in model.robots:
        if robot.readings[OBJECT_SENSED] > 0.5:
            robot.restarted = True
            leap(ball, model, rng, EDGE)


def move_zone(zone, model, rng):
    """Move a drop zone that the robot is in."""
    for robot in model.robots:
        if robot.readings[ZONE_SENSED] > 0.5:
            robot.restarted = True
            leap(zone, model, rng, EDGE)


def pay_for_object(ball, model, rng):
    """Pay for an object that the claw can reach, and move it."""
    for robot in model.robots:
        if robot.readings[OBJECT_SENSED] > 0.5:
            robot.earned += 1
            leap_clear(ball, model, rng, 4.0)


def pay_for_zone(zone, model, rng):
    """Pay for a drop zone that the robot is in, and move it."""
    for robot in model.robots:
        if robot.readings[ZONE_SENSED] > 0.5:
            robot.earned += 1
            leap_clear(zone, model, rng, zone.half_width)


# Worlds -----------------------------------------------------------------------------------------


def learner(meets=()):
    """Return the robot that learns, and what it bumps into besides obstacles and borders."""
    body = Disc(meets=meets)
    return Population(
        Collector, 1, body=body, sensors=SENSORS, actuators=ACTUATORS, hierarchy="mind"
    )


class GoToObject(Model):
    """Going to the object in an empty arena."""

    ticks = 600

    world = Plane(ARENA)
    drop_zones = Population(Zone, 0)
    objects = Population(Ball, 1, body=BALL)
    robots = learner()
    rewards = {"closing": closing("objects", gain=0.001), "reached": reached("SENSOBJ", 0.5)}
    setup = (each(robots, start), each(objects, put_object))
    schedule = (each(objects, move_object),)


class GoToDropZone(Model):
    """Going to the drop zone in an empty arena."""

    ticks = 600

    world = Plane(ARENA)
    drop_zones = Population(Zone, 1)
    objects = Population(Ball, 0, body=BALL)
    robots = learner()
    rewards = {
        "closing": closing("drop_zones", gain=0.001),
        "reached": reached("SENSDZ", 0.5),
        # The zone can be backed into as well; but the range finders look ahead.
        "forward": forward(0.0005),
    }
    setup = (each(robots, start), each(drop_zones, put_zone))
    schedule = (each(drop_zones, move_zone),)


class Avoid(Model):
    """Moving about among obstacles; a collision costs much and ends it."""

    ticks = 2000

    half_width: float = parameter(ARENA, unit="units", low=60.0, doc="from the middle to a border")
    world = Plane("half_width")
    obstacles = Population(Obstacle, SIDE * SIDE)
    drop_zones = Population(Zone, 0)
    objects = Population(Ball, 0, body=BALL)
    robots = learner()
    rewards = {
        "exploring": exploring(1.0, side=10.0, cells=14),
        "straight": straight(0.002),
        "clear": clear(AROUND, threshold=0.5, gain=0.004),
        "forward": forward(0.001),
        "collision": collision_cost(20.0),
    }
    interruptions = {"collision": collision()}
    setup = (each(obstacles, lay), each(robots, start))


class GoToObjectAvoid(Model):
    """Going to the object among obstacles; a collision ends it."""

    ticks = 2000

    half_width: float = parameter(ARENA, unit="units", low=60.0, doc="from the middle to a border")
    world = Plane("half_width")
    obstacles = Population(Obstacle, SIDE * SIDE)
    drop_zones = Population(Zone, 0)
    objects = Population(Ball, 1, body=BALL)
    robots = learner()
    rewards = {"reached": paid()}
    interruptions = {"collision": collision()}
    setup = (each(obstacles, lay), each(robots, start), each(objects, put_object_clear))
    schedule = (each(objects, pay_for_object),)


class GoToDropZoneAvoid(Model):
    """Going to the drop zone among obstacles; a collision ends it."""

    ticks = 2000

    half_width: float = parameter(ARENA, unit="units", low=60.0, doc="from the middle to a border")
    world = Plane("half_width")
    obstacles = Population(Obstacle, SIDE * SIDE)
    drop_zones = Population(Zone, 1)
    objects = Population(Ball, 0, body=BALL)
    robots = learner()
    rewards = {"reached": paid()}
    interruptions = {"collision": collision()}
    setup = (each(obstacles, lay), each(robots, start), each(drop_zones, put_zone_clear))
    schedule = (each(drop_zones, pay_for_zone),)


class CollectObjects(Model):
    """The whole task; a collision ends it."""

    ticks = 5000

    half_width: float = parameter(ARENA, unit="units", low=60.0, doc="from the middle to a border")
    world = Plane("half_width")
    obstacles = Population(Obstacle, SIDE * SIDE)
    drop_zones = Population(Zone, 1)
    objects = Population(Ball, 1, body=BALL)
    robots = learner(meets=("objects",))
    rewards = {"delivered": paid()}
    interruptions = {"collision": collision()}
    setup = (
        each(obstacles, lay),
        each(drop_zones, mark),
        each(robots, start),
        each(objects, place),
    )
    schedule = (each(objects, deliver),)


# Lessons ----------------------------------------------------------------------------------------

COARSE = {
    "population": 200,
    "selected": 0.2,
    "elite": 5,
    "mutation": 0.3,
    "step": 2.0,
    "narrowing": 0.98,
}
"""For the small networks of base skills: large steps, out of the habit of turning one way."""
FINE = {
    "population": 100, "selected": 0.2, "elite": 5, "mutation": 0.05, "step": 1.0, "narrowing": 0.96
}  # fmt: skip

curriculum = Curriculum(
    (
        Lesson("GoToObject", GoToObject, repetitions=4, generations=75, settings=COARSE),
        Lesson("GoToDropZone", GoToDropZone, repetitions=4, generations=75, settings=COARSE),
        Lesson("Avoid", Avoid, repetitions=6, generations=60, settings=FINE),
        Lesson("GoToObject+Avoid", GoToObjectAvoid, repetitions=10, generations=40, settings=FINE),
        Lesson(
            "GoToDropZone+Avoid", GoToDropZoneAvoid, repetitions=10, generations=40, settings=FINE
        ),
        Lesson("Collect", CollectObjects, repetitions=8, generations=10, settings=FINE),
    )
)
"""The six lessons of the thesis: some 2.5e8 ticks."""
