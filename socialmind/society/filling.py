"""Filling fields of agents from outside: columns are checked, then written as a whole."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from coglogo_py.border.errors import shown
from coglogo_py.border.numbers import is_whole
from socialmind.agents import bookkeeping
from socialmind.columns import check_fields
from socialmind.errors import ValueRefusedError
from socialmind.fields import presence
from socialmind.values import fitted_column

if TYPE_CHECKING:
    from socialmind.society.founding.beginning import Beginning

Keeper = Callable[[float, str], float]
"""Gives a place or a heading as agents keep it; takes it and, for an error, whose it is."""


def fill(
    table: Any,
    fields: Mapping[str, Any],
    slots: NDArray[np.int64],
    keepers: Mapping[str, Keeper],
    of: Beginning | None = None,
) -> None:
    """Write fields of the agents in some slots, once all of them are checked.

    Args:
        table: the population's.
        fields: by name, one value for all or a value for each.
        slots: of the agents.
        keepers: by field, what brings values into the range that agents keep them in.
        of: the table that the values come from, which an error names with the row.

    Raises:
        UnknownNameError: there is no such field.
        ValueRefusedError: too many or few values, or one that the field cannot hold.
    """
    population = repr(table.shape.name)
    check_fields(fields, table.shape.fields, population)
    checked = {}
    identities = table.columns["_id"][slots]
    for name, values in fields.items():
        found, there = fitted_column(
            table.shape.fields[name],
            values,
            len(slots),
            f"the field {name!r} of {population}" if of is None else f"{of.what}, column {name!r}",
            (lambda place: f"agent {identities[place]} (row {place})") if of is None else of.row,
        )
        if name in keepers:
            found = kept_within(found, keepers[name], population, of)
        checked[name] = found, there
    for name, (found, there) in checked.items():
        table.columns[name][slots] = found
        if table.shape.fields[name].optional:
            table.columns[presence(name)][slots] = there


def kept_within(
    values: NDArray[Any], keep: Keeper, population: str, of: Beginning | None = None
) -> NDArray[Any]:
    """Return places or headings as agents keep them, one by one as rules set them."""
    kept = [
        keep(one, f"{population} (row {row})" if of is None else f"{of.what}, {of.row(row)}")
        for row, one in enumerate(values.tolist())
    ]
    return np.array(kept, float)


def slots_of(table: Any, identities: Any, what: str, by: str) -> NDArray[np.int64]:
    """Return the slots of living agents, each named once.

    Args:
        table: the population's.
        identities: of the agents, a row each.
        what: what the rows are of, for errors.
        by: the column that holds the identities.

    Raises:
        ValueRefusedError: a row is for no living agent, or two are for one.
    """
    given = np.asarray(identities)
    slots = np.zeros(len(given), np.int64)
    seen: dict[int, int] = {}
    for row, identity in enumerate(given.tolist()):
        whole = is_whole(identity) or (isinstance(identity, float) and identity.is_integer())
        if not whole or not table.contains(int(identity)):
            living = table.id
            ends = f", {living[0]} … {living[-1]}" if len(living) else "; none lives"
            raise ValueRefusedError(
                f"{what}, row {row}: found {shown(identity)} as {by}; expected the identity of "
                f"a living agent{ends}"
            )
        if int(identity) in seen:
            raise ValueRefusedError(
                f"{what}, row {row}: agent {int(identity)} again, as in row "
                f"{seen[int(identity)]}; expected one row for each"
            )
        seen[int(identity)] = row
        slots[row] = bookkeeping.slot_of_agent(table.slot_of, int(identity))
    return slots
