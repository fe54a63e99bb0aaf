"""Robots that forage three kinds of objects, in bodies: by a scheme, by thresholds, by chance.

The model is `foraging_roles` with a third kind C, whose objects lie on a third side. What an object
is worth is 0.5 + 0.15 (w − s) / (w (1 − w)), w being the share that is wanted of its kind and s its
share of the counts: with two kinds that is the payoff of `foraging_roles`. A robot is known by what
it brought home last. Bodies, skills and Collect are those of `foraging_roles`; Collect C is one
more duplicate.
"""

from socialmind import Model, Population, each, once, parameter
from socialmind.catalogue import load_file, model_folder
from socialmind.economy import proportional_decay
from socialmind.mind import MindDescription, Programmed, Skill, Variable
from socialmind.worlds.plane import (
    BALL,
    Disc,
    Obstacle,
    Plane,
    Robot,
    Zone,
    claw,
    in_claw,
    orientation,
)

MODEL = model_folder("foraging_roles")
KNOWN = model_folder("collect_retrained") / "mind"
PLACES = load_file(MODEL / "places.py")
WORK = load_file(MODEL / "work.py")
PAYOFF = load_file(MODEL / "payoff.py")
DECIDING = load_file(MODEL / "deciding.py")
RULES = load_file(MODEL / "thresholds.py")
BALLS = load_file(MODEL / "model.py").Ball
COLLECT = PLACES.COLLECT
LESSONS = load_file(MODEL / "lessons.py")

A, B, C = 0, 1, 2
KINDS = 3
SCHEME, THRESHOLDS, CHANCE, GREED = 0, 1, 2, 3
MOST = 36  # robots
ASIDE = 30.0  # units across, at most, of objects on their side
WITHIN = 1e-9


# Mind -------------------------------------------------------------------------------------------


def forage():
    """Collect all the time."""
    return 1.0


def collect_select(ROLE):
    """Collect what the role says: A at 0, B at 0.5, C at 1."""
    if ROLE < 0.25:
        return 1.0, 0.0, 0.0
    if ROLE < 0.75:
        return 0.0, 1.0, 0.0
    return 0.0, 0.0, 1.0


def mind() -> MindDescription:
    """Return the mind of robots that can collect three kinds; what to collect is not its matter."""
    known = MindDescription.load(KNOWN)
    collecting = [f"SK:Collect{kind}" for kind in "ABC"]
    own = [
        Skill("Forage", [], ["SK:CollectSelect"], Programmed(forage)),
        Skill("CollectSelect", ["VA:ROLE"], collecting, Programmed(collect_select)),
    ]
    skills = [*own, *(one for kind in "ABC" for one in LESSONS.collecting(known, kind))]
    variables = [*known.variables.values(), Variable("ROLE")]
    by_name = {one.name: one for one in skills}
    return MindDescription("Forager", SENSORS, ACTUATORS, variables, by_name.values())


# Places -----------------------------------------------------------------------------------------


def put(ball, model, rng, kind):
    """Put an object somewhere on the side of its kind: left, right or above, free of obstacles."""
    free = False
    while not free:
        away = rng.uniform(PLACES.NEAREST, PLACES.FARTHEST)
        aside = rng.uniform(-ASIDE, ASIDE)
        ball.x = -away if kind == A else away if kind == B else aside
        ball.y = away if kind == C else aside
        free = True
        for obstacle in model.obstacles:
            margin = obstacle.half_width * 1.4143 + COLLECT.FROM_OBSTACLES
            if COLLECT.away(ball, obstacle.x, obstacle.y) < margin:
                free = False
    ball.vx = 0
    ball.vy = 0
    ball.home_x = ball.x
    ball.home_y = ball.y


def lay(ball, model, rng, kind):
    """Put an object on its side, unless there are enough."""
    if ball.id < len(model.robots) + PLACES.SPARE:
        put(ball, model, rng, kind)
    else:
        ball.die()


def lay_a(ball, model, rng):
    """Put an object of the kind A on its side."""
    lay(ball, model, rng, A)


def lay_b(ball, model, rng):
    """Put an object of the kind B on its side."""
    lay(ball, model, rng, B)


def lay_c(ball, model, rng):
    """Put an object of the kind C on its side."""
    lay(ball, model, rng, C)


def tidy_a(ball, model, rng):
    """Put an object of the kind A that is astray elsewhere."""
    if PLACES.astray(ball):
        put(ball, model, rng, A)


