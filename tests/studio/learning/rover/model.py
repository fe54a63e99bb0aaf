"""A robot that may drive ahead in a small arena."""

from socialmind import Model, Population
from socialmind.mind import MindDescription, Perceptron, Skill
from socialmind.worlds.plane import Disc, Plane, RangeFinder, Robot, collision, forward, wheel

MIND = MindDescription(
    "rover",
    ["AHEAD"],
    ["MotL", "MotR"],
    skills=[Skill("Drive", ["SE:AHEAD"], ["MO:MotL", "MO:MotR"], Perceptron(layers=0))],
)


class Rover(Model):
    """One robot, paid for going ahead, until it meets a border."""

    ticks = 60
    world = Plane(20.0)
    rovers = Population(
        Robot,
        1,
        body=Disc(),
        sensors={"AHEAD": RangeFinder(0.0)},
        actuators={"MotL": wheel(at=(0.0, 1.0)), "MotR": wheel(at=(0.0, -1.0))},
        hierarchy=MIND,
    )
    rewards = {"forward": forward(0.01)}  # noqa: RUF012
    interruptions = {"collision": collision()}  # noqa: RUF012
