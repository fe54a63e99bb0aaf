"""The tables of a run: rows kept in Parquet parts while it goes on, then merged into one file.

A part is one closed Parquet file; which parts count is the checkpoint's word, so a killed run
never trusts a half-written one. Column types are few and stable: ``int64``, ``double``, ``bool``,
``string``, and ``null`` for a column in which nothing but None was ever seen. The merged file has
row groups of a fixed length, so it does not depend on where the parts were cut.

pyarrow is imported by the functions that write or read: a run reaches its first tick without it.
"""

from __future__ import annotations

import hashlib
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from socialmind.errors import SocialmindError
from socialmind.experiments.columns import EXPECTED, from_arrow, to_arrow

if TYPE_CHECKING:
    import pyarrow as pa

SERIES = "series"
AGENTS = "agents"
TABLES = (SERIES, AGENTS)

ROW_GROUP = 1 << 15
"""Rows in a row group of a merged table."""

WAITING_ROWS = 1 << 15
"""Rows that may wait in memory for the next checkpoint; more go to a part at once."""

Columns = Mapping[str, Sequence[Any] | np.ndarray]


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


class GrowingTable:
    """One table of a run while the run goes on.

    Args:
        name: `SERIES` or `AGENTS`; begins the names of its parts.
        folder: where the parts go; made when the first is written.
        parts: names of the parts that already count, for a run that goes on.
    """

    def __init__(self, name: str, folder: Path, parts: Iterable[str] = ()) -> None:
        self.name = name
        self.parts = list(parts)
        self._folder = folder
        self._waiting: list[Columns] = []
        self._rows = 0
        self._names: tuple[str, ...] | None = None
        self._types: dict[str, pa.DataType] = {}

    def add(self, tick: int, columns: Columns) -> None:
        """Add the rows recorded at one tick; the values are copied.

        Args:
            tick: goes into the first column, ``tick``.
            columns: one sequence a column, all of one length; None is a missing value.

        Raises:
            SocialmindError: columns of unequal length, or other columns than before.
        """
        rows: dict[str, Sequence[Any] | np.ndarray] = {}
        lengths = {name: len(values) for name, values in columns.items() if name != "tick"}
        length = next(iter(lengths.values()), 0)
        for name, found in lengths.items():
            if found != length:
                raise SocialmindError(
                    f"{self.name} at tick {tick}: column {name} has {found} values, "
                    f"{next(iter(lengths))} has {length}; give every column one value a row"
                )
        rows["tick"] = np.full(length, tick, dtype=np.int64)
        for name in lengths:
            values = columns[name]
            rows[name] = values.copy() if isinstance(values, np.ndarray) else list(values)
        names = tuple(rows)
        if self._names is None:
            self._names = names
        elif names != self._names:
            raise SocialmindError(
                f"{self.name} at tick {tick}: columns {', '.join(names)}; expected the columns of "
                f"the ticks before, {', '.join(self._names)}; give the same columns at every tick"
            )
        self._waiting.append(rows)
        self._rows += length
        if self._rows >= WAITING_ROWS:
            self.flush()

    def flush(self) -> None:
        """Write the waiting rows as a part."""
        if not self._waiting:
            return
        import pyarrow.parquet as pq

        table = _arrow_table(self._waiting, self.name)
        for field in table.schema:
            before = self._types.get(field.name, field.type)
            self._types[field.name] = _common_type(before, field.type, self.name, field.name)
        self._folder.mkdir(exist_ok=True)
        part = f"{self.name}-{len(self.parts):06d}.parquet"
        pq.write_table(table, self._folder / part, row_group_size=ROW_GROUP, compression="zstd")
        self.parts.append(part)
        self._waiting = []
        self._rows = 0


def merge(
    parts: Sequence[Path], target: Path, name: str, drop_tick: int | None = None
) -> TableContent:
    """Write the rows of some Parquet files, in order, into one; appears whole or not at all.

    Args:
        parts: the files, at least one.
        target: the file to write.
        name: of the table, for errors.
        drop_tick: leave out the rows of this tick.

    Returns:
        What the new file holds.
    """
    import pyarrow as pa
    import pyarrow.parquet as pq

    schema = _common_schema([pq.read_schema(part) for part in parts], name)
    digest = ContentDigest(schema)
    unfinished = target.with_name(target.name + ".partial")
    with pq.ParquetWriter(unfinished, schema, compression="zstd") as writer:
        for rows in pieces(parts, schema, drop_tick):
            digest.update(rows)
            writer.write_table(rows, row_group_size=ROW_GROUP)
        if digest.rows == 0:
            writer.write_table(pa.Table.from_batches([], schema))
    unfinished.replace(target)
    return digest.content()


def content_of(path: Path) -> TableContent:
    """What a Parquet file holds, written by `merge` or by another program since.

    Raises:
        SocialmindError: the file is missing, not a Parquet file, or has columns of other types.
    """
    import pyarrow as pa
    import pyarrow.parquet as pq

    try:
        found = pq.read_schema(path)
        schema = pa.schema([(f.name, _standard_type(f.type, path.name, f.name)) for f in found])
        digest = ContentDigest(schema)
        for rows in pieces([path], schema):
            digest.update(rows)
    except (OSError, pa.ArrowException) as error:
        raise SocialmindError(f"{path}: cannot be read as a table ({error})") from error
    return digest.content()


