"""The robots as one sees them from outside: by what they bring home.

The measures of `foraging_roles` take a robot's role from the variable ROLE of its mind, at 0.5.
Where what ROLE means was learned that says nothing. Here a robot is in B from when it brings a B
home until an A, and else in A; so all ways to decide are measured alike.

Rules are called as those of the model, so that the same seed gives the same worlds.
"""

from socialmind import Population, each, once

from .measures import watch as note_split
from .model import Forager, ForagingRoles
from .payoff import forget
from .places import tidy_a, tidy_b
from .shocks import shock as let_happen
from .work import work as do_work


class Bringer(Forager):
    """A robot, and what it brought home last: 1 for an A, 2 for a B, 0 for nothing yet.

    `says_b` keeps what its ROLE says while it is `taken` for what it brings.
    """

    brought: int = 0
    taken: bool = False
    says_b: bool = False


def work(robot, model, rng):
    """Work, and be seen with what one brings home."""
    a, b = robot.delivered_a, robot.delivered_b
    do_work(robot, model, rng)
    brought = robot.brought
    if robot.delivered_a > a:
        brought = 1
    elif robot.delivered_b > b:
        brought = 2
    if robot.brought > 0 and brought != robot.brought:
        model.changed_kind += 1
    robot.brought = brought


def shock(market, model, rng):
    """Let happen what happens half-way; who is taken away is seen by what it brings."""
    take_for_what_they_bring(model)
    let_happen(market, model, rng)
    take_at_their_word(model)


def watch(model):
    """See the split of what robots bring that a tick leaves."""
    take_for_what_they_bring(model)
    model.changed = model.changed_kind
    note_split(model)
    take_at_their_word(model)


def take_for_what_they_bring(model):
    """Let robots count as in B that brought a B."""
    for robot in model.robots:
        robot.taken = True
        robot.says_b = robot.is_b
        robot.is_b = robot.brought == 2


def take_at_their_word(model):
    """Let robots count as in B again whose ROLE says so; who has just come does already."""
    for robot in model.robots:
        if robot.taken:
            robot.is_b = robot.says_b
            robot.taken = False


class ForagingByDeliveries(ForagingRoles):
    """Foraging with roles, measured by what the robots bring home."""

    changed_kind: int = 0

    robots = Population(
        Bringer,
        "foragers",
        body=ForagingRoles.robots.body,
        sensors=ForagingRoles.robots.sensors,
        actuators=ForagingRoles.robots.actuators,
        hierarchy="mind",
        master="Forage",
        mind="scheme.yaml",
        plans=ForagingRoles.robots.plans,
    )
    schedule = (
        each(robots, work),
        each(ForagingRoles.objects_a, tidy_a),
        each(ForagingRoles.objects_b, tidy_b),
        each(ForagingRoles.markets, forget),
        each(ForagingRoles.markets, shock),
        once(watch),
    )
