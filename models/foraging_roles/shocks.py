"""Shocks: the wanted ratio turned round, robots taken away, robots added."""

from .measures import begin_anew
from .roles import arrive


def shock(market, model, rng):
    """Turn the wanted ratio round, take robots away or add some, when it is time to."""
    if model.tick == model.reverse_at:
        model.wanted = 1 - model.wanted
        begin_anew(model)
    if model.tick == model.remove_at:
        left = model.shift
        for robot in model.robots:
            if left > 0 and robot.is_b == (model.removed_role == 1):
                robot.die()
                left -= 1
        # Where too few have the role others go, so that all worlds lose as many.
        for robot in model.robots:
            if left > 0 and robot.is_b != (model.removed_role == 1):
                robot.die()
                left -= 1
        begin_anew(model)
    if model.tick == model.add_at:
        for _ in range(model.shift):
            robot = model.robots.create()
            arrive(robot, model, rng)
        begin_anew(model)
