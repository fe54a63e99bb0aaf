"""Genomes to start learning from: weights drawn by the size of each neuron."""

from __future__ import annotations

import math

from socialmind.learning.imprinting.pytorch import torch
from socialmind.mind.functions.network import (
    CLAMP,
    LINEAR,
    NEAT_ACTIVATIONS,
    RELU,
    Dense,
    Gather,
    Network,
    Neuron,
    Neurons,
)


def initial_genome(network: Network, seed: int) -> torch.Tensor:
    """Return weights drawn so that signals neither fade nor grow from layer to layer.

    Weights are uniform within ± √(6 / inputs) for ReLU neurons (He) and ± √(6 / (inputs + neurons))
    for others (Glorot). The bias of a ReLU neuron puts its kink through a random point of its
    inputs' unit cube, since signals lie in [0, 1]: hardly any is silent from the start. The bias of
    a neuron held to [0, 1] is 0.5, where gradients pass; of others, within ± 1 / √inputs.

    Args:
        network: the network.
        seed: decides the draws, and they are the same for the same seed.

    Returns:
        Shape (genome size,), float64.

    >>> from socialmind.mind.functions.perceptron import Perceptron
    >>> initial_genome(Perceptron(layers=0).network(2, 1), seed=1)[-1]
    tensor(0.5000, dtype=torch.float64)
    """
    genome = torch.zeros(network.genome_size, dtype=torch.float64)
    generator = torch.Generator().manual_seed(seed)
    held = _held(network)
    for step in network.steps:
        if isinstance(step, Dense):
            width = step.sources + 1
            places = slice(step.weights, step.weights + step.neurons * width)
            genome[places] = _layer(step.neurons, step.sources, step.activation, generator).view(-1)
        elif isinstance(step, Neurons):
            for node, neuron in enumerate(step.neurons, step.target):
                # Neurons of a kernel share their weights: those drawn last stay.
                drawn = _layer(1, len(neuron.sources), _kind(neuron, node in held), generator)[0]
                genome[list(neuron.weights)] = drawn[:-1]
                if neuron.bias >= 0:
                    genome[neuron.bias] = drawn[-1]
    return genome


def _held(network: Network) -> set[int]:
    """Return the nodes whose values are outputs, which are held to [0, 1]."""
    held = set(range(network.output, network.output + network.outputs))
    for step in reversed(network.steps):
        if isinstance(step, Gather):
            held |= {one for node, one in enumerate(step.sources, step.target) if node in held}
    return held


def _kind(neuron: Neuron, held: bool) -> int:
    """Return the activation that a neuron's weights are drawn for."""
    if held and neuron.activation in (LINEAR, NEAT_ACTIVATIONS["identity"]):
        return CLAMP
    return RELU if neuron.activation == NEAT_ACTIVATIONS["relu"] else neuron.activation


def _layer(neurons: int, sources: int, activation: int, generator: torch.Generator) -> torch.Tensor:
    """Return the weights and biases of neurons, shape (neurons, sources + 1)."""
    drawn = torch.rand(2, neurons, sources + 1, generator=generator, dtype=torch.float64)
    spread = 2.0 * drawn[0] - 1.0
    fan = sources if activation == RELU else sources + neurons
    weights = math.sqrt(6.0 / max(fan, 1)) * spread[:, :-1]
    if activation == CLAMP:
        biases = torch.full((neurons,), 0.5, dtype=torch.float64)
    elif activation == RELU and sources:
        biases = -(weights * drawn[1, :, :-1]).sum(1)
    else:
        biases = spread[:, -1].abs() if activation == RELU else spread[:, -1]
        biases = biases / math.sqrt(max(sources, 1))
    return torch.cat([weights, biases[:, None]], 1)
