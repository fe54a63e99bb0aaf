"""The connection of a model's arrays to its compiled code: addresses and sizes in one record."""

from __future__ import annotations

import operator
from typing import TYPE_CHECKING, Any

import numpy as np

from coglogo_py import CognitiveScheme
from coglogo_py.arrays import MindArrays, SchemeArrays, culturons_of
from socialmind.errors import ModelError
from socialmind.language.program import Program

if TYPE_CHECKING:
    from socialmind.model import Model


def connect(model: Model) -> None:
    """Write into the model's record where its arrays are, and how large, unless it knows.

    The arrays are kept: while they are, no other array can take an address that was written.
    """
    arrays = _all_arrays(model)
    known = model.connected
    if len(known) == len(arrays) and all(map(operator.is_, known, arrays.values())):
        return
    context = model.context
    context["_stream"] = _address(model.stream)
    if model.grid is not None:
        context["_world_size"] = model.grid.size
        context["_world_low"] = model.grid.low
        context["_world_high"] = model.grid.high
    for name, table in model.tables.items():
        context[f"_{name}_room"] = len(table.rows)
    for name, array in arrays.items():
        context[f"_{name}"] = _address(array)
        if array.dtype.names is None:
            for axis, length in enumerate(array.shape):
                context[f"_{name}_{axis}"] = length
    model.connected = list(arrays.values())


def _address(array: Any) -> int:
    return int(array.__array_interface__["data"][0])


def _all_arrays(model: Model) -> dict[str, Any]:
    """Return the arrays of a model by the names that the record gives their addresses."""
    arrays: dict[str, Any] = {}
    if model.grid is not None:
        arrays["patches"] = model.grid.rows
    for name, table in model.tables.items():
        for part in ("rows", "default", "order", "acting", "slot_of", "free", "alive", "counters"):
            arrays[f"{name}_{part}"] = getattr(table, part)
        arrays[f"{name}_names"] = model.names[name]
        if table.society is not None:
            for part, array in table.scratch(model.program).items():
                arrays[f"{name}_{part}"] = array
            for part, array in zip(SchemeArrays._fields, table.society.arrays, strict=True):
                arrays[f"{name}_scheme_{part}"] = array
            for part, array in zip(MindArrays._fields, table.society.minds, strict=True):
                arrays[f"{name}_minds_{part}"] = array
    return arrays


def names_of_scheme(program: Program, population: str, scheme: CognitiveScheme | None) -> list[int]:
    """Return where in a scheme the names stand that a population's rules write.

    Raises:
        ModelError: a rule names what the scheme does not have, or a plan has no function.
    """
    if scheme is None:
        return []
    tables: dict[str, dict[Any, int]] = {
        "plan": {name: place for place, name in enumerate(scheme.plans)},
        "cogniton": {one.name: place for place, one in enumerate(scheme.cognitons)},
        "group": {one.name: place for place, one in enumerate(scheme.groups)},
        "role": {},
        "culturon": {},
    }
    for group in scheme.groups:
        for role in group.roles:
            tables["role"][group.name, role.name] = len(tables["role"])
        for culturon in culturons_of(group):
            tables["culturon"][group.name, culturon.name] = len(tables["culturon"])
    if population in program.plans:
        for plan in scheme.plans:
            if plan not in program.plans[population]:
                raise ModelError(
                    f"the plan {plan!r} of the scheme {scheme.name!r}, which has no function",
                    "a function for each plan",
                    f"the population {population!r} has {', '.join(program.plans[population])}",
                )
    owners = dict.fromkeys(tables, f"the scheme {scheme.name!r}")
    return program.placed(population, tables, owners)


def plan_functions(program: Program, population: str, scheme: CognitiveScheme) -> Any:
    """Return the number of each plan's function, in the scheme's order."""
    known = {plan: place for place, plan in enumerate(program.plans.get(population, {}))}
    return np.array([known.get(plan, -1) for plan in scheme.plans], np.int64)
