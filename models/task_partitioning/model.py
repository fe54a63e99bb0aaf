"""Robots that fetch items down a slope: one carries them all the way, or two divide the way.

Items lie at the source, at the upper end of an arena; the nest is at its lower end. What is let go
on the slope slides down into the cache beside the nest. Nobody tells a robot to be a dropper or a
collector: it has but phototaxis, antiphototaxis, a random walk and a gripper, and a mind that says
when to do what, the same one in all robots (after Ferrante, Turgut, Duéñez-Guzmán, Dorigo and
Wenseleers, 2015, PLoS Computational Biology 11(8): e1004273).
"""

import math

import numpy as np

from socialmind import Agent, Grid, Model, Population, each, once, parameter

from .places import BORDERS, CACHE, LENGTH, NEST, SLOPE, SOURCE, WIDTH, place_of
from .programmed import (
    ANTIPHOTOTAXIS,
    LEARNED,
    PHOTOTAXIS,
    RANDOM_WALK,
    follow_strategy,
    strategy_of,
)

PLACES = ("NEST", "CACHE", "SLOPE", "SOURCE")
BEHAVIOURS = ("Phototaxis", "Antiphototaxis", "RandomWalk")
STRATEGIES = ("learned", "generalist", "dropper", "collector")
MASTER = "Forage"
WAVER = 20.0  # degrees to either side by which a robot misses the light's direction
TURN = 50.0  # degrees to either side that a robot turns in each tick of a random walk


class Item(Agent):
    """An item: who took it from the source, whether another had it too, and how it moves."""

    fetched_by: int | None = None
    shared: bool = False
    slid: bool = False
    carried: bool = False
    sliding: bool = False
    rests_at: float = 0.0


class Robot(Agent):
    """A robot: where it is, what it does, the item that it has, and its work so far."""

    strategy: int = LEARNED
    place: int = NEST
    behaviour: int = PHOTOTAXIS
    picks_up: bool = False
    drops: bool = False
    item: int | None = None
    timer: int = 0
    fetched: int = 0
    collected: int = 0
    delivered: int = 0
    chances: list[float] = [0.0] * len(BEHAVIOURS)


# Setup ------------------------------------------------------------------------------------------


def begin(robot, model, rng):
    """Begin somewhere in the nest."""
    robot.strategy = strategy_of(robot.id, model)
    model.world.move_to(robot, across(rng), rng.uniform(0.0, BORDERS[CACHE] - 0.5))
    robot.heading = rng.uniform(0.0, 360.0)


def restock(model, rng):
    """Let as many items lie untouched at the source as shall, unless there are too many."""
    while model.untouched < model.n_source and len(model.items) < model.most_items:
        item = model.items.create()
        model.world.move_to(item, across(rng), rng.uniform(BORDERS[SOURCE] + 0.5, LENGTH - 1.0))
        model.untouched += 1


def across(rng):
    """Return a place across the arena, any as likely."""
    return rng.uniform(0.0, WIDTH - 1.0)


# A tick -----------------------------------------------------------------------------------------


def forage(robot, model, rng):
    """Decide where it is time to; pick up or drop what there is to; move."""
    place = place_of(robot.y)
    if robot.timer == 0 or place != robot.place:
        robot.place = place
        decide(robot, model, rng)
    robot.timer -= 1
    if robot.item is None:
        if robot.picks_up:
            pick_up(robot, model)
    elif robot.drops:
        drop(robot, model, rng)
    move(robot, model, rng)


def slide(item, model):
    """Slide on, down to where the item comes to rest in the cache."""
    if item.sliding:
        item.y = max(item.y - model.gradient * model.sliding, item.rests_at)
        item.sliding = item.y > item.rests_at


# What robots do ---------------------------------------------------------------------------------


def decide(robot, model, rng):
    """Choose what to do for the next ticks."""
    robot.timer = model.decision
    if robot.strategy != LEARNED:
        follow_strategy(robot, model)
        return
    mind = robot.hierarchy
    mind.set_sensor("NEST", 1.0 if robot.place == NEST else 0.0)
    mind.set_sensor("CACHE", 1.0 if robot.place == CACHE else 0.0)
    mind.set_sensor("SLOPE", 1.0 if robot.place == SLOPE else 0.0)
    mind.set_sensor("SOURCE", 1.0 if robot.place == SOURCE else 0.0)
    mind.set_sensor("LADEN", 0.0 if robot.item is None else 1.0)
    mind.set_sensor("PHOTOTAXIS", 1.0 if robot.behaviour == PHOTOTAXIS else 0.0)
    mind.set_sensor("ANTIPHOTOTAXIS", 1.0 if robot.behaviour == ANTIPHOTOTAXIS else 0.0)
    mind.set_sensor("RANDOM_WALK", 1.0 if robot.behaviour == RANDOM_WALK else 0.0)
    mind.evaluate()
    robot.chances[PHOTOTAXIS] = mind.actuator("Phototaxis")
    robot.chances[ANTIPHOTOTAXIS] = mind.actuator("Antiphototaxis")
    robot.chances[RANDOM_WALK] = mind.actuator("RandomWalk")
    if sum(robot.chances) > 0.0:
        robot.behaviour = rng.choice(len(BEHAVIOURS), p=robot.chances)
    robot.picks_up = rng.random() < mind.actuator("PickUp")
    robot.drops = rng.random() < mind.actuator("Drop")