def read(paths: Sequence[Path], name: str) -> pa.Table:
    """The rows of some Parquet files, in order, as one table with common column types."""
    import pyarrow as pa
    import pyarrow.parquet as pq

    try:
        schema = _common_schema([pq.read_schema(path) for path in paths], name)
        return pa.Table.from_batches(
            (b for t in _batches(paths, schema, None) for b in t.to_batches()), schema
        )
    except (OSError, pa.ArrowException) as error:
        raise SocialmindError(f"{name}: cannot be read as a table ({error})") from error


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


def _arrow_table(records: Sequence[Columns], name: str) -> pa.Table:
    """The rows of several ticks as one Arrow table."""
    import pyarrow as pa

    columns, fields = [], []
    for column in records[0]:
        try:
            pieces = [to_arrow(one) for one in _joined([record[column] for record in records])]
        except SocialmindError as error:
            raise SocialmindError(f"{name}: column {column}: {error}") from error
        kind = pieces[0].type
        for piece in pieces[1:]:
            kind = _common_type(kind, piece.type, name, column)
        columns.append(pa.chunked_array([p.cast(kind, safe=False) for p in pieces], kind))
        fields.append((column, kind))
    return pa.Table.from_arrays(columns, schema=pa.schema(fields))


def _joined(pieces: list[Sequence[Any] | np.ndarray]) -> list[Sequence[Any] | np.ndarray]:
    """The same values in fewer pieces, where they are of one sort."""
    if all(type(one) is list for one in pieces):
        return [[value for one in pieces for value in one]]
    arrays = [np.asarray(one) for one in pieces if isinstance(one, np.ndarray)]
    if 1 < len(arrays) == len(pieces) and len({one.dtype for one in arrays}) == 1:
        return [np.concatenate(arrays)]
    return pieces


def _standard_type(kind: pa.DataType, name: str, column: str) -> pa.DataType:
    """The one of the five types that holds the values of another."""
    import pyarrow as pa

    if pa.types.is_integer(kind):
        return pa.int64()
    if pa.types.is_floating(kind):
        return pa.float64()
    if pa.types.is_string(kind) or pa.types.is_large_string(kind) or pa.types.is_dictionary(kind):
        return pa.string()
    if pa.types.is_boolean(kind) or pa.types.is_null(kind):
        return kind
    raise SocialmindError(f"{name}: column {column}: values of type {kind}; expected {EXPECTED}")


def _common_type(a: pa.DataType, b: pa.DataType, name: str, column: str) -> pa.DataType:
    """The type that holds the values of both."""
    import pyarrow as pa

    if a == b or pa.types.is_null(b):
        return a
    if pa.types.is_null(a):
        return b
    if {a, b} == {pa.int64(), pa.float64()}:
        return pa.float64()
    raise SocialmindError(
        f"{name}: column {column} holds {a} at one tick and {b} at another; give one kind of value"
    )


def _common_schema(schemas: Sequence[pa.Schema], name: str) -> pa.Schema:
    """The column types that hold the values of every part."""
    import pyarrow as pa

    types = {field.name: field.type for field in schemas[0]}
    for schema in schemas[1:]:
        if schema.names != list(types):
            raise SocialmindError(
                f"{name}: columns {', '.join(schema.names)} in one part, {', '.join(types)} before"
            )
        for field in schema:
            types[field.name] = _common_type(types[field.name], field.type, name, field.name)
    return pa.schema(list(types.items()))


def pieces(
    paths: Sequence[Path], schema: pa.Schema, drop_tick: int | None = None
) -> Iterator[pa.Table]:
    """The rows of some Parquet files, in order, in pieces of `ROW_GROUP`, the last one shorter.

    Args:
        paths: the files.
        schema: the column types to give; those of the files must convert to them.
        drop_tick: leave out the rows of this tick.
    """
    import pyarrow as pa

    waiting = pa.Table.from_batches([], schema)
    for rows in _batches(paths, schema, drop_tick):
        waiting = pa.concat_tables([waiting, rows])
        while waiting.num_rows >= ROW_GROUP:
            yield waiting.slice(0, ROW_GROUP).combine_chunks()
            waiting = waiting.slice(ROW_GROUP)
    if waiting.num_rows:
        yield waiting.combine_chunks()


def _batches(paths: Sequence[Path], schema: pa.Schema, drop_tick: int | None) -> Iterator[pa.Table]:
    """The rows of some Parquet files, as they lie, in the types of `schema`."""
    import pyarrow as pa
    import pyarrow.parquet as pq

    for path in paths:
        with pq.ParquetFile(path) as file:
            for batch in file.iter_batches(ROW_GROUP, use_threads=False):
                rows = pa.Table.from_batches([batch]).cast(schema, safe=False)
                if drop_tick is not None:
                    ticks = [from_arrow(chunk).values for chunk in rows["tick"].chunks]
                    rows = rows.filter(to_arrow(np.concatenate(ticks) != drop_tick))
                yield rows
