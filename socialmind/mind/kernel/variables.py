"""Variables over lanes: the commands of the last cycle, and what regulations make of them."""

from __future__ import annotations

import math
from typing import Any

from numba.extending import register_jitable

from socialmind.mind.kernel.layout import (
    SHARED_COM,
    SHARED_COMMAND,
    SHARED_MEMORY,
    SHARED_TICK,
    SHARED_VALUE,
    SHARED_WEIGHT,
    VARIABLES,
)
from socialmind.mind.regulation import REGULATED, SIMPLE, WAVE

SLOWEST_WAVE = 0.001
"""What a wave's phase grows by in a tick for the command 0 (thesis, A.2: t / 1000)."""
FASTEST_WAVE = 3.0
"""The same for the command 1 (thesis, A.2: t * 3)."""


@register_jitable
def regulate(
    code: int, parameters: Any, command: float, kept: float, value: float, memory: float
) -> tuple[float, float]:
    """Return a variable's value and what it remembers, by one of the built-in regulations.

    Args:
        code: SIMPLE, WAVE or COUNTER.
        parameters: the regulation's numbers.
        command: the command of the last cycle, or NaN when no skill gave one.
        kept: the last command before, NaN when there was none.
        value: the value in the tick before.
        memory: what it remembered then.
    """
    commanded = not math.isnan(command)
    if code == SIMPLE:
        return (command if commanded else value), memory
    latest = command if commanded else kept
    if code == WAVE:
        growth = 1.0
        if not math.isnan(latest):
            growth = SLOWEST_WAVE + (FASTEST_WAVE - SLOWEST_WAVE) * latest
        phase = memory + growth
        return 0.5 + 0.5 * math.sin(phase), phase
    maximum, increment, reset = parameters[0], parameters[1], parameters[2]
    previous = 0.0 if math.isnan(kept) else kept
    if not math.isnan(latest):
        if previous <= increment < latest:
            memory = 0.0 if memory >= maximum else memory + 1.0
            value = memory / maximum
        elif previous >= reset > latest:
            memory = 0.0
            value = 0.0
    return value, memory


@register_jitable
def commanded(
    structure: Any, state: Any, block: int, lanes: int, module: int, com: Any, weight: Any
) -> None:
    """Add up what commands a variable or an actuator: Σ Com and Σ Σ influence of equation 4.3.

    Args:
        structure: the hierarchy's arrays.
        state: the agents' arrays.
        block: the block of agents.
        lanes: how many of its lanes live.
        module: the variable's number; for an actuator, that and the number of variables.
        com: the row to fill with Σ Com.
        weight: the row to fill with Σ Σ influence.
    """
    totals, sent = state.totals[block], state.sent[block]
    drive_command, drive_weight = state.drive_command[block], state.drive_weight[block]
    for lane in range(lanes):
        com[lane] = drive_command[module, lane]
        weight[lane] = drive_weight[module, lane]
    for place in range(structure.command_begin[module], structure.command_begin[module + 1]):
        entry = structure.command_entry[place]
        row, total = sent[entry], totals[structure.entry_skill[entry]]
        for lane in range(lanes):
            com[lane] += row[lane]
            weight[lane] += total[lane]


@register_jitable
def forget_drive(state: Any, block: int, lanes: int, module: int) -> None:
    """Forget what the drive commanded a module; it was heard."""
    for lane in range(lanes):
        state.drive_command[block, module, lane] = 0.0
        state.drive_weight[block, module, lane] = 0.0


@register_jitable
def take_commands(structure: Any, state: Any, block: int, lanes: int, variable: int) -> Any:
    """Return a row of a variable's commands of the last cycle, NaN where none came.

    The drive's own are taken with them, and forgotten.
    """
    com, weight = state.nodes[0, 0], state.nodes[0, 1]
    commanded(structure, state, block, lanes, variable, com, weight)
    for lane in range(lanes):
        com[lane] = com[lane] / weight[lane] if weight[lane] > 0.0 else math.nan
    forget_drive(state, block, lanes, variable)
    return com


@register_jitable
def vary(structure: Any, state: Any, block: int, lanes: int) -> None:
    """Step 2 for all variables with built-in regulations; the modeller's own come after.

    Members of a group see its shared variable; outside any group it is an agent's own.
    """
    values, memory, kept = state.values[block], state.memory[block], state.command[block]
    for variable in range(structure.sizes[VARIABLES]):
        code = structure.regulation[variable]
        if code == REGULATED:
            continue
        row = take_commands(structure, state, block, lanes, variable)
        parameters = structure.regulation_parameters[variable]
        number = structure.shared[variable]
        for lane in range(lanes):
            group = state.group[block, number, lane] if number >= 0 else -1
            if group >= 0:
                instance = state.instances[group, number]
                if instance[SHARED_TICK] != state.now[0]:
                    settle_shared(code, parameters, instance)
                    instance[SHARED_TICK] = state.now[0]
                values[variable, lane] = instance[SHARED_VALUE]
                continue
            values[variable, lane], memory[variable, lane] = regulate(
                code,
                parameters,
                row[lane],
                kept[variable, lane],
                values[variable, lane],
                memory[variable, lane],
            )
            if not math.isnan(row[lane]):
                kept[variable, lane] = row[lane]


@register_jitable
def settle_shared(code: int, parameters: Any, instance: Any) -> None:
    """Regulate a shared variable by the commands of its members in the last tick."""
    command = math.nan
    if instance[SHARED_WEIGHT] > 0.0:
        command = instance[SHARED_COM] / instance[SHARED_WEIGHT]
    instance[SHARED_VALUE], instance[SHARED_MEMORY] = regulate(
        code,
        parameters,
        command,
        instance[SHARED_COMMAND],
        instance[SHARED_VALUE],
        instance[SHARED_MEMORY],
    )
    if not math.isnan(command):
        instance[SHARED_COMMAND] = command
    instance[SHARED_COM] = 0.0
    instance[SHARED_WEIGHT] = 0.0


@register_jitable
def share(structure: Any, state: Any, block: int, lanes: int) -> None:
    """End a cycle: add the agents' commands to those of their groups, by their participation."""
    com, weight = state.nodes[0, 0], state.nodes[0, 1]
    for variable in range(structure.sizes[VARIABLES]):
        number = structure.shared[variable]
        if number < 0:
            continue
        commanded(structure, state, block, lanes, variable, com, weight)
        for lane in range(lanes):
            group = state.group[block, number, lane]
            part = state.participation[block, number, lane]
            if group >= 0:
                instance = state.instances[group, number]
                instance[SHARED_COM] += part * com[lane]
                instance[SHARED_WEIGHT] += part * weight[lane]
