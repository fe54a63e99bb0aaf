"""The counting task in outline: a lesson of seconds in place of hours.

The robot is a point that goes wherever it wants, the way is clear, and all skills below the master
are programs that know it. What the master sees and what it influences is what it sees and
influences in the arena, tick by tick, so what it learns here it can do there.
"""

import math

from socialmind import Model, Population, each, parameter
from socialmind.mind import MindDescription, Programmed, Skill
from socialmind.worlds.plane import Act, Disc, Interruption, Plane, Sense, paid

from .model import MOST, Counting, away, reckon, too_many, want, wanted_share

NEAREST, FARTHEST = 5.0, 9.0  # units from the drop zone to objects, and to the validation zone
APART = 3.5  # units between an object and the validation zone
ZONE = 1.6  # the radius of zones
REACH = 1.1  # of the claw
SLOWEST, FASTEST = 0.4, 1.0  # units a tick
LONGEST = 6  # ticks of turning round, after delivering or validating


class Sketched(Counting):
    """The robot, its object and its validation zone; the drop zone is in the middle."""

    pace: float = 1.0
    busy: int = 0
    object_x: float = 0.0
    object_y: float = 0.0
    valid_x: float = 0.0
    valid_y: float = 0.0
    carries: bool = False
    let_go: bool = False


# Devices ------------------------------------------------------------------------------------------


def senses_object(robot, reach):
    """Return whether an object is in reach, or carried."""
    near = away(robot, robot.object_x, robot.object_y) < reach
    return 1.0 if near or robot.carries else 0.0


def senses_drop(robot, radius):
    """Return whether the robot is in the drop zone."""
    return 1.0 if away(robot, 0.0, 0.0) < radius else 0.0


def senses_valid(robot, radius):
    """Return whether the robot is in the validation zone."""
    return 1.0 if away(robot, robot.valid_x, robot.valid_y) < radius else 0.0


def way(far, step):
    """Return how far to go along an axis, half a step each way."""
    return 0.5 + 0.5 * step / far if far > 0.5 else 0.5


def object_along(robot):
    """Return the way to the object along x; none for one that is carried."""
    far = away(robot, robot.object_x, robot.object_y)
    return 0.5 if robot.carries else way(far, robot.object_x - robot.x)


def object_aside(robot):
    """Return the way to the object along y; none for one that is carried."""
    far = away(robot, robot.object_x, robot.object_y)
    return 0.5 if robot.carries else way(far, robot.object_y - robot.y)


def drop_along(robot):
    """Return the way to the drop zone along x."""
    return way(away(robot, 0.0, 0.0), -robot.x)


def drop_aside(robot):
    """Return the way to the drop zone along y."""
    return way(away(robot, 0.0, 0.0), -robot.y)


def valid_along(robot):
    """Return the way to the validation zone along x."""
    return way(away(robot, robot.valid_x, robot.valid_y), robot.valid_x - robot.x)


def valid_aside(robot):
    """Return the way to the validation zone along y."""
    return way(away(robot, robot.valid_x, robot.valid_y), robot.valid_y - robot.y)


def step_along(robot, command):
    """Go up to a step along x."""
    if robot.busy == 0:
        robot.x += robot.pace * (2.0 * command - 1.0)


def step_aside(robot, command):
    """Go up to a step along y."""
    if robot.busy == 0:
        robot.y += robot.pace * (2.0 * command - 1.0)


def use_claw(robot, command, reach):
    """Pick up an object in reach, or let it go."""
    if command < 0.5:
        robot.let_go = robot.carries
        robot.carries = False
    elif command > 0.5 and away(robot, robot.object_x, robot.object_y) < reach:
        robot.carries = True


# Rules --------------------------------------------------------------------------------------------


