"""What the programmed robots do: bring items all the way, or divide the way between two of them."""

from .places import CACHE, NEST, SLOPE, SOURCE

PHOTOTAXIS, ANTIPHOTOTAXIS, RANDOM_WALK = range(3)
LEARNED, GENERALIST, DROPPER, COLLECTOR = range(4)


def strategy_of(number, model):
    """Return what the robot of a number is: generalists come first, those who learned last."""
    if number < model.n_generalists:
        return GENERALIST
    if number < model.n_generalists + model.n_droppers:
        return DROPPER
    if number < model.n_generalists + model.n_droppers + model.n_collectors:
        return COLLECTOR
    return LEARNED


def follow_strategy(robot, model):
    """Do what the strategy says of the place where the robot is, with an item or without."""
    laden = robot.item is not None
    if laden:
        robot.behaviour = ANTIPHOTOTAXIS
    else:
        robot.behaviour = search(robot.strategy, robot.place)
    searched = CACHE if robot.strategy == COLLECTOR else SOURCE
    robot.picks_up = not laden and robot.place == searched
    robot.drops = laden and robot.place == goal(robot.strategy, model)


def search(strategy, place):
    """Return the behaviour that looks for an item: go to where they are, and walk about there."""
    if strategy != COLLECTOR:
        return RANDOM_WALK if place == SOURCE else PHOTOTAXIS
    if place == CACHE:
        return RANDOM_WALK
    return PHOTOTAXIS if place == NEST else ANTIPHOTOTAXIS


def goal(strategy, model):
    """Return where an item is let go: droppers bring it to the cache where it does not slide."""
    if strategy != DROPPER:
        return NEST
    return SLOPE if model.gradient > 0 else CACHE
