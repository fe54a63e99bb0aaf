"""Pieces of a table, whose columns and types may differ: as one, and sorted by run."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from socialmind.errors import SocialmindError
from socialmind.experiments.sweeps.columns import RUN
from socialmind.runs.tables.column_types import common_type
from socialmind.runs.tables.columns import from_arrow, to_arrow

if TYPE_CHECKING:
    import pyarrow as pa


def united(schemas: Sequence[pa.Schema], first: Sequence[str]) -> pa.Schema:
    """Return the columns of all, with the types that hold the values of all."""
    import pyarrow as pa

    types: dict[str, pa.DataType] = {}
    for schema in schemas:
        for one in schema:
            types[one.name] = _wider(types.get(one.name, one.type), one.type)
    names = [name for name in first if name in types]
    names += sorted(name for name in types if name not in names)
    return pa.schema([(name, types[name]) for name in names])


def _wider(a: pa.DataType, b: pa.DataType) -> pa.DataType:
    """Return the type that holds the values of two; text where no other does."""
    import pyarrow as pa

    try:
        return common_type(a, b, "", "")
    except SocialmindError:
        return pa.string()


def cast(rows: pa.Table, schema: pa.Schema) -> pa.Table:
    """Return rows in the columns of a schema; of a column that they lack, nothing."""
    import pyarrow as pa

    columns = []
    for one in schema:
        if one.name in rows.column_names:
            columns.append(rows[one.name].cast(one.type, safe=False))
        else:
            columns.append(pa.nulls(rows.num_rows, one.type))
    return pa.Table.from_arrays(columns, schema=schema)


def together(pieces: Sequence[pa.Table], first: Sequence[str] = ()) -> pa.Table:
    """Return the rows of several tables as one, with the columns of all, some of them first."""
    import pyarrow as pa

    names = dict.fromkeys([*first, *(n for one in pieces for n in one.column_names)])
    schema = united([one.schema for one in pieces], list(names))
    return pa.concat_tables([cast(one, schema) for one in pieces])


def runs_in(rows: pa.Table) -> NDArray[np.int64]:
    """Return the column `run` of a table."""
    found = [from_arrow(chunk).values for chunk in rows[RUN].chunks]
    return np.concatenate([np.zeros(0, np.int64), *found])


def sorted_by_run(rows: pa.Table) -> pa.Table:
    """Return rows by run; those of one run stay in order."""
    found = runs_in(rows)
    if (np.diff(found) >= 0).all():
        return rows.combine_chunks()
    return rows.take(to_arrow(np.argsort(found, kind="stable"))).combine_chunks()
