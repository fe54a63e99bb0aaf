"""Robots among strangers, in other arenas, in groups of any size: what their roles generalise to.

Two learned minds share a society as one mind with two heads (`two_headed`): a robot says by
`stranger` which of them is awake in it, and the other one, without influence, does nothing. So a
society with no strangers is that of the first mind to the last bit.

All are measured by what they bring home. Rules are called as those of the model, so that the same
seed gives the same worlds.
"""

from socialmind import Population, each, once, parameter
from socialmind.mind import MindDescription, Programmed, Skill
from socialmind.worlds.plane import Sense

from .deciding import AS_IT_SHOULD_BE, is_due
from .model import SENSORS, ForagingRoles
from .payoff import forget
from .places import COLLECT, NEAREST, ZONE_HALF_WIDTH
from .places import tidy_a as let_tidy_a
from .places import tidy_b as let_tidy_b
from .roles import arrive as let_arrive
from .thresholds import ForagingByThresholds, Responder, shock
from .thresholds import watch as watch_split
from .thresholds import work as do_work

HALF_WIDTH = 70.0  # of the model's arena, the middle of which obstacles fill
A_NINTH = 9.0  # of the robots: one of the nine of the model


# Minds --------------------------------------------------------------------------------------------


def either(PAID, STRANGER):
    """Let one head collect, and think about the role after a delivery; the other one sleeps."""
    return 1.0 - STRANGER, PAID * (1.0 - STRANGER), STRANGER, PAID * STRANGER


def two_headed(first: MindDescription, second: MindDescription) -> MindDescription:
    """Return a mind that is the first one, and in strangers the second one.

    Args:
        first: a mind of `foraging_roles`, with ForageRole and CollectSelect.
        second: another, whose Collect is the same.
    """
    heads = "CollectSelect", "ForageRole"
    others = [
        Skill(f"{name}2", one.inputs, one.outputs, one.function, genome=one.genome)
        for name in heads
        for one in (second.skill(name),)
    ]
    awake = [f"SK:{name}{end}" for end in ("", "2") for name in heads]
    master = Skill("Forage", ["SE:PAID", "SE:STRANGER"], awake, Programmed(either))
    return first.with_modules(sensors=["STRANGER"], skills=[master, *others])


# Rules --------------------------------------------------------------------------------------------


class Newcomer(Responder):
    """A robot, and whether the other mind is awake in it.

    `changes_brought` are its changes of the kind that it brings home.
    """

    stranger: bool = False
    changes_brought: int = 0


def is_stranger(robot):
    """Return 1 in a robot in which the other mind is awake."""
    return robot.stranger


def sharpened(robot, model):
    """Return the last payoff, as much farther from what it should be as `gain` says."""
    return AS_IT_SHOULD_BE + model.gain * (robot.payoff - AS_IT_SHOULD_BE)


def lay(obstacle, model, rng):
    """Put an obstacle near the middle of its cell, in the middle of the arena, if there are any."""
    COLLECT.strew(obstacle, model, rng)
    obstacle.x += model.half_width - HALF_WIDTH
    obstacle.y += model.half_width - HALF_WIDTH
    size = obstacle.half_width
    near = COLLECT.away(obstacle, 0.0, 0.0) < size + ZONE_HALF_WIDTH + COLLECT.FREE
    if near or model.cleared == 1:
        obstacle.die()


def arrive(robot, model, rng):
    """Put a robot near the middle, and say which mind is awake in it."""
    let_arrive(robot, model, rng)
    robot.stranger = is_due(model.strangers, robot.id, model.foragers)


def work(robot, model, rng):
    """Work, and count the changes of what one brings home."""
    before = robot.brought
    do_work(robot, model, rng)
    if before > 0 and robot.brought != before:
        robot.changes_brought += 1


def tidy_a(ball, model, rng):
    """Put an object of the kind A where it is to be."""
    let_tidy_a(ball, model, rng)
    take_away(ball, model.reach_a)


def tidy_b(ball, model, rng):
    """Put an object of the kind B where it is to be."""
    let_tidy_b(ball, model, rng)
    take_away(ball, model.reach_b)


def take_away(ball, reach):
    """Put an object that was just laid as many times farther to its side as `reach` says."""
    if ball.carrier_kind == -1 and abs(ball.home_x) < NEAREST * reach:
        ball.x *= reach
        ball.home_x *= reach


def watch(model):
    """See by how many robots, and by which part of them, the split that a tick leaves is off."""
    watch_split(model)
    if model.off > model.present / A_NINTH + 1e-9:
        model.last_beyond_a_ninth = model.tick + 1
    if model.tick >= model.late:
        model.off_late += model.off


class ForagingElsewhere(ForagingByThresholds):
    """Foraging with roles among strangers, in other arenas, in groups of any size."""

    strangers: float = parameter(
        0.0, unit="of the robots", low=0.0, high=1.0, doc="in which the other mind is awake"
    )
    gain: float = parameter(
        1.0, unit="times", low=0.0, doc="farther from 0.5 than they are learned minds read payoffs"
    )
    reach_a: float = parameter(
        1.0,
        unit="times",
        low=1.0,
        high=2.0,
        doc="as far to the side objects A are: 1, or 12/7 to 2",
    )
    reach_b: float = parameter(
        1.0,
        unit="times",
        low=1.0,
        high=2.0,
        doc="as far to the side objects B are: 1, or 12/7 to 2",
    )
    cleared: int = parameter(0, unit="of two", low=0, high=1, doc="1 for no obstacles")
    late: int = parameter(45_000, unit="ticks", low=0, doc="from which on the distance is added up")

    last_beyond_a_ninth: int = -1
    off_late: float = 0.0

    robots = Population(
        Newcomer,
        "foragers",
        body=ForagingByThresholds.robots.body,
        sensors={**SENSORS, "PAYOFF": Sense(sharpened), "STRANGER": Sense(is_stranger)},
        actuators=ForagingByThresholds.robots.actuators,
        hierarchy="mind",
        master="Forage",
        mind="scheme.yaml",
        plans=ForagingByThresholds.robots.plans,
    )
    setup = (
        each(ForagingRoles.obstacles, lay),
        *ForagingRoles.setup[1:3],
        each(robots, arrive),
        *ForagingRoles.setup[4:],
    )
    schedule = (
        each(robots, work),
        each(ForagingRoles.objects_a, tidy_a),
        each(ForagingRoles.objects_b, tidy_b),
        each(ForagingRoles.markets, forget),
        each(ForagingRoles.markets, shock),
        once(watch),
    )
