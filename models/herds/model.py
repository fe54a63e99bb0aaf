"""Herds: cows graze, found herds, join the nearest one they see, and leave it with its leader.

A herd is a group with a leader and followers; what it adds to their minds are its culturons. The
model is one of those that came with CogLogo (Suro, 2020).
"""

from socialmind import Agent, Model, Patch, Population, Torus, each, once, parameter

LEAST_GRASS = 100.0  # of a patch at the start
MOST_GRASS = 130.0
BITE = 86.0  # grass of a full meal
MEAL = 5.4  # energy of a full meal
LEAST_EFFORT = 0.1  # energy that a tick costs
MOST_EFFORT = 0.34
FIRST_ENERGY = 500
ENERGY_SPREAD = 250
TURN = 50  # degrees to either side, while a cow strays
CLOSE = 1.0  # patches from its leader at which a follower stands still
NO_HERD = -1


class Cow(Agent):
    """A cow: its energy, its herd and its part in it, and what it has eaten and joined so far."""

    energy: float = 0.0
    leader: int | None = None
    herd: int = NO_HERD
    leading: bool = False
    eaten: float = 0.0
    founded: int = 0
    joined: int = 0


class Pasture(Patch):
    """A patch and its grass."""

    grass: float = 0.0


# Setup ------------------------------------------------------------------------------------------


def sow(model, rng):
    """Give each patch its first grass."""
    for patch in model.world.patches:
        patch.grass = rng.uniform(LEAST_GRASS, MOST_GRASS)


def arrive(cow, model, rng):
    """Put a cow on a random place."""
    world = model.world
    cow.x = rng.uniform(world.low - 0.5, world.high + 0.5)
    cow.y = rng.uniform(world.low - 0.5, world.high + 0.5)
    cow.heading = rng.integers(360)
    cow.energy = FIRST_ENERGY + rng.integers(ENERGY_SPREAD)


# A tick -----------------------------------------------------------------------------------------


def live(cow, model, rng):
    """Spend energy, choose a plan, and carry it out."""
    cow.energy -= rng.uniform(LEAST_EFFORT, MOST_EFFORT)
    if cow.energy <= 0:
        cow.die()
        return
    cow.mind.set_cogniton_value("energy", cow.energy)
    cow.plan = cow.mind.choose_next_plan()
    cow.run_plan(model, rng)


def regrow(model):
    """Let the grass grow, up to the most that a patch can bear."""
    for patch in model.world.patches:
        patch.grass = min(patch.grass + model.growth, MOST_GRASS)


def look_round(model):
    """Note who is in which herd, and count the herds."""
    for cow in model.cows:
        cow.herd = cow.mind.get_group_id("herd")
        cow.leading = is_leader(cow)
    model.herds = sum(1 for cow in model.cows if cow.leading)
    model.in_herds = sum(1 for cow in model.cows if cow.herd != NO_HERD)
    model.largest = max((size(cow.herd, model) for cow in model.cows if cow.leading), default=0)
    model.energy = sum(cow.energy for cow in model.cows)


def size(herd, model):
    """Return how many cows are in a herd, its leader included."""
    return sum(1 for cow in model.cows if cow.herd == herd)


# Plans ------------------------------------------------------------------------------------------


def eat(cow, model, rng):
    """Graze what is left here, at most a full meal; stray where there is nothing."""
    patch = model.world.patch(cow.x, cow.y)
    if patch.grass < 1:
        stray(cow, model, rng)
        return
    bite = min(patch.grass, BITE)
    patch.grass -= bite
    cow.energy += MEAL * bite / BITE
    cow.eaten += bite


def look_for_group(cow, model, rng):
    """Join the herd of the nearest leader in sight and leave one's own; stray if there is none."""
    leader = min(
        (other for other in model.cows.near(cow, model.sight) if is_leader(other)),
        key=lambda other: model.world.distance(cow, other.x, other.y),
        default=None,
    )
    if leader is None:
        stray(cow, model, rng)
        return
    herd = leader.mind.get_group_id("herd")
    if herd == cow.mind.get_group_id("herd"):
        return
    cow.mind.leave_group("herd")
    cow.mind.join_group("herd", "follower", herd)
    cow.mind.set_participation("herd", model.participation)
    cow.leader = leader.id
    cow.joined += 1


def create_group(cow, model):
    """Found a herd and lead it; a follower leaves its own, a leader has one."""
    if is_leader(cow):
        return
    cow.mind.leave_group("herd")
    cow.mind.create_and_join_group("herd", "leader")
    cow.mind.set_participation("herd", model.participation)
    cow.leader = None
    cow.founded += 1


def lead_herd(cow, model, rng):
    """Stray; the herd comes along."""
    stray(cow, model, rng)


def follow_leader(cow, model):
    """Walk to one's leader; leave the herd if it leads no longer."""
    if cow.leader is None or not leads(cow.leader, cow.mind.get_group_id("herd"), model):
        cow.mind.leave_group("herd")
        cow.leader = None
        return
    leader = model.cows[cow.leader]
    if model.world.distance(cow, leader.x, leader.y) > CLOSE:
        model.world.walk_to(cow, leader.x, leader.y, 1)


def is_leader(cow):
    """Say whether a cow leads a herd."""
    return cow.mind.get_group_role_id("herd", "leader") >= 0


def leads(leader, herd, model):
    """Say whether a cow, by its identity, lives and leads a herd."""
    if not model.cows.contains(leader):
        return False
    return model.cows[leader].mind.get_group_role_id("herd", "leader") == herd


def stray(cow, model, rng):
    """Turn a little to either side and go a step."""
    model.world.right(cow, rng.integers(TURN))
    model.world.left(cow, rng.integers(TURN))
    model.world.forward(cow, 1)


class Herds(Model):
    """Cows that found herds, follow their leader and leave it (after CogLogo's model)."""

    ticks = 5_000

    n_cows: int = parameter(16, unit="cows", low=1, high=1000, doc="cows at the start")
    sight: float = parameter(
        8.0, unit="patches", low=0.0, high=24.0, doc="how far a cow sees leaders"
    )
    participation: float = parameter(
        4.0, unit="–", low=0.0, high=1000.0, doc="how much a herd's culturons count for its cows"
    )
    growth: float = parameter(
        0.1, unit="grass a tick", low=0.0, high=130.0, doc="grass that grows on a patch"
    )

    herds: int = 0
    in_herds: int = 0
    largest: int = 0
    energy: float = 0.0

    world = Torus(33, Pasture)
    cows = Population(
        Cow,
        "n_cows",
        mind="scheme.yaml",
        plans={
            "lead-herd": lead_herd,
            "cow-eat": eat,
            "create-group": create_group,
            "follow-leader": follow_leader,
            "look-for-group": look_for_group,
        },
    )

    setup = (once(sow), each(cows, arrive))
    schedule = (each(cows, live), once(regrow), once(look_round))