def tidy_b(ball, model, rng):
    """Put an object of the kind B that is astray elsewhere."""
    if PLACES.astray(ball):
        put(ball, model, rng, B)


def tidy_c(ball, model, rng):
    """Put an object of the kind C that is astray elsewhere."""
    if PLACES.astray(ball):
        put(ball, model, rng, C)


# Work -------------------------------------------------------------------------------------------


class Fetcher(Robot):
    """A robot: what it fetches, what it brought home last, and what decides in it.

    `load` is the kind in its claw and `brought` that of its last delivery, -1 for none; `cargo` the
    object's identity. `thresholds` are those of the three tasks.
    """

    kind: int = 0
    load: int = -1
    cargo: int = -1
    brought: int = -1
    payoff: float = 0.5
    paid: bool = False
    since: int = 0
    rescues: int = 0
    delivered: int = 0
    changes_brought: int = 0
    thresholds: list[float] = [0.0] * KINDS


def begin(model):
    """Let counts begin at the wanted ratio, as if the group had worked before."""
    parts = model.part_a + model.part_b + model.part_c
    model.wanted[A] = model.part_a / parts
    model.wanted[B] = model.part_b / parts
    model.wanted[C] = model.part_c / parts
    for kind in range(KINDS):
        model.counts[kind] = PAYOFF.COUNTED * len(model.robots) * model.wanted[kind]


def arrive(robot, model, rng):
    """Put a robot near the middle, with a role that is drawn."""
    PLACES.stand(robot, rng)
    for kind in range(KINDS):
        robot.thresholds[kind] = RULES.begun(rng.random(), model)
    take_up(robot, model, rng.integers(KINDS))


def work(robot, model, rng):
    """Notice what a robot picks up, pay it for what it delivers, and let it decide."""
    robot.paid = False
    robot.since += 1
    if robot.carrying >= 0:
        if robot.cargo != robot.carrying:
            robot.cargo = robot.carrying  # its object is put ahead of it in the next tick
        elif robot.load == -1:
            pick_up(robot, model)
    elif robot.load == A:
        let_go(robot, model, rng, model.objects_a[robot.cargo])
    elif robot.load == B:
        let_go(robot, model, rng, model.objects_b[robot.cargo])
    elif robot.load == C:
        let_go(robot, model, rng, model.objects_c[robot.cargo])
    if robot.since > model.patience:
        rescue(robot, model, rng)
    if robot.paid:
        decide(robot, model, rng)


def pick_up(robot, model):
    """Find out which kind of object a robot has in its claw: the one just ahead of it."""
    robot.since = 0
    robot.load = C
    if model.objects_a.contains(robot.cargo) and is_ahead(robot, model.objects_a[robot.cargo]):
        robot.load = A
    elif model.objects_b.contains(robot.cargo) and is_ahead(robot, model.objects_b[robot.cargo]):
        robot.load = B


def is_ahead(robot, ball):
    """Say whether an object is carried, and that just ahead of a robot."""
    return ball.carrier_kind >= 0 and COLLECT.away(ball, robot.x, robot.y) < WORK.AHEAD


def let_go(robot, model, rng, ball):
    """Pay a robot for the object that it let go of, if that was in the drop zone."""
    if WORK.delivered(ball, model):
        kind = robot.load
        model.counts[kind] += 1
        total = model.counts[A] + model.counts[B] + model.counts[C]
        wanted = model.wanted[kind]
        robot.payoff = PAYOFF.worth((wanted - model.counts[kind] / total) / (wanted * (1 - wanted)))
        robot.paid = True
        robot.earned += 1
        robot.delivered += 1
        if robot.brought >= 0 and robot.brought != kind:
            robot.changes_brought += 1
        robot.brought = kind
        put(ball, model, rng, kind)
    empty(robot)


def empty(robot):
    """Let a robot have nothing in its claw."""
    robot.load = -1
    robot.cargo = -1
    robot.since = 0


def rescue(robot, model, rng):
    """Put a robot that is stuck back near the middle, without what it carries."""
    if robot.load == A:
        WORK.release(model.objects_a[robot.cargo])
    elif robot.load == B:
        WORK.release(model.objects_b[robot.cargo])
    elif robot.load == C:
        WORK.release(model.objects_c[robot.cargo])
    robot.carrying = -1
    robot.closed = False
    empty(robot)
    robot.rescues += 1
    PLACES.stand(robot, rng)


