"""Genomes of neat-python read and written as the neurons of a graph and their weights.

neat-python itself is not imported: the genome and its configuration bring all that is needed.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from socialmind.mind.functions.neat.neuron import GraphNeuron

Connections = Mapping[tuple[int, int], float]
"""The weights of enabled connections by (source, target), in the order of their genome."""


def read_genome(genome: Any, config: Any) -> tuple[list[GraphNeuron], list[float]]:
    """Return the neurons of a genome that outputs depend on, and their weights.

    Args:
        genome: a `neat.DefaultGenome`.
        config: the `neat.Config` that it belongs to.

    Returns:
        The neurons in the order of evaluation, and for each its weights and then its bias.

    Raises:
        ModelError: an activation or an aggregation of the modeller's own.
    """
    settings = config.genome_config
    enabled = {key: gene.weight for key, gene in genome.connections.items() if gene.enabled}
    needed = _needed(settings.output_keys, enabled)
    order = _forward(needed, enabled) if settings.feed_forward else _recurrent(needed, enabled)
    neurons, weights = [], []
    for key in order:
        gene = genome.nodes[key]
        sources = tuple(source for source, target in enabled if target == key)
        neurons.append(
            GraphNeuron(key, sources, gene.activation, gene.aggregation, float(gene.response))
        )
        weights += [*(enabled[source, key] for source in sources), gene.bias]
    return neurons, weights


def written_genome(
    config: Any,
    neurons: Sequence[GraphNeuron],
    silent: Sequence[int],
    weights: Sequence[float] | NDArray[np.float64],
    key: int,
) -> Any:
    """Return a genome of neat-python with these neurons.

    Args:
        config: the `neat.Config` that it is to belong to.
        neurons: the neurons.
        silent: the keys of neurons that are 0.
        weights: for each neuron its weights and then its bias.
        key: the key of the genome.

    Returns:
        The genome. Its connections get the innovation numbers of the configuration's tracker, or
        1, 2, … where it has none yet.
    """
    settings = config.genome_config
    genome = config.genome_type(key)
    for one in silent:
        genome.nodes[one] = _node_gene(settings, GraphNeuron(one, (), "identity"), 0.0)
    place = 0
    for neuron in neurons:
        for source in neuron.sources:
            ends = source, neuron.key
            number = len(genome.connections) + 1
            if settings.innovation_tracker is not None:
                tracker = settings.innovation_tracker
                number = tracker.get_innovation_number(*ends, "initial_connection")
            connection = settings.connection_gene_type(ends, innovation=number)
            connection.weight, connection.enabled = float(weights[place]), True
            genome.connections[ends] = connection
            place += 1
        genome.nodes[neuron.key] = _node_gene(settings, neuron, float(weights[place]))
        place += 1
    return genome


def _needed(outputs: Iterable[int], connections: Connections) -> set[int]:
    """Return the keys of the outputs and of all neurons that they depend on."""
    needed = set(outputs)
    waiting = list(needed)
    while waiting:
        target = waiting.pop()
        for source, end in connections:
            if end == target and source >= 0 and source not in needed:
                needed.add(source)
                waiting.append(source)
    return needed


def _recurrent(needed: set[int], connections: Connections) -> list[int]:
    """Return the neurons that neat-python evaluates in a recurrent network, by key."""
    return sorted(needed & {target for _, target in connections})


def _forward(needed: set[int], connections: Connections) -> list[int]:
    """Return the neurons that neat-python evaluates in a feed-forward network, sources first.

    It does not evaluate those in or behind a cycle.
    """
    order: list[int] = []
    ready: set[int] = set()
    sources = {key: {a for a, b in connections if b == key and a >= 0} for key in needed}
    while True:
        layer = sorted(key for key in needed - ready if sources[key] <= ready)
        if not layer:
            return order
        order += layer
        ready.update(layer)


def _node_gene(settings: Any, neuron: GraphNeuron, bias: float) -> Any:
    """Return a neuron as a gene of neat-python, without a draw from its random numbers."""
    gene = settings.node_gene_type(neuron.key)
    gene.bias, gene.response = bias, float(neuron.response)
    gene.activation, gene.aggregation = neuron.activation, neuron.aggregation
    gene.time_constant = getattr(settings, "time_constant_init_mean", 1.0)
    return gene
