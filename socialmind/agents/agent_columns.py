"""What a run records of the agents unless the model says otherwise: one table, whoever they are.

Where several populations are recorded they stand one after another, and a column `population` says
which; what one of them does not have is None. Runs made before this column hold the first
population alone; `as_before` gives what they would have recorded.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from socialmind.agents.group_columns import PARTS, memberships

if TYPE_CHECKING:
    from socialmind.agents.running import Running

POPULATION = "population"
"""The column that says which population an agent is of."""
OWN = ("tick", POPULATION, "agent", "plan")
"""The table's own columns, in their order; a field of such a name goes by its population's too."""


def default_series(model: Any, stops: bool) -> dict[str, Any]:
    """Return the size of each population, what the world records, and the variables.

    Args:
        model: a running model.
        stops: whether to say what ended it.
    """
    sizes: dict[str, Any] = {name: len(table) for name, table in model.tables.items()}
    plain = {n: getattr(model, n) for n, one in model.variables.items() if one.size is None}
    return sizes | model.ground.series() | plain | ({"over": model.over} if stops else {})


def agent_columns(model: Running) -> dict[str, Any]:
    """Return identity, plan and fields of the agents of all populations at a tick.

    Args:
        model: a running model with at least one population.

    Returns:
        A sequence for each column, over the living.
    """
    kinds: dict[str, set[type]] = {}
    for table in model.tables.values():
        for field in table.shape.fields.values():
            kinds.setdefault(field.name, set()).add(field.kind)
    parts: dict[str, dict[str, Any]] = {}
    for name, table in model.tables.items():
        part: dict[str, Any] = {"agent": table.id}
        if table.shape.minded:
            part["plan"] = model.plans(table)
            part |= memberships(table, kinds)
        if table.shape.steps is not None:
            part["plan_step"] = table.plan_steps(table.slots)
        for field in table.shape.fields.values():
            if field.size is None and field.name != "heading":
                alone = len(model.tables) == 1 or field.name not in OWN
                column = field.name if alone else f"{name}.{field.name}"
                values = getattr(table, field.name)
                if field.kind is bool and kinds[field.name] != {bool}:
                    # Beside numbers of another population: 0 and 1.
                    values = [None if one is None else int(one) for one in values]
                part[column] = values
        parts[name] = part
    return one_table(parts)


def one_table(parts: Mapping[str, Mapping[str, Any]]) -> dict[str, Any]:
    """Return the columns of several populations as one table; those of a single one as they are.

    Args:
        parts: for each population its columns, ``agent`` among them.

    >>> one_table({"cows": {"agent": [0], "milk": [2.5]}, "dogs": {"agent": [0, 1]}})["milk"]
    [2.5, None, None]
    """
    if len(parts) == 1:
        return dict(next(iter(parts.values())))
    names = {column for part in parts.values() for column in part}
    own = [column for column in OWN[2:] if column in names]
    columns = dict.fromkeys([*own, *(column for part in parts.values() for column in part)])
    sizes = {name: len(part["agent"]) for name, part in parts.items()}
    table: dict[str, Any] = {POPULATION: [n for n, size in sizes.items() for _ in range(size)]}
    for column in columns:
        values: list[Any] = []
        for name, part in parts.items():
            found = part.get(column)
            values += [None] * sizes[name] if found is None else _listed(found)
        table[column] = values
    return table


def as_before(columns: Mapping[str, Any], known: Sequence[str], first: str | None) -> Any:
    """Return the columns of a tick as a run began to record them.

    Args:
        columns: what is recorded today.
        known: the columns that the run has, without the tick.
        first: the model's first population.

    Returns:
        The known columns, where today's hold them: of the first population alone, where the run
        does not say which population an agent is of.
    """
    # Runs made before memberships were recorded go on without them.
    unknown = {name for name in columns if name not in known and name.startswith(PARTS)}
    if unknown:
        columns = {name: one for name, one in columns.items() if name not in unknown}
    today = [name for name in columns if name != "tick"]
    if today == list(known) or not set(known) <= set(today):
        return columns
    if set(known) == set(today):
        return {name: columns[name] for name in known}
    if POPULATION in known or POPULATION not in columns:
        return columns
    rows = [place for place, name in enumerate(columns[POPULATION]) if name == first]
    return {name: [columns[name][row] for row in rows] for name in known}


def _listed(values: Any) -> list[Any]:
    listed: list[Any] = np.asarray(values, object).tolist()
    return listed
