"""Roles: what they are at the start, and what a robot's mind says of its own."""

from .deciding import FIXED, appoint, begin_plan, fixed_in_b
from .places import stand

ALL_A, ALL_B, UNDECIDED, RANDOM, ANY = 0, 1, 2, 3, 4
"""What the robots' roles are at the start; ANY of the four is drawn for each world."""


def choose_start(model, rng):
    """Choose what the robots' roles are at the start."""
    model.began_as = model.start
    if model.start == ANY:
        model.began_as = rng.integers(ANY)


def arrive(robot, model, rng):
    """Put a robot near the middle, with the role that it has at the start."""
    stand(robot, rng)
    appoint(robot, model)
    take_role(robot, model, rng)
    if robot.programmed:
        begin_plan(robot)


def take_role(robot, model, rng):
    """Give a robot the role that it has at the start."""
    role = rng.random()
    if model.unlearned == FIXED and not robot.programmed:
        role = 1.0 if fixed_in_b(robot, model) else 0.0
    elif model.began_as == ALL_A:
        role = 0.0
    elif model.began_as == ALL_B:
        role = 1.0
    elif model.began_as == UNDECIDED:
        role = 0.5
    robot.hierarchy.set_variable("ROLE", role)
    robot.role = role
    robot.is_b = role >= 0.5


def look_at_role(robot, model):
    """See what the robot's mind says of its role, and count its changes."""
    robot.role = robot.hierarchy.variable("ROLE")
    is_b = robot.role >= 0.5
    if is_b != robot.is_b:
        robot.changes += 1
        model.changed += 1
        robot.is_b = is_b
