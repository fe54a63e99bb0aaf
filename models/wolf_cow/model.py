"""Wolves, cows and bulls: cows graze, multiply and keep near bulls; wolves attack unless afraid.

Two kinds of minds share a pasture. Cows that are far from bulls are afraid, wolves that are near
them. The model is one of those that came with CogLogo (Suro, 2020).
"""

from socialmind import Agent, Model, Patch, Population, Torus, each, once, parameter

MOST_GRASS = 130.0  # of a patch
BITE = 86.0  # grass of a full meal
MEAL = 5.4  # energy of a full meal
LEAST_EFFORT = 0.1  # energy that a tick costs a cow
MOST_EFFORT = 0.34
FIRST_ENERGY = 50
ENERGY_SPREAD = 25
BREEDING_ENERGY = 30.0  # above which a cow can have a calf
DETECTION = 8.2  # patches at which a cow makes out a bull
MOST_FEAR = 10.0  # of a cow
CHASE = 13.3  # patches at which a wolf goes for a cow
MOST_COURAGE = 100.0  # of a wolf that no bull frightens
FLIGHT_SPREAD = 10.0  # degrees to either side of the way from the bull
TURN = 50  # degrees to either side, while an animal strays


class Cow(Agent):
    """A cow: its energy, and how many cows there were before it in its line."""

    energy: float = 0.0
    generation: int = 0


class Wolf(Agent):
    """A wolf: its hunger, and the cows that it has eaten."""

    hunger: float = 0.0
    eaten: int = 0


class Bull(Agent):
    """A bull, which wanders."""


class Pasture(Patch):
    """A patch and its grass."""

    grass: float = 0.0


# Setup ------------------------------------------------------------------------------------------


def sow(model, rng):
    """Give each patch its first grass."""
    for patch in model.world.patches:
        patch.grass = rng.uniform(0, MOST_GRASS)


def arrive(animal, model, rng):
    """Put an animal on a random place."""
    world = model.world
    animal.x = rng.uniform(world.low - 0.5, world.high + 0.5)
    animal.y = rng.uniform(world.low - 0.5, world.high + 0.5)
    animal.heading = rng.integers(360)


def fatten(cow, rng):
    """Give a cow its first energy."""
    cow.energy = FIRST_ENERGY + rng.integers(ENERGY_SPREAD)


# Cows -------------------------------------------------------------------------------------------


def live(cow, model, rng):
    """Spend energy, look for the bulls, choose a plan, and carry it out."""
    cow.energy -= rng.uniform(LEAST_EFFORT, MOST_EFFORT)
    if cow.energy <= 0:
        cow.die()
        model.starved += 1
        return
    cow.mind.set_cogniton_value("energy", cow.energy)
    cow.mind.set_cogniton_value("fear", fear_of_cow(cow, model))
    cow.plan = cow.mind.choose_next_plan()
    cow.run_plan(model, rng)


def fear_of_cow(cow, model):
    """Return a cow's fear: it grows with the distance to the nearest bull."""
    bull = model.bulls.nearest(cow)
    if bull is None:
        return MOST_FEAR
    away = model.world.distance(cow, bull.x, bull.y)
    return min(MOST_FEAR, MOST_FEAR * away / (DETECTION / 2))


def eat(cow, model, rng):
    """Graze what is left here, at most a full meal; stray where there is nothing."""
    patch = model.world.patch(cow.x, cow.y)
    if patch.grass < 1:
        stray(cow, model, rng)
        return
    bite = min(patch.grass, BITE)
    patch.grass -= bite
    cow.energy += MEAL * bite / BITE


def reproduce(cow, model):
    """Have a calf, which gets half the energy and the same mind, if there is enough for two."""
    if cow.energy > BREEDING_ENERGY:
        cow.energy /= 2
        calf = cow.hatch()
        calf.generation += 1
        calf.plan = None
        model.born += 1


def follow_bull(cow, model, rng):
    """Walk to the nearest bull; stray where there is none."""
    bull = model.bulls.nearest(cow)
    if bull is None:
        stray(cow, model, rng)
    else:
        model.world.walk_to(cow, bull.x, bull.y, 1)


# Wolves -----------------------------------------------------------------------------------------


