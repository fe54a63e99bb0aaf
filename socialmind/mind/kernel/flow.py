"""The flow of influence over lanes: equations 4.2 and 4.3 (thesis, section 4.2)."""

from __future__ import annotations

import math
from typing import Any

from numba.extending import register_jitable

from socialmind.mind.kernel.layout import (
    ACTUATORS,
    MASTER,
    OBSERVED,
    SENSORS,
    SHARED_COM,
    SHARED_COMMAND,
    SHARED_MEMORY,
    SHARED_TICK,
    SHARED_VALUE,
    SHARED_WEIGHT,
    SKILLS,
    VARIABLES,
)
from socialmind.mind.kernel.variables import commanded, forget_drive, share


@register_jitable
def receive(structure: Any, state: Any, block: int, lanes: int, skill: int) -> bool:
    """Add up the influence that a skill receives, and give it its inputs.

    Returns:
        Whether its function must be evaluated; if not, what it sends is set to zero. A skill
        without influence in any lane changes nothing, unless its function remembers.
    """
    total = state.totals[block, skill]
    drive = state.drive_influence[block, skill]
    impulse = 1.0 if skill == structure.sizes[MASTER] else 0.0
    for lane in range(lanes):
        total[lane] = impulse + drive[lane]
        drive[lane] = 0.0
    sent = state.sent[block]
    for place in range(structure.source_begin[skill], structure.source_begin[skill + 1]):
        row = sent[structure.source_entry[place]]
        for lane in range(lanes):
            total[lane] += row[lane]
    influenced = structure.sizes[OBSERVED] != 0 or structure.skill_keeps[skill] != 0
    if not influenced:
        for lane in range(lanes):
            influenced |= total[lane] > 0.0
    if not influenced:
        for entry in range(structure.entry_begin[skill], structure.entry_begin[skill + 1]):
            for lane in range(lanes):
                sent[entry, lane] = 0.0
        return False
    nodes, signals = state.nodes[0], state.signals[block]
    first = structure.input_begin[skill]
    for place in range(first, structure.input_begin[skill + 1]):
        row, node = signals[structure.input_signal[place]], nodes[place - first]
        for lane in range(lanes):
            node[lane] = row[lane]
    return True


@register_jitable
def transmit(structure: Any, state: Any, block: int, lanes: int, skill: int) -> None:
    """Hold a function's outputs to [0, 1] and send them, times the influence (equation 4.2).

    The outputs are the nodes from `output_node` on.
    """
    nodes, total = state.nodes[0], state.totals[block, skill]
    output, sent = state.output[block], state.sent[block]
    node = structure.output_node[skill]
    for entry in range(structure.entry_begin[skill], structure.entry_begin[skill + 1]):
        row, own, out = nodes[node], output[entry], sent[entry]
        for lane in range(lanes):
            value = row[lane]
            value = value if value > 0.0 else 0.0
            value = value if value < 1.0 else 1.0
            own[lane] = value
            out[lane] = value * total[lane]
        node += 1


@register_jitable
def act(structure: Any, state: Any, block: int, lanes: int) -> None:
    """Step 4: the actuators' commands (equation 4.3), and the end of the cycle."""
    com, weight = state.nodes[0, 0], state.nodes[0, 1]
    actuators = state.actuators[block]
    for actuator in range(structure.sizes[ACTUATORS]):
        module = structure.sizes[VARIABLES] + actuator
        commanded(structure, state, block, lanes, module, com, weight)
        forget_drive(state, block, lanes, module)
        neutral, row = structure.neutral[actuator], actuators[actuator]
        for lane in range(lanes):
            row[lane] = com[lane] / weight[lane] if weight[lane] > 0.0 else neutral
    share(structure, state, block, lanes)
    fresh = state.fresh[block]
    for lane in range(lanes):
        fresh[lane] = 0
    state.clock[block] += 1


