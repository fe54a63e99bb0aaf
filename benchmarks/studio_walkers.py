"""A model for the benchmark of the studio: many agents that wander over many patches."""

from socialmind import Agent, Model, Patch, Population, Torus, each, parameter


class Land(Patch):
    """A patch, and how often somebody stood there."""

    trodden: float = 0.0


class Walker(Agent):
    """An agent that wanders about."""

    walked: float = 0.0


def arrive(walker, model, rng):
    """Stand somewhere, turned anywhere."""
    walker.x = rng.uniform(model.world.low - 0.5, model.world.high + 0.5)
    walker.y = rng.uniform(model.world.low - 0.5, model.world.high + 0.5)
    walker.heading = rng.uniform(0.0, 360.0)


def wander(walker, model, rng):
    """Turn a little, and go a step."""
    model.world.right(walker, rng.uniform(-20.0, 20.0))
    model.world.forward(walker, 0.3)
    walker.walked += 0.3
    model.world.patch(walker.x, walker.y).trodden += 1


class Walkers(Model):
    """Agents that wander over patches."""

    n_walkers: int = parameter(10_000, unit="agents", low=0)
    world_size: int = parameter(101, unit="patches", low=3, high=20_000)
    walkers = Population(Walker, "n_walkers")
    world = Torus("world_size", Land)
    setup = (each(walkers, arrive),)
    schedule = (each(walkers, wander),)
