"""neat-python's evolution of graphs, a generation at a time and from draws of our own."""

from __future__ import annotations

import random
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from itertools import cycle
from threading import Lock
from types import SimpleNamespace
from typing import Any

from socialmind.errors import SocialmindError


class MissingNeatError(SocialmindError, ImportError):
    """The library neat-python is not installed."""


try:
    import neat
    from neat.reporting import ReporterSet
except ImportError as error:
    raise MissingNeatError(
        "NEAT needs the library neat-python, which is not installed; "
        "pip install 'socialmind[learning]'"
    ) from error

HIDDEN, OUTPUT = "relu", "identity"
"""Activations of hidden neurons and of outputs; what outputs give is held to [0, 1] as in A.3.1."""

GREATEST = 1e150
"""Scores are held to this, of either sign, since the library adds them up."""

_TURN = Lock()
"""Held while the library draws, since all threads of a process share its generator."""


@contextmanager
def drawn_from(seed: int) -> Iterator[None]:
    """Let the library draw from a seed, and put Python's own generator back afterwards.

    The library draws from the generator of Python's module `random`, which it shares with all that
    runs in the process.
    """
    with _TURN:
        before = random.getstate()
        random.seed(seed)
        try:
            yield
        finally:
            random.setstate(before)


class Counter:
    """Counts up as `itertools.count` does, and says what comes next.

    >>> keys = Counter(5)
    >>> next(keys), keys.following
    (5, 6)
    """

    def __init__(self, following: int) -> None:
        self.following = following

    def __next__(self) -> int:
        self.following += 1
        return self.following - 1


class Genome(neat.DefaultGenome):
    """A genome whose hidden neurons are ReLUs, and whose outputs are linear."""

    @staticmethod
    def create_node(config: Any, node_id: int) -> Any:
        """Return a drawn neuron."""
        node = neat.DefaultGenome.create_node(config, node_id)
        if node_id in config.output_keys:
            node.activation = OUTPUT
        return node


class Stagnation(neat.DefaultStagnation):
    """Lets the poorest species die out too where the population cannot hold them all.

    Args:
        config: the library's settings of stagnation.
        reporters: whom the library tells.
        most: how many species there is room for.
    """

    def __init__(self, config: Any, reporters: Any, most: int) -> None:
        super().__init__(config, reporters)
        self._most = most

    def update(self, species_set: Any, generation: int) -> list[tuple[int, Any, bool]]:
        """Return species, the poorest first, and whether each is to die out."""
        judged = super().update(species_set, generation)
        living = [key for key, _, stagnant in judged if not stagnant]
        crowded = living[: max(0, len(living) - self._most)]
        return [(key, one, stagnant or key in crowded) for key, one, stagnant in judged]


class Reproduction(neat.DefaultReproduction):
    """Shares out the population exactly, where the library gives up on some shares."""

    @staticmethod
    def compute_spawn(
        adjusted_fitness: Sequence[float],
        previous_sizes: Sequence[int],
        pop_size: int,
        min_species_size: int,
    ) -> list[int]:
        """Return how many offspring each species has."""
        amounts = neat.DefaultReproduction.compute_spawn(
            adjusted_fitness, previous_sizes, pop_size, min_species_size
        )
        return fitted(amounts, pop_size, min_species_size)


def fitted(amounts: Sequence[int], total: int, least: int) -> list[int]:
    """Return numbers near to others that add up to a total.

    In turns, the smallest first, each is raised by one; or the greatest first, lowered.

    Args:
        amounts: the numbers, each `least` or more.
        total: what they are to add up to, `least` times their number or more.
        least: below which none is lowered.

    >>> fitted([9, 2, 2], 10, 2), fitted([3, 1], 6, 1)
    ([6, 2, 2], [4, 2])
    """
    found = list(amounts)
    step = 1 if sum(found) < total else -1
    for place in cycle(sorted(range(len(found)), key=lambda place: step * amounts[place])):
        if sum(found) == total:
            break
        if step > 0 or found[place] > least:
            found[place] += step
    return found


