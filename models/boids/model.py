"""Boids: three base skills make a flock when a complex skill arbitrates (thesis, figure 2.22).

Each skill says how it would fly if it were in charge: to the others, away from the nearest, or as
they do. Flocking gives them influence and the wings obey the weighted mean.
"""

import math

import numpy as np

from socialmind import Agent, Model, Population, Torus, each, parameter


class Boid(Agent):
    """A boid: what it sees of its flockmates, and how much its skills counted."""

    mates: int = 0
    nearest: float = 0.0
    cohesion_influence: float = 0.0
    separation_influence: float = 0.0
    alignment_influence: float = 0.0


def arrive(boid, model, rng):
    """Put a boid on a random place, heading anywhere."""
    boid.x = rng.uniform(model.world.low - 0.5, model.world.high + 0.5)
    boid.y = rng.uniform(model.world.low - 0.5, model.world.high + 0.5)
    boid.heading = rng.uniform(0, 360)


def live(boid, model, rng):
    """See the flockmates, let the skills command the wings, and fly."""
    see(boid, model)
    mind = boid.hierarchy
    mind.set_sensor("COHESION", model.cohesion)
    mind.set_sensor("SEPARATION", model.separation)
    mind.set_sensor("ALIGNMENT", model.alignment)
    mind.evaluate()
    boid.cohesion_influence = mind.influence("Cohesion")
    boid.separation_influence = mind.influence("Separation")
    boid.alignment_influence = mind.influence("Alignment")
    turn = (2 * mind.actuator("TURN") - 1) * model.largest_turn
    model.world.right(boid, turn + rng.uniform(-model.noise, model.noise))
    model.world.forward(boid, model.speed * (0.5 + mind.actuator("SPEED")))


def see(boid, model):
    """Set the senses: where the flockmates are, on the mean and the nearest, and are heading."""
    world = model.world
    half = world.size / 2
    mates = 0
    nearest = model.sight
    nearest_x = 0.0
    nearest_y = 0.0
    x = 0.0
    y = 0.0
    east = 0.0
    north = 0.0
    for other in model.boids:
        dx = other.x - boid.x
        dy = other.y - boid.y
        # The short way round the torus.
        if dx > half:
            dx -= world.size
        elif dx < -half:
            dx += world.size
        if dy > half:
            dy -= world.size
        elif dy < -half:
            dy += world.size
        if abs(dx) < model.sight and abs(dy) < model.sight and other.id != boid.id:
            away = math.hypot(dx, dy)
            if away < model.sight:
                mates += 1
                x += dx
                y += dy
                angle = math.radians(other.heading)
                east += math.sin(angle)
                north += math.cos(angle)
                if away < nearest:
                    nearest = away
                    nearest_x = dx
                    nearest_y = dy
    boid.mates = mates
    boid.nearest = nearest
    mind = boid.hierarchy
    mind.set_sensor("COMPANY", min(1.0, mates / model.company))
    mind.set_sensor("NEAREST_AWAY", nearest / model.sight)
    if mates > 0:
        away = math.hypot(x, y) / mates
        mind.set_sensor("CENTRE_AWAY", min(1.0, away / model.sight))
        mind.set_sensor("CENTRE", angle_to(boid, model, x, y))
        mind.set_sensor("NEAREST", angle_to(boid, model, nearest_x, nearest_y))
        mind.set_sensor("HEADING", angle_to(boid, model, east, north))


def angle_to(boid, model, dx, dy):
    """Return an angle as the skills are told it: 0.5 is straight ahead, more is to the right."""
    length = math.hypot(dx, dy)
    if length == 0:
        return 0.5
    bearing = model.world.towards(boid, boid.x + dx / length, boid.y + dy / length) - boid.heading
    return min(1.0, ((bearing + 180) % 360) / 360)


