"""Two robots that seek a ball, between two stones and a zone."""

from socialmind import Model, Population, each, parameter
from socialmind.mind import MindDescription, Perceptron, Skill
from socialmind.worlds.plane import (
    BALL,
    Body,
    Disc,
    Obstacle,
    Plane,
    RangeFinder,
    Robot,
    Zone,
    collision,
    orientation,
    wheel,
)


class Ball(Body):
    """What they seek."""


def lay(stone):
    """Put a square at (-2, 12), a cylinder at (8, 12)."""
    stone.x = 10.0 * stone.id - 2.0
    stone.y = 12.0
    stone.round = stone.id


def place(ball):
    """Put the ball below the robots, at the right."""
    ball.x = 15.0
    ball.y = -5.0


def start(robot):
    """Put the robots at (-8, 0) and (-2, 3), looking to the right."""
    robot.x = -8.0 + 6.0 * robot.id
    robot.y = 3.0 * robot.id


def mark(zone):
    """Put the zone at the lower left."""
    zone.x = -20.0
    zone.y = -20.0
    zone.angle = 0.3


MIND = MindDescription(
    "seeker",
    ["RADBALL"],
    ["MotL", "MotR"],
    skills=[
        Skill(
            "Seek", [], ["SK:Ahead", "SK:Turn", "SK:Idle"], Perceptron(layers=0), [0.75, 0.25, 0]
        ),
        Skill("Ahead", [], ["MO:MotL", "MO:MotR"], Perceptron(layers=0), [1, 1]),
        Skill("Turn", ["SE:RADBALL"], ["MO:MotL", "MO:MotR"], Perceptron(layers=0), [1, 0, -1, 1]),
        Skill("Idle", [], ["MO:MotL"], Perceptron(layers=0), [0.5]),
    ],
)


ENDS = {"collision": collision()}


class Seekers(Model):
    """Two robots, a ball, two stones and a zone."""

    ticks = 60

    half_width: float = parameter(30.0, low=20.0)

    world = Plane("half_width")
    stones = Population(Obstacle, 2)
    zones = Population(Zone, 1)
    balls = Population(Ball, 1, body=BALL)
    robots = Population(
        Robot,
        2,
        body=Disc(meets=("balls",)),
        sensors={
            "AHEAD": RangeFinder(0.0),
            "RADBALL": orientation("balls"),
            "LEFT": RangeFinder(1.5707963267948966, half_angle=0.0, rays=1),
            "RADZONE": orientation("zones", reach=25.0),
        },
        actuators={"MotL": wheel(at=(0.0, 1.0)), "MotR": wheel(at=(0.0, -1.0))},
        hierarchy=MIND,
    )

    interruptions = ENDS

    setup = (each(stones, lay), each(balls, place), each(robots, start), each(zones, mark))
