"""A robot that drives straight on until it meets a border, and counts its tens of ticks."""

import math

from socialmind import Model, Population, each, parameter
from socialmind.mind import MindDescription, Perceptron, Skill
from socialmind.worlds.plane import (
    Disc,
    Measure,
    Plane,
    RangeFinder,
    Robot,
    collision,
    constant,
    flat_battery,
    forward,
    survived,
    total,
    wheel,
)


class Rover(Robot):
    """A robot that counts."""

    delivered: int = 0


def start(rover, rng):
    """Turn to a random direction."""
    rover.angle = rng.uniform(-math.pi, math.pi)


def count(rover, model):
    """Count the ticks: every tenth for the rover, all for the model."""
    if model.tick % 10 == 9:
        rover.delivered += 1
    model.counted += 1


def counted_share(counted, limit):
    """The share of the run that was counted."""
    return counted / limit


MIND = MindDescription(
    "rover",
    ["AHEAD"],
    ["MotL", "MotR"],
    skills=[Skill("Drive", [], ["MO:MotL", "MO:MotR"], Perceptron(layers=0), [1, 1])],
)


REWARDS = {"forward": forward(0.001)}
INTERRUPTIONS = {"battery": flat_battery(), "collision": collision()}
MEASURES = {
    "objects": total("delivered"),
    "survived": survived(),
    "collisions": total("rovers.collisions"),
    "counted": Measure(counted_share),
}


class Rovers(Model):
    """One robot in a small arena."""

    ticks = 45

    half_width: float = parameter(6.0, low=4.0)
    counted: int = 0

    world = Plane("half_width")
    rovers = Population(
        Rover,
        1,
        body=Disc(),
        sensors={"AHEAD": RangeFinder(0.0), "HALF": constant(0.5)},
        actuators={"MotL": wheel(at=(0.0, 1.0)), "MotR": wheel(at=(0.0, -1.0))},
        hierarchy=MIND,
    )
    rewards = REWARDS
    interruptions = INTERRUPTIONS
    measures = MEASURES
    setup = (each(rovers, start),)
    schedule = (each(rovers, count),)