class Boids(Model):
    """Birds that flock by cohesion, separation and alignment (thesis, figure 2.22)."""

    ticks = 500

    n_boids: int = parameter(60, unit="boids", low=1, doc="boids")
    sight: float = parameter(5.0, unit="patches", low=0.1, doc="distance at which boids see others")
    company: float = parameter(
        7.0, unit="boids", low=1.0, doc="flockmates in sight that are company enough"
    )
    cohesion: float = parameter(
        1.0, unit="influence", low=0.0, high=1.0, doc="how much a boid cares to be near others"
    )
    separation: float = parameter(
        1.0, unit="influence", low=0.0, high=1.0, doc="how much it cares not to touch others"
    )
    alignment: float = parameter(
        1.0, unit="influence", low=0.0, high=1.0, doc="how much it cares to fly as they do"
    )
    speed: float = parameter(
        0.3, unit="patches a tick", low=0.0, doc="usual speed; from half of it to one and a half"
    )
    largest_turn: float = parameter(
        20.0, unit="degrees a tick", low=0.0, high=180.0, doc="sharpest turn of the wings"
    )
    noise: float = parameter(
        5.0, unit="degrees", low=0.0, high=180.0, doc="largest turn by gusts of wind in a tick"
    )
    world_size: int = parameter(33, unit="patches", low=3, high=20_000, doc="side of the world")

    world = Torus("world_size")
    boids = Population(Boid, "n_boids", hierarchy="mind")

    setup = (each(boids, arrive),)
    schedule = (each(boids, live),)

    def series(self):
        """Return how ordered the boids fly, how near each other, and in how many flocks."""
        away = self.distances()
        np.fill_diagonal(away, math.inf)
        flock = flocks(away < self.sight / 2)
        sizes = np.bincount(flock)
        boids = self.boids
        return {
            "polarisation": polarisation(boids.heading),
            "flock_polarisation": flock_polarisation(boids.heading, flock),
            "nearest_distance": float(away.min(axis=1).mean()) if len(boids) > 1 else math.nan,
            "too_near": int((away.min(axis=1) < self.sight / 10).sum()),
            "flocks": int((sizes > 2).sum()),
            "in_flocks": int(sizes[sizes > 2].sum()),
            "largest_flock": int(sizes.max()),
            "cohesion_influence": float(boids.cohesion_influence.mean()),
            "separation_influence": float(boids.separation_influence.mean()),
            "alignment_influence": float(boids.alignment_influence.mean()),
        }

    def agents(self):
        """Return each boid's place, heading, flockmates, and its skills' influence."""
        boids = self.boids
        names = ("x", "y", "heading", "mates", "nearest")
        influences = ("cohesion_influence", "separation_influence", "alignment_influence")
        return {"agent": boids.id, **{name: getattr(boids, name) for name in names + influences}}

    def distances(self):
        """Return the distances between all boids, a square array."""
        size = self.world_size
        dx = np.abs(np.subtract.outer(self.boids.x, self.boids.x))
        dy = np.abs(np.subtract.outer(self.boids.y, self.boids.y))
        return np.hypot(np.minimum(dx, size - dx), np.minimum(dy, size - dy))


def polarisation(headings):
    """Return the length of the mean heading: 0 in all directions, 1 all in one."""
    angles = np.radians(headings)
    return float(np.hypot(np.sin(angles).mean(), np.cos(angles).mean()))


def flock_polarisation(headings, flock):
    """Return the polarisation inside flocks of three or more, on the mean over their boids."""
    sizes = np.bincount(flock)
    large = [one for one in range(len(sizes)) if sizes[one] > 2]
    if not large:
        return math.nan
    total = sum(sizes[one] * polarisation(headings[flock == one]) for one in large)
    return float(total / sum(sizes[one] for one in large))


def flocks(linked):
    """Return the number of each boid's flock, those being in one who are linked through others.

    Args:
        linked: which boids are near each other, a square array of truth values.
    """
    flock = np.arange(len(linked))
    while True:
        least = np.minimum(flock, np.where(linked, flock, len(flock)).min(axis=1))
        if (least == flock).all():
            return flock
        flock = least
