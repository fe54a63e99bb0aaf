"""Sheep that stray into fields, farmers who chase them, shepherds who bring them back.

Three kinds of minds meet under one scheduler. Farmers decide by a cognitive scheme, sheep act by a
hierarchy of skills, and shepherds have both: their scheme chooses a plan and their hierarchy
carries it out.
"""

import math

import numpy as np

from socialmind import Agent, Model, Patch, Population, Torus, each, once, parameter

PASTURE = 8.0  # patches from the fold, at (0, 0), to the end of the pasture
FIELD = 1  # patches of a field on each side of its middle
SIGHT = 5.0  # patches that sheep see
FEAR = 3.0  # patches to people at which sheep become afraid
BEHIND = 2.0  # patches behind a stray to where a shepherd runs
BITE = 0.05  # food that a sheep eats in a tick
FADING = 0.98  # what a tick leaves of anger
DECISION = 10  # ticks that a shepherd keeps to a plan


class Land(Patch):
    """A patch: its grass, the crop on it and the farmer whose field it is."""

    grass: float = 1.0
    crop: float = 0.0
    owner: int = -1


class Farmer(Agent):
    """A farmer: the middle of the field, what it has borne, and what sheep have eaten of it."""

    field_x: int = 0
    field_y: int = 0
    harvest: float = 0.0
    loss: float = 0.0
    loss_now: float = 0.0


class Sheep(Agent):
    """A sheep: what it has eaten, grass and crop, and how much it is afraid."""

    food: float = 0.0
    fear: float = 0.0


class Shepherd(Agent):
    """A shepherd: the sheep in view, and when the next decision is due."""

    stray: int = 0
    timer: int = 0


# Setup ------------------------------------------------------------------------------------------


def settle(farmer, model, rng):
    """Give a farmer a field off the pasture that is nobody else's."""
    free = False
    while not free:
        farmer.x = rng.integers(model.world.low, model.world.high + 1)
        farmer.y = rng.integers(model.world.low, model.world.high + 1)
        free = model.world.distance(farmer, 0, 0) > PASTURE + 2
        for dx in range(-FIELD, FIELD + 1):
            for dy in range(-FIELD, FIELD + 1):
                if model.world.patch(farmer.x + dx, farmer.y + dy).owner >= 0:
                    free = False
    farmer.field_x = round(farmer.x)
    farmer.field_y = round(farmer.y)
    for dx in range(-FIELD, FIELD + 1):
        for dy in range(-FIELD, FIELD + 1):
            model.world.patch(farmer.x + dx, farmer.y + dy).owner = farmer.id


def arrive(agent, model, rng):
    """Put a sheep or a shepherd near the fold."""
    agent.x = rng.uniform(-PASTURE / 2, PASTURE / 2)
    agent.y = rng.uniform(-PASTURE / 2, PASTURE / 2)
    agent.heading = rng.uniform(0, 360)


# Sheep: a hierarchy of skills -------------------------------------------------------------------


def graze(sheep, model, rng):
    """See the flock and the people, let the skills command the legs, walk and eat."""
    see_flock(sheep, model)
    see_danger(sheep, model)
    land = model.world.patch(sheep.x, sheep.y)
    sheep.hierarchy.set_sensor("FOOD", min(1.0, land.grass + land.crop))
    sheep.hierarchy.evaluate()
    sheep.fear = sheep.hierarchy.influence("Flee")
    walk(sheep, model, model.sheep_speed, rng.uniform(-20, 20))
    eat(sheep, model)


def see_flock(sheep, model):
    """Sense the middle of the sheep in sight."""
    size = model.world.size
    mates = 0
    x = 0.0
    y = 0.0
    for other in model.sheep:
        dx = short_way(other.x - sheep.x, size)
        dy = short_way(other.y - sheep.y, size)
        if dx * dx + dy * dy < SIGHT * SIGHT:
            mates += 1  # itself as well, at distance 0
            x += dx
            y += dy
    away = math.hypot(x, y) / mates
    sheep.hierarchy.set_sensor("FLOCK_AWAY", min(1.0, away / SIGHT))
    sheep.hierarchy.set_sensor("FLOCK", angle_to(sheep, model, sheep.x + x, sheep.y + y))


def see_danger(sheep, model):
    """Sense the nearest person who is after sheep: people at work or at rest frighten nobody."""
    nearest = FEAR
    x = sheep.x
    y = sheep.y
    for farmer in model.farmers:
        away = model.world.distance(sheep, farmer.x, farmer.y)
        if away < nearest and farmer.plan == "Chase":
            nearest = away
            x = farmer.x
            y = farmer.y
    for shepherd in model.shepherds:
        away = model.world.distance(sheep, shepherd.x, shepherd.y)
        if away < nearest and shepherd.plan == "Herd":
            nearest = away
            x = shepherd.x
            y = shepherd.y
    sheep.hierarchy.set_sensor("DANGER_NEAR", 1 - nearest / FEAR)
    sheep.hierarchy.set_sensor("DANGER", angle_to(sheep, model, x, y))