def begin(robot, model, rng):
    """Lay out the task anew, with the robot between drop zone and validation zone."""
    want(robot, model, rng)
    angle = rng.uniform(-math.pi, math.pi)
    far = rng.uniform(NEAREST, FARTHEST)
    robot.pace = rng.uniform(SLOWEST, FASTEST)
    robot.valid_x = far * math.cos(angle)
    robot.valid_y = far * math.sin(angle)
    robot.x = robot.valid_x / 2
    robot.y = robot.valid_y / 2
    put_object(robot, rng)


def put_object(robot, rng):
    """Put an object around the drop zone, away from the validation zone."""
    near = True
    while near:
        angle = rng.uniform(-math.pi, math.pi)
        far = rng.uniform(NEAREST, FARTHEST)
        robot.object_x = far * math.cos(angle)
        robot.object_y = far * math.sin(angle)
        aside = math.hypot(robot.object_x - robot.valid_x, robot.object_y - robot.valid_y)
        near = aside < APART


def carry(robot, rng):
    """Take the object along; count one that was let go in the drop zone, and lay out another."""
    robot.busy = max(0, robot.busy - 1)
    if robot.carries:
        robot.object_x = robot.x
        robot.object_y = robot.y
    if robot.let_go:
        robot.let_go = False
        if away(robot, 0.0, 0.0) < ZONE:
            robot.delivered += 1
            robot.earned += 1
            robot.busy = rng.integers(0, LONGEST + 1)
            put_object(robot, rng)


def judge(robot, model, rng):
    """Keep the score of what the robot did."""
    validates = away(robot, robot.valid_x, robot.valid_y) < ZONE
    if validates and not robot.validating:
        robot.busy = rng.integers(0, LONGEST + 1)
    reckon(robot, model, rng, validates)


# Stand-ins ----------------------------------------------------------------------------------------


def collect(obj, zone, object_along, object_aside, drop_along, drop_aside):
    """Go to the object, or home with it; close the claw on it, and open it at home."""
    if obj > 0.5 and zone > 0.5:
        return 0.5, 0.5, 0.0
    if obj > 0.5:
        return drop_along, drop_aside, 1.0
    return object_along, object_aside, 0.5


def go_to_valid(along, aside):
    """Go to the validation zone."""
    return along, aside


WAYS = {
    "OBJX": object_along, "OBJY": object_aside, "DZX": drop_along, "DZY": drop_aside,
    "VZX": valid_along, "VZY": valid_aside,
}  # fmt: skip
SENSORS = {
    "SENSOBJ": Sense(senses_object, settings={"reach": REACH}),
    "SENSDZ": Sense(senses_drop, settings={"radius": ZONE}),
    "SENSVZ": Sense(senses_valid, settings={"radius": ZONE}),
    "WANTED": Sense(wanted_share),
    **{name: Sense(function) for name, function in WAYS.items()},
}
ACTUATORS = {
    "EMAG": Act(use_claw, settings={"reach": REACH}),
    "X": Act(step_along),
    "Y": Act(step_aside),
}
STAND_INS = (
    Skill("Collect", [f"SE:{n}" for n in ("SENSOBJ", "SENSDZ", "OBJX", "OBJY", "DZX", "DZY")],
          ["MO:X", "MO:Y", "MO:EMAG"], Programmed(collect)),
    Skill("GoToValid+Avoid", ["SE:VZX", "SE:VZY"], ["MO:X", "MO:Y"], Programmed(go_to_valid)),
)  # fmt: skip
ALONE = MindDescription("alone", list(SENSORS), list(ACTUATORS), skills=STAND_INS[:1])


class Sketch(Model):
    """The task in outline."""

    ticks = 600

    wanted: int = parameter(
        2, unit="objects", low=0, high=MOST, doc="of a sequence; 0 draws it anew for each"
    )
    world = Plane(0.0)
    robots = Population(
        Sketched, 1, body=Disc(), sensors=SENSORS, actuators=ACTUATORS, hierarchy=ALONE
    )
    rewards = {"earned": paid()}
    interruptions = {"too many": Interruption(too_many)}
    setup = (each(robots, begin),)
    schedule = (each(robots, carry), each(robots, judge))
