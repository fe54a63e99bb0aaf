"""Sensors and variables over lanes: values, derivatives and histories (thesis, figure 5.4)."""

from __future__ import annotations

from typing import Any

from numba.extending import register_jitable

from socialmind.mind.kernel.layout import SENSORS, VARIABLES


@register_jitable
def check_sensors(structure: Any, state: Any, block: int, lanes: int) -> None:
    """Refuse sensors before anything changes, so that an evaluation that is refused did nothing.

    Raises:
        ValueError: a value that is not in [0, 1].
    """
    sensors = state.sensors[block]
    wrong = False
    for sensor in range(structure.sizes[SENSORS]):
        row = sensors[sensor]
        for lane in range(lanes):
            wrong |= not (row[lane] >= 0.0 and row[lane] <= 1.0)
    if wrong:
        raise ValueError("a sensor's value outside [0, 1]")


@register_jitable
def sense(structure: Any, state: Any, block: int, lanes: int) -> None:
    """Step 1: take the sensors' values, their derivatives and histories."""
    count = structure.sizes[SENSORS]
    present(structure, state, block, lanes, state.sensors[block], 0, count)


@register_jitable
def present_variables(structure: Any, state: Any, block: int, lanes: int) -> None:
    """End step 2: show the variables' values, derivatives and histories to the skills."""
    sensors, variables = structure.sizes[SENSORS], structure.sizes[VARIABLES]
    signals, before, fresh = state.signals[block], state.before[block], state.fresh[block]
    values = state.values[block]
    for variable in range(variables):
        for lane in range(lanes):
            shown = values[variable, lane] if fresh[lane] else signals[sensors + variable, lane]
            before[variable, lane] = shown
    present(structure, state, block, lanes, values, sensors, variables)


@register_jitable
def present(
    structure: Any, state: Any, block: int, lanes: int, values: Any, first: int, count: int
) -> None:
    """Write the values of modules into the signals, and what is derived from them.

    Args:
        structure: the hierarchy's arrays.
        state: the agents' arrays.
        block: the block of agents.
        lanes: how many of its lanes live.
        values: the values, a row for each module.
        first: the modules' first signal.
        count: how many modules there are.
    """
    signals, past, fresh = state.signals[block], state.past[block], state.fresh[block]
    clock = state.clock[block]
    plain = structure.sizes[SENSORS] + structure.sizes[VARIABLES]
    # Derivatives first: they need what the signals held in the tick before.
    for tap in range(len(structure.tap_module)):
        module = structure.tap_module[tap]
        if structure.tap_lag[tap] == 0 and first <= module < first + count:
            row, old = values[module - first], signals[module]
            shown = signals[plain + tap]
            for lane in range(lanes):
                change = row[lane] - old[lane]
                shown[lane] = 0.5 if fresh[lane] else 0.5 + 0.5 * change
    for module in range(count):
        row, shown = values[module], signals[first + module]
        for lane in range(lanes):
            shown[lane] = row[lane]
    for ring in range(len(structure.ring_module)):
        module = structure.ring_module[ring]
        if first <= module < first + count:
            row = values[module - first]
            begin, length = structure.ring_begin[ring], structure.ring_length[ring]
            at = begin + clock % length
            for lane in range(lanes):
                past[at, lane] = row[lane]
                if fresh[lane]:
                    for place in range(begin, begin + length):
                        past[place, lane] = row[lane]
    for tap in range(len(structure.tap_module)):
        module, lag = structure.tap_module[tap], structure.tap_lag[tap]
        if lag > 0 and first <= module < first + count:
            row = past[structure.tap_ring[tap] + (clock - lag) % structure.tap_length[tap]]
            shown = signals[plain + tap]
            for lane in range(lanes):
                shown[lane] = row[lane]