def pick_up(robot, model):
    """Take an item within reach that lies still, and decide anew."""
    for item in model.items.near(robot, model.reach):
        if item.carried or item.sliding:
            continue
        if item.fetched_by is None:
            item.fetched_by = robot.id
            robot.fetched += 1
            model.untouched -= 1
        elif item.fetched_by != robot.id:
            item.shared = True
        robot.collected += robot.place == CACHE
        item.carried = True
        robot.item = item.id
        robot.timer = 0
        break


def drop(robot, model, rng):
    """Let the item go: in the nest it is home, on a slope it slides. Decide anew."""
    item = model.items[robot.item]
    robot.item = None
    robot.timer = 0
    item.carried = False
    model.world.move_to(item, robot.x, robot.y)
    if robot.place == NEST:
        robot.delivered += 1
        model.delivered += 1
        model.shared += item.shared
        model.slid += item.slid
        item.die()
    elif robot.place == SLOPE and model.gradient > 0.0:
        item.sliding = True
        item.slid = True
        item.rests_at = rng.uniform(BORDERS[CACHE] + 0.5, BORDERS[SLOPE] - 0.5)


def move(robot, model, rng):
    """Go to the light, away from it or anywhere; slower on the slope; turn at a wall."""
    if robot.behaviour == PHOTOTAXIS:
        robot.heading = rng.uniform(-WAVER, WAVER)
    elif robot.behaviour == ANTIPHOTOTAXIS:
        robot.heading = 180.0 + rng.uniform(-WAVER, WAVER)
    else:
        robot.heading += rng.uniform(-TURN, TURN)
    step = model.speed
    if robot.place == SLOPE:
        rise = math.cos(math.radians(robot.heading))
        loss = model.uphill_loss * rise if rise > 0.0 else -model.downhill_loss * rise
        step *= 1.0 - model.gradient * loss
    if model.world.can_move(robot, step):
        model.world.forward(robot, step)
    else:
        robot.heading = rng.uniform(0.0, 360.0)


class TaskPartitioning(Model):
    """Robots that fetch items, alone or by dividing the way (Ferrante et al., 2015)."""

    ticks = 1_000

    n_robots: int = parameter(4, unit="robots", low=1, high=100, doc="robots of the group")
    n_generalists: int = parameter(
        0, unit="robots", low=0, high=100, doc="of them programmed to carry items all the way"
    )
    n_droppers: int = parameter(
        0, unit="robots", low=0, high=100, doc="of them programmed to let items go on the slope"
    )
    n_collectors: int = parameter(
        0, unit="robots", low=0, high=100, doc="of them programmed to collect from the cache"
    )
    gradient: float = parameter(
        1.0, unit="share", low=0.0, high=1.0, doc="of the steepest slope; 0 for flat ground"
    )
    speed: float = parameter(
        1.0, unit="patches a tick", low=0.01, high=1.0, doc="of robots on flat ground"
    )
    uphill_loss: float = parameter(
        0.6, unit="share", low=0.0, high=0.99, doc="of speed lost straight up the steepest slope"
    )
    downhill_loss: float = parameter(
        0.4, unit="share", low=0.0, high=0.99, doc="of speed lost straight down, by braking"
    )
    sliding: float = parameter(
        2.0, unit="patches a tick", low=0.01, high=10.0, doc="of items on the steepest slope"
    )
    reach: float = parameter(
        0.6, unit="patches", low=0.1, high=5.0, doc="from a robot to an item that it can pick up"
    )
    n_source: int = parameter(
        5, unit="items", low=1, high=100, doc="that lie untouched at the source"
    )
    most_items: int = parameter(
        60, unit="items", low=1, high=1000, doc="in the arena, beyond which none are added"
    )
    decision: int = parameter(
        10, unit="ticks", low=1, high=1000, doc="after which a robot decides anew at the latest"
    )

    untouched: int = 0
    delivered: int = 0
    shared: int = 0
    slid: int = 0

    world = Grid(WIDTH, LENGTH, wraps=False, low=(0, 0))
    robots = Population(Robot, "n_robots", hierarchy="mind", master=MASTER)
    items = Population(Item, 0)

    setup = (each(robots, begin), once(restock))
    schedule = (
        each(robots, forage),
        each(items, slide, shuffled=False),
        once(restock),
    )

    def score(self):
        """Return how many items the group has brought home."""
        return float(self.delivered)

    def series(self):
        """Return items fetched, brought home, by how many hands and how, and who is where."""
        robots = self.robots
        places = np.bincount(robots.place, minlength=len(PLACES))
        return {
            "fetched": int(robots.fetched.sum()),
            "collected": int(robots.collected.sum()),
            "delivered": self.delivered,
            "shared": self.shared,
            "slid": self.slid,
            "lying": int((~self.items.carried).sum()) - self.untouched,
            **{f"in_{name.lower()}": int(n) for name, n in zip(PLACES, places, strict=True)},
        }

    def agents(self):
        """Return each robot's strategy, place, behaviour, load and work so far."""
        robots = self.robots
        return {
            "agent": robots.id,
            "x": robots.x,
            "y": robots.y,
            "heading": robots.heading,
            "strategy": [STRATEGIES[one] for one in robots.strategy.tolist()],
            "place": [PLACES[one].lower() for one in robots.place.tolist()],
            "behaviour": [BEHAVIOURS[one] for one in robots.behaviour.tolist()],
            "laden": robots.filled("item", -1) >= 0,
            "fetched": robots.fetched,
            "collected": robots.collected,
            "delivered": robots.delivered,
        }
