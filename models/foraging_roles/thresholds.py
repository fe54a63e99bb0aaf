"""Robots that decide by response thresholds, as insects are thought to: fixed or reinforced ones.

After a delivery a robot knows what its object was worth, and so what one of the other kind is: as
much more than it should be as its own is worth less. That is the stimulus s of the other task, and
with the probability s² / (s² + θ²) the robot takes it up, θ being its threshold for it; a robot of
this world is never idle, so that it goes on otherwise.

With thresholds that differ between robots and stay (`fixed_thresholds`) it is the model of
Bonabeau, Theraulaz and Deneubourg (1998, Bulletin of Mathematical Biology 60: 753–807). With equal
ones, of which that of the task at hand falls and the other one rises (`reinforced_thresholds`), it
is that of Theraulaz, Bonabeau and Deneubourg (1998, Proceedings of the Royal Society B 265:
327–332).
"""

from socialmind import Population, each, once, parameter

from .by_deliveries import Bringer, ForagingByDeliveries, shock, watch
from .by_deliveries import work as bring
from .deciding import AS_IT_SHOULD_BE, change_role
from .payoff import forget
from .places import tidy_a, tidy_b

THRESHOLDS = 4
"""What decides in the robots that are not programmed, beside what `deciding` knows."""


class Responder(Bringer):
    """A robot, and its thresholds for both tasks; -1 before it has any."""

    threshold_a: float = -1.0
    threshold_b: float = -1.0


def work(robot, model, rng):
    """Work, and after a delivery take up the other task or not."""
    if robot.threshold_a < 0:
        begin_thresholds(robot, model, rng)
    bring(robot, model, rng)
    if robot.paid and model.unlearned == THRESHOLDS and not robot.programmed:
        respond(robot, model, rng)


def begin_thresholds(robot, model, rng):
    """Get thresholds from the middle of their range, as far apart as the model says."""
    robot.threshold_a = begun(rng.random(), model)
    robot.threshold_b = begun(rng.random(), model)


def begun(drawn, model):
    """Return a threshold at the start, of a number drawn from 0 … 1."""
    middle = (model.lowest_threshold + model.highest_threshold) / 2
    span = model.highest_threshold - model.lowest_threshold
    return middle + (drawn - 0.5) * span * model.variety


def respond(robot, model, rng):
    """Let doing a task change the thresholds, and answer to the call of the other one."""
    stimulus = max(0.0, AS_IT_SHOULD_BE - robot.payoff)
    if robot.is_b:
        robot.threshold_b = bounded(robot.threshold_b - model.learning, model)
        robot.threshold_a = bounded(robot.threshold_a + model.forgetting, model)
        if rng.random() < response(stimulus, robot.threshold_a):
            change_role(robot, False)
    else:
        robot.threshold_a = bounded(robot.threshold_a - model.learning, model)
        robot.threshold_b = bounded(robot.threshold_b + model.forgetting, model)
        if rng.random() < response(stimulus, robot.threshold_b):
            change_role(robot, True)


def response(stimulus, threshold):
    """Return the probability of taking up a task: s² / (s² + θ²)."""
    return stimulus * stimulus / (stimulus * stimulus + threshold * threshold)


def bounded(threshold, model):
    """Return a threshold within the bounds."""
    return min(max(threshold, model.lowest_threshold), model.highest_threshold)


class ForagingByThresholds(ForagingByDeliveries):
    """Foraging with roles that thresholds decide about."""

    unlearned: int = parameter(
        THRESHOLDS,
        unit="of five",
        low=0,
        high=4,
        doc="decides in the others: 4 thresholds, and 0 to 3 as in `foraging_roles`",
    )
    lowest_threshold: float = parameter(
        0.05, unit="of payoff", low=0.001, high=10.0, doc="that a threshold can be"
    )
    highest_threshold: float = parameter(
        0.5, unit="of payoff", low=0.001, high=10.0, doc="that a threshold can be"
    )
    variety: float = parameter(
        1.0, unit="of the range", low=0.0, high=1.0, doc="in which thresholds begin, at its middle"
    )
    learning: float = parameter(
        0.0, unit="a delivery", low=0.0, doc="by which the threshold of the task at hand falls"
    )
    forgetting: float = parameter(
        0.0, unit="a delivery", low=0.0, doc="by which the threshold of the other task rises"
    )

    robots = Population(
        Responder,
        "foragers",
        body=ForagingByDeliveries.robots.body,
        sensors=ForagingByDeliveries.robots.sensors,
        actuators=ForagingByDeliveries.robots.actuators,
        hierarchy="mind",
        master="Forage",
        mind="scheme.yaml",
        plans=ForagingByDeliveries.robots.plans,
    )
    schedule = (
        each(robots, work),
        each(ForagingByDeliveries.objects_a, tidy_a),
        each(ForagingByDeliveries.objects_b, tidy_b),
        each(ForagingByDeliveries.markets, forget),
        each(ForagingByDeliveries.markets, shock),
        once(watch),
    )
