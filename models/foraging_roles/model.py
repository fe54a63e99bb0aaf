"""Robots that forage two kinds of objects and find their roles (thesis, 8.2).

Objects of the kinds A and B are wanted in some ratio. A robot that brings one home is told what it
is worth to the group, and that alone; who fetches which is for the robots to settle.
"""

import math

from socialmind import Model, Population, each, once, parameter
from socialmind.catalogue import load_file, model_folder
from socialmind.economy import Market, demand_perception, proportional_decay
from socialmind.worlds.plane import (
    BALL,
    Body,
    Disc,
    Measure,
    Obstacle,
    Plane,
    Robot,
    Sense,
    Zone,
    claw,
    distance_to,
    in_claw,
    in_zone,
    orientation,
    paid,
    total,
)

COLLECT = load_file(model_folder("collect") / "model.py")
ZONE_HALF_WIDTH = 5.0  # the drop zone is in the middle
RING = 2.5  # units from the middle at which the robots start
NEAREST, FARTHEST, ASIDE = 35.0, 60.0, 50.0  # where objects are: units to the side, and across
MOST = 36  # robots at the start
SPARE = 3  # objects of a kind more than robots
COUNTED = 3.0  # objects delivered a robot that have been counted before the start
PAYOFF = 0.15  # how much of the payoff sensor's range a perceived demand of 1 takes
PUSHED = 2.0  # units that an object may be pushed away from where it was put
AHEAD = 2.1  # units within which what a robot carries is
FARTHEST_OFF = 3  # robots off the wanted split up to which it is watched
HOLD = 5000  # ticks within one robot of the wanted split that count as settled
ALL_A, ALL_B, UNDECIDED, RANDOM, ANY = 0, 1, 2, 3, 4
"""What the robots' roles are at the start; ANY of the four is drawn for each world."""


class Forager(Robot):
    """A robot, what it carries, and what it is paid.

    `load` is the kind of object in its claw (1 for A, 2 for B, 0 for none) and `cargo` its
    identity. `paid` says that it has just delivered one, `payoff` what the last one was worth (0 …
    1, 0.5 as it should be), `role` the variable ROLE of its mind: B from 0.5 on, else A. `since`
    are the ticks since it has picked up or let go of anything, `rescues` how often that was too
    long.
    """

    role: float = 0.5
    is_b: bool = False
    payoff: float = 0.5
    paid: bool = False
    load: int = 0
    cargo: int = -1
    since: int = 0
    rescues: int = 0
    delivered_a: int = 0
    delivered_b: int = 0
    changes: int = 0


class Ball(Body):
    """An object, and the place where it was put."""

    home_x: float = 0.0
    home_y: float = 0.0


# Setup ------------------------------------------------------------------------------------------


def lay(obstacle, model, rng):
    """Put an obstacle near the middle of its cell, unless drop zone and robots are there."""
    COLLECT.strew(obstacle, model, rng)
    size = obstacle.half_width
    if COLLECT.away(obstacle, 0.0, 0.0) < size + ZONE_HALF_WIDTH + COLLECT.FREE:
        obstacle.die()


def mark(zone):
    """Put the drop zone in the middle."""
    zone.half_width = ZONE_HALF_WIDTH


def open_market(market, model, rng):
    """Let the group's counts begin at the wanted ratio, as if it had worked before."""
    model.wanted = model.wanted_b
    counted = COUNTED * len(model.robots)
    market.staple = counted * model.wanted
    market.ware = counted * (1 - model.wanted)
    model.began_as = model.start
    if model.start == ANY:
        model.began_as = rng.integers(ANY)


def arrive(robot, model, rng):
    """Put a robot near the middle, with the role that it has at the start."""
    stand(robot, rng)
    take_role(robot, model.began_as, rng)


def stand(robot, rng):
    """Put a robot near the middle."""
    way = rng.uniform(-math.pi, math.pi)
    robot.x = RING * math.cos(way)
    robot.y = RING * math.sin(way)
    robot.angle = rng.uniform(-math.pi, math.pi)


def take_role(robot, start, rng):
    """Give a robot the role of a start."""
    role = rng.random()
    if start == ALL_A:
        role = 0.0
    elif start == ALL_B:
        role = 1.0
    elif start == UNDECIDED:
        role = 0.5
    robot.hierarchy.set_variable("ROLE", role)
    robot.role = role
    robot.is_b = role >= 0.5


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


# A tick -----------------------------------------------------------------------------------------