def hunt(wolf, model, rng):
    """Grow hungrier, look for the bulls, choose a plan, and carry it out."""
    wolf.hunger += model.hunger_growth
    wolf.mind.set_cogniton_value("hunger", wolf.hunger)
    wolf.mind.set_cogniton_value("fear", fear_of_wolf(wolf, model))
    wolf.plan = wolf.mind.choose_next_plan()
    wolf.run_plan(model, rng)


def fear_of_wolf(wolf, model):
    """Return a wolf's fear: it grows as the nearest bull comes nearer."""
    bull = model.bulls.nearest(wolf)
    if bull is None:
        return 0.0
    away = max(model.world.distance(wolf, bull.x, bull.y), 0.01)
    return (MOST_COURAGE - model.courage) / away


def attack(wolf, model, rng):
    """Go to the nearest cow in reach and eat it; stray where there is none."""
    cow = model.cows.nearest(wolf, CHASE)
    if cow is None:
        stray(wolf, model, rng)
        return
    model.world.walk_to(wolf, cow.x, cow.y, 1)
    if model.world.distance(wolf, cow.x, cow.y) == 0:
        cow.die()
        wolf.hunger = 0.0
        wolf.eaten += 1
        model.killed += 1


def flee(wolf, model, rng):
    """Go a step away from the nearest bull, more or less."""
    bull = model.bulls.nearest(wolf)
    if bull is None:
        stray(wolf, model, rng)
        return
    away = model.world.towards(wolf, bull.x, bull.y) + 180
    wolf.heading = away + rng.uniform(-FLIGHT_SPREAD, FLIGHT_SPREAD)
    model.world.forward(wolf, 1)


# Bulls and grass --------------------------------------------------------------------------------


def wander(bull, model, rng):
    """Turn a little and go a step."""
    model.world.right(bull, rng.integers(TURN))
    model.world.left(bull, rng.integers(TURN))
    model.world.forward(bull, model.bull_step)


def stray(animal, model, rng):
    """Turn a little to either side and go a step."""
    model.world.right(animal, rng.integers(TURN))
    model.world.left(animal, rng.integers(TURN))
    model.world.forward(animal, 1)


def regrow(model):
    """Let the grass grow, up to the most that a patch can bear."""
    for patch in model.world.patches:
        patch.grass = min(patch.grass + model.growth, MOST_GRASS)


def count(model):
    """Count the wolves that attack and that flee."""
    model.attacking = sum(1 for wolf in model.wolves if wolf.plan == "attack")
    model.fleeing = sum(1 for wolf in model.wolves if wolf.plan == "flee")


class WolfCow(Model):
    """Cows that keep near bulls, and wolves that bulls frighten (after CogLogo's model)."""

    ticks = 5_000

    n_cows: int = parameter(19, unit="cows", low=1, high=1000, doc="cows at the start")
    n_wolves: int = parameter(5, unit="wolves", low=0, high=100, doc="wolves")
    n_bulls: int = parameter(3, unit="bulls", low=0, high=100, doc="bulls")
    courage: float = parameter(
        50.0, unit="–", low=0.0, high=100.0, doc="of wolves; at 100 no bull frightens them"
    )
    hunger_growth: float = parameter(
        0.3, unit="hunger a tick", low=0.0, high=100.0, doc="by which a wolf grows hungrier"
    )
    bull_step: float = parameter(
        0.2, unit="patches a tick", low=0.0, high=10.0, doc="pace of bulls"
    )
    growth: float = parameter(
        0.1, unit="grass a tick", low=0.0, high=130.0, doc="grass that grows on a patch"
    )

    born: int = 0
    starved: int = 0
    killed: int = 0
    attacking: int = 0
    fleeing: int = 0

    world = Torus(33, Pasture)
    cows = Population(
        Cow,
        "n_cows",
        mind="cows.yaml",
        plans={"reproduce": reproduce, "cow-eat": eat, "follow-bull": follow_bull},
    )
    wolves = Population(
        Wolf, "n_wolves", mind="wolves.yaml", plans={"attack": attack, "flee": flee}
    )
    bulls = Population(Bull, "n_bulls")

    setup = (
        once(sow),
        each(cows, arrive),
        each(cows, fatten),
        each(wolves, arrive),
        each(bulls, arrive),
    )
    schedule = (
        each(cows, live),
        each(wolves, hunt),
        each(bulls, wander),
        once(regrow),
        once(count),
    )
