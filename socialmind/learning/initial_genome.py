"""Genomes to start learning from: weights drawn by the size of each neuron."""

from __future__ import annotations

import math

from socialmind.learning.pytorch import torch
from socialmind.mind.functions.network import CLAMP, RELU, Dense, Network, Neurons


def initial_genome(network: Network, seed: int) -> torch.Tensor:
    """Return weights drawn so that signals neither fade nor grow from layer to layer.

    Weights are uniform within ± √(6 / inputs) for ReLU neurons (He) and ± √(6 / (inputs + neurons))
    for others (Glorot), biases within ± 1 / √inputs. The biases of neurons held to [0, 1] are 0.5,
    so that they start where gradients pass.

    Args:
        network: the network.
        seed: decides the draws, and they are the same for the same seed.

    Returns:
        Shape (genome size,), float64.

    >>> from socialmind.mind.functions.perceptron import Perceptron
    >>> initial_genome(Perceptron(layers=0).network(2, 1), seed=1)[-1]
    tensor(0.5000, dtype=torch.float64)
    """
    centres = torch.zeros(network.genome_size, dtype=torch.float64)
    limits = torch.zeros(network.genome_size, dtype=torch.float64)
    for step in network.steps:
        if isinstance(step, Dense):
            width = step.sources + 1
            places = slice(step.weights, step.weights + step.neurons * width)
            limit = _limit(step.sources, step.neurons, step.activation)
            limits[places].view(step.neurons, width)[:, :-1] = limit
            centre, limit = _bias(step.sources, step.activation)
            centres[places].view(step.neurons, width)[:, -1] = centre
            limits[places].view(step.neurons, width)[:, -1] = limit
        elif isinstance(step, Neurons):
            for neuron in step.neurons:
                count = len(neuron.sources)
                limits[list(neuron.weights)] = _limit(count, 1, neuron.activation)
                if neuron.bias >= 0:
                    centre, limit = _bias(count, neuron.activation)
                    centres[neuron.bias], limits[neuron.bias] = centre, limit
    generator = torch.Generator().manual_seed(seed)
    draws = torch.rand(network.genome_size, generator=generator, dtype=torch.float64)
    return centres + limits * (2.0 * draws - 1.0)


def _limit(sources: int, neurons: int, activation: int) -> float:
    """Return the greatest weight of a neuron."""
    return math.sqrt(6.0 / max(sources if activation == RELU else sources + neurons, 1))


def _bias(sources: int, activation: int) -> tuple[float, float]:
    """Return the centre of a neuron's bias, and how far it may lie from it."""
    return (0.5, 0.0) if activation == CLAMP else (0.0, 1.0 / math.sqrt(max(sources, 1)))
