"""Rovers in a large arena, side by side; their minds let them go straight on, slowly."""

from socialmind import Model, Population, each, parameter
from socialmind.mind import MindDescription, Perceptron, Skill
from socialmind.worlds.plane import Disc, Plane, RangeFinder, Robot, wheel


class Rover(Robot):
    """A robot with two wheels and an eye ahead."""


def side_by_side(rover, model):
    """Put each in a lane of its own, looking east."""
    rover.x = -30.0
    rover.y = 15.0 * (rover.id % 4) - 20.0


MIND = MindDescription(
    "rover",
    ["AHEAD"],
    ["MotL", "MotR"],
    skills=[
        Skill("Top", ["SE:AHEAD"], ["SK:Drive"], Perceptron(layers=0), [0, 1]),
        Skill(
            "Drive",
            ["SE:AHEAD", "SH:AHEAD:2"],
            ["MO:MotL", "MO:MotR"],
            Perceptron(layers=0),
            [0, 0, 0.75, 0, 0, 0.75],
        ),
    ],
)


class Rovers(Model):
    """Some robots in an arena."""

    n: int = parameter(3, low=1, high=4)
    world = Plane(40.0)
    rovers = Population(
        Rover,
        "n",
        body=Disc(),
        sensors={"AHEAD": RangeFinder(0.0)},
        actuators={"MotL": wheel(at=(0.0, 1.0)), "MotR": wheel(at=(0.0, -1.0))},
        hierarchy=MIND,
    )

    setup = (each(rovers, side_by_side),)
