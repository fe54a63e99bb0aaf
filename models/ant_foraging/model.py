"""Ants that find food, mark the way with a pheromone, and follow what others have marked.

Nobody knows the field or the shorter way; the marks on the ground are the colony's memory, and they
fade (Deneubourg and Goss, 1989; thesis, section 2.5.1). With `bridge`, two ways of different length
join nest and food (Goss, Aron, Deneubourg and Pasteels, 1989, Naturwissenschaften 76: 579–581).
"""

import math

import numpy as np

from socialmind import Agent, Grid, Looks, Model, Patch, Population, each, once, parameter

STEPS = ((0, 1), (1, 1), (1, 0), (1, -1), (0, -1), (-1, -1), (-1, 0), (-1, 1))
TURN = 45  # degrees from one of the eight steps to the next, clockwise from north
AHEAD = 1  # eighths that an ant turns at most, as it goes
ANYWHERE = 4
NEST_RADIUS = 1.5  # patches
BRIDGE_NEST = -8  # x of the nest where there is a bridge; the food lies as far to the east


class Ant(Agent):
    """An ant: whether it is in the nest, whether it carries food, and what it brought home."""

    inside: bool = True
    laden: bool = False
    brought: int = 0
    chances: list[float] = [0.0] * len(STEPS)


class Ground(Patch):
    """A patch: pheromone on it, pieces of food, whether ants can walk here, and the nest."""

    pheromone: float = 0.0
    food: int = 0
    open: bool = False
    nest: bool = False


# Setup ------------------------------------------------------------------------------------------


def lay_out(model, rng):
    """Lay out the bridge, or the field: a nest in its middle and piles of food around it."""
    if model.bridge:
        build_bridge(model)
        return
    for patch in model.world.patches:
        patch.open = True
        patch.nest = math.hypot(patch.x, patch.y) <= NEST_RADIUS
    turn = rng.uniform(0.0, 360.0)
    for pile in range(model.n_piles):
        angle = math.radians(turn + 360.0 * pile / model.n_piles)
        x = model.pile_distance * math.sin(angle)
        y = model.pile_distance * math.cos(angle)
        pile_up(round(x), round(y), model)


