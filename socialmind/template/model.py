"""Grazers wander over grass, and eat when hunger weighs more than the wish to move on."""

from socialmind import Agent, Model, Patch, Population, Torus, each, once, parameter


class Grazer(Agent):
    """An animal that lives on grass."""

    energy: float = 10.0


class Meadow(Patch):
    """A patch of grass."""

    grass: float = 1.0


def regrow(model):
    """Let the grass grow."""
    for patch in model.world.patches:
        patch.grass = min(patch.grass + model.regrowth, 1.0)


def live(grazer, model, rng):
    """Get hungry, choose a plan and carry it out."""
    grazer.energy -= 0.2
    grazer.mind.set_cogniton_value("Hunger", max(10.0 - grazer.energy, 0.0))
    grazer.plan = grazer.mind.choose_next_plan()
    grazer.run_plan(model, rng)


def wander(grazer, model, rng):
    """Take a step, more or less ahead."""
    model.world.right(grazer, rng.integers(-45, 46))
    model.world.forward(grazer, 1)


def graze(grazer, model):
    """Eat the grass under one's feet."""
    here = model.world.patch(grazer.x, grazer.y)
    grazer.energy += here.grass
    here.grass = 0.0


class Grazers(Model):
    """Grazers on a meadow, torn between eating and moving on."""

    ticks = 1000
    n_grazers: int = parameter(20, unit="grazers", low=0, doc="grazers at the start")
    regrowth: float = parameter(0.01, unit="grass a tick", low=0.0, doc="growth of a patch")
    world = Torus(33, Meadow)
    grazers = Population(
        Grazer, "n_grazers", mind="scheme.yaml", plans={"Wander": wander, "Graze": graze}
    )
    schedule = (each(grazers, live), once(regrow))
