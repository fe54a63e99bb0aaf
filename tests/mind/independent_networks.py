"""Internal functions in plain Python: perceptrons by equation 5.1, other networks step by step.

Nothing of `socialmind.mind` computes here; only the descriptions of networks are read.
"""

import math
import statistics
from collections.abc import Callable, Sequence
from typing import Any

from socialmind.mind.functions import network as form
from socialmind.mind.functions.network import Network, Neuron

HELD = 1e100
"""The neurons of NEAT graphs hold what they compute within this."""


def clamped(x: float) -> float:
    """Return x held to [0, 1]; 0 for what is not a number."""
    return 1.0 if x >= 1.0 else x if x > 0.0 else 0.0


def relu(x: float) -> float:
    return x if x > 0.0 else 0.0


def sigmoid(x: float) -> float:
    return 1.0 / (1.0 + math.exp(-x)) if x > -700.0 else 0.0


def perceptron(
    inputs: Sequence[float],
    genome: Sequence[float],
    outputs: int,
    layers: int = 2,
    added: int = 2,
    hidden: Callable[[float], float] = relu,
) -> list[float]:
    """Return what a multi-layered perceptron makes of its inputs (thesis, 5.2.1, equation 5.1).

    Hidden layers have max(inputs, outputs) + added neurons; the last layer is linear, clamped.
    The genome goes layer by layer, neuron by neuron: incoming weights in input order, then bias.
    """
    genes = iter(genome)

    def layer(values: Sequence[float], neurons: int, f: Callable[[float], float]) -> list[float]:
        result = []
        for _ in range(neurons):
            total = sum([next(genes) * value for value in values])
            result.append(f(total + next(genes)))
        return result

    values = list(inputs)
    for _ in range(layers):
        values = layer(values, max(len(inputs), outputs) + added, hidden)
    result = layer(values, outputs, clamped)
    left_over = len(list(genes))
    if left_over:
        raise ValueError(f"a genome with {left_over} weights too many for a perceptron")
    return result


def neat_range(x: float) -> float:
    """Return x as the neurons of NEAT graphs take it: finite."""
    return 0.0 if math.isnan(x) else max(-HELD, min(HELD, x))


def bent(x: float, slope: float) -> float:
    """Return 5x or 2.5x as neat-python takes it, within ± 60."""
    return max(-60.0, min(60.0, slope * x))


NEAT: dict[str, Callable[[float], float]] = {
    "sigmoid": lambda x: 1.0 / (1.0 + math.exp(-bent(x, 5.0))),
    "tanh": lambda x: math.tanh(bent(x, 2.5)),
    "sin": lambda x: math.sin(bent(x, 5.0)),
    "gauss": lambda x: math.exp(-5.0 * max(-3.4, min(3.4, x)) ** 2),
    "relu": relu,
    "elu": lambda x: x if x > 0.0 else math.exp(x) - 1.0,
    "lelu": lambda x: x if x > 0.0 else 0.005 * x,
    "selu": lambda x: 1.0507009873554805 * (x if x > 0 else 1.6732632423543772 * math.expm1(x)),
    "softplus": lambda x: 0.2 * math.log(1.0 + math.exp(bent(x, 5.0))),
    "identity": lambda x: x,
    "clamped": lambda x: max(-1.0, min(1.0, x)),
    "inv": lambda x: 0.0 if x == 0.0 else max(-HELD, min(HELD, 1.0 / x)),
    "log": lambda x: math.log(max(1e-7, x)),
    "exp": lambda x: math.exp(bent(x, 1.0)),
    "abs": abs,
    "hat": lambda x: max(0.0, 1.0 - abs(x)),
    "square": lambda x: x * x,
    "cube": lambda x: x * x * x,
}
"""The activations of neat-python 2.0 by name."""


def held(f: Callable[[float], float]) -> Callable[[float], float]:
    """Return an activation that takes its input as the neurons of NEAT graphs do."""
    return lambda x: f(neat_range(x))


ACTIVATIONS: dict[int, Callable[[float], float]] = {
    form.LINEAR: lambda x: x,
    form.RELU: relu,
    form.SIGMOID: sigmoid,
    form.CLAMP: clamped,
    form.TANH: math.tanh,
    **{code: held(NEAT[name]) for name, code in form.NEAT_ACTIVATIONS.items()},
}

AGGREGATIONS: dict[int, Callable[[list[float]], float]] = {
    form.SUM: sum,
    form.PRODUCT: math.prod,
    form.GREATEST: lambda values: max(values, default=0.0),
    form.LEAST: lambda values: min(values, default=0.0),
    form.GREATEST_ABSOLUTE: lambda values: max(values, key=abs, default=0.0),
    form.MEDIAN: lambda values: statistics.median(values) if values else 0.0,
    form.MEAN: lambda values: sum(values) / len(values) if values else 0.0,
}


def run_network(
    network: Network, inputs: Sequence[float], genome: Sequence[float], memory: list[float]
) -> list[float]:
    """Return what a network makes of its inputs.

    Args:
        network: its steps.
        inputs: one number each.
        genome: its weights.
        memory: what it remembers; changed in place.
    """
    nodes: list[float | None] = [None] * network.nodes  # so that reading too early fails
    nodes[: network.inputs] = inputs
    for step in network.steps:
        run_step(step, nodes, genome, memory)
    return [clamped(_filled(nodes[network.output + k])) for k in range(network.outputs)]


def run_step(
    step: Any, nodes: list[float | None], genome: Sequence[float], memory: list[float]
) -> None:
    """Fill nodes or memory by one step of a network."""
    match step:
        case form.Dense():
            read = [_filled(nodes[step.source + k]) for k in range(step.sources)]
            for neuron in range(step.neurons):
                place = step.weights + neuron * (step.sources + 1)
                total = sum([genome[place + k] * value for k, value in enumerate(read)])
                result = ACTIVATIONS[step.activation](total + genome[place + step.sources])
                nodes[step.target + neuron] = result
        case form.Neurons():
            for k, one in enumerate(step.neurons):
                nodes[step.target + k] = run_neuron(one, nodes, genome)
        case form.Gather():
            for k, source in enumerate(step.sources):
                nodes[step.target + k] = _filled(nodes[source])
        case form.Mix():
            for k, pairs in enumerate(step.pairs):
                branches = [(_filled(nodes[i]), _filled(nodes[v])) for i, v in pairs]
                influence = sum([i for i, _ in branches])
                weighted = sum([i * v for i, v in branches])
                nodes[step.target + k] = weighted / influence if influence > 0.0 else 0.5
        case form.Recall():
            nodes[step.target : step.target + step.count] = memory[
                step.memory : step.memory + step.count
            ]
        case form.Remember():
            for k in range(step.count):
                value = _filled(nodes[step.source + k])
                memory[step.memory + k] = max(-form.MEMORY_BOUND, min(form.MEMORY_BOUND, value))
        case _:
            raise TypeError(f"no step of a network that is known here: {step}")


def run_neuron(neuron: Neuron, nodes: list[float | None], genome: Sequence[float]) -> float:
    """Return a neuron's value: activation(bias + response · aggregate of the weighted inputs)."""
    weighted = [
        genome[weight] * _filled(nodes[source])
        for source, weight in zip(neuron.sources, neuron.weights, strict=True)
    ]
    bias = genome[neuron.bias] if neuron.bias >= 0 else 0.0
    aggregate = AGGREGATIONS[neuron.aggregation](weighted)
    return ACTIVATIONS[neuron.activation](bias + neuron.response * aggregate)


def _filled(value: float | None) -> float:
    if value is None:
        raise ValueError("a step reads a node that no step has filled")
    return value
