"""Wolves, sheep and grass: who eats whom, and how their numbers go up and down.

Wolf sheep predation (Wilensky 1997), by the rules of the public comparison of agent-based
frameworks (DOI 10.5281/zenodo.8016506).
"""

import numpy as np

from socialmind import Agent, Looks, Model, Patch, Population, Torus, each, once, parameter

SHEEP_GAIN = 5  # energy of the grass of a patch
WOLF_GAIN = 13  # energy of a sheep


class Animal(Agent):
    """A wolf or a sheep, and what it has eaten."""

    energy: float = 0.0


class Meadow(Patch):
    """A patch, and how many ticks its grass still grows."""

    growing: int = 0


def sprout(model, rng):
    """Let the grass of half the patches be grown, and the others' grow."""
    for patch in model.world.patches:
        patch.growing = 0 if rng.random() < 0.5 else rng.integers(1, model.regrowth + 1)


def arrive_sheep(sheep, model, rng):
    """Put a sheep anywhere."""
    arrive(sheep, model, rng, SHEEP_GAIN)


def arrive_wolf(wolf, model, rng):
    """Put a wolf anywhere."""
    arrive(wolf, model, rng, WOLF_GAIN)


def arrive(animal, model, rng, gain):
    """Put an animal anywhere, with energy of up to two meals."""
    animal.x = rng.integers(model.world.low, model.world.high + 1)
    animal.y = rng.integers(model.world.low, model.world.high + 1)
    animal.energy = rng.integers(1, 2 * gain + 1)


def roam(animal, model, rng):
    """Move to one of the eight neighbours."""
    there = model.world.neighbours(animal).one_of(rng)
    model.world.move_to(animal, there.x, there.y)
    animal.energy -= 1


def live_sheep(sheep, model, rng):
    """Roam, eat grown grass, starve or lamb."""
    roam(sheep, model, rng)
    patch = model.world.patch(sheep.x, sheep.y)
    if patch.growing == 0:
        sheep.energy += SHEEP_GAIN
        patch.growing = model.regrowth
    if sheep.energy < 1:
        sheep.die()
    elif rng.random() < model.sheep_reproduction:
        breed(sheep)


def live_wolf(wolf, model, rng):
    """Roam, eat a sheep that is there, starve or whelp."""
    roam(wolf, model, rng)
    prey = model.sheep.on(wolf).one_of(rng)
    if prey is not None:
        prey.die()
        wolf.energy += WOLF_GAIN
    if wolf.energy < 0:
        wolf.die()
    elif rng.random() < model.wolf_reproduction:
        breed(wolf)


def breed(animal):
    """Share one's energy with a child that is a copy."""
    animal.energy /= 2
    animal.hatch()


def grow(model):
    """Let grass grow."""
    for patch in model.world.patches:
        if patch.growing > 0:
            patch.growing -= 1


def drought(society):
    """Let all grass die; it grows again from the root."""
    society.world.growing = society.regrowth


def plague(society, rng):
    """Let every other sheep die."""
    for sheep in society.sheep:
        if rng.random() < 0.5:
            sheep.die()


class WolvesSheep(Model):
    """Wolves, sheep and grass: numbers that go up and down (Wilensky 1997)."""

    ticks = 1000

    n_sheep: int = parameter(60, unit="sheep", low=0, doc="sheep at the start")
    n_wolves: int = parameter(40, unit="wolves", low=0, doc="wolves at the start")
    regrowth: int = parameter(20, unit="ticks", low=1, doc="ticks until grass is grown again")
    sheep_reproduction: float = parameter(
        0.2, unit="chance a tick", low=0.0, high=1.0, doc="whether a sheep lambs"
    )
    wolf_reproduction: float = parameter(
        0.1, unit="chance a tick", low=0.0, high=1.0, doc="whether a wolf whelps"
    )
    world_size: int = parameter(25, unit="patches", low=3, high=20_000, doc="side of the world")

    world = Torus("world_size", Meadow)
    sheep = Population(Animal, "n_sheep")
    wolves = Population(Animal, "n_wolves")
    setup = (once(sprout), each(sheep, arrive_sheep), each(wolves, arrive_wolf))
    schedule = (each(sheep, live_sheep), each(wolves, live_wolf), once(grow))
    buttons = {"Drought": drought, "Plague among sheep": plague}

    def series(self):
        """Return how many live, and how much grass is grown."""
        grown = int((self.world.growing == 0).sum())
        return {"sheep": len(self.sheep), "wolves": len(self.wolves), "grass": grown}

    def looks(self):
        """Return white sheep and dark wolves, large where they are well fed, on grass or earth."""
        return {
            "sheep": Looks("animal", "white", size=0.7 + 0.02 * np.minimum(self.sheep.energy, 25)),
            "wolves": Looks(
                "animal", "black", size=0.9 + 0.01 * np.minimum(self.wolves.energy, 50)
            ),
            "patches": Looks(
                colour=("grass", "earth"), by=self.world.growing, low=0, high=self.regrowth
            ),
        }