def work(robot, model, rng):
    """Notice what a robot picks up, pay it for what it delivers, and look at its role."""
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


def delivered(ball, model):
    """Say whether an object was let go in the drop zone."""
    found = False
    for zone in model.drop_zones:
        if in_zone(zone, ball.x, ball.y):
            found = True
    return found


def pay(robot, model):
    """Count an object that was delivered, and tell the robot what it is worth."""
    for market in model.markets:
        if robot.load == 1:
            market.ware += 1
        else:
            market.staple += 1
        market.perception = scarcity_of_a(market.staple, market.ware, model.wanted)
        robot.payoff = worth(market.perception if robot.load == 1 else -market.perception)
    robot.paid = True
    robot.earned += 1


def scarcity_of_a(count_b, count_a, wanted):
    """Return how much scarcer A is than it should be; B is the market's staple, A its ware.

    The price of an A is the wanted ratio; as many A as are wanted of all objects are plenty.
    """
    price = wanted / (1 - wanted)
    return demand_perception(count_b, count_a, price, (count_b + count_a) * (1 - wanted))


def worth(scarcity):
    """Return the payoff of an object, more than 0.5 where its kind is scarce."""
    return 0.5 + PAYOFF * scarcity


def look_at_role(robot, model):
    """See what the robot's mind says of its role, and count its changes."""
    robot.role = robot.hierarchy.variable("ROLE")
    is_b = robot.role >= 0.5
    if is_b != robot.is_b:
        robot.changes += 1
        model.changed += 1
        robot.is_b = is_b


def forget(market, model):
    """Let the counts decay."""
    market.staple = proportional_decay(market.staple, model.decay)
    market.ware = proportional_decay(market.ware, model.decay)


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
        begin_anew(model)
    if model.tick == model.add_at:
        for _ in range(model.shift):
            robot = model.robots.create()
            arrive(robot, model, rng)
        begin_anew(model)


# What is measured -------------------------------------------------------------------------------


def begin_anew(model):
    """Wait once more for the roles to settle, at the start and after a shock."""
    model.began_at = model.tick
    model.within_since = -1
    model.settled_at = -1


def watch(model):
    """See how far the split of roles is from the wanted one, and whether it has settled."""
    robots = 0
    in_b = 0
    for robot in model.robots:
        robots += 1
        if robot.is_b:
            in_b += 1
    model.in_b = in_b
    model.present = robots
    model.off = abs(in_b - model.wanted * robots)
    for beyond in range(FARTHEST_OFF):
        if model.off > beyond + 1 + 1e-9:
            model.last_beyond[beyond] = model.tick
    if model.off > 1 + 1e-9:
        model.within_since = -1
    else:
        if model.within_since == -1:
            model.within_since = model.tick
            model.changes_before = model.changed
        if model.settled_at == -1 and model.tick - model.within_since >= HOLD:
            model.settled_at = model.within_since
            model.changes_settled = model.changes_before


def stays_within(robots):
    """Measure whether the last quarter stays within so many robots of the wanted split, 1 or 0."""

    def within(last_beyond, ticks):
        return float(last_beyond[robots - 1] <= 0.75 * ticks)

    return Measure(within)


def changes_after_settling(changed, present, changes_settled, settled_at, ticks):
    """Return the changes of roles for each robot and 10,000 ticks after settling.

    All of the run counts where the roles never settled; the robots are those at the end.
    """
    since, before = (settled_at, changes_settled) if settled_at >= 0 else (0, 0)
    return (changed - before) / max(present, 1) / max(ticks - since, 1) * 10_000


def ticks_to_settle(settled_at, began_at, ticks):
    """Return the ticks from the start, or the last shock, until the roles settled.

    Where they never do, it is all the ticks that there were.
    """
    return (settled_at if settled_at >= 0 else ticks) - began_at


# The model --------------------------------------------------------------------------------------


def last_payoff(robot):
    """Return what the last object that the robot delivered was worth."""
    return robot.payoff


def just_paid(robot):
    """Return 1 in the tick after a delivery."""
    return robot.paid


SENSORS = {
    **{name: one for name, one in COLLECT.SENSORS.items() if name not in ("RADOBJ", "SENSOBJ")},
    "RADOBJA": orientation("objects_a"),
    "RADOBJB": orientation("objects_b"),
    "DISTOBJA": distance_to("objects_a"),
    "DISTOBJB": distance_to("objects_b"),
    "SENSOBJA": in_claw("objects_a"),
    "SENSOBJB": in_claw("objects_b"),
    "PAYOFF": Sense(last_payoff),
    "PAID": Sense(just_paid),
}
ACTUATORS = {
    **{name: one for name, one in COLLECT.ACTUATORS.items() if name != "EMAG"},
    "EMAGA": claw("objects_a"),
    "EMAGB": claw("objects_b"),
}