@register_jitable
def start_lane(structure: Any, state: Any, block: int, lane: int) -> None:
    """Put an agent back to before its first evaluation; its genome and groups stay."""
    for variable in range(structure.sizes[VARIABLES]):
        state.values[block, variable, lane] = structure.start[variable, 0]
        state.before[block, variable, lane] = structure.start[variable, 0]
        state.memory[block, variable, lane] = structure.start[variable, 1]
        state.command[block, variable, lane] = math.nan
    for signal in range(state.signals.shape[1]):
        state.signals[block, signal, lane] = 0.0
    for row in range(structure.sizes[SENSORS]):
        state.sensors[block, row, lane] = 0.0
    for skill in range(structure.sizes[SKILLS]):
        state.totals[block, skill, lane] = 0.0
        state.drive_influence[block, skill, lane] = 0.0
    for entry in range(state.sent.shape[1]):
        state.output[block, entry, lane] = 0.0
        state.sent[block, entry, lane] = 0.0
    for module in range(state.drive_command.shape[1]):
        state.drive_command[block, module, lane] = 0.0
        state.drive_weight[block, module, lane] = 0.0
    for actuator in range(structure.sizes[ACTUATORS]):
        state.actuators[block, actuator, lane] = structure.neutral[actuator]
    for place in range(state.remembered.shape[1]):
        state.remembered[block, place, lane] = 0.0
    state.fresh[block, lane] = 1


@register_jitable
def born_lane(structure: Any, state: Any, agent: int, inherits: bool) -> None:
    """Begin a new agent's life; what it had of an earlier one is gone.

    Args:
        structure: the hierarchy's arrays.
        state: the agents' arrays.
        agent: its number.
        inherits: whether its own genome, if it has one, is that of first agents; else it stays.
    """
    lanes = state.fresh.shape[1]
    block, lane = agent // lanes, agent % lanes
    start_lane(structure, state, block, lane)
    for number in range(state.group.shape[1]):
        state.group[block, number, lane] = -1
        state.participation[block, number, lane] = 1.0
    if inherits and state.genome.shape[0] > 1:
        for weight in range(state.genome.shape[1]):
            state.genome[block, weight, lane] = state.first_genome[0, weight, 0]


@register_jitable
def start_instances(structure: Any, state: Any, world: int, worlds: int) -> None:
    """Put the instances of groups of one of several worlds back to before its first tick."""
    each = state.instances.shape[0] // worlds
    for variable in range(structure.sizes[VARIABLES]):
        number = structure.shared[variable]
        if number < 0:
            continue
        for place in range(world * each, (world + 1) * each):
            instance = state.instances[place, number]
            instance[SHARED_VALUE] = structure.start[variable, 0]
            instance[SHARED_MEMORY] = structure.start[variable, 1]
            instance[SHARED_COMMAND] = math.nan
            instance[SHARED_COM] = 0.0
            instance[SHARED_WEIGHT] = 0.0
            instance[SHARED_TICK] = -1.0


@register_jitable
def copy_lane(state: Any, parent: int, child: int) -> None:
    """Make an agent its parent's copy; it is in no group."""
    _copy_rows(state.sensors, parent, child)
    _copy_rows(state.signals, parent, child)
    _copy_rows(state.past, parent, child)
    _copy_rows(state.values, parent, child)
    _copy_rows(state.before, parent, child)
    _copy_rows(state.command, parent, child)
    _copy_rows(state.memory, parent, child)
    _copy_rows(state.totals, parent, child)
    _copy_rows(state.output, parent, child)
    _copy_rows(state.sent, parent, child)
    _copy_rows(state.drive_influence, parent, child)
    _copy_rows(state.drive_command, parent, child)
    _copy_rows(state.drive_weight, parent, child)
    _copy_rows(state.actuators, parent, child)
    _copy_rows(state.remembered, parent, child)
    lanes = state.fresh.shape[1]
    block, lane = child // lanes, child % lanes
    state.fresh[block, lane] = state.fresh[parent // lanes, parent % lanes]
    state.clock[block] = state.clock[parent // lanes]
    for number in range(state.group.shape[1]):
        state.group[block, number, lane] = -1
        state.participation[block, number, lane] = 1.0
    if state.genome.shape[0] > 1 or state.genome.shape[2] > 1:
        _copy_rows(state.genome, parent, child)


@register_jitable
def _copy_rows(array: Any, parent: int, child: int) -> None:
    lanes = array.shape[2]
    from_block, from_lane = parent // lanes, parent % lanes
    block, lane = child // lanes, child % lanes
    for row in range(array.shape[1]):
        array[block, row, lane] = array[from_block, row, from_lane]