# Deciding ---------------------------------------------------------------------------------------


def decide(robot, model, rng):
    """Let a robot decide that has just delivered; it is in what it brought."""
    if model.decides == SCHEME:
        follow_scheme(robot, model, rng)
    elif model.decides == THRESHOLDS:
        respond(robot, model, rng)
    elif model.decides == CHANCE:
        draw_kind(robot, model, rng)
    elif robot.payoff < DECIDING.AS_IT_SHOULD_BE:
        fetch(robot, (robot.kind + 1 + rng.integers(KINDS - 1)) % KINDS)


def draw_kind(robot, model, rng):
    """Draw what to fetch by the parts that were wanted at first."""
    drawn = rng.random() * (model.part_a + model.part_b + model.part_c)
    if drawn < model.part_a:
        fetch(robot, A)
    elif drawn < model.part_a + model.part_b:
        fetch(robot, B)
    else:
        fetch(robot, C)


def fetch(robot, kind):
    """Tell the robot's skills what to fetch."""
    robot.kind = kind
    robot.hierarchy.set_variable("ROLE", 0.5 * kind)


def take_up(robot, model, kind):
    """Begin with a calling."""
    fetch(robot, kind)
    if kind == A:
        DECIDING.take_up(robot, "CallingA")
        robot.plan = "CollectA"
    elif kind == B:
        DECIDING.take_up(robot, "CallingB")
        robot.plan = "CollectB"
    else:
        DECIDING.take_up(robot, "CallingC")
        robot.plan = "CollectC"


def follow_scheme(robot, model, rng):
    """Let a delivery reinforce the plan that led to it, see what it says, and choose."""
    if robot.kind == A:
        DECIDING.reinforce(robot, "CollectA", "CallingA")
        DECIDING.perceive(robot, model, "PlentyOfA")
    elif robot.kind == B:
        DECIDING.reinforce(robot, "CollectB", "CallingB")
        DECIDING.perceive(robot, model, "PlentyOfB")
    else:
        DECIDING.reinforce(robot, "CollectC", "CallingC")
        DECIDING.perceive(robot, model, "PlentyOfC")
    robot.plan = robot.mind.choose_next_plan()
    robot.run_plan(model, rng)


def collect_a(robot, model):
    """Fetch A from now on, or go on with it."""
    change(robot, model, A)


def collect_b(robot, model):
    """Fetch B from now on, or go on with it."""
    change(robot, model, B)


def collect_c(robot, model):
    """Fetch C from now on, or go on with it."""
    change(robot, model, C)


def change(robot, model, kind):
    """Give up a calling and what was known of it for another one, if it is another."""
    if robot.kind == kind:
        return
    if robot.kind == A:
        DECIDING.leave(robot, "CallingA", "PlentyOfA")
    elif robot.kind == B:
        DECIDING.leave(robot, "CallingB", "PlentyOfB")
    else:
        DECIDING.leave(robot, "CallingC", "PlentyOfC")
    take_up(robot, model, kind)


def respond(robot, model, rng):
    """Let doing a task change the thresholds, and answer to the call of one of the others.

    Each calls as loud as the object was worth too little; they are looked at in a random order.
    """
    stimulus = max(0.0, DECIDING.AS_IT_SHOULD_BE - robot.payoff)
    own = robot.kind
    for kind in range(KINDS):
        moved = model.forgetting
        if kind == own:
            moved = -model.learning
        robot.thresholds[kind] = RULES.bounded(robot.thresholds[kind] + moved, model)
    first = (own + 1 + rng.integers(KINDS - 1)) % KINDS
    second = KINDS - own - first
    if rng.random() < RULES.response(stimulus, robot.thresholds[first]):
        fetch(robot, first)
    elif rng.random() < RULES.response(stimulus, robot.thresholds[second]):
        fetch(robot, second)


# What is seen -----------------------------------------------------------------------------------


def go_on(model):
    """Let counts decay, turn the wanted ratio round when it is time to, and see the split."""
    for kind in range(KINDS):
        model.counts[kind] = proportional_decay(model.counts[kind], model.decay)
    if model.tick == model.reverse_at:
        before = model.wanted[A]
        model.wanted[A] = model.wanted[C]
        model.wanted[C] = before
    off = 0.0
    for kind in range(KINDS):
        bring = 0
        for robot in model.robots:
            if max(robot.brought, 0) == kind:
                bring += 1
        off += abs(bring - model.wanted[kind] * len(model.robots)) / 2
    model.off = off
    if off > 1 + WITHIN:
        model.last_beyond = model.tick + 1
    if model.tick >= model.late:
        model.off_late += off


