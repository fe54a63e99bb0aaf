"""What the robot learns about its battery, on top of what it knows (thesis, 6.3.2).

Two ways to give the hierarchy of `collect_retrained` the new task: its master is replaced
(Retrained), or becomes a subskill of another one (Encapsulated). `curriculum` teaches the second.
"""

from socialmind import Model, Population, each, parameter
from socialmind.catalogue import load_file, model_folder
from socialmind.learning import Curriculum, Lesson
from socialmind.mind import Input, MindDescription, Output, Perceptron, Skill
from socialmind.worlds.plane import (
    BALL,
    Disc,
    Obstacle,
    Plane,
    Zone,
    closing,
    collision,
    flat_battery,
    forward,
    paid,
    reached,
)

from .model import (
    ACTUATORS,
    BODY,
    COLLECT,
    SENSORS,
    lay,
    mark_power,
    start,
    use_power,
)

LESSONS = load_file(model_folder("collect") / "lessons.py")
POWER_SENSED = list(SENSORS).index("SENSPW")
MASTER = "CollectPower"


# Worlds -----------------------------------------------------------------------------------------


def put_supply(supply, model, rng):
    """Put the power supply somewhere in the empty arena."""
    LESSONS.leap(supply, model, rng, LESSONS.EDGE)


def put_supply_clear(supply, model, rng):
    """Put the power supply somewhere clear of obstacles."""
    LESSONS.leap_clear(supply, model, rng, supply.half_width)


def move_supply(supply, model, rng):
    """Move a power supply that the robot is in."""
    for robot in model.robots:
        if robot.readings[POWER_SENSED] > 0.5:
            robot.restarted = True
            LESSONS.leap(supply, model, rng, LESSONS.EDGE)


def pay_for_supply(supply, model, rng):
    """Pay for a power supply that the robot is in, and move it."""
    for robot in model.robots:
        if robot.readings[POWER_SENSED] > 0.5:
            robot.earned += 1
            LESSONS.leap_clear(supply, model, rng, supply.half_width)


class GoToPower(Model):
    """Going to the power supply in an empty arena."""

    ticks = 600

    world = Plane(LESSONS.ARENA)
    drop_zones = Population(Zone, 0)
    supplies = Population(Zone, 1)
    objects = Population(COLLECT.Ball, 0, body=BALL)
    robots = Population(
        COLLECT.Collector, 1, body=Disc(), sensors=SENSORS, actuators=ACTUATORS, hierarchy="mind"
    )
    rewards = {
        "closing": closing("supplies", gain=0.001),
        "reached": reached("SENSPW", 0.5),
        "forward": forward(0.0005),
    }
    setup = (each(robots, start), each(supplies, put_supply))
    schedule = (each(supplies, move_supply),)


class GoToPowerAvoid(Model):
    """Going to the power supply among obstacles; a collision ends it."""

    ticks = 2000

    half_width: float = parameter(
        LESSONS.ARENA, unit="units", low=60.0, doc="from the middle to a border"
    )
    world = Plane("half_width")
    obstacles = Population(Obstacle, COLLECT.SIDE * COLLECT.SIDE)
    drop_zones = Population(Zone, 0)
    supplies = Population(Zone, 1)
    objects = Population(COLLECT.Ball, 0, body=BALL)
    robots = Population(
        COLLECT.Collector, 1, body=Disc(), sensors=SENSORS, actuators=ACTUATORS, hierarchy="mind"
    )
    rewards = {"reached": paid()}
    interruptions = {"collision": collision()}
    setup = (each(obstacles, COLLECT.lay), each(robots, start), each(supplies, put_supply_clear))
    schedule = (each(supplies, pay_for_supply),)


class CollectWithPower(Model):
    """The whole task; a collision or a flat battery ends it."""

    ticks = 10_000

    half_width: float = parameter(
        LESSONS.ARENA, unit="units", low=60.0, doc="from the middle to a border"
    )
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


# Minds ------------------------------------------------------------------------------------------


def with_power(mind: MindDescription) -> MindDescription:
    """Return a mind with the two skills of going to the power supply, not learned yet."""
    goes, dodges = mind.skills["GoToDropZone"], mind.skills["GoToDropZone+Avoid"]
    read = [Input.parse("SE:RADPW") if str(one) == "SE:RADDZ" else one for one in dodges.inputs]
    skills = [
        Skill("GoToPower", [Input.parse("SE:RADPW")], goes.outputs, goes.function),
        Skill(
            "GoToPower+Avoid",
            read,
            [Output.parse("SK:GoToPower"), Output.parse("SK:Avoid")],
            dodges.function,
        ),
    ]
    return mind.with_modules(sensors=["RADPW", "SENSPW", "BATTERY"], skills=skills)


def encapsulated(mind: MindDescription) -> MindDescription:
    """Return a mind in which Collect is a subskill of a new master (figure 6.7, right)."""
    master = Skill(
        MASTER,
        ["SE:BATTERY", "SE:SENSPW"],
        ["SK:Collect", "SK:GoToPower+Avoid"],
        Perceptron(layers=2),
    )
    return with_power(mind).with_modules(skills=[master])


def retrained(mind: MindDescription) -> MindDescription:
    """Return a mind in which a new master takes the place of Collect (figure 6.7, left)."""
    collect = mind.skills["Collect"]
    master = Skill(
        MASTER,
        [*collect.inputs, Input.parse("SE:BATTERY"), Input.parse("SE:SENSPW")],
        [*collect.outputs, Output.parse("SK:GoToPower+Avoid")],
        Perceptron(layers=2),
    )
    return with_power(mind).with_modules(skills=[master], without=["Collect"])


def known(folder: str) -> MindDescription:
    """Return the mind of a model as it was learned."""
    return MindDescription.load(model_folder(folder) / "mind")


lessons = (
    Lesson("GoToPower", GoToPower, repetitions=4, generations=75, settings=LESSONS.COARSE),
    Lesson(
        "GoToPower+Avoid", GoToPowerAvoid, repetitions=10, generations=40, settings=LESSONS.FINE
    ),
    Lesson(MASTER, CollectWithPower, repetitions=8, generations=15, settings=LESSONS.FINE),
)
"""What is learned in either way."""

curriculum = Curriculum(lessons, mind=encapsulated(known("collect_retrained")))
