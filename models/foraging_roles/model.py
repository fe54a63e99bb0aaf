"""Robots that forage two kinds of objects and find their roles (thesis, 8.2).

Objects of the kinds A and B are wanted in some ratio. A robot that brings one home is told what it
is worth to the group, and that alone; who fetches which is for the robots to settle.
"""

from socialmind import Model, Population, each, once, parameter
from socialmind.economy import Market
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
    orientation,
    paid,
    total,
)

from .deciding import collect_a, collect_b, is_learned
from .measures import (
    FARTHEST_OFF,
    changes_after_settling,
    stays_within,
    ticks_to_settle,
    watch,
    watch_start,
)
from .payoff import forget, open_market
from .places import COLLECT, SPARE, lay, lay_a, lay_b, mark, tidy_a, tidy_b
from .roles import ANY, arrive
from .shocks import shock
from .work import work

MOST = 36  # robots at the start


class Forager(Robot):
    """A robot, what it carries, and what it is paid.

    `load` is the kind of object in its claw (1 for A, 2 for B, 0 for none) and `cargo` its
    identity. `paid` says that it has just delivered one, `payoff` what the last one was worth (0 …
    1, 0.5 as it should be), `role` the variable ROLE of its mind: B from 0.5 on, else A. `since`
    are the ticks since it has picked up or let go of anything, `rescues` how often that was too
    long. `programmed` says that a cogniton scheme decides about its role.
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
    programmed: bool = False


class Ball(Body):
    """An object, and the place where it was put."""

    home_x: float = 0.0
    home_y: float = 0.0


def last_payoff(robot):
    """Return what the last object that the robot delivered was worth."""
    return robot.payoff


def just_paid(robot, model):
    """Return 1 in the tick after a delivery, where it is the learned mind that decides then."""
    return robot.paid and is_learned(robot, model)


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
        0, unit="of two", low=0, high=1, doc="whose robots go first: 0 for A, 1 for B"
    )
    add_at: int = parameter(-1, unit="ticks", low=-1, doc="when robots are added; -1 for never")
    shift: int = parameter(3, unit="robots", low=0, doc="how many are taken away, or added")
    programmed: float = parameter(
        0.0, unit="of the robots", low=0.0, high=1.0, doc="the share whose roles a scheme decides"
    )
    unlearned: int = parameter(
        0,
        unit="of four",
        low=0,
        high=3,
        doc="decides in the others: 0 the learned mind, 1 nobody, 2 chance, 3 the last payoff",
    )
    tolerance: float = parameter(
        5.0,
        unit="% of payoff",
        low=0.0,
        doc="lacking before the scheme thinks of change",
    )

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
    changes_seen: int = 0
    changes_before: int = 0
    changes_settled: int = 0
    settled_changes: int = 0
    settled_robot_ticks: int = 0
    robot_ticks: int = 0

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
        mind="scheme.yaml",
        plans={"CollectA": collect_a, "CollectB": collect_b},
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
        once(watch_start),
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