def pile_up(x, y, model):
    """Pile food on a patch and its eight neighbours, as evenly as can be."""
    for piece in range(model.pile_food):
        model.world.patch(x + piece % 3 - 1, y + piece // 3 % 3 - 1).food += 1


def build_bridge(model):
    """Build the nest, the food and two ways between them, one to the north, one to the south."""
    nest = model.world.patch(BRIDGE_NEST, 0)
    nest.nest = True
    nest.open = True
    food = model.world.patch(-BRIDGE_NEST, 0)
    food.food = 1
    food.open = True
    build_way(model.detour_north, 1, model)
    build_way(model.detour_south, -1, model)


def build_way(detour, side, model):
    """Build one way: out from the nest, along to the east, back in to the food."""
    for out in range(1, detour + 2):
        model.world.patch(BRIDGE_NEST + 1, side * out).open = True
        model.world.patch(-BRIDGE_NEST - 1, side * out).open = True
    along = detour + 2 if detour > 0 else 1  # the corners are cut
    for x in range(BRIDGE_NEST + 2, -BRIDGE_NEST - 1):
        model.world.patch(x, side * along).open = True


def stay_inside(ant, model, rng):
    """Begin in the nest."""
    model.world.move_to(ant, nest_x(model), 0)


# A tick -----------------------------------------------------------------------------------------


def forage(ant, model, rng):
    """Leave the nest at times; outside go a step, mark it, take food or bring it home."""
    if ant.inside:
        if rng.random() >= model.leaving:
            return
        ant.inside = False
    go(ant, model, rng)
    patch = model.world.patch(ant.x, ant.y)
    if ant.laden and patch.nest:
        come_home(ant, model)
    elif not ant.laden and patch.food > 0:
        take(ant, patch, model)
    else:
        patch.pheromone += model.homeward if ant.laden else model.outward


def fade(model):
    """Let the pheromone spread and evaporate."""
    model.world.diffuse("pheromone", model.diffusion)
    model.world.evaporate("pheromone", model.evaporation)


# What ants do -----------------------------------------------------------------------------------


def go(ant, model, rng):
    """Go a step ahead; on nest and food, and where it does not go on, in any direction."""
    patch = model.world.patch(ant.x, ant.y)
    anywhere = patch.nest or patch.food > 0
    if weigh(ant, ANYWHERE if anywhere else AHEAD, model) == 0.0:
        weigh(ant, ANYWHERE, model)
    direction = rng.choice(len(STEPS), p=ant.chances)
    dx, dy = STEPS[direction]
    ant.heading = direction * TURN
    model.world.move_to(ant, ant.x + dx, ant.y + dy)
    if model.bridge and ant.x == 0:
        model.passed_north += ant.y > 0
        model.passed_south += ant.y < 0


def weigh(ant, most, model):
    """Weigh the steps that turn the ant by so many eighths at most, and return their sum."""
    ahead = round(ant.heading / TURN)
    for direction in range(len(STEPS)):
        turned = (direction - ahead) % len(STEPS)
        ant.chances[direction] = 0.0
        if min(turned, len(STEPS) - turned) <= most:
            ant.chances[direction] = attraction(ant, direction, model)
    return sum(ant.chances)


def attraction(ant, direction, model):
    """Return how much a step attracts: by its pheromone, and to who carries food by the nest."""
    dx, dy = STEPS[direction]
    x = ant.x + dx
    y = ant.y + dy
    if not model.world.is_inside(x, y):
        return 0.0
    patch = model.world.patch(x, y)
    if not patch.open:
        return 0.0
    attracts = (model.threshold + patch.pheromone) ** model.exponent
    if ant.laden:
        east = nest_x(model) - ant.x
        north = 0 - ant.y
        cosine = (dx * east + dy * north) / (math.hypot(dx, dy) * math.hypot(east, north))
        attracts *= math.exp(model.homing * cosine)
    return attracts


def nest_x(model):
    """Return how far east the nest lies."""
    return BRIDGE_NEST if model.bridge else 0


def take(ant, patch, model):
    """Take a piece of food; that of the bridge never comes to an end."""
    ant.laden = True
    if not model.bridge:
        patch.food -= 1


def come_home(ant, model):
    """Leave the food in the nest, and stay there."""
    ant.laden = False
    ant.inside = True
    ant.brought += 1
    model.brought += 1


class AntForaging(Model):
    """Ants that mark and follow ways to food, in a field or over two ways (Goss et al., 1989)."""

    ticks = 2_000

    n_ants: int = parameter(300, unit="ants", low=1, high=10_000, doc="ants of the colony")
    leaving: float = parameter(
        0.2, unit="chance a tick", low=0.0, high=1.0, doc="whether an ant in the nest goes out"
    )
    outward: float = parameter(
        0.0, unit="pheromone", low=0.0, high=1000.0, doc="what an ant without food lays a step"
    )
    homeward: float = parameter(
        10.0, unit="pheromone", low=0.0, high=1000.0, doc="what an ant with food lays a step"
    )
    diffusion: float = parameter(
        0.01, unit="share a tick", low=0.0, high=1.0, doc="of a patch's pheromone that spreads"
    )
    evaporation: float = parameter(
        0.01, unit="share a tick", low=0.0, high=1.0, doc="of the pheromone that evaporates"
    )
    threshold: float = parameter(
        20.0, unit="pheromone", low=0.001, high=1000.0, doc="k, pull of a patch without pheromone"
    )
    exponent: float = parameter(
        2.0, unit="–", low=0.0, high=10.0, doc="n, how steeply pheromone pulls"
    )
    homing: float = parameter(
        2.0, unit="–", low=0.0, high=20.0, doc="how straight an ant with food heads for the nest"
    )
    n_piles: int = parameter(3, unit="piles", low=0, high=100, doc="piles of food in the field")
    pile_food: int = parameter(300, unit="pieces", low=0, high=10_000, doc="food of a pile")
    pile_distance: float = parameter(
        14.0, unit="patches", low=4.0, high=18.0, doc="from the nest to each pile"
    )
    bridge: bool = parameter(False, doc="whether two ways join nest and food, or a field")
    detour_north: int = parameter(
        2, unit="patches", low=0, high=18, doc="d of the northern way, which takes 16 + 2d steps"
    )
    detour_south: int = parameter(12, unit="patches", low=0, high=18, doc="d of the southern way")

    brought: int = 0
    passed_north: int = 0
    passed_south: int = 0

    world = Grid(41, 41, wraps=False, patch=Ground)
    ants = Population(Ant, "n_ants")

    setup = (once(lay_out), each(ants, stay_inside))
    schedule = (each(ants, forage), once(fade))

    def series(self):
        """Return food brought home and left, who is out, the marks, and who passed either way."""
        return {
            "brought": self.brought,
            "food": int(self.world.food.sum()),
            "outside": int((~self.ants.inside).sum()),
            "laden": int(self.ants.laden.sum()),
            "pheromone": float(self.world.pheromone.sum()),
            "passed_north": self.passed_north,
            "passed_south": self.passed_south,
        }

    def looks(self):
        """Return ants with and without food; nest, food, and the marks on the ground."""
        world = self.world
        ground = np.select([world.nest, world.food > 0, ~world.open], [-2.0, -1.0, -3.0], 0.0)
        marks = np.minimum(np.log1p(world.pheromone) / np.log1p(500.0), 1.0)
        return {
            "ants": Looks("animal", {"searching": "black", "with food": "orange"}, self.ants.laden),
            "patches": Looks(
                colour=("grey", "brown", "gold", "white", "green"),
                by=np.where(ground < 0, ground, marks),
                low=-3,
                high=1,
            ),
        }

    def agents(self):
        """Return each ant's place, what it carries and brought, and the mark where it stands."""
        ants = self.ants
        column, row = (
            np.asarray(ants.x, int) - self.world.low_x,
            np.asarray(ants.y, int) - self.world.low_y,
        )
        return {
            "agent": ants.id,
            "x": ants.x,
            "y": ants.y,
            "heading": ants.heading,
            "inside": ants.inside,
            "laden": ants.laden,
            "brought": ants.brought,
            "pheromone": self.world.pheromone[column, row],
        }
