"""Where things are: the arena's middle, the sides where objects lie, and what is put elsewhere."""

import math

from socialmind.catalogue import load_file, model_folder

COLLECT = load_file(model_folder("collect") / "model.py")
ZONE_HALF_WIDTH = 5.0  # the drop zone is in the middle
RING = 2.5  # units from the middle at which the robots start
NEAREST, FARTHEST, ASIDE = 35.0, 60.0, 50.0  # where objects are: units to the side, and across
SPARE = 3  # objects of a kind more than robots
PUSHED = 2.0  # units that an object may be pushed away from where it was put


def lay(obstacle, model, rng):
    """Put an obstacle near the middle of its cell, unless drop zone and robots are there."""
    COLLECT.strew(obstacle, model, rng)
    size = obstacle.half_width
    if COLLECT.away(obstacle, 0.0, 0.0) < size + ZONE_HALF_WIDTH + COLLECT.FREE:
        obstacle.die()


def mark(zone):
    """Put the drop zone in the middle."""
    zone.half_width = ZONE_HALF_WIDTH


def stand(robot, rng):
    """Put a robot near the middle."""
    way = rng.uniform(-math.pi, math.pi)
    robot.x = RING * math.cos(way)
    robot.y = RING * math.sin(way)
    robot.angle = rng.uniform(-math.pi, math.pi)


def lay_a(ball, model, rng):
    """Put an object of the kind A on its side, unless there are enough."""
    if ball.id < len(model.robots) + SPARE:
        place_a(ball, model, rng)
    else:
        ball.die()


def lay_b(ball, model, rng):
    """Put an object of the kind B on its side, unless there are enough."""
    if ball.id < len(model.robots) + SPARE:
        place_b(ball, model, rng)
    else:
        ball.die()


def place_a(ball, model, rng):
    """Put an object of the kind A somewhere on its side."""
    place(ball, model, rng, -1.0)


def place_b(ball, model, rng):
    """Put an object of the kind B somewhere on its side."""
    place(ball, model, rng, 1.0)


def place(ball, model, rng, side):
    """Put an object somewhere on a side, free of obstacles."""
    free = False
    while not free:
        ball.x = side * rng.uniform(NEAREST, FARTHEST)
        ball.y = rng.uniform(-ASIDE, ASIDE)
        free = True
        for obstacle in model.obstacles:
            margin = obstacle.half_width * 1.4143 + COLLECT.FROM_OBSTACLES
            if COLLECT.away(ball, obstacle.x, obstacle.y) < margin:
                free = False
    ball.vx = 0
    ball.vy = 0
    ball.home_x = ball.x
    ball.home_y = ball.y


def tidy_a(ball, model, rng):
    """Put an object of the kind A that is astray elsewhere on its side."""
    if astray(ball):
        place_a(ball, model, rng)


def tidy_b(ball, model, rng):
    """Put an object of the kind B that is astray elsewhere on its side."""
    if astray(ball):
        place_b(ball, model, rng)


def astray(ball):
    """Say whether an object was pushed away, or dropped on the way: obstacles may be too near."""
    return ball.carrier_kind == -1 and COLLECT.away(ball, ball.home_x, ball.home_y) > PUSHED
