"""What rules and drives do with the hierarchy of one agent, beside evaluating it."""

from __future__ import annotations

import math
from typing import Any

from numba.extending import register_jitable

from socialmind.mind.kernel.layout import SENSORS, SHARED_MEMORY, SHARED_VALUE, VARIABLES
from socialmind.mind.regulation import COUNTER

ROUNDING = 1e-9
"""How far beyond [0, 1] a sensor's value may lie for the rounding of arithmetic."""


@register_jitable
def override(
    structure: Any, state: Any, block: int, lane: int, variable: int, value: float
) -> None:
    """Give a variable a value at once: skills of this tick see it, and what is derived from it."""
    signals, past = state.signals[block], state.past[block]
    module = structure.sizes[SENSORS] + variable
    plain = structure.sizes[SENSORS] + structure.sizes[VARIABLES]
    fresh = state.fresh[block, lane] != 0
    if fresh:
        state.before[block, variable, lane] = value
    signals[module, lane] = value
    for tap in range(len(structure.tap_module)):
        if structure.tap_module[tap] == module and structure.tap_lag[tap] == 0:
            change = value - state.before[block, variable, lane]
            signals[plain + tap, lane] = 0.5 + 0.5 * change
    for ring in range(len(structure.ring_module)):
        if structure.ring_module[ring] == module:
            begin, length = structure.ring_begin[ring], structure.ring_length[ring]
            past[begin + state.clock[block] % length, lane] = value
            if fresh:
                for place in range(begin, begin + length):
                    past[place, lane] = value
    if fresh:
        for tap in range(len(structure.tap_module)):
            if structure.tap_module[tap] == module and structure.tap_lag[tap] > 0:
                signals[plain + tap, lane] = value


@register_jitable
def set_variable(
    structure: Any, state: Any, block: int, lane: int, variable: int, value: float
) -> None:
    """Set a variable, for a whole group where it is shared; skills see it in the next evaluation.

    Raises:
        ValueError: a value that is not in [0, 1].
    """
    if not (value >= 0.0 and value <= 1.0):
        raise ValueError("a value for a variable outside [0, 1]")
    memory = state.memory[block, variable, lane]
    if structure.regulation[variable] == COUNTER:
        memory = math.floor(value * structure.regulation_parameters[variable, 0] + 0.5)
    state.values[block, variable, lane] = value
    state.memory[block, variable, lane] = memory
    number = structure.shared[variable]
    if number >= 0 and state.group[block, number, lane] >= 0:
        instance = state.instances[state.group[block, number, lane], number]
        instance[SHARED_VALUE] = value
        instance[SHARED_MEMORY] = memory


@register_jitable
def join(
    structure: Any, state: Any, block: int, lane: int, group: int, instance: int, part: float
) -> None:
    """Make an agent a member of a group's instance, or of none (-1), for its shared variables.

    Raises:
        ValueError: there is no such instance, or the participation is below 0 or infinite.
    """
    if instance < -1 or instance >= state.instances.shape[0]:
        raise ValueError("no such instance of the group; see Population(..., instances=)")
    if not (part >= 0.0 and part < math.inf):
        raise ValueError("a participation below 0, or not finite")
    for number in range(len(structure.shared_group)):
        if structure.shared_group[number] == group:
            state.group[block, number, lane] = instance
            state.participation[block, number, lane] = part


@register_jitable
def instance_of(state: Any, number: int, instance: int, agents: int, worlds: int) -> int:
    """Return which instance an agent means, in a world of its own among several.

    Args:
        state: the agents' arrays.
        number: the agent's.
        instance: as its world counts them, -1 for none.
        agents: how many there are in all worlds.
        worlds: how many worlds there are, of as many agents and instances each.
    """
    each = state.instances.shape[0] // worlds
    if instance < 0:
        return instance
    if instance >= each:
        return state.instances.shape[0]  # there is none
    return number // (agents // worlds) * each + instance


@register_jitable
def set_sensor(state: Any, block: int, lane: int, sensor: int, value: float) -> None:
    """Set a sensor; what lies beyond [0, 1] by no more than rounding counts as 0 or 1.

    Raises:
        ValueError: a value that is not in [0, 1].
    """
    if not (value >= -ROUNDING and value <= 1.0 + ROUNDING):
        raise ValueError("a value for a sensor outside [0, 1]")
    state.sensors[block, sensor, lane] = min(max(value, 0.0), 1.0)


@register_jitable
def add_influence(state: Any, block: int, lane: int, skill: int, value: float) -> None:
    """Let the drive add to the influence that a skill receives in this evaluation.

    Raises:
        ValueError: an influence below 0, or that is not finite.
    """
    if not (value >= 0.0 and value < math.inf):
        raise ValueError("an influence below 0")
    state.drive_influence[block, skill, lane] += value


@register_jitable
def command(
    structure: Any, state: Any, block: int, lane: int, actuator: bool, place: int,
    value: float, weight: float,
) -> None:  # fmt: skip
    """Let the drive add a command to an actuator or a variable, as a base skill does.

    Raises:
        ValueError: a command outside [0, 1], or a weight below 0.
    """
    if not (value >= 0.0 and value <= 1.0):
        raise ValueError("a command outside [0, 1]")
    if not (weight >= 0.0 and weight < math.inf):
        raise ValueError("a weight of a command below 0")
    module = structure.sizes[VARIABLES] + place if actuator else place
    state.drive_command[block, module, lane] += value * weight
    state.drive_weight[block, module, lane] += weight
