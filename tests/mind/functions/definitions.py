"""What the networks compute, in plain Python, written from their definitions.

Nothing here looks at a network's steps. A genome is read from front to back, as its documented
order has it.
"""

import math

from socialmind.mind.functions.convolution import Convolution
from socialmind.mind.functions.elman import Elman
from socialmind.mind.functions.influence_network import InfluenceNetwork
from socialmind.mind.functions.neat.graph import NeatGraph
from socialmind.mind.functions.perceptron import Perceptron
from socialmind.mind.functions.recurrent import Recurrent


def held(x):
    return min(max(x, 0.0), 1.0)


HIDDEN = {"relu": lambda x: max(x, 0.0), "sigmoid": lambda x: 1.0 / (1.0 + math.exp(-x))}


def layer(weights, read, neurons, activation):
    """A layer's values; `weights` is an iterator over the genome."""
    values = []
    for _ in range(neurons):
        total = sum(next(weights) * value for value in read)
        values.append(activation(total + next(weights)))
    return values


def perceptron(function, weights, read, outputs):
    size = max(len(read), outputs) + function.added
    for _ in range(function.layers):
        read = layer(weights, read, size, HIDDEN[function.hidden])
    return layer(weights, read, outputs, held)


def convolution(function, weights, read, outputs):
    below = read
    for kernel in function.kernels:
        shared = [next(weights) for _ in range(kernel.size)]
        bias = next(weights)
        below = [
            HIDDEN[function.hidden](
                sum(w * below[place] for w, place in zip(shared, places, strict=True)) + bias
            )
            for places in kernel.links
        ]
    return perceptron(function, weights, [*below, *(read[place] for place in function.bypass)],
                      outputs)  # fmt: skip


def influence_network(function, weights, read, outputs):
    branches = function.branches + len(function.passes)
    gates = branches if function.gates == "branch" else branches * outputs
    influence = perceptron(function, weights, read, gates)
    values = [perceptron(function, weights, read, outputs) for _ in range(function.branches)]
    values += [[read[place]] * outputs for place in function.passes]
    mixed = []
    for output in range(outputs):
        own = influence[output * branches :] if function.gates == "output" else influence
        total = sum(own[branch] for branch in range(branches))
        weighted = sum(own[branch] * values[branch][output] for branch in range(branches))
        mixed.append(weighted / total if total else 0.5)
    return mixed


def elman(function, weights, read, outputs, last):
    size = max(len(read), outputs) + function.added
    now = []
    for place in range(function.layers):
        context = last[place] if last else [0.0] * size
        read = layer(weights, [*read, *context], size, HIDDEN[function.hidden])
        now.append(read)
    return layer(weights, read, outputs, held), now


def recurrent(function, weights, read, outputs, last):
    size = max(len(read), outputs) + function.added
    last = last or [0.0] * (function.layers * size + outputs)
    now = []
    for _ in range(function.layers):
        read = layer(weights, [*read, *last], size, HIDDEN[function.hidden])
        now += read
    given = layer(weights, read, outputs, held)
    return given, [*now, *given]


def neat_graph(function, weights, read, outputs, last):
    import neat

    if function.inputs is None:
        function = NeatGraph.minimal(len(read), outputs)
    activations = neat.activations.ActivationFunctionSet()
    aggregations = neat.aggregations.AggregationFunctionSet()
    values = {-place - 1: value for place, value in enumerate(read)}
    seen = values if not function.recurrent else (last or {}) | values
    now = dict(values)
    for one in function.neurons:
        weighted = [next(weights) * seen.get(source, 0.0) for source in one.sources]
        total = aggregations.get(one.aggregation)(weighted)
        now[one.key] = activations.get(one.activation)(next(weights) + one.response * total)
        if not function.recurrent:
            seen = now
    return [held(now.get(key, 0.0)) for key in range(outputs)], now


WITHOUT_MEMORY = {
    Perceptron: perceptron,
    Convolution: convolution,
    InfluenceNetwork: influence_network,
}
WITH_MEMORY = {Elman: elman, Recurrent: recurrent, NeatGraph: neat_graph}


def defined(function, genome, sequence, outputs):
    """The outputs at each evaluation of a sequence of inputs."""
    given, last = [], None
    for inputs in sequence:
        weights = iter([float(weight) for weight in genome])
        read = [float(value) for value in inputs]
        if type(function) in WITHOUT_MEMORY:
            result = WITHOUT_MEMORY[type(function)](function, weights, read, outputs)
        else:
            result, last = WITH_MEMORY[type(function)](function, weights, read, outputs, last)
        assert next(weights, None) is None, "a weight was not used"
        given.append(result)
    return given
