"""Networks evaluated step by step in plain Python."""

from socialmind.mind.functions.activations import activate, aggregate
from socialmind.mind.functions.network import (
    MEMORY_BOUND,
    Dense,
    Gather,
    Mix,
    Neurons,
    Recall,
    Remember,
)


def stepped(network, genome, sequence):
    """The outputs at each evaluation of a sequence; a node read before it is filled is an error."""
    memory, given = [0.0] * network.memory, []
    for inputs in sequence:
        nodes = dict(enumerate(inputs))
        kept = list(memory)
        for step in network.steps:
            fill(step, nodes, genome, memory, kept)
        assert set(nodes) == set(range(network.nodes))
        memory = kept
        first = network.output
        given.append([min(max(nodes[first + k], 0.0), 1.0) for k in range(network.outputs)])
    return given


def fill(step, nodes, genome, memory, kept):
    match step:
        case Dense():
            for neuron in range(step.neurons):
                first = step.weights + neuron * (step.sources + 1)
                total = genome[first + step.sources]
                for k in range(step.sources):
                    total += genome[first + k] * nodes[step.source + k]
                nodes[step.target + neuron] = activate(step.activation, total)
        case Neurons():
            for place, one in enumerate(step.neurons):
                weighted = [
                    genome[w] * nodes[s] for w, s in zip(one.weights, one.sources, strict=True)
                ]
                total = aggregate(one.aggregation, weighted)
                bias = genome[one.bias] if one.bias >= 0 else 0.0
                nodes[step.target + place] = activate(one.activation, bias + one.response * total)
        case Gather():
            for place, source in enumerate(step.sources):
                nodes[step.target + place] = nodes[source]
        case Mix():
            for place, pairs in enumerate(step.pairs):
                total = sum(nodes[influence] for influence, _ in pairs)
                weighted = sum(nodes[influence] * nodes[value] for influence, value in pairs)
                nodes[step.target + place] = weighted / total if total > 0.0 else 0.5
        case Recall():
            for k in range(step.count):
                nodes[step.target + k] = memory[step.memory + k]
        case Remember():
            for k in range(step.count):
                value = nodes[step.source + k]
                kept[step.memory + k] = min(max(value, -MEMORY_BOUND), MEMORY_BOUND)
