"""The connection of a model's arrays to its compiled code: addresses and sizes in one record."""

from __future__ import annotations

import operator
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from coglogo_py import CognitiveScheme
from coglogo_py.arrays import MindArrays, SchemeArrays
from coglogo_py.names import Names
from socialmind.compiling.layout import GATHERING, SEEKING
from socialmind.compiling.memory import address
from socialmind.errors import ModelError
from socialmind.language.program import Program

if TYPE_CHECKING:
    from socialmind.agents.running import Running
    from socialmind.mind.evaluation.arrays import Assembly


def connect(model: Running) -> None:
    """Write into the model's record where its arrays are, and how large, unless it knows.

    The arrays are kept: while they are, no other array can take an address that was written.
    """
    now, known = _held(model), model.connected
    if len(known) == len(now) and all(map(operator.is_, known, now)):
        return
    arrays = _all_arrays(model)
    numbers = [address(model.stream), *(len(table.rows) for table in model.tables.values())]
    for array in arrays.values():
        numbers.append(address(array))
        if array.dtype.names is None:
            numbers += array.shape
    words = model.record.places_of(tuple(arrays), lambda: _columns(model, arrays))
    words_of(model)[words] = numbers
    model.connected = now
    model.ground.connect(model.context)


def words_of(model: Running) -> NDArray[np.int64]:
    """Return the model's record as the whole numbers of eight bytes that it was made from."""
    words: Any = model.contexts.base
    found: NDArray[np.int64] = words
    return found


def _columns(model: Running, arrays: Mapping[str, Any]) -> list[str]:
    """Return the columns of the record that `connect` writes, in its order."""
    columns = ["_stream", *(f"_{name}_room" for name in model.tables)]
    for name, array in arrays.items():
        columns.append(f"_{name}")
        if array.dtype.names is None:
            columns += [f"_{name}_{axis}" for axis in range(array.ndim)]
    return columns


_OF_TABLES = operator.attrgetter(
    "rows", "default", "order", "acting", "slot_of", "free", "alive", "counters"
)


def _held(model: Running) -> list[Any]:
    """Return what holds the arrays of a model: while it is the same, so are they."""
    held: list[Any] = [*model.ground.arrays().values()]
    if model.program.eventful:
        held.append(model.event_log.rows)
    for name in model.program.sought:
        held += model.tables[name].index(model.program).values()
    for name, kind in model.program.gathered:
        held += model.tables[name].gathered(kind, model.program.loops_over_found).values()
    for table in model.tables.values():
        held += _OF_TABLES(table)
        held += table.link_arrays().values()
        if table.minds is not None:
            held.append(table.minds.record.record)
        if table.society is not None:
            held += (table.society.arrays, table.society.minds)
    return held


def connected_arrays(model: Running) -> list[Any]:
    """Return the arrays of a model that are state, beside its record and its minds."""
    lists = [f"{name}_{kind}_{one}" for name, kind in model.program.gathered for one in GATHERING]
    return [
        array
        for name, array in _all_arrays(model).items()
        if name != "events"
        and name not in lists
        and not name.endswith(("_names", "_default", "_hierarchy", *SEEKING))
    ]


def _all_arrays(model: Running) -> dict[str, Any]:
    """Return the arrays of a model by the names that the record gives their addresses."""
    arrays: dict[str, Any] = dict(model.ground.arrays())
    if model.program.eventful:
        arrays["events"] = model.event_log.rows
    for name in model.program.sought:
        for part, array in model.tables[name].index(model.program).items():
            arrays[f"{name}_{part}"] = array
    for name, kind in model.program.gathered:
        lists = model.tables[name].gathered(kind, model.program.loops_over_found)
        arrays |= {f"{name}_{part}": array for part, array in lists.items()}
    for name, table in model.tables.items():
        for part in ("rows", "default", "order", "acting", "slot_of", "free", "alive", "counters"):
            arrays[f"{name}_{part}"] = getattr(table, part)
        arrays[f"{name}_names"] = model.names[name]
        arrays |= {f"{name}_{part}": array for part, array in table.link_arrays().items()}
        if table.minds is not None:
            arrays[f"{name}_hierarchy"] = table.minds.record.record
        if table.society is not None:
            for part, array in table.scratch(model.program).items():
                arrays[f"{name}_{part}"] = array
            for part, array in zip(SchemeArrays._fields, table.society.arrays, strict=True):
                arrays[f"{name}_scheme_{part}"] = array
            for part, array in zip(MindArrays._fields, table.society.minds, strict=True):
                arrays[f"{name}_minds_{part}"] = array
    return arrays


def names_of_minds(
    program: Program,
    population: str,
    scheme: CognitiveScheme | None,
    assembly: Assembly | None = None,
    file: Path | None = None,
    names: Names | None = None,
) -> list[int]:
    """Return where in a scheme and a hierarchy the names stand that a population's rules write.

    Args:
        program: the model's.
        population: whose.
        scheme: that of its minds.
        assembly: its hierarchy of skills.
        file: where the scheme was read from, for errors.
        names: where its parts stand, in a culture; by default where they stand in it alone.

    Raises:
        ModelError: a rule names what the minds do not have, or a plan has no function.
    """
    tables: dict[str, dict[Any, int]] = {}
    owners: dict[str, str] = {}
    if scheme is not None:
        _check_plans(program, population, scheme, file)
        tables |= _parts_of_scheme(names or Names(scheme))
        place = "" if file is None else f" ({file})"
        owners |= dict.fromkeys(tables, f"the scheme {scheme.name!r}{place}")
    if assembly is not None:
        from socialmind.mind.code.drive import tables_of

        parts = tables_of(assembly)
        tables |= parts
        owners |= dict.fromkeys(parts, f"the mind {assembly.description.name!r}")
    return program.placed(population, tables, owners)


def _parts_of_scheme(names: Names) -> dict[str, dict[Any, int]]:
    """Return the places of a scheme's parts by part and name."""
    return {
        "plan": dict(names.plans),
        "cogniton": dict(names.cognitons),
        "group": dict(names.groups),
        **{
            part: {(group, name): k for group, places in of.items() for name, k in places.items()}
            for part, of in (
                ("role", names.roles),
                ("culturon", names.culturons),
                ("attribute", names.attributes),
            )
        },
    }


def _check_plans(
    program: Program, population: str, scheme: CognitiveScheme, file: Path | None
) -> None:
    """Refuse a plan of a scheme that has no function."""
    if population in program.plans:
        known = program.plans[population].names
        for plan in scheme.plans:
            if plan not in known:
                raise ModelError(
                    f"the plan {plan!r} of the scheme {scheme.name!r}, which has no function",
                    "a function for each plan",
                    f"the population {population!r} has {', '.join(known)}",
                    file,
                )


def plan_functions(program: Program, population: str, scheme: CognitiveScheme) -> Any:
    """Return the number of each plan's function, in the scheme's order."""
    plans = program.plans.get(population)
    known = {plan: place for place, plan in enumerate(() if plans is None else plans.names)}
    return np.array([known.get(plan, -1) for plan in scheme.plans], np.int64)
