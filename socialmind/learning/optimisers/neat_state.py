"""The state of an evolution by neat-python as arrays."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from socialmind.learning.optimisers.contract import State
from socialmind.learning.optimisers.neat_library import Counter, Evolution, neat
from socialmind.mind.functions.network import NEAT_ACTIVATIONS, NEAT_AGGREGATIONS

ACTIVATIONS = {code: name for name, code in NEAT_ACTIVATIONS.items()}
AGGREGATIONS = {code: name for name, code in NEAT_AGGREGATIONS.items()}


def evolution_state(evolution: Evolution) -> State:
    """Return all that decides how an evolution goes on, beside its settings and its draws.

    Returns:
        `genomes`, shape (population, 3): key, neurons, connections of each genome;
        `neurons`, shape (n, 3), of one genome after the other: key, activation, aggregation;
        `biases`, shape (n, 3): bias, response, time constant; `connections`, shape (m, 4): source,
        target, innovation number, whether enabled; `weights`, shape (m,); `species`, shape (s, 5):
        key, generation of its making and of its last gain, key of the representative, members;
        `members`, shape (population,), of one species after the other: keys of genomes; `records`,
        shape (s, 2): whether a species was judged, and its best score; `counters`, shape (5,): the
        generation, the keys to come of genomes, species and neurons, the last innovation number.
    """
    genomes = list(evolution.population.values())
    neurons = [gene for genome in genomes for gene in genome.nodes.values()]
    connections = [gene for genome in genomes for gene in genome.connections.values()]
    species = [evolution.species.species[key] for key in sorted(evolution.species.species)]
    return {
        "genomes": _whole([(one.key, len(one.nodes), len(one.connections)) for one in genomes], 3),
        "neurons": _whole(
            [
                (one.key, NEAT_ACTIVATIONS[one.activation], NEAT_AGGREGATIONS[one.aggregation])
                for one in neurons
            ],
            3,
        ),
        "biases": _real([(one.bias, one.response, one.time_constant) for one in neurons], 3),
        "connections": _whole([(*one.key, one.innovation, one.enabled) for one in connections], 4),
        "weights": np.array([one.weight for one in connections], dtype=np.float64),
        "species": _whole(
            [
                (one.key, one.created, one.last_improved, one.representative.key, len(one.members))
                for one in species
            ],
            5,
        ),
        "members": np.array([key for one in species for key in one.members], dtype=np.int64),
        "records": _real(
            [(bool(one.fitness_history), *(one.fitness_history or [0.0])) for one in species], 2
        ),
        "counters": np.array(
            [
                evolution.generation,
                evolution.reproduction.genome_indexer.following,
                evolution.species.indexer.following,
                evolution.config.genome_config.node_indexer.following,
                evolution.tracker.global_counter,
            ],
            dtype=np.int64,
        ),
    }


VARYING = ("neurons", "biases", "connections", "weights", "species", "records")
"""The arrays whose length is another from generation to generation."""


def restore_evolution(evolution: Evolution, state: Mapping[str, Any]) -> None:
    """Let an evolution go on from what `evolution_state` returned.

    Args:
        evolution: one of the same inputs, outputs and settings.
        state: what `evolution_state` returned.
    """
    neurons = zip(state["neurons"].tolist(), state["biases"].tolist(), strict=True)
    connections = zip(state["connections"].tolist(), state["weights"].tolist(), strict=True)
    genomes = {}
    for key, neuron_count, connection_count in state["genomes"].tolist():
        genomes[key] = genome = evolution.config.genome_type(key)
        for _ in range(neuron_count):
            neuron = _neuron(*next(neurons))
            genome.nodes[neuron.key] = neuron
        for _ in range(connection_count):
            connection = _connection(*next(connections))
            genome.connections[connection.key] = connection
    members = iter(state["members"].tolist())
    species = {}
    records = zip(state["species"].tolist(), state["records"].tolist(), strict=True)
    for (key, created, improved, representative, count), (judged, best) in records:
        species[key] = one = neat.species.Species(key, created)
        one.last_improved = improved
        one.fitness_history = [best] if judged else []
        own = [next(members) for _ in range(count)]
        one.update(genomes[representative], {member: genomes[member] for member in own})
    generation, genome, kind, neuron, innovation = state["counters"].tolist()
    evolution.population, evolution.generation = genomes, generation
    evolution.species.species = species
    evolution.species.genome_to_species = {
        member: key for key, one in species.items() for member in one.members
    }
    evolution.reproduction.genome_indexer = Counter(genome)
    evolution.species.indexer = Counter(kind)
    evolution.config.genome_config.node_indexer = Counter(neuron)
    evolution.tracker.global_counter = innovation


def _neuron(codes: list[int], values: list[float]) -> Any:
    key, activation, aggregation = codes
    gene = neat.genes.DefaultNodeGene(key)
    gene.activation, gene.aggregation = ACTIVATIONS[activation], AGGREGATIONS[aggregation]
    gene.bias, gene.response, gene.time_constant = values
    return gene


def _connection(codes: list[int], weight: float) -> Any:
    source, target, innovation, enabled = codes
    gene = neat.genes.DefaultConnectionGene((source, target), innovation=innovation)
    gene.weight, gene.enabled = weight, bool(enabled)
    return gene


def _whole(rows: list[tuple[int, ...]], columns: int) -> Any:
    return np.array(rows, dtype=np.int64).reshape(-1, columns)


def _real(rows: list[tuple[float, ...]], columns: int) -> Any:
    return np.array(rows, dtype=np.float64).reshape(-1, columns)
