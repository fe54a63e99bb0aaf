"""Flocking: birds that cohere, keep apart and match, as frameworks are compared by.

Boids (Reynolds 1987) in continuous space, by the rules of the public comparison of agent-based
frameworks (DOI 10.5281/zenodo.8016506).
"""

import math

import numpy as np

from socialmind import Agent, Model, Population, Torus, each, parameter


class Bird(Agent):
    """A bird: the direction in which it flies, a vector of length 1."""

    east: float = 0.0
    north: float = 1.0


def arrive(bird, model, rng):
    """Put a bird anywhere, flying anywhere."""
    world = model.world
    bird.x = rng.uniform(world.low - 0.5, world.high + 0.5)
    bird.y = rng.uniform(world.low - 0.5, world.high + 0.5)
    angle = rng.uniform(0, math.tau)
    bird.east = math.sin(angle)
    bird.north = math.cos(angle)


def fly(bird, model):
    """Turn towards the others, away from those too near, and as they do; then fly."""
    count = 0
    to_x = to_y = away_x = away_y = east = north = 0.0
    for other in model.birds.near(bird, model.sight):
        dx, dy = model.world.offset(bird, other)
        count += 1
        to_x += dx
        to_y += dy
        if dx * dx + dy * dy < model.separation**2:
            away_x -= dx
            away_y -= dy
        east += other.east
        north += other.north
    count = max(count, 1)
    bird.east += (model.cohere * to_x + model.separate * away_x + model.match * east) / count
    bird.north += (model.cohere * to_y + model.separate * away_y + model.match * north) / count
    length = math.hypot(bird.east, bird.north)
    bird.east /= length
    bird.north /= length
    model.world.move_to(bird, bird.x + model.speed * bird.east, bird.y + model.speed * bird.north)


class Flocking(Model):
    """Birds that cohere, keep apart and match (Reynolds 1987)."""

    ticks = 100

    n_birds: int = parameter(200, unit="birds", low=1, doc="birds")
    world_size: int = parameter(100, unit="patches", low=1, high=20_000, doc="side of the world")
    sight: float = parameter(5.0, unit="patches", low=0.0, doc="how far a bird sees")
    speed: float = parameter(1.0, unit="patches a tick", low=0.0, doc="speed of a bird")
    separation: float = parameter(1.0, unit="patches", low=0.0, doc="what is too near")
    cohere: float = parameter(0.03, unit="weight", low=0.0, doc="weight of flying to the others")
    separate: float = parameter(0.015, unit="weight", low=0.0, doc="weight of flying from the near")
    match: float = parameter(0.05, unit="weight", low=0.0, doc="weight of flying as the others do")

    world = Torus("world_size")
    birds = Population(Bird, "n_birds")
    setup = (each(birds, arrive),)
    schedule = (each(birds, fly),)

    def series(self):
        """Return how much the birds fly one way: 1 if all do, near 0 if all differ."""
        birds = self.birds
        polarisation = float(np.hypot(birds.east.mean(), birds.north.mean()))
        return {"birds": len(birds), "polarisation": polarisation}
