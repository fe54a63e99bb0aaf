"""The tables of a run: rows kept in Parquet parts while it goes on, then merged into one file.

A part is one closed Parquet file; which parts count is the checkpoint's word, so a killed run
never trusts a half-written one. Column types are few and stable: ``int64``, ``double``, ``bool``,
``string``, and ``null`` for a column in which nothing but None was ever seen. The merged file has
row groups of a fixed length, so it does not depend on where the parts were cut.

pyarrow is imported by the functions that write or read: a run reaches its first tick without it.
"""

from __future__ import annotations

import hashlib
import os
from collections.abc import Iterable, Iterator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from socialmind.agents.agent_columns import POPULATION
from socialmind.errors import SocialmindError
from socialmind.runs.record import within
from socialmind.runs.tables.column_types import common_schema, standard_type
from socialmind.runs.tables.columns import from_arrow, to_arrow
from socialmind.runs.tables.digest import ContentDigest, TableContent
from socialmind.work.files import make_room

if TYPE_CHECKING:
    import pyarrow as pa

FIRST = "columns of the first row"
"""What a merged file says of itself if other columns came later."""
ROW_GROUP = 1 << 15
"""Rows in a row group of a merged table."""


def part_name(name: str, number: int) -> str:
    """The name of a table's part, by its number from 0."""
    return f"{name}-{number:06d}.parquet"


def seal(path: Path) -> list[Any]:
    """Bring a file safely to the disk; gives its size in bytes and its SHA-256."""
    with path.open("rb") as file:
        os.fsync(file.fileno())
        return [path.stat().st_size, hashlib.file_digest(file, "sha256").hexdigest()]


def check_part(path: Path, sealed: Sequence[Any] | None) -> None:
    """Raise unless a part is the file that the run wrote.

    Args:
        path: the part.
        sealed: what `seal` gave; None where that is not known, and it must be readable.

    Raises:
        SocialmindError: it is missing, cut off, changed, a folder or a link elsewhere.
    """
    within(path.parent, path.name)
    remedy = "take it from a copy of the folder"
    if not path.is_file():
        found = "is no file" if path.exists() else "is missing"
        raise SocialmindError(f"{path}: this part of the run {found}; {remedy}")
    if sealed is None:
        content_of(path)
    elif [path.stat().st_size] != list(sealed[:1]) or seal(path) != list(sealed):
        raise SocialmindError(f"{path}: this part of the run is cut off or was changed; {remedy}")


def merge(
    parts: Sequence[Path],
    target: Path,
    name: str,
    drop_tick: int | None = None,
    last_tick: int | None = None,
    changing: bool = False,
) -> TableContent:
    """Write the rows of some Parquet files, in order, into one; appears whole or not at all.

    Args:
        parts: the files, at least one.
        target: the file to write.
        name: of the table, for errors.
        drop_tick: leave out the rows of this tick.
        last_tick: leave out the rows of later ticks; a column without a value up to then is null.
        changing: whether columns that came with the rows left out go with them.

    Returns:
        What the new file holds.
    """
    import pyarrow as pa
    import pyarrow.parquet as pq

    schema = common_schema([pq.read_schema(part) for part in parts], name)
    if last_tick is not None:
        schema = _with_nulls(schema, pieces(parts, schema, last_tick=last_tick))
    first = _first_columns(parts)
    if changing:
        there = _with_values(schema, pieces(parts, schema, drop_tick))
        there |= set(schema.names[:first]) if there else {"tick"}
        schema = pa.schema([one for one in schema if one.name in there])
    digest = ContentDigest(schema)
    noted = schema if first >= len(schema) else schema.with_metadata({FIRST: str(first)})
    unfinished = make_room(target.with_name(target.name + ".partial"))
    with pq.ParquetWriter(unfinished, noted, compression="zstd") as writer:
        for rows in pieces(parts, schema, drop_tick, last_tick=last_tick):
            digest.update(rows)
            writer.write_table(rows, row_group_size=ROW_GROUP)
        if digest.rows == 0:
            writer.write_table(pa.Table.from_batches([], schema))
    unfinished.replace(target)
    return digest.content()


def _first_columns(parts: Sequence[Path]) -> int:
    """Return how many columns the first row has; those behind came later, if there are more."""
    import pyarrow.parquet as pq

    for part in parts:
        if pq.read_metadata(part).num_rows:
            schema = pq.read_schema(part)
            return int((schema.metadata or {}).get(FIRST.encode(), len(schema)))
    return len(pq.read_schema(parts[0]))


def _with_nulls(schema: pa.Schema, rows: Iterable[pa.Table]) -> pa.Schema:
    """Return a schema in which columns that hold no value in some rows are null."""
    import pyarrow as pa

    there = _with_values(schema, rows)
    kinds = [(f.name, f.type if f.name in there or not there else pa.null()) for f in schema]
    return pa.schema(kinds)


