"""The layout of a model's data: the records of agents, patches and the model, and its arrays."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any, NamedTuple

import numpy as np

from coglogo_py.arrays import MindArrays, SchemeArrays
from coglogo_py.laying_out import ENGINE_ARRAYS
from socialmind.fields import Field
from socialmind.language.program import Program
from socialmind.language.shape import ModelShape, PopulationShape

Columns = list[Any]

TABLE_ARRAYS: dict[str, tuple[str, int]] = {
    "order": ("int64", 1),
    "acting": ("int64", 1),
    "slot_of": ("int64", 1),
    "free": ("int64", 1),
    "alive": ("bool_", 1),
    "counters": ("int64", 1),
    "names": ("int64", 1),
}
"""The arrays of every population beside its rows: NumPy type and dimensions."""

MIND_SCRATCH: dict[str, tuple[str, int]] = {
    "weights": ("float64", 1),
    "plans": ("int64", 1),
    "functions": ("int64", 1),
}
"""Further arrays of a population with minds: room for a decision, the function of each plan."""

WEIGHING: dict[str, tuple[str, int]] = {
    "weighing_sensor": ("int64", 1),
    "weighing_reach": ("float64", 1),
    "weighing_actuator": ("int64", 1),
    "weighing_plans": ("float64", 1),
}
"""Further arrays of a population whose hierarchies weigh plans, as `WeighingPlaces` has them."""


CONDITIONS: dict[str, tuple[str, int]] = {"conditions": ("int64", 2), "sides": ("float64", 2)}
"""Further arrays of a population whose scheme has conditions, as `agents.heeding` has them."""
Further = tuple[tuple[str, str, str, int], ...]
"""Arrays that depend on more than the shape: population, name, NumPy type and dimensions."""

LINKS: dict[str, tuple[str, int]] = {
    "heads_out": ("int64", 2),
    "ties_out": ("int64", 2),
    "joined": ("int64", 2),
}
"""Further arrays of a network, as `networks.adjacency` has them."""
LINKS_APART: dict[str, tuple[str, int]] = {"heads_in": ("int64", 2), "ties_in": ("int64", 2)}
"""Further arrays of one in which sources are told from targets."""
SEEKING = (
    *("near_cells", "near_entries", "near_entries_0", "near_starts", "near_starts_0"),
    *("near_heads", "near_heads_0"),
    *("near_spots", "near_spots_0", "near_found", "near_found_0"),
    *("near_marks", "near_marks_0", "near_places", "near_places_0"),
)
"""Further columns of the record for a population whose agents rules look for: its index."""
EVENTS = ("events", "events_0", "events_1")
"""Further columns where agents are born or die in ticks: what is noted of it."""

GATHERING = ("heads", "heads_0", "entries", "entries_0", "entries_1", "found", "found_0", "marks",
             "marks_0")  # fmt: skip
"""Further columns of the record for each kind of lists of agents in groups that rules ask for."""


def population_arrays(population: PopulationShape) -> dict[str, tuple[str, int]]:
    """Return the names, types and dimensions of all plain arrays of a population."""
    arrays = dict(TABLE_ARRAYS)
    if population.minded:
        arrays |= MIND_SCRATCH
        if population.weighed:
            arrays |= WEIGHING
        arrays |= {f"scheme_{name}": ENGINE_ARRAYS[name] for name in SchemeArrays._fields}
        arrays |= {f"minds_{name}": ENGINE_ARRAYS[name] for name in MindArrays._fields}
    if population.links is not None:
        arrays |= LINKS | (LINKS_APART if population.links.apart else {})
    return arrays


def row_dtype(fields: dict[str, Field], population: PopulationShape | None) -> np.dtype[Any]:
    """Return the record of an agent, or of a patch when there is no population."""
    columns: Columns = []
    if population is not None:
        columns += [("_id", "i8"), ("_slot", "i8")]
        if population.minded:
            columns += [("_mind", "i8"), ("_plan", "i8"), ("_decided", "i8")]
        if population.links is not None:
            columns += [("_source", "i8"), ("_target", "i8")]
        if population.steps is not None:
            columns += [("_step", "i8"), ("_rounds", "i8", (population.steps.depth,))]
        if population.messages_to is not None:
            columns.append(("_next", "i8"))
        columns += [(f"_first_{messages}", "i8") for messages in population.mailboxes]
    for field in fields.values():
        columns += field.dtype
    # A patch may be a few bytes, and there are many: no padding between them.
    return np.dtype(columns or [("_empty", "i1")], align=population is not None)


class Asked(NamedTuple):
    """What a society's record holds beside its own, because rules or minds ask for it.

    Attributes:
        more: columns that what rules call of the world needs.
        sought: the populations whose agents rules look for.
        gathered: the populations, and the lists of their agents in groups that rules ask for.
        eventful: whether agents are born or die in ticks.
        further: arrays of populations, for conditions of schemes and imitation.
    """

    more: tuple[str, ...] = ()
    sought: tuple[str, ...] = ()
    gathered: tuple[tuple[str, str], ...] = ()
    eventful: bool = False
    further: Further = ()


def asked_for(program: Program, conditioned: Iterable[str]) -> Asked:
    """Return what a society's record holds because it is asked for.

    Args:
        program: the typed rules.
        conditioned: the populations whose schemes have conditions.
    """
    further = [(name, one, *kind) for name in conditioned for one, kind in CONDITIONS.items()]
    for command, learner, other in program.imitations:
        if command == "imitate_memes":
            further.append((learner, f"memes_{other}", "int64", 2))
    return Asked(
        program.world_columns,
        program.sought,
        program.gathered,
        bool(program.eventful),
        tuple(further),
    )


def model_dtype(shape: ModelShape, asked: Asked) -> np.dtype[Any]:
    """Return the model's record: parameters, variables, and where everything else is.

    Args:
        shape: the model's.
        asked: what its rules and minds ask for.
    """
    columns: Columns = []
    for field in [*shape.parameters.values(), *shape.variables.values()]:
        columns += field.dtype
    plain = "tick stream idle idle_agent idle_tick world_size world_low world_high patches"
    columns += [(f"_{name}", "i8") for name in plain.split()]
    # Those of patches stand in every record: a checkpoint holds it as it is.
    columns += [
        (f"_{one}", "i8") for one in (*shape.world.columns, *asked.more) if one not in plain.split()
    ]
    columns += [(f"_{name}_{one}", "i8") for name in asked.sought for one in SEEKING]
    columns += [
        (f"_{name}_{kind}_{one}", "i8") for name, kind in asked.gathered for one in GATHERING
    ]
    columns += [(f"_{one}", "i8") for one in EVENTS if asked.eventful]
    for population in shape.populations.values():
        name = population.name
        columns += [(f"_{name}_rows", "i8"), (f"_{name}_default", "i8"), (f"_{name}_room", "i8")]
        if population.hierarchy:
            columns.append((f"_{name}_hierarchy", "i8"))
        for array, (_, dimensions) in population_arrays(population).items():
            columns += _address_of(name, array, dimensions)
    for name, array, _, dimensions in asked.further:
        columns += _address_of(name, array, dimensions)
    return np.dtype(columns, align=True)


def _address_of(population: str, array: str, dimensions: int) -> Columns:
    """Return the columns that say where an array is, and how large."""
    place = f"_{population}_{array}"
    return [(place, "i8"), *((f"{place}_{axis}", "i8") for axis in range(dimensions))]


def dtype_text(dtype: np.dtype[Any]) -> str:
    """Return a record's type as the compiled module writes it."""
    assert dtype.fields is not None  # a record
    columns = []
    for name, (column, *_) in dtype.fields.items():
        shape = f", {column.shape}" if column.shape else ""
        # numba knows no arrays of truth values in a record; bytes are laid out alike.
        kind = "u1" if shape and column.base == np.bool_ else column.base.str[1:]
        columns.append(f"    ({name!r}, {kind!r}{shape}),\n")
    return f"np.dtype(\n    [\n{''.join(columns)}    ],\n    align={dtype.isalignedstruct},\n)"


def view_text(population: str, array: str, kind: str, dimensions: int) -> str:
    """Return the expression by which compiled code reaches an array of a population."""
    place = f"_model._{population}_{array}"
    shape = "".join(f"{place}_{axis}, " for axis in range(dimensions))
    return f"carray(_as_pointer({place}), ({shape}), np.{kind})"


def view_function_text(population: str, array: str, kind: str, dimensions: int) -> str:
    """Return a function of the model's record that gives an array of a population."""
    view = view_text(population, array, kind, dimensions)
    return f"@_inner\ndef _{array}_{population}(_model):\n    return {view}"
