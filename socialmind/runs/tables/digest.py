"""A hash of what a table holds, apart from how its file is laid out."""

from __future__ import annotations

import hashlib
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from socialmind.runs.tables.columns import from_arrow

if TYPE_CHECKING:
    import pyarrow as pa


@dataclass(frozen=True)
class TableContent:
    """What a table holds, apart from how its file is laid out.

    Args:
        rows: number of rows.
        columns: name and type of every column, in order.
        sha256: hash of names, types and values; two tables with equal values have equal hashes,
            whatever the compression, the row groups or the version of the writer.
    """

    rows: int
    columns: dict[str, str]
    sha256: str


class ContentDigest:
    """A running hash of a table's content.

    Every column has a hash of its own over its values and one over which are missing, so the
    result does not depend on how the rows are cut into pieces. NaN has one bit pattern here: which
    of them an operation yields is the processor's choice.

    Args:
        schema: names and types of the columns.
    """

    def __init__(self, schema: pa.Schema) -> None:
        self.rows = 0
        self._schema = schema
        self._hashes = [[hashlib.sha256() for _ in range(3)] for _ in schema]

    def update(self, rows: pa.Table) -> None:
        """Add rows at the end."""
        self.rows += rows.num_rows
        for hashes, column in zip(self._hashes, rows.columns, strict=True):
            for array in column.chunks:
                for running, part in zip(hashes, _column_bytes(array), strict=True):
                    running.update(part)

    def content(self) -> TableContent:
        """The result so far."""
        total = hashlib.sha256()
        columns = {field.name: str(field.type) for field in self._schema}
        for (name, kind), hashes in zip(columns.items(), self._hashes, strict=True):
            total.update("\0".join([name, kind, *(h.hexdigest() for h in hashes), ""]).encode())
        return TableContent(self.rows, columns, total.hexdigest())


def _column_bytes(array: pa.Array) -> tuple[bytes, bytes, bytes]:
    """Which values are missing, the values' own bytes, and those of texts."""
    found = from_arrow(array)
    values = found.values
    if values.dtype.kind == "f":
        values = np.where(np.isnan(values), np.nan, values)
    return found.missing.tobytes(), values.tobytes(), found.text