class ForagingRoles(Model):
    """Robots, objects of two kinds on two sides, a drop zone between, and a field of obstacles."""

    ticks = 60_000

    half_width: float = parameter(70.0, unit="units", low=70.0, doc="from the middle to a border")
    foragers: int = parameter(9, unit="robots", low=1, high=36, doc="how many begin")
    wanted_b: float = parameter(
        2 / 3, unit="of the objects", low=0.05, high=0.95, doc="the share wanted of B at the start"
    )
    decay: float = parameter(
        0.0005, unit="of the counts", low=0.0, high=1.0, doc="what a tick takes of them"
    )
    patience: int = parameter(
        3000, unit="ticks", low=1, doc="without picking up or delivering until a robot is rescued"
    )
    start: int = parameter(
        ANY,
        unit="of five",
        low=0,
        high=4,
        doc="roles then: 0 all A, 1 all B, 2 undecided, 3 random, 4 one of these, drawn",
    )
    reverse_at: int = parameter(
        -1, unit="ticks", low=-1, doc="when the wanted ratio is turned round; -1 for never"
    )
    remove_at: int = parameter(
        -1, unit="ticks", low=-1, doc="when robots of one role are taken away; -1 for never"
    )
    removed_role: int = parameter(
        0, unit="of two", low=0, high=1, doc="whose robots are taken away: 0 for A, 1 for B"
    )
    add_at: int = parameter(-1, unit="ticks", low=-1, doc="when robots are added; -1 for never")
    shift: int = parameter(3, unit="robots", low=0, doc="how many are taken away, or added")

    wanted: float = 0.5
    began_as: int = 0
    in_b: int = 0
    present: int = 0
    changed: int = 0
    off: float = 0.0
    last_beyond: list[int] = [-1] * FARTHEST_OFF
    began_at: int = 0
    within_since: int = -1
    settled_at: int = -1
    changes_before: int = 0
    changes_settled: int = 0

    world = Plane("half_width")
    obstacles = Population(Obstacle, COLLECT.SIDE * COLLECT.SIDE)
    drop_zones = Population(Zone, 1)
    markets = Population(Market, 1)
    objects_a = Population(Ball, MOST + SPARE, body=BALL)
    objects_b = Population(Ball, MOST + SPARE, body=BALL)
    robots = Population(
        Forager,
        "foragers",
        body=Disc(meets=("objects_a", "objects_b"), seen=False),
        sensors=SENSORS,
        actuators=ACTUATORS,
        hierarchy="mind",
        master="Forage",
    )

    rewards = {"delivered": paid()}
    measures = {
        "within_one": stays_within(1),
        "within_two": stays_within(2),
        "within_three": stays_within(3),
        "role_changes": Measure(changes_after_settling),
        "settling_ticks": Measure(ticks_to_settle),
        "objects_a": total("delivered_a"),
        "objects_b": total("delivered_b"),
        "collisions": total("collisions"),
        "rescues": total("rescues"),
    }

    setup = (
        each(obstacles, lay),
        each(drop_zones, mark),
        each(markets, open_market),
        each(robots, arrive),
        each(objects_a, lay_a),
        each(objects_b, lay_b),
    )
    schedule = (
        each(robots, work),
        each(objects_a, tidy_a),
        each(objects_b, tidy_b),
        each(markets, forget),
        each(markets, shock),
        once(watch),
    )

    def series(self):
        """Return the split of roles, what is wanted, and what the market holds."""
        market = self.markets
        return {
            "robots": len(self.robots),
            "in_a": len(self.robots) - self.in_b,
            "in_b": self.in_b,
            "wanted_in_b": self.wanted * len(self.robots),
            "off": self.off,
            "count_a": float(market.ware[0]),
            "count_b": float(market.staple[0]),
            "scarcity_of_a": float(market.perception[0]),
            "payoff": float(self.robots.payoff.mean()),
            "delivered_a": int(self.robots.delivered_a.sum()),
            "delivered_b": int(self.robots.delivered_b.sum()),
            "changes": int(self.robots.changes.sum()),
            "over": self.over,
        }
