"""Wolves and sheep, flocking and Schelling's segregation in Mesa: the yardstick of `classics.py`.

They are Mesa's own examples. Where a rule differs from that of the public comparison of frameworks
(DOI 10.5281/zenodo.8016506), the comparison's takes its place; what an example collects or paints
beside its rules is left out.
"""

from mesa import Model
from mesa.discrete_space import OrthogonalMooreGrid
from mesa.examples import BoidFlockers, Schelling, WolfSheep
from mesa.examples.advanced.wolf_sheep.agents import GrassPatch, Sheep, Wolf
from mesa.examples.basic.schelling.agents import SchellingAgent
from mesa.experimental.devs import ABMSimulator


class Roaming:
    """Moves to any of the eight neighbours, and loses one unit of energy by it."""

    def move(self):
        self.cell = self.cell.neighborhood.select_random_cell()


class RoamingSheep(Roaming, Sheep):
    """A sheep that dies below 1, after it has eaten."""

    def feed(self):
        super().feed()
        if self.energy < 1:
            self.energy = -1


class RoamingWolf(Roaming, Wolf):
    """A wolf."""


class WolvesAndSheep(WolfSheep):
    """Wolves and sheep on a grid of eight neighbours.

    Args:
        size: cells a side.
        sheep, wolves: how many there are at the start.
        regrowth: steps.
        chances: of a sheep and of a wolf to reproduce in a step.
        seed: of the run.
    """

    def __init__(self, size, sheep, wolves, regrowth, chances, seed):
        Model.__init__(self, seed=seed)
        self.simulator = ABMSimulator()
        self.simulator.setup(self)
        self.grid = OrthogonalMooreGrid([size, size], torus=True, random=self.random)
        cells = self.grid.all_cells.cells
        for kind, count, gain, chance in (
            (RoamingSheep, sheep, 5, chances[0]),
            (RoamingWolf, wolves, 13, chances[1]),
        ):
            kind.create_agents(
                self,
                count,
                energy=self.rng.integers(1, 2 * gain + 1, count),
                p_reproduce=chance,
                energy_from_food=gain,
                cell=self.random.choices(cells, k=count),
            )
        for cell in self.grid:
            countdown = 0 if self.random.random() < 0.5 else self.random.randint(1, regrowth)
            GrassPatch(self, countdown, regrowth, cell)

    def step(self):
        self.agents_by_type[RoamingSheep].shuffle_do("step")
        self.agents_by_type[RoamingWolf].shuffle_do("step")

    def run(self, steps):
        """Run the model; grass grows by Mesa's own events."""
        self.simulator.run_for(steps)


class Flocking(BoidFlockers):
    """Birds that cohere, keep apart and match.

    Args:
        size: length of a side.
        birds: how many.
        sight: how far they see.
        seed: of the run.
    """

    def __init__(self, size, birds, sight, seed):
        super().__init__(birds, size, size, vision=sight, separation=1, seed=seed)

    def update_average_heading(self):
        """Leave it out: no rule of the model."""

    def step(self):
        self.agents.shuffle_do("step")

    def run(self, steps):
        """Run the model."""
        for _ in range(steps):
            self.step()


class Settler(SchellingAgent):
    """An agent that wants so many of its own kind about it."""

    def step(self):
        near = self.cell.get_neighborhood(radius=self.radius).agents
        self.happy = sum(1 for other in near if other.type == self.type) >= self.homophily
        if not self.happy:
            self.cell = self.model.grid.select_random_empty_cell()


class Segregation(Schelling):
    """Two kinds of agents on a grid with edges.

    Args:
        size: cells a side.
        agents: how many, half of each kind.
        radius: how far they look.
        minimum: neighbours of one's own kind that make happy.
        seed: of the run.
    """

    def __init__(self, size, agents, radius, minimum, seed):
        super().__init__(size, size, 0.0, seed=seed)
        self.grid = OrthogonalMooreGrid((size, size), torus=False, capacity=1, random=self.random)
        for number, cell in enumerate(self.random.sample(self.grid.all_cells.cells, agents)):
            Settler(self, cell, number % 2, homophily=minimum, radius=radius)

    def run(self, steps):
        """Run the model."""
        for _ in range(steps):
            self.agents.shuffle_do("step")
