"""Networks over lanes: the steps of `functions.network`, compiled.

Sums run in the order of the inputs, in every lane alike, whatever the number of lanes: an agent
alone and the same agent among thousands get equal results, bit by bit.
"""

from __future__ import annotations

from typing import Any

from numba.extending import register_jitable

from socialmind.mind.functions.activations import activate, aggregate
from socialmind.mind.functions.network import LINEAR, MEMORY_BOUND, RELU, SUM
from socialmind.mind.kernel.layout import DENSE, GATHER, MIX, NEURONS, RECALL, REMEMBER

LONG_RUN = 8
"""How many lanes next to each other must have equal weights on the mean to take these once: weights
of so many lanes fill a line of the cache."""

_activate = register_jitable(activate)
_aggregate = register_jitable(aggregate)


@register_jitable
def run_network(structure: Any, state: Any, block: int, lanes: int, skill: int) -> None:
    """Fill the nodes of a skill's network from its inputs.

    Args:
        structure: the hierarchy's arrays.
        state: the agents' arrays.
        block: the block of agents.
        lanes: how many of its lanes live.
        skill: the skill's number.
    """
    nodes = state.nodes[0]
    genome = state.genome[block if state.genome.shape[0] > 1 else 0]
    if state.common[skill] != 0:
        genome = state.first_genome[0]
    shared = genome.shape[1] == 1
    individual = state.individual[block]
    in_runs = not shared and _runs(individual, lanes) * LONG_RUN <= lanes
    remembered = state.remembered[block]
    for place in range(structure.step_begin[skill], structure.step_begin[skill + 1]):
        step = structure.steps[place]
        kind = step[0]
        if kind == DENSE:
            if lanes == 1:
                _dense_alone(nodes, genome, step)
            elif shared:
                _dense_alike(nodes, genome, step, 0, lanes)
            elif in_runs:
                begin = 0
                while begin < lanes:
                    end = _end_of_run(individual, begin, lanes)
                    _dense_alike(nodes, genome, step, begin, end)
                    begin = end
            else:
                _dense_own(nodes, genome, step, lanes)
            for node in range(step[3], step[3] + step[4]):
                _activated(nodes[node], step[6], lanes)
        elif kind == NEURONS:
            _neurons(structure, nodes, genome, step, lanes)
        elif kind == GATHER:
            for i in range(step[2]):
                source = nodes[structure.node_list[step[1] + i]]
                target = nodes[step[3] + i]
                for lane in range(lanes):
                    target[lane] = source[lane]
        elif kind == MIX:
            _mix(structure, nodes, step, lanes)
        elif kind == RECALL:
            for i in range(step[2]):
                for lane in range(lanes):
                    nodes[step[3] + i, lane] = remembered[step[1] + i, lane]
        elif kind == REMEMBER:
            for i in range(step[2]):
                for lane in range(lanes):
                    value = nodes[step[1] + i, lane]
                    value = min(max(value, -MEMORY_BOUND), MEMORY_BOUND)
                    remembered[step[3] + i, lane] = value


@register_jitable
def _activated(row: Any, activation: int, lanes: int) -> None:
    """Apply an activation to a row; the two commonest without a call for each lane."""
    if activation == RELU:
        for lane in range(lanes):
            row[lane] = row[lane] if row[lane] > 0.0 else 0.0
    elif activation != LINEAR:
        for lane in range(lanes):
            row[lane] = _activate(activation, row[lane])


@register_jitable
def _end_of_run(individual: Any, begin: int, lanes: int) -> int:
    """Return the first lane behind those from `begin` on that have equal weights."""
    end = begin + 1
    while end < lanes and individual[end] == individual[begin]:
        end += 1
    return end


@register_jitable
def _runs(individual: Any, lanes: int) -> int:
    """Return how many runs of lanes with equal weights there are."""
    runs = 1
    for lane in range(1, lanes):
        if individual[lane] != individual[lane - 1]:
            runs += 1
    return runs


@register_jitable
def _dense_alike(nodes: Any, genome: Any, step: Any, begin: int, end: int) -> None:
    """Fill a fully connected layer of lanes that all have the weights of the first of them."""
    source, sources, target = step[1], step[2], step[3]
    weights = genome[:, begin]
    lanes = end - begin
    for neuron in range(step[4]):
        first = step[5] + neuron * (sources + 1)
        row = nodes[target + neuron, begin:end]
        bias = weights[first + sources]
        for lane in range(lanes):
            row[lane] = bias
        i = 0
        # Four inputs at a time: each sum is loaded and stored a quarter as often.
        while i + 4 <= sources:
            w0, w1 = weights[first + i], weights[first + i + 1]
            w2, w3 = weights[first + i + 2], weights[first + i + 3]
            x0, x1 = nodes[source + i, begin:end], nodes[source + i + 1, begin:end]
            x2, x3 = nodes[source + i + 2, begin:end], nodes[source + i + 3, begin:end]
            for lane in range(lanes):
                row[lane] = (
                    row[lane] + w0 * x0[lane] + w1 * x1[lane] + w2 * x2[lane] + w3 * x3[lane]
                )
            i += 4
        while i < sources:
            w0 = weights[first + i]
            x0 = nodes[source + i, begin:end]
            for lane in range(lanes):
                row[lane] += w0 * x0[lane]
            i += 1