def configuration(inputs: int, outputs: int, settings: Mapping[str, float]) -> Any:
    """Return settings of NEAT as the library takes them.

    Args:
        inputs: how many inputs networks have.
        outputs: how many outputs.
        settings: all of `Neat.known_settings`.

    Returns:
        What stands for a `neat.Config`: `genome_type`, `genome_config`, `species_set_config`,
        `stagnation_config` and `reproduction_config`.
    """
    bound, spread = settings["bound"], settings["spread"]
    genes = {
        name: {
            "init_mean": 0.0,
            "init_stdev": spread,
            "max_value": bound,
            "min_value": -bound,
            "mutate_power": settings[f"{ours}step"],
            "mutate_rate": settings[f"{ours}mutation"],
            "replace_rate": settings[f"{ours}replacement"],
        }
        for name, ours in (("weight", ""), ("bias", "bias_"))
    }
    still = dict.fromkeys(("init_stdev", "mutate_power", "mutate_rate", "replace_rate"), 0.0)
    genes["response"] = still | {"init_mean": 1.0, "max_value": 1.0, "min_value": 1.0}
    genome = {
        "num_inputs": inputs,
        "num_outputs": outputs,
        "num_hidden": 0,
        "feed_forward": str(not settings["recurrent"]),
        "initial_connection": "full_direct",
        "compatibility_disjoint_coefficient": settings["disjoint"],
        "compatibility_weight_coefficient": settings["difference"],
        "conn_add_prob": settings["add_connection"],
        "conn_delete_prob": settings["delete_connection"],
        "node_add_prob": settings["add_neuron"],
        "node_delete_prob": settings["delete_neuron"],
        "activation_default": HIDDEN,
        "activation_options": HIDDEN,
        "activation_mutate_rate": 0.0,
        "aggregation_default": "sum",
        "aggregation_options": "sum",
        "aggregation_mutate_rate": 0.0,
        "enabled_default": "True",
        "enabled_mutate_rate": settings["enabling"],
        **{f"{name}_{part}": value for name, gene in genes.items() for part, value in gene.items()},
    }
    stagnation = {
        "species_fitness_func": "max",
        "max_stagnation": settings["stagnation"],
        "species_elitism": settings["species_elite"],
    }
    reproduction = {
        "elitism": settings["elite"],
        "survival_threshold": settings["survival"],
        "min_species_size": settings["species_least"],
    }
    return SimpleNamespace(
        genome_type=Genome,
        genome_config=Genome.parse_config(genome),
        species_set_config=neat.DefaultSpeciesSet.parse_config(
            {"compatibility_threshold": settings["threshold"]}
        ),
        stagnation_config=Stagnation.parse_config(stagnation),
        reproduction_config=Reproduction.parse_config(reproduction),
    )


class Evolution:
    """A population of genomes, its species, and all that numbers them.

    Args:
        inputs: how many inputs networks have.
        outputs: how many outputs.
        settings: all of `Neat.known_settings`.
    """

    def __init__(self, inputs: int, outputs: int, settings: Mapping[str, float]) -> None:
        self.config = configuration(inputs, outputs, settings)
        self.count = int(settings["population"])
        reporters = ReporterSet()
        least = int(max(settings["species_least"], settings["elite"]))
        self.reproduction = Reproduction(
            self.config.reproduction_config,
            reporters,
            Stagnation(self.config.stagnation_config, reporters, self.count // least),
        )
        self.reproduction.genome_indexer = Counter(1)
        self.tracker = self.reproduction.innovation_tracker
        self.config.genome_config.innovation_tracker = self.tracker
        self.species = neat.DefaultSpeciesSet(self.config.species_set_config, reporters)
        self.species.indexer = Counter(1)
        self.population: dict[int, Any] = {}
        self.generation = 0

    def begin(self, first: Sequence[Any], seed: int) -> None:
        """Draw the first population.

        Args:
            first: genomes to begin from (`NeatGenome`), no more than there is room for.
            seed: decides all draws.
        """
        with drawn_from(seed):
            for one in first:
                key = next(self.reproduction.genome_indexer)
                self.population[key] = one.graph.to_genome(self.config, one.weights, key)
            self.population |= self._drawn(self.count - len(first))
            neurons = [key for genome in self.population.values() for key in genome.nodes]
            self.config.genome_config.node_indexer = Counter(max(neurons) + 1)
            self._speciate()

    def advance(self, scores: Sequence[float], seed: int) -> None:
        """Draw the population that follows one with these scores; anew where all species died out.

        Args:
            scores: the score of each genome, in the order of the population.
            seed: decides all draws.
        """
        for genome, score in zip(self.population.values(), scores, strict=True):
            genome.fitness = min(max(score, -GREATEST), GREATEST)
        with drawn_from(seed):
            self.population = self.reproduction.reproduce(
                self.config, self.species, self.count, self.generation
            )
            if not self.population:
                self.population = self._drawn(self.count)
            self._speciate()
        for one in self.species.species.values():
            # Of the past, only the best counts.
            one.fitness_history = one.fitness_history and [max(one.fitness_history)]
        self.generation += 1

    def _drawn(self, count: int) -> dict[int, Any]:
        """Return new genomes by key."""
        return self.reproduction.create_new(
            self.config.genome_type, self.config.genome_config, count
        )

    def _speciate(self) -> None:
        self.species.speciate(self.config, self.population, self.generation)
        # Numbers of one generation's innovations are done with, and nobody asks for ancestors.
        self.tracker.reset_generation()
        self.reproduction.ancestors.clear()