def _with_values(schema: pa.Schema, rows: Iterable[pa.Table]) -> set[str]:
    """Return the columns that hold a value in some row."""
    there: set[str] = set()
    for piece in rows:
        there |= {one for one in schema.names if piece[one].null_count < piece.num_rows}
    return there


def content_of(path: Path) -> TableContent:
    """What a Parquet file holds, written by `merge` or by another program since.

    Raises:
        SocialmindError: the file is missing, not a Parquet file, or has columns of other types.
    """
    import pyarrow as pa
    import pyarrow.parquet as pq

    try:
        found = pq.read_schema(path)
        schema = pa.schema([(f.name, standard_type(f.type, path.name, f.name)) for f in found])
        digest = ContentDigest(schema)
        for rows in pieces([path], schema):
            digest.update(rows)
    except (OSError, pa.ArrowException, UnicodeDecodeError) as error:
        raise _unreadable(path) from error
    return digest.content()


def check_content(path: Path, sha256: str) -> None:
    """Raise unless a table's content is the one that a run wrote.

    Raises:
        SocialmindError: it cannot be read, or was changed.
    """
    if content_of(path).sha256 != sha256:
        raise SocialmindError(
            f"{path}: is not the table that the run wrote; take it from a copy of the folder"
        )


def read(paths: Sequence[Path], name: str) -> pa.Table:
    """The rows of some Parquet files, in order, as one table with common column types."""
    import pyarrow as pa
    import pyarrow.parquet as pq

    try:
        schema = common_schema([pq.read_schema(path) for path in paths], name)
        return pa.Table.from_batches(
            (b for t in _batches(paths, schema) for b in t.to_batches()), schema
        )
    except (OSError, pa.ArrowException, UnicodeDecodeError) as error:
        raise _unreadable(paths[0] if len(paths) == 1 else Path(name)) from error


def _unreadable(path: Path) -> SocialmindError:
    # Arrow's own words, of messages and protocols, are not about what the user can do.
    found = "cannot be read as a table; it is missing, cut off or was changed"
    return SocialmindError(f"{path}: {found}; take it from a copy of the folder")


def pieces(
    paths: Sequence[Path],
    schema: pa.Schema,
    drop_tick: int | None = None,
    population: str | None = None,
    last_tick: int | None = None,
) -> Iterator[pa.Table]:
    """The rows of some Parquet files, in order, in pieces of `ROW_GROUP`, the last one shorter.

    Args:
        paths: the files.
        schema: the columns to give, and their types; those of the files must convert to them.
        drop_tick: leave out the rows of this tick.
        population: give the rows of this population alone, by the files' column of that name.
        last_tick: leave out the rows of later ticks.
    """
    import pyarrow as pa

    waiting = pa.Table.from_batches([], schema)
    for rows in _batches(paths, schema, drop_tick, population, last_tick):
        waiting = pa.concat_tables([waiting, rows])
        while waiting.num_rows >= ROW_GROUP:
            yield waiting.slice(0, ROW_GROUP).combine_chunks()
            waiting = waiting.slice(ROW_GROUP)
    if waiting.num_rows:
        yield waiting.combine_chunks()


def _batches(
    paths: Sequence[Path],
    schema: pa.Schema,
    drop_tick: int | None = None,
    population: str | None = None,
    last_tick: int | None = None,
) -> Iterator[pa.Table]:
    """The rows of some Parquet files, as they lie, in the types of `schema`."""
    import pyarrow as pa
    import pyarrow.parquet as pq

    for path in paths:
        with pq.ParquetFile(path) as file:
            for batch in file.iter_batches(ROW_GROUP, use_threads=False):
                rows = pa.Table.from_batches([batch])
                if population is not None:
                    of_it = [one == population for one in rows[POPULATION].to_pylist()]
                    rows = rows.filter(to_arrow(np.array(of_it, bool)))
                if drop_tick is not None:
                    rows = rows.filter(to_arrow(_ticks_of(rows) != drop_tick))
                if last_tick is not None:
                    rows = rows.filter(to_arrow(_ticks_of(rows) <= last_tick))
                yield _as(rows, schema)


def _as(rows: pa.Table, schema: pa.Schema) -> pa.Table:
    """Return the columns of a schema, in its types; what is not there, or null, holds no value."""
    import pyarrow as pa

    there = {f.name for f in schema if f.name in rows.schema.names and not pa.types.is_null(f.type)}
    columns = [
        rows[f.name].cast(f.type, safe=False)
        if f.name in there
        else pa.nulls(rows.num_rows, f.type)
        for f in schema
    ]
    return pa.Table.from_arrays(columns, schema=schema)


def _ticks_of(rows: pa.Table) -> np.ndarray:
    import pyarrow as pa

    ticks = rows["tick"].cast(pa.int64())
    chunks = [from_arrow(chunk).values for chunk in ticks.chunks]
    return np.concatenate([np.zeros(0, np.int64), *chunks])