@register_jitable
def _dense_own(nodes: Any, genome: Any, step: Any, lanes: int) -> None:
    """Fill a fully connected layer; each lane has its own weights."""
    source, sources, target = step[1], step[2], step[3]
    for neuron in range(step[4]):
        first = step[5] + neuron * (sources + 1)
        row = nodes[target + neuron]
        bias = genome[first + sources]
        for lane in range(lanes):
            row[lane] = bias[lane]
        i = 0
        while i + 4 <= sources:
            w0, w1 = genome[first + i], genome[first + i + 1]
            w2, w3 = genome[first + i + 2], genome[first + i + 3]
            x0, x1 = nodes[source + i], nodes[source + i + 1]
            x2, x3 = nodes[source + i + 2], nodes[source + i + 3]
            for lane in range(lanes):
                row[lane] = (
                    row[lane]
                    + w0[lane] * x0[lane]
                    + w1[lane] * x1[lane]
                    + w2[lane] * x2[lane]
                    + w3[lane] * x3[lane]
                )
            i += 4
        while i < sources:
            w0 = genome[first + i]
            x0 = nodes[source + i]
            for lane in range(lanes):
                row[lane] += w0[lane] * x0[lane]
            i += 1


@register_jitable
def _dense_alone(nodes: Any, genome: Any, step: Any) -> None:
    """Fill a fully connected layer for one agent: four neurons at a time, as sums wait on sums."""
    source, sources, target, neurons = step[1], step[2], step[3], step[4]
    size = sources + 1
    neuron = 0
    while neuron + 4 <= neurons:
        a = step[5] + neuron * size
        b, c, d = a + size, a + 2 * size, a + 3 * size
        s0, s1 = genome[a + sources, 0], genome[b + sources, 0]
        s2, s3 = genome[c + sources, 0], genome[d + sources, 0]
        for i in range(sources):
            x = nodes[source + i, 0]
            s0 += genome[a + i, 0] * x
            s1 += genome[b + i, 0] * x
            s2 += genome[c + i, 0] * x
            s3 += genome[d + i, 0] * x
        nodes[target + neuron, 0] = s0
        nodes[target + neuron + 1, 0] = s1
        nodes[target + neuron + 2, 0] = s2
        nodes[target + neuron + 3, 0] = s3
        neuron += 4
    while neuron < neurons:
        a = step[5] + neuron * size
        s0 = genome[a + sources, 0]
        for i in range(sources):
            s0 += genome[a + i, 0] * nodes[source + i, 0]
        nodes[target + neuron, 0] = s0
        neuron += 1


@register_jitable
def _neurons(structure: Any, nodes: Any, genome: Any, step: Any, lanes: int) -> None:
    """Fill nodes by neurons with inputs of their own."""
    weight_lanes = genome.shape[1]
    for k in range(step[2]):
        neuron = structure.neurons[step[1] + k]
        first, count, bias, activation, aggregation = (
            neuron[0], neuron[1], neuron[2], neuron[3], neuron[4],
        )  # fmt: skip
        response = structure.neuron_response[step[1] + k]
        row = nodes[step[3] + k]
        for lane in range(lanes):
            at = lane if weight_lanes > 1 else 0
            if aggregation == SUM:
                total = 0.0
                for i in range(first, first + count):
                    weight = genome[structure.neuron_weight[i], at]
                    total += weight * nodes[structure.neuron_source[i], lane]
            else:
                total = _aggregated(structure, nodes, genome, neuron, lane, at)
            total *= response
            if bias >= 0:
                total += genome[bias, at]
            row[lane] = total
        _activated(row, activation, lanes)


@register_jitable
def _aggregated(structure: Any, nodes: Any, genome: Any, neuron: Any, lane: int, at: int) -> float:
    """Return another aggregation than the sum of a neuron's weighted inputs."""
    first, count = neuron[0], neuron[1]
    values = [0.0 for _ in range(count)]
    for i in range(count):
        weight = genome[structure.neuron_weight[first + i], at]
        values[i] = weight * nodes[structure.neuron_source[first + i], lane]
    return _aggregate(neuron[4], values)


@register_jitable
def _mix(structure: Any, nodes: Any, step: Any, lanes: int) -> None:
    """Fill nodes as motors are: Σ influence · value / Σ influence, 0.5 without influence."""
    place = step[1]
    for k in range(step[2]):
        pairs = structure.node_list[place]
        place += 1
        for lane in range(lanes):
            total, weight = 0.0, 0.0
            for pair in range(pairs):
                influence = nodes[structure.node_list[place + 2 * pair], lane]
                total += influence * nodes[structure.node_list[place + 2 * pair + 1], lane]
                weight += influence
            nodes[step[3] + k, lane] = total / weight if weight > 0.0 else 0.5
        place += 2 * pairs
