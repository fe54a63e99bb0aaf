"""The connection of a model's arrays to its compiled code: addresses and sizes in one record."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from coglogo_py import CognitiveScheme
from coglogo_py.arrays import culturons_of
from socialmind.errors import ModelError
from socialmind.language.program import Program

if TYPE_CHECKING:
    from socialmind.model import Model
    from socialmind.population import Table


def connect(model: Model) -> None:
    """Write into the model's record where its arrays are, and how large."""
    context = model.context
    context["_stream"] = _address(model.stream)
    if model.grid is not None:
        context["_world_size"] = model.grid.size
        context["_world_low"] = model.grid.low
        context["_world_high"] = model.grid.high
        context["_patches"] = _address(model.grid.rows)
    for name, table in model.tables.items():
        context[f"_{name}_rows"] = _address(table.rows)
        context[f"_{name}_room"] = len(table.rows)
        context[f"_{name}_default"] = _address(table.default)
        for array, value in _arrays(model, name, table).items():
            context[f"_{name}_{array}"] = _address(value)
            for axis, length in enumerate(value.shape):
                context[f"_{name}_{array}_{axis}"] = length


def _address(array: Any) -> int:
    return int(array.__array_interface__["data"][0])


def _arrays(model: Model, name: str, table: Table) -> dict[str, Any]:
    arrays = {
        "order": table.order,
        "acting": table.acting,
        "slot_of": table.slot_of,
        "free": table.free,
        "alive": table.alive,
        "counters": table.counters,
        "names": model.names[name],
    }
    if table.society is not None:
        arrays |= table.scratch(model.program)
        arrays |= {f"scheme_{k}": v for k, v in table.society.arrays._asdict().items()}
        arrays |= {f"minds_{k}": v for k, v in table.society.minds._asdict().items()}
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
    return program.placed(population, tables, f"the scheme {scheme.name!r}")


def plan_functions(program: Program, population: str, scheme: CognitiveScheme) -> Any:
    """Return the number of each plan's function, in the scheme's order."""
    known = {plan: place for place, plan in enumerate(program.plans.get(population, {}))}
    return np.array([known.get(plan, -1) for plan in scheme.plans], np.int64)
