"""What a robot does in a tick beside moving: pick up, deliver, be paid, be rescued."""

from socialmind.worlds.plane import in_zone

from .deciding import decide
from .payoff import pay
from .places import COLLECT, place_a, place_b, stand
from .roles import look_at_role

AHEAD = 2.1  # units within which what a robot carries is


def work(robot, model, rng):
    """Notice what a robot picks up, pay it for what it delivers, and let it decide."""
    robot.paid = False
    robot.since += 1
    if robot.carrying >= 0:
        if robot.cargo != robot.carrying:
            robot.cargo = robot.carrying  # its object is put ahead of it in the next tick
        elif robot.load == 0:
            pick_up(robot, model)
    elif robot.load == 1:
        let_go_of_a(robot, model, rng)
    elif robot.load == 2:
        let_go_of_b(robot, model, rng)
    if robot.since > model.patience:
        rescue(robot, model, rng)
    if robot.paid:
        decide(robot, model, rng)
    look_at_role(robot, model)


def let_go_of_a(robot, model, rng):
    """Pay a robot for the A that it let go of, if that was in the drop zone."""
    ball = model.objects_a[robot.cargo]
    if delivered(ball, model):
        robot.delivered_a += 1
        pay(robot, model)
        place_a(ball, model, rng)
    empty(robot)


def let_go_of_b(robot, model, rng):
    """Pay a robot for the B that it let go of, if that was in the drop zone."""
    ball = model.objects_b[robot.cargo]
    if delivered(ball, model):
        robot.delivered_b += 1
        pay(robot, model)
        place_b(ball, model, rng)
    empty(robot)


def empty(robot):
    """Let a robot have nothing in its claw."""
    robot.load = 0
    robot.cargo = -1
    robot.since = 0


def pick_up(robot, model):
    """Find out which kind of object a robot has in its claw: the one just ahead of it."""
    robot.since = 0
    robot.load = 2
    if model.objects_a.contains(robot.cargo):
        ball = model.objects_a[robot.cargo]
        if ball.carrier_kind >= 0 and COLLECT.away(ball, robot.x, robot.y) < AHEAD:
            robot.load = 1


def rescue(robot, model, rng):
    """Put a robot that is stuck back near the middle, without what it carries."""
    if robot.load == 1:
        release(model.objects_a[robot.cargo])
    elif robot.load == 2:
        release(model.objects_b[robot.cargo])
    robot.carrying = -1
    robot.closed = False
    empty(robot)
    robot.rescues += 1
    stand(robot, rng)


def release(ball):
    """Let nobody carry an object."""
    ball.carrier_kind = -1
    ball.carrier = -1


def delivered(ball, model):
    """Say whether an object was let go in the drop zone."""
    found = False
    for zone in model.drop_zones:
        if in_zone(zone, ball.x, ball.y):
            found = True
    return found
