"""What the hierarchy is compared with: one skill that does everything, and learning all at once."""

from __future__ import annotations

from dataclasses import replace

from socialmind import Model, Population, each, parameter
from socialmind.catalogue import load_file, model_folder
from socialmind.mind import MindDescription, Output, Perceptron, Skill
from socialmind.worlds.plane import (
    BALL,
    Disc,
    Obstacle,
    Plane,
    Reward,
    Zone,
    clear,
    closing,
    collision,
    collision_cost,
    exploring,
    forward,
    paid,
    straight,
)

LESSONS = load_file(model_folder("collect") / "lessons.py")
MONOLITH = "Monolith"
ADDED = 7
"""Neurons that a hidden layer has more than inputs: as many weights in all as the hierarchy."""


def arriving(reading, memory, amount):
    """Pay for a target when it is reached, not for staying there."""
    arrives = reading > 0.5 and memory[0] < 0.5
    memory[0] = reading
    return amount if arrives else 0.0


def arrival(sensor: str) -> Reward:
    """Return the reward for reaching what a sensor tells of, as large as in the lessons."""
    return Reward(arriving, sensor=sensor, memory=1, settings={"amount": 0.5})


class AllAtOnce(Model):
    """The final world with the rewards of all lessons together (thesis, 6.1.4)."""

    ticks = 5000

    half_width: float = parameter(
        LESSONS.ARENA, unit="units", low=60.0, doc="from the middle to a border"
    )
    world = Plane("half_width")
    obstacles = Population(Obstacle, LESSONS.SIDE * LESSONS.SIDE)
    drop_zones = Population(Zone, 1)
    objects = Population(LESSONS.Ball, 1, body=BALL)
    robots = Population(
        LESSONS.Collector,
        1,
        body=Disc(meets=("objects",)),
        sensors=LESSONS.SENSORS,
        actuators=LESSONS.ACTUATORS,
        hierarchy=model_folder("collect") / "mind",
    )
    rewards = {
        "closing object": closing("objects", gain=0.001),
        "reached object": arrival("SENSOBJ"),
        "closing zone": closing("drop_zones", gain=0.001),
        "reached zone": arrival("SENSDZ"),
        "exploring": exploring(1.0, side=10.0, cells=14),
        "straight": straight(0.002),
        "clear": clear(LESSONS.AROUND, threshold=0.5, gain=0.004),
        "forward": forward(0.001),
        "collision": collision_cost(20.0),
        "delivered": paid(),
    }
    interruptions = {"collision": collision()}
    setup = (
        each(obstacles, LESSONS.lay),
        each(drop_zones, LESSONS.mark),
        each(robots, LESSONS.start),
        each(objects, LESSONS.place),
    )
    schedule = (each(objects, LESSONS.deliver),)


def hierarchy() -> MindDescription:
    """The hierarchy of figure 6.1, nothing learned."""
    mind = MindDescription.load(model_folder("collect") / "mind")
    return mind.with_modules(skills=[replace(one, genome=None) for one in mind.skills.values()])


def monolith() -> MindDescription:
    """One network with the inputs and outputs of the hierarchy, and three hidden layers."""
    whole = hierarchy()
    claw = whole.skills["ClawControl"]
    learned = [one for one in whole.skills.values() if one.genome_size]
    read = {str(one): one for skill in learned for one in skill.inputs}
    inputs = [read[name] for name in sorted(read)]
    outputs = [Output.parse(name) for name in ("MO:MotL", "MO:MotR", "SK:ClawControl")]
    skill = Skill(MONOLITH, inputs, outputs, Perceptron(layers=3, added=ADDED))
    return MindDescription(
        MONOLITH,
        list(whole.sensors.values()),
        list(whole.actuators.values()),
        list(whole.variables.values()),
        [skill, claw],
    )