SENSORS = {
    **{name: one for name, one in COLLECT.SENSORS.items() if name not in ("RADOBJ", "SENSOBJ")},
    "RADOBJA": orientation("objects_a"),
    "RADOBJB": orientation("objects_b"),
    "RADOBJC": orientation("objects_c"),
    "SENSOBJA": in_claw("objects_a"),
    "SENSOBJB": in_claw("objects_b"),
    "SENSOBJC": in_claw("objects_c"),
}
ACTUATORS = {
    **{name: one for name, one in COLLECT.ACTUATORS.items() if name != "EMAG"},
    "EMAGA": claw("objects_a"),
    "EMAGB": claw("objects_b"),
    "EMAGC": claw("objects_c"),
}


class ForagingThree(Model):
    """Robots, objects of three kinds on three sides, a drop zone, and a field of obstacles."""

    ticks = 60_000

    half_width: float = parameter(70.0, unit="units", low=70.0, doc="from the middle to a border")
    foragers: int = parameter(9, unit="robots", low=1, high=MOST, doc="how many there are")
    part_a: float = parameter(2.0, unit="parts", low=0.01, doc="wanted of A")
    part_b: float = parameter(3.0, unit="parts", low=0.01, doc="wanted of B")
    part_c: float = parameter(4.0, unit="parts", low=0.01, doc="wanted of C")
    decay: float = parameter(0.0005, unit="of the counts", low=0.0, high=1.0, doc="each tick")
    patience: int = parameter(3000, unit="ticks", low=1, doc="until a robot is rescued")
    reverse_at: int = parameter(
        -1, unit="ticks", low=-1, doc="when A and C change places; -1 never"
    )
    decides: int = parameter(
        SCHEME, unit="of four", low=0, high=3, doc="0 the scheme, 1 thresholds, 2 chance, 3 greed"
    )
    tolerance: float = parameter(5.0, unit="% of payoff", low=0.0, doc="lacking before plenty")
    lowest_threshold: float = parameter(0.05, unit="of payoff", low=0.001, doc="there can be")
    highest_threshold: float = parameter(0.5, unit="of payoff", low=0.001, doc="there can be")
    variety: float = parameter(1.0, unit="of the range", low=0.0, high=1.0, doc="at the start")
    learning: float = parameter(0.0, unit="a delivery", low=0.0, doc="by which the own one falls")
    forgetting: float = parameter(0.0, unit="a delivery", low=0.0, doc="by which others rise")
    late: int = parameter(45_000, unit="ticks", low=0, doc="from which on distance is added up")

    wanted: list[float] = [1 / 3] * KINDS
    counts: list[float] = [0.0] * KINDS
    off: float = 0.0
    off_late: float = 0.0
    last_beyond: int = -1

    world = Plane("half_width")
    obstacles = Population(Obstacle, COLLECT.SIDE * COLLECT.SIDE)
    drop_zones = Population(Zone, 1)
    objects_a = Population(BALLS, MOST + PLACES.SPARE, body=BALL)
    objects_b = Population(BALLS, MOST + PLACES.SPARE, body=BALL)
    objects_c = Population(BALLS, MOST + PLACES.SPARE, body=BALL)
    robots = Population(
        Fetcher,
        "foragers",
        body=Disc(meets=("objects_a", "objects_b", "objects_c"), seen=False),
        sensors=SENSORS,
        actuators=ACTUATORS,
        hierarchy=mind(),
        master="Forage",
        mind="three_kinds.yaml",
        plans={"CollectA": collect_a, "CollectB": collect_b, "CollectC": collect_c},
    )
    setup = (
        each(obstacles, PLACES.lay),
        each(drop_zones, PLACES.mark),
        once(begin),
        each(robots, arrive),
        each(objects_a, lay_a),
        each(objects_b, lay_b),
        each(objects_c, lay_c),
    )
    schedule = (
        each(robots, work),
        each(objects_a, tidy_a),
        each(objects_b, tidy_b),
        each(objects_c, tidy_c),
        once(go_on),
    )