def eat(sheep, model):
    """Take a bite of the crop where there is one, or else of the grass."""
    land = model.world.patch(sheep.x, sheep.y)
    if land.crop > 0:
        bite = min(BITE, land.crop)
        land.crop -= bite
        farmer = model.farmers[land.owner]
        farmer.loss += bite
        farmer.loss_now += bite
    else:
        bite = min(BITE, land.grass)
        land.grass -= bite
    sheep.food += bite


# Farmers: a cognitive scheme --------------------------------------------------------------------


def farm(farmer, model, rng):
    """Look after the field: perceive, decide and act."""
    intruders = 0
    for sheep in model.sheep:
        if near_field(farmer, sheep, model):
            intruders += 1
    if intruders > 0:
        farmer.mind.activate_cogniton("Intruders")
        farmer.mind.set_cogniton_value("Intruders", intruders)
    else:
        farmer.mind.deactivate_cogniton("Intruders")
    anger = farmer.mind.get_cogniton_value("Anger")
    farmer.mind.set_cogniton_value("Anger", max(0.0, FADING * anger + farmer.loss_now))
    farmer.loss_now = 0
    farmer.plan = farmer.mind.choose_next_plan()
    farmer.run_plan(model, rng)


def near_field(farmer, sheep, model):
    """Say whether a sheep is on a farmer's field or next to it."""
    return model.world.distance(sheep, farmer.field_x, farmer.field_y) < FIELD + 2


def tend(farmer, model):
    """Go to the field; there, let the crop grow and bring in what is ripe."""
    world = model.world
    if not world.is_on(farmer, farmer.field_x, farmer.field_y):
        world.walk_to(farmer, farmer.field_x, farmer.field_y, model.people_speed)
        return
    for dx in range(-FIELD, FIELD + 1):
        for dy in range(-FIELD, FIELD + 1):
            land = world.patch(farmer.field_x + dx, farmer.field_y + dy)
            land.crop += model.growth
            if land.crop >= 1:
                land.crop = 0
                farmer.harvest += 1


def chase(farmer, model):
    """Run at the nearest sheep."""
    least = math.inf
    x = farmer.x
    y = farmer.y
    for sheep in model.sheep:
        away = model.world.distance(farmer, sheep.x, sheep.y)
        if away < least:
            least = away
            x = sheep.x
            y = sheep.y
    model.world.walk_to(farmer, x, y, model.people_speed)
    farmer.mind.feed_back_from_plan("Chase", 1)


# Shepherds: both kinds of mind ------------------------------------------------------------------


def guard(shepherd, model, rng):
    """Perceive the flock and the farmers, decide now and then, and let the skills carry it out."""
    shepherd.mind.set_cogniton_value("Strays", strays(model))
    shepherd.mind.set_cogniton_value("Complaints", complaints(model))
    shepherd.stray = furthest(shepherd, model)
    if shepherd.timer <= 0:
        shepherd.plan = shepherd.mind.choose_next_plan()
        shepherd.timer = DECISION
    shepherd.timer -= 1
    shepherd.run_plan(model, rng)
    look(shepherd, model)
    shepherd.hierarchy.evaluate()
    walk(shepherd, model, model.people_speed, 0.0)


def herd(shepherd):
    """Tell the hierarchy that the plan is to herd, and grow tired."""
    shepherd.hierarchy.set_sensor("HERDING", 1)
    shepherd.mind.feed_back_from_plan("Herd", 1)


def rest(shepherd):
    """Tell the hierarchy that the plan is to rest, and recover."""
    shepherd.hierarchy.set_sensor("HERDING", 0)
    shepherd.mind.feed_back_from_plan("Rest", 1)
    if shepherd.mind.get_cogniton_value("Fatigue") < 0:
        shepherd.mind.set_cogniton_value("Fatigue", 0)


def look(shepherd, model):
    """Sense the stray, the place behind it and the fold."""
    sheep = model.sheep[shepherd.stray]
    out = math.hypot(sheep.x, sheep.y)
    x = sheep.x
    y = sheep.y
    if out > 0:
        x += BEHIND * sheep.x / out
        y += BEHIND * sheep.y / out
    mind = shepherd.hierarchy
    mind.set_sensor("STRAY", angle_to(shepherd, model, sheep.x, sheep.y))
    mind.set_sensor("BEHIND", angle_to(shepherd, model, x, y))
    mind.set_sensor("BEHIND_AWAY", min(1.0, model.world.distance(shepherd, x, y) / 5))
    mind.set_sensor("HOME", angle_to(shepherd, model, 0, 0))
    mind.set_sensor("HOME_AWAY", min(1.0, model.world.distance(shepherd, 0, 0) / 5))


def furthest(shepherd, model):
    """Return the sheep furthest from the fold, of such the one that is near the shepherd."""
    best = shepherd.stray
    most = -math.inf
    for sheep in model.sheep:
        far = model.world.distance(sheep, 0, 0)
        score = far - model.world.distance(sheep, shepherd.x, shepherd.y) / 2
        if score > most:
            most = score
            best = sheep.id
    return best


