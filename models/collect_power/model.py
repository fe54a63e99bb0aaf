"""A robot that collects objects and has to look after its battery (thesis, 6.3).

The world of `collect` with a power supply: a zone in which the battery charges quickly. Doing
nothing, the robot lasts 2,000 ticks. It fails when it runs into something or the battery is flat.
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
    battery,
    collision,
    flat_battery,
    in_zone,
    inside,
    orientation,
    paid,
)

COLLECT = load_file(model_folder("collect") / "model.py")
POWER_X, POWER_Y, POWER_HALF_WIDTH = 40.0, 40.0, 5.0
CHARGE = 0.4  # of the battery at the start
CHARGING = 0.005  # that a tick in the power supply adds


def lay(obstacle, model, rng):
    """Put an obstacle near the middle of its cell, unless start, drop zone or supply are there."""
    COLLECT.lay(obstacle, model, rng)
    if COLLECT.away(obstacle, POWER_X, POWER_Y) < obstacle.half_width + POWER_HALF_WIDTH:
        obstacle.die()


def mark_power(supply):
    """Put the power supply in its place."""
    supply.x = POWER_X
    supply.y = POWER_Y
    supply.half_width = POWER_HALF_WIDTH


def start(robot, rng):
    """Turn the robot to a random direction, its battery not full."""
    robot.angle = rng.uniform(-math.pi, math.pi)
    robot.battery = CHARGE


def use_power(robot, model):
    """Charge the battery in the power supply, or else use some of it up."""
    charges = False
    for supply in model.supplies:
        if in_zone(supply, robot.x, robot.y):
            charges = True
    if charges:
        robot.battery = min(1.0, robot.battery + CHARGING)
    else:
        robot.battery = max(0.0, robot.battery - model.consumption)


SENSORS = {
    **COLLECT.SENSORS,
    "RADPW": orientation("supplies"),
    "SENSPW": inside("supplies"),
    "BATTERY": battery(),
}
ACTUATORS = COLLECT.ACTUATORS
BODY = Disc(meets=("objects",))


class CollectPower(Model):
    """A robot with a battery, an object, a drop zone, a power supply and a field of obstacles."""

    ticks = 20_000

    half_width: float = parameter(70.0, unit="units", low=60.0, doc="from the middle to a border")
    consumption: float = parameter(
        0.0002, unit="of the battery", low=0.0, high=1.0, doc="what a tick uses up"
    )

    world = Plane("half_width")
    obstacles = Population(Obstacle, COLLECT.SIDE * COLLECT.SIDE)
    drop_zones = Population(Zone, 1)
    supplies = Population(Zone, 1)
    objects = Population(COLLECT.Ball, 1, body=BALL)
    robots = Population(
        COLLECT.Collector, 1, body=BODY, sensors=SENSORS, actuators=ACTUATORS, hierarchy="mind"
    )
    rewards = {"delivered": paid()}
    interruptions = {"collision": collision(), "battery": flat_battery()}
    setup = (
        each(obstacles, lay),
        each(drop_zones, COLLECT.mark),
        each(supplies, mark_power),
        each(robots, start),
        each(objects, COLLECT.place),
    )
    schedule = (each(objects, COLLECT.deliver), each(robots, use_power))
