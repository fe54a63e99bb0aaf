"""The arrays of a hierarchy: its structure, and the state of any number of agents.

Agents are evaluated in lockstep, a block of lanes at a time: the last axis of every array of state
is the lane, so that the same step of all lanes is one vector operation. Agent i is lane i % lanes
of block i // lanes. Agents that act one after another, as in a model, are blocks of one lane.
"""

from __future__ import annotations

from functools import cache
from typing import Annotated, Any, NamedTuple, get_type_hints

from numpy.typing import NDArray

Ints1 = Annotated[NDArray[Any], ("int64", 1)]
Ints2 = Annotated[NDArray[Any], ("int64", 2)]
Ints3 = Annotated[NDArray[Any], ("int64", 3)]
Floats1 = Annotated[NDArray[Any], ("float64", 1)]
Floats2 = Annotated[NDArray[Any], ("float64", 2)]
Floats3 = Annotated[NDArray[Any], ("float64", 3)]

SENSORS, VARIABLES, ACTUATORS, SKILLS, MASTER, OBSERVED = range(6)
"""Places in `Structure.sizes`: how many there are, the master's number, and whether the outputs of
skills without influence are wanted too."""
SIZES = 6

NETWORK, PROGRAM, SCHEME = range(3)
"""Kinds of internal functions, in `Structure.skill_kind`."""

DENSE, NEURONS, GATHER, MIX, RECALL, REMEMBER = range(6)
"""Kinds of steps of networks, in the first column of `Structure.steps`."""
STEP_COLUMNS = 7
"""A step: its kind, then its numbers as `arrays.py` lists them."""
NEURON_COLUMNS = 5
"""A neuron: first of its sources, how many, place of its bias, activation, aggregation."""

SHARED_VALUE, SHARED_COMMAND, SHARED_MEMORY, SHARED_COM, SHARED_WEIGHT, SHARED_TICK = range(6)
"""Columns of a shared variable's instance: value, last command, memory, the members' commands of
this tick and their weight so far, and the tick."""
SHARED_COLUMNS = 6


class Structure(NamedTuple):
    """A hierarchy as arrays; nothing of it changes while agents run.

    Signals are what skills read: rows 0 … sensors − 1 the sensors' values, then the variables'
    values, then derivatives and histories, the *taps*. Entries are the outputs of all skills, in
    the order of evaluation. A group of short lists is stored end to end, with its begins.
    """

    sizes: Ints1  # (SIZES,)
    tap_module: Ints1  # (taps,) the signal it is taken from
    tap_lag: Ints1  # (taps,) ticks back; 0 for a derivative
    tap_ring: Ints1  # (taps,) first row of the module's past values
    tap_length: Ints1  # (taps,) how many past values are kept
    ring_module: Ints1  # (rings,) signals whose past values are kept
    ring_begin: Ints1  # (rings,)
    ring_length: Ints1  # (rings,)
    regulation: Ints1  # (variables,) the regulation's code
    regulation_number: Ints1  # (variables,) which of the modeller's regulations
    regulation_parameters: Floats2  # (variables, PARAMETERS)
    start: Floats2  # (variables, 2) value and memory at the start
    shared: Ints1  # (variables,) its number among the shared variables, -1 for an own one
    shared_group: Ints1  # (shared variables,) the group whose members share it
    command_begin: Ints1  # (variables + actuators + 1,) into command_entry
    command_entry: Ints1  # entries that command a module, by the names of their skills
    entry_skill: Ints1  # (entries,)
    entry_begin: Ints1  # (skills + 1,)
    neutral: Floats1  # (actuators,)
    skill_kind: Ints1  # (skills,)
    skill_number: Ints1  # (skills,) which program or scheme
    skill_keeps: Ints1  # (skills,) 1 when its function remembers and must always be evaluated
    source_begin: Ints1  # (skills + 1,) into source_entry
    source_entry: Ints1  # entries that influence a skill, by the names of their skills
    input_begin: Ints1  # (skills + 1,) into input_signal
    input_signal: Ints1  # signals that a skill reads
    output_node: Ints1  # (skills,) the first of its network's output nodes
    step_begin: Ints1  # (skills + 1,) into steps
    steps: Ints2  # (steps, STEP_COLUMNS)
    node_list: Ints1  # nodes that steps list
    neurons: Ints2  # (neurons, NEURON_COLUMNS)
    neuron_response: Floats1  # (neurons,)
    neuron_source: Ints1  # sources of all neurons
    neuron_weight: Ints1  # place in the genome of each of them


class State(NamedTuple):
    """What changes as agents run; `blocks` and `lanes` as said above."""

    sensors: Floats3  # (blocks, sensors, lanes) written by the world
    signals: Floats3  # (blocks, signals, lanes) what skills read
    past: Floats3  # (blocks, past values, lanes)
    values: Floats3  # (blocks, variables, lanes) the variables' values
    before: Floats3  # (blocks, variables, lanes) those of the last tick
    command: Floats3  # (blocks, variables, lanes) the last command; NaN when never commanded
    memory: Floats3  # (blocks, variables, lanes) what regulations remember
    totals: Floats3  # (blocks, skills, lanes) Σ influence that a skill received
    output: Floats3  # (blocks, entries, lanes) what functions gave: V_O
    sent: Floats3  # (blocks, entries, lanes) V_O · Σ influence
    drive_influence: Floats3  # (blocks, skills, lanes) what the drive adds
    drive_command: Floats3  # (blocks, variables + actuators, lanes) command · weight of the drive
    drive_weight: Floats3  # (blocks, variables + actuators, lanes)
    actuators: Floats3  # (blocks, actuators, lanes) the commands, equation 4.3
    remembered: Floats3  # (blocks, memory, lanes) what networks remember
    fresh: Ints2  # (blocks, lanes) 1 before the first evaluation
    clock: Ints1  # (blocks,) evaluations of the block
    genome: Floats3  # (1 or blocks, weights, 1 or lanes)
    first_genome: Floats3  # (1, weights, 1) of those born with own genomes; the `common` weights
    common: Ints1  # (skills,) 1 where all take the weights in `first_genome`, own genomes or not
    individual: Ints2  # (blocks, lanes) who has one number as the lane before has its own genome
    nodes: Floats3  # (1, nodes, lanes) room for one skill's network
    group: Ints3  # (blocks, shared variables, lanes) instance that an agent is in, -1 for none
    participation: Floats3  # (blocks, shared variables, lanes)
    instances: Floats3  # (instances, shared variables, SHARED_COLUMNS)
    now: Ints1  # (1,) the tick, by which shared variables know a new one


LIVES = (
    "sensors", "signals", "past", "values", "before", "command", "memory", "totals", "output",
    "sent", "drive_influence", "drive_command", "drive_weight", "actuators", "remembered", "fresh",
    "clock", "group", "participation",
)  # fmt: skip
"""The arrays of state with a row for each block."""
NOT_KEPT = ("nodes", "individual")
"""The arrays of state that a copy leaves out: room for arithmetic, and what saves some."""


@cache
def array_types(kind: type) -> dict[str, tuple[str, int]]:
    """Return the NumPy type and the dimensions of each array of `Structure` or `State`."""
    hints = get_type_hints(kind, include_extras=True)
    return {name: hint.__metadata__[0] for name, hint in hints.items()}