def strays(model):
    """Count the sheep off the pasture."""
    count = 0
    for sheep in model.sheep:
        if model.world.distance(sheep, 0, 0) > PASTURE:
            count += 1
    return count


def complaints(model):
    """Count the farmers who are chasing sheep."""
    count = 0
    for farmer in model.farmers:
        if farmer.plan == "Chase":
            count += 1
    return count


# The world --------------------------------------------------------------------------------------


def regrow(model):
    """Let the grass grow."""
    for patch in model.world.patches:
        patch.grass = min(1.0, patch.grass + model.regrowth)


def walk(agent, model, speed, stumble):
    """Turn and go as the hierarchy commands the legs."""
    turn = (2 * agent.hierarchy.actuator("TURN") - 1) * 45
    model.world.right(agent, turn + stumble)
    model.world.forward(agent, speed * agent.hierarchy.actuator("SPEED"))


def angle_to(agent, model, x, y):
    """Return the angle to a point as skills are told it: 0.5 is ahead, more is to the right."""
    bearing = model.world.towards(agent, x, y) - agent.heading
    return min(1.0, ((bearing + 180) % 360) / 360)


def short_way(difference, size):
    """Return a difference of coordinates the short way round the torus."""
    if difference > size / 2:
        return difference - size
    if difference < -size / 2:
        return difference + size
    return difference


class FieldsAndFlocks(Model):
    """Farmers, sheep and shepherds: cogniton schemes, hierarchies of skills, and both in one."""

    ticks = 2000

    n_farmers: int = parameter(8, unit="farmers", low=1, high=20, doc="farmers, each with a field")
    n_sheep: int = parameter(40, unit="sheep", low=1, doc="sheep")
    n_shepherds: int = parameter(2, unit="shepherds", low=0, doc="shepherds of the one flock")
    growth: float = parameter(
        0.01, unit="crop a tick", low=0.0, high=1.0, doc="crop that a tick of work adds to a patch"
    )
    regrowth: float = parameter(
        0.002, unit="grass a tick", low=0.0, high=1.0, doc="grass that grows on a patch"
    )
    sheep_speed: float = parameter(
        0.5, unit="patches a tick", low=0.0, doc="speed of a sheep that runs"
    )
    people_speed: float = parameter(
        0.6, unit="patches a tick", low=0.0, doc="speed of a person who runs"
    )

    world = Torus(33, Land)
    farmers = Population(
        Farmer, "n_farmers", mind="farmer.yaml", plans={"Tend": tend, "Chase": chase}
    )
    sheep = Population(Sheep, "n_sheep", hierarchy="sheep")
    shepherds = Population(
        Shepherd,
        "n_shepherds",
        mind="shepherd.yaml",
        plans={"Herd": herd, "Rest": rest},
        hierarchy="shepherd",
    )

    setup = (each(farmers, settle), each(sheep, arrive), each(shepherds, arrive))
    schedule = (each(sheep, graze), each(shepherds, guard), each(farmers, farm), once(regrow))

    def series(self):
        """Return what fields and flock have come to, and what people do about it."""
        farmers, sheep, shepherds = self.farmers, self.sheep, self.shepherds
        away = np.hypot(sheep.x, sheep.y)
        x, y = np.floor(sheep.x + 0.5).astype(int), np.floor(sheep.y + 0.5).astype(int)
        owner = self.world.owner[x - self.world.low, y - self.world.low]
        return {
            "harvest": float(farmers.harvest.sum()),
            "loss": float(farmers.loss.sum()),
            "food": float(sheep.food.sum()),
            "strays": int((away > PASTURE).sum()),
            "on_fields": int((owner >= 0).sum()),
            "afraid": int((sheep.fear > 0).sum()),
            "chasing": self.plans(farmers).count("Chase"),
            "herding": self.plans(shepherds).count("Herd"),
            "anger": float(farmers.cogniton("Anger").mean()),
        }

    def agents(self):
        """Return everybody's place and plan, and what they have got."""
        tables = (self.farmers, self.sheep, self.shepherds)
        own = {name: self.everybody(name) for name in ("field_x", "field_y", "harvest", "loss")}
        own |= {name: self.everybody(name) for name in ("food", "fear")}
        plans = [self.plans(one) if one.shape.minded else [None] * len(one) for one in tables]
        return {
            "population": [one.shape.name for one in tables for _ in range(len(one))],
            "agent": np.concatenate([one.id for one in tables]),
            "plan": [plan for some in plans for plan in some],
            "x": np.concatenate([one.x for one in tables]),
            "y": np.concatenate([one.y for one in tables]),
            "heading": np.concatenate([one.heading for one in tables]),
            **own,
        }

    def everybody(self, name):
        """Return a field of all agents, None for those of populations without it."""
        values = []
        for table in (self.farmers, self.sheep, self.shepherds):
            known = name in table.shape.fields
            values += getattr(table, name).tolist() if known else [None] * len(table)
        return values
