"""A robot that collects objects and steers for one target, which a variable holds (thesis, 7.1).

The world of `collect` with several objects in it. What is measured is how far the robot goes for
each object that it brings home, against a hierarchy that has a skill for each goal.
"""

import math

from socialmind import Model, Population, each, parameter
from socialmind.catalogue import load_file, model_folder
from socialmind.worlds.plane import (
    BALL,
    Disc,
    Obstacle,
    Plane,
    Zone,
    against,
    collision,
    paid,
    ratio,
    survived,
    total,
)

COLLECT = load_file(model_folder("collect") / "model.py")
PLAIN = model_folder("collect_retrained") / "mind"
"""The hierarchy with a skill for each goal."""


class Carrier(COLLECT.Collector):
    """The robot, how far it has gone, and how far it had when it last delivered an object."""

    gone: float = 0.0
    path: float = 0.0
    counted: int = 0
    last_x: float = 0.0
    last_y: float = 0.0


def pace(robot):
    """Add up the robot's way; the way to an object that is still to be delivered does not count."""
    robot.gone += math.hypot(robot.x - robot.last_x, robot.y - robot.last_y)
    robot.last_x = robot.x
    robot.last_y = robot.y
    if robot.delivered > robot.counted:
        robot.counted = robot.delivered
        robot.path = robot.gone


class TargetVariable(Model):
    """A robot, some objects, a drop zone and a field of obstacles."""

    ticks = 10_000

    half_width: float = parameter(70.0, unit="units", low=60.0, doc="from the middle to a border")
    number: int = parameter(3, unit="objects", low=1, high=20, doc="in the arena at any time")

    world = Plane("half_width")
    obstacles = Population(Obstacle, COLLECT.SIDE * COLLECT.SIDE)
    drop_zones = Population(Zone, 1)
    objects = Population(COLLECT.Ball, "number", body=BALL)
    robots = Population(
        Carrier,
        1,
        body=Disc(meets=("objects",)),
        sensors=COLLECT.SENSORS,
        actuators=COLLECT.ACTUATORS,
        hierarchy="mind",
    )

    rewards = {"delivered": paid()}
    interruptions = {"collision": collision()}
    measures = {
        "path_ratio": against(ratio("path", "delivered"), mind=PLAIN),
        "path": ratio("path", "delivered"),
        "objects": total("delivered"),
        "survived": survived(),
        "collisions": total("collisions"),
    }

    setup = (
        each(obstacles, COLLECT.lay),
        each(drop_zones, COLLECT.mark),
        each(robots, COLLECT.start),
        each(objects, COLLECT.place),
    )
    schedule = (each(objects, COLLECT.deliver), each(robots, pace))
