"""Networks as steps of arithmetic over numbered nodes.

Every trainable internal function comes down to a `Network`: a few steps that fill nodes from
earlier nodes and from the genome. The compiled evaluator, the torch twin and the drawings all read
this one form, so a kind of network is described once.

Nodes 0 … inputs − 1 are the inputs. A genome is ordered layer by layer, neuron by neuron: the
incoming weights in the order of the layer's inputs, then the bias.
"""

from __future__ import annotations

from dataclasses import dataclass

LINEAR, RELU, SIGMOID, CLAMP, TANH = range(5)
"""Activations: x, max(x, 0), 1 / (1 + exp(−x)), x held to [0, 1], tanh(x)."""
NEAT_ACTIVATIONS = {
    name: 5 + place
    for place, name in enumerate(
        (
            "sigmoid", "tanh", "sin", "gauss", "relu", "elu", "lelu", "selu", "softplus",
            "identity", "clamped", "inv", "log", "exp", "abs", "hat", "square", "cube",
        )
    )
}  # fmt: skip
"""The activations of neat-python by name, with its own constants (`sigmoid` is 1/(1+exp(−5x)))."""
SUM, PRODUCT, GREATEST, LEAST, GREATEST_ABSOLUTE, MEDIAN, MEAN = range(7)
"""Aggregations of a neuron's weighted inputs."""
NEAT_AGGREGATIONS = {
    "sum": SUM, "product": PRODUCT, "max": GREATEST, "min": LEAST, "maxabs": GREATEST_ABSOLUTE,
    "median": MEDIAN, "mean": MEAN,
}  # fmt: skip
MEMORY_BOUND = 1e6
"""What a recurrent network remembers is held within ± this, so that it stays finite."""


@dataclass(frozen=True)
class Dense:
    """Fills nodes, each from all of a range of nodes: a fully connected layer.

    Attributes:
        source, sources: the first node read, and how many.
        target, neurons: the first node filled, and how many.
        weights: place in the genome of the first neuron's first weight; `sources + 1` a neuron.
        activation: one of the activations.
    """

    source: int
    sources: int
    target: int
    neurons: int
    weights: int
    activation: int


@dataclass(frozen=True)
class Neuron:
    """A neuron with its own inputs.

    Attributes:
        sources: the nodes read.
        weights: the place in the genome of each one's weight.
        bias: the place in the genome of its bias, -1 for none.
        activation: one of the activations.
        aggregation: one of the aggregations.
        response: the factor of the aggregated input: activation(bias + response · aggregate).
    """

    sources: tuple[int, ...]
    weights: tuple[int, ...]
    bias: int
    activation: int
    aggregation: int = SUM
    response: float = 1.0


@dataclass(frozen=True)
class Neurons:
    """Fills nodes one after another, each by a neuron of its own (convolutions, NEAT)."""

    target: int
    neurons: tuple[Neuron, ...]


@dataclass(frozen=True)
class Gather:
    """Copies nodes side by side, so that a dense layer can read them."""

    sources: tuple[int, ...]
    target: int


@dataclass(frozen=True)
class Mix:
    """Fills nodes by equation 4.3: Σ influence · value / Σ influence; 0.5 without influence.

    Attributes:
        target: the first node filled.
        pairs: for each node filled, the nodes (influence, value) of its branches.
    """

    target: int
    pairs: tuple[tuple[tuple[int, int], ...], ...]


@dataclass(frozen=True)
class Recall:
    """Fills nodes with what the network remembered at the last evaluation (0 at the start)."""

    memory: int
    target: int
    count: int


@dataclass(frozen=True)
class Remember:
    """Keeps nodes for the next evaluation, held within ± `MEMORY_BOUND`."""

    source: int
    memory: int
    count: int


Step = Dense | Neurons | Gather | Mix | Recall | Remember


@dataclass(frozen=True)
class Network:
    """A network as steps.

    Attributes:
        inputs: how many inputs: nodes 0 … inputs − 1.
        outputs: how many outputs.
        output: the first of the output nodes; their values are held to [0, 1].
        nodes: how many nodes in all.
        genome_size: how many weights.
        memory: how many numbers it keeps between evaluations.
        steps: what fills the nodes, in order.
    """

    inputs: int
    outputs: int
    output: int
    nodes: int
    genome_size: int
    memory: int
    steps: tuple[Step, ...]
