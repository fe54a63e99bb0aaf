"""What foraging robots learn on top of collecting (thesis, 8.1.2).

To reach a signal is learned alone, from a lamp that stands for a team mate. All the rest is learned
together: the robots of a world have one genome, and what they come to as a group judges it.
"""

from socialmind import Population, each
from socialmind.catalogue import load_file, model_folder
from socialmind.learning import Curriculum, Lesson
from socialmind.worlds.plane import (
    Disc,
    Robot,
    collision,
    collision_cost,
    paid,
    signal_active,
    signal_orientation,
)

from .minds import FORAGE, SEARCH, SEARCH_AVOID, SIGNAL, forager
from .model import COLLECT, SENSORS, Forager, Foraging, lay, look_around, start

LESSONS = load_file(model_folder("collect") / "lessons.py")
REACHED = 4.0  # units from a lamp at which it is reached
CLEAR = 4.0  # units that it keeps away from obstacles
MIDDLE = 60.0  # units around the middle in which it is put up


class Lamp(Robot):
    """What emits a signal in place of a team mate."""

    signal: list[float] = [1.0]


def put_up(lamp, model, rng):
    """Put the lamp where it is clear of obstacles, not near the robot."""
    blocked = True
    while blocked:
        lamp.x = rng.uniform(-MIDDLE, MIDDLE)
        lamp.y = rng.uniform(-MIDDLE, MIDDLE)
        blocked = False
        for robot in model.robots:
            if COLLECT.away(robot, lamp.x, lamp.y) < LESSONS.LEAP:
                blocked = True
        for stone in model.obstacles:
            if COLLECT.away(lamp, stone.x, stone.y) < stone.half_width * 1.4143 + CLEAR:
                blocked = True


def pay_for_lamp(lamp, model, rng):
    """Pay for a lamp that is reached, and put it up elsewhere."""
    for robot in model.robots:
        if COLLECT.away(robot, lamp.x, lamp.y) < REACHED:
            robot.earned += 1
            put_up(lamp, model, rng)


def pay_for_view(chart, model):
    """Pay each robot for the squares of the map that it is the first to see."""
    if model.tick % 5 == 0:
        for robot in model.robots:
            found = look_around(robot, chart, model.sight, model.half_width)
            robot.earned += found
            model.covered += found


class ReachSignal(Foraging):
    """One robot goes from signal to signal among obstacles; a collision ends it."""

    ticks = 2000

    lamps = Population(Lamp, 1, body=Disc(seen=False))
    robots = Population(
        Forager,
        1,
        body=Disc(),
        sensors={
            **SENSORS,
            "RADSIG": signal_orientation("lamps", reach="hearing"),
            "ACTSIG": signal_active("lamps", reach="hearing"),
        },
        actuators=Foraging.robots.actuators,
        hierarchy="mind",
    )
    rewards = {"reached": paid()}
    interruptions = {"collision": collision()}
    setup = (each(Foraging.obstacles, lay), each(robots, start), each(lamps, put_up))
    schedule = (each(lamps, pay_for_lamp),)


class SearchTogether(Foraging):
    """The group is paid for what it sees of an arena without objects."""

    ticks = 2000

    rewards = {"seen": paid(), "collision": collision_cost(0.2)}
    setup = Foraging.setup[:2]
    schedule = (each(Foraging.charts, pay_for_view),)


class ForageTogether(Foraging):
    """The whole task: the group is paid for the objects that it brings home."""

    ticks = 6000

    rewards = {"delivered": paid(), "collision": collision_cost(0.002)}


COARSE, FINE = LESSONS.COARSE, LESSONS.FINE
GENTLE = {**FINE, "step": 0.2, "mutation": 0.1, "narrowing": 0.97}
"""For all skills together: small steps, as little must change in base skills to lose the way."""
SEARCHING = (SEARCH, SEARCH_AVOID)

curriculum = Curriculum(
    (
        Lesson(
            "ReachSignal",
            ReachSignal,
            skill=SIGNAL,
            master="ReachSignal",
            repetitions=10,
            generations=20,
            settings={**FINE, "step": 0.5},
            start="known",
        ),
        Lesson(
            SEARCH,
            SearchTogether,
            master=SEARCH_AVOID,
            repetitions=4,
            generations=40,
            settings=COARSE,
        ),
        Lesson(
            SEARCH_AVOID,
            SearchTogether,
            skill=SEARCHING,
            master=SEARCH_AVOID,
            repetitions=6,
            generations=40,
            settings={**FINE, "step": 0.5},
            start="known",
        ),
        Lesson(
            FORAGE,
            ForageTogether,
            repetitions=8,
            generations=24,
            settings=FINE,
            finals=64,
        ),
        Lesson(
            "All in context",
            ForageTogether,
            skill=(*SEARCHING, *SIGNAL, FORAGE),
            master=FORAGE,
            repetitions=8,
            generations=24,
            settings=GENTLE,
            start="known",
            finals=96,
        ),
    ),
    mind=forager(),
)
