"""A robot that counts: it collects two objects, then validates, and again (thesis, 7.2).

The world of `collect` with a validation zone. Nothing in it tells how many objects the robot has
collected since it last validated; only a variable of its mind can.
"""

from socialmind import Model, Population, each, parameter
from socialmind.catalogue import load_file, model_folder
from socialmind.worlds.plane import (
    BALL,
    Disc,
    Interruption,
    Obstacle,
    Plane,
    Sense,
    Zone,
    collision,
    inside,
    orientation,
    paid,
    ratio,
    survived,
    total,
)

COLLECT = load_file(model_folder("collect") / "model.py")
away = COLLECT.away
VALID_X, VALID_Y, VALID_HALF_WIDTH = 55.0, 0.0, 5.0
MOST = 4  # objects of a sequence
SEQUENCE = 10.0  # what a correct sequence earns; an object earns 1


class Counting(COLLECT.Collector):
    """The robot, and what it has done since it last validated, and all in all."""

    wanted: int = 0
    collected: int = 0
    counted: int = 0
    validating: bool = False
    correct: int = 0
    ended: int = 0
    overdone: bool = False


def lay(obstacle, model, rng):
    """Put an obstacle near the middle of its cell, unless start or zones are there."""
    COLLECT.lay(obstacle, model, rng)
    if away(obstacle, VALID_X, VALID_Y) < obstacle.half_width + VALID_HALF_WIDTH:
        obstacle.die()


def mark_valid(zone):
    """Put the validation zone in its place."""
    zone.x = VALID_X
    zone.y = VALID_Y
    zone.half_width = VALID_HALF_WIDTH


def want(robot, model, rng):
    """Say how many objects the sequence that begins is to have."""
    robot.wanted = model.wanted
    if model.wanted == 0:
        robot.wanted = rng.integers(1, MOST + 1)


def start(robot, model, rng):
    """Turn the robot to a random direction, at the beginning of a sequence."""
    COLLECT.start(robot, rng)
    want(robot, model, rng)


def judge(robot, model, rng):
    """End a sequence on entering the validation zone, or with an object too many."""
    reckon(robot, model, rng, robot.readings[VALIDATES] > 0.5)


def reckon(robot, model, rng, validates):
    """Keep the score of a robot that is in the validation zone, or is not."""
    if robot.delivered > robot.counted:
        robot.collected += robot.delivered - robot.counted
        robot.counted = robot.delivered
        if robot.collected > robot.wanted:
            robot.ended += 1
            robot.overdone = True
    if validates and not robot.validating and robot.collected > 0:
        robot.ended += 1
        if robot.collected == robot.wanted:
            robot.correct += 1
            robot.earned += SEQUENCE
        robot.collected = 0
        want(robot, model, rng)
    robot.validating = validates


def wanted_share(robot):
    """Return how many objects are wanted, over the most that there can be."""
    return robot.wanted / MOST


def too_many(robot):
    """Return whether the robot has collected more than was wanted."""
    return robot.overdone


SENSORS = {
    **COLLECT.SENSORS,
    "RADVZ": orientation("validation_zones"),
    "SENSVZ": inside("validation_zones"),
    "WANTED": Sense(wanted_share),
}
VALIDATES = list(SENSORS).index("SENSVZ")
ACTUATORS = COLLECT.ACTUATORS
BODY = Disc(meets=("objects",))


class Counter(Model):
    """A robot, an object, a drop zone, a validation zone and a field of obstacles."""

    ticks = 10_000

    half_width: float = parameter(70.0, unit="units", low=60.0, doc="from the middle to a border")
    wanted: int = parameter(
        2, unit="objects", low=0, high=MOST, doc="of a sequence; 0 draws it anew for each"
    )

    world = Plane("half_width")
    obstacles = Population(Obstacle, COLLECT.SIDE * COLLECT.SIDE)
    drop_zones = Population(Zone, 1)
    validation_zones = Population(Zone, 1)
    objects = Population(COLLECT.Ball, 1, body=BALL)
    robots = Population(
        Counting, 1, body=BODY, sensors=SENSORS, actuators=ACTUATORS, hierarchy="mind"
    )

    rewards = {"earned": paid()}
    interruptions = {"collision": collision(), "too many": Interruption(too_many)}
    measures = {
        "correct_sequences": ratio("correct", "ended"),
        "sequences": total("correct"),
        "objects": total("delivered"),
        "survived": survived(),
        "collisions": total("collisions"),
    }

    setup = (
        each(obstacles, lay),
        each(drop_zones, COLLECT.mark),
        each(validation_zones, mark_valid),
        each(robots, start),
        each(objects, COLLECT.place),
    )
    schedule = (each(objects, COLLECT.deliver), each(robots, judge))
