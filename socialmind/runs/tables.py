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
from collections.abc import Iterable, Iterator, Mapping, Sequence, Set
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from coglogo_py.border.errors import shown
from socialmind.agents.agent_columns import POPULATION
from socialmind.agents.events import columns_of_events
from socialmind.errors import SocialmindError
from socialmind.runs.columns import EXPECTED, from_arrow, to_arrow
from socialmind.runs.digest import ContentDigest, TableContent
from socialmind.runs.record import within
from socialmind.work.files import make_room

if TYPE_CHECKING:
    import pyarrow as pa

SERIES = "series"
AGENTS = "agents"
GROUPS = "groups"
TABLES = (SERIES, AGENTS)
"""The tables that every run has."""
LINKS = "links"
EVENTS = "events"
FURTHER = (GROUPS, LINKS, EVENTS)
"""Those that a run has from its beginning, or never: of models whose minds can form groups, of
those whose links are to be recorded, and of those in whose ticks agents are born or die."""

ROW_GROUP = 1 << 15
"""Rows in a row group of a merged table."""

WAITING_ROWS = 1 << 15
"""Rows that may wait in memory for the next checkpoint; more go to a part at once."""

Columns = Mapping[str, Sequence[Any] | np.ndarray]


class GrowingTable:
    """One table of a run while the run goes on.

    Args:
        name: `SERIES`, `AGENTS` or `GROUPS`; begins the names of its parts.
        folder: where the parts go; made when the first is written.
        parts: names of the parts that already count, for a run that goes on.
        source: what gives the rows, for errors.
        sums: what `seal` gave for these parts, where it is known.
    """

    def __init__(
        self,
        name: str,
        folder: Path,
        parts: Iterable[str] = (),
        source: str = "",
        sums: Mapping[str, list[Any]] | None = None,
    ) -> None:
        self.name = name
        self.parts = list(parts)
        self.sums = {part: one for part, one in (sums or {}).items() if part in self.parts}
        self.source = source or name
        self._folder = folder
        self._waiting: list[Columns] = []
        self._rows = 0
        self.columns: tuple[str, ...] | None = None
        self._types: dict[str, pa.DataType] = {}
        if self.parts:
            import pyarrow.parquet as pq

            schema = pq.read_schema(folder / self.parts[0])
            self.columns = tuple(name for name in schema.names if name != "tick")

    def add(self, tick: int, columns: Columns) -> None:
        """Add the rows recorded at one tick; the values are copied.

        Args:
            tick: goes into the first column, ``tick``.
            columns: one sequence a column, all of one length; None is a missing value.

        Raises:
            SocialmindError: columns of unequal length, or other columns than before.
        """
        where = f"{self.source} at tick {tick}"
        rows: dict[str, Sequence[Any] | np.ndarray] = {}
        for name, values in _items(columns, where):
            if name == "tick":
                _refuse_unless_tick(values, tick, where)
            elif name in rows:
                raise SocialmindError(f"{where}: two columns {name!r}; give each a name")
            else:
                rows[name] = values.copy() if isinstance(values, np.ndarray) else list(values)
        names = tuple(rows)
        length = len(rows[names[0]]) if names else 0
        for name, values in rows.items():
            if len(values) != length:
                raise SocialmindError(
                    f"{where}: column {name} has {len(values)} values, {names[0]} has {length}; "
                    "give every column one value a row"
                )
        if self.columns is None:
            self.columns = names
        elif names != self.columns:
            raise SocialmindError(
                f"{where}: columns {', '.join(names) or 'none'}; expected those of the ticks "
                f"before, {', '.join(self.columns) or 'none'}; give the same columns at every tick"
            )
        self._waiting.append({"tick": np.full(length, tick, dtype=np.int64), **rows})
        self._rows += length
        if self._rows >= WAITING_ROWS:
            self.flush()

    def flush(self) -> None:
        """Write the waiting rows as a part."""
        if not self._waiting:
            return
        import pyarrow.parquet as pq

        table = _arrow_table(self._waiting, self.source)
        for field in table.schema:
            before = self._types.get(field.name, field.type)
            self._types[field.name] = _common_type(before, field.type, self.source, field.name)
        self._folder.mkdir(exist_ok=True)
        part = part_name(self.name, len(self.parts))
        path = make_room(self._folder / part)
        pq.write_table(table, path, row_group_size=ROW_GROUP, compression="zstd")
        self.sums[part] = seal(path)
        self.parts.append(part)
        self._waiting = []
        self._rows = 0


class EventTable(GrowingTable):
    """The births and deaths of a run while the run goes on.

    Args:
        populations: their names, by their numbers in the rows.
        folder, parts, sums: as of a table of other rows.
    """

    def __init__(
        self,
        populations: tuple[str, ...],
        folder: Path,
        parts: Iterable[str] = (),
        sums: Mapping[str, list[Any]] | None = None,
    ) -> None:
        super().__init__(EVENTS, folder, parts, EVENTS, sums)
        self._populations = populations
        self._noted: list[NDArray[np.int64]] = []

    def note(self, rows: NDArray[np.int64]) -> None:
        """Add events, a row each."""
        if len(rows):
            self._noted.append(rows)
            self._rows += len(rows)
        if self._rows >= WAITING_ROWS:
            self.flush()

    def flush(self) -> None:
        """Write the waiting rows as a part; the first one may have none, but has the columns."""
        rows = np.concatenate([np.zeros((0, 4), np.int64), *self._noted])
        if len(rows) or not self.parts:
            self._waiting = [columns_of_events(rows, self._populations)]
        super().flush()
        self._noted = []


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


def _items(columns: Any, where: str) -> Iterable[tuple[str, Any]]:
    """The columns of a tick by name, each a sequence of values."""
    if not hasattr(columns, "items"):
        raise SocialmindError(
            f"{where}: found {shown(columns)}; expected a dictionary of columns by name"
        )
    for name, values in columns.items():
        if not isinstance(name, str) or not name.isprintable() or not name:
            raise SocialmindError(f"{where}: a column called {shown(name)}; expected a name")
        odd = isinstance(values, str | bytes | Mapping | Set)
        if odd or not hasattr(values, "__len__") or not hasattr(values, "__iter__"):
            raise SocialmindError(
                f"{where}: column {name}: found {shown(values)}; expected a sequence with one "
                "value for each row"
            )
        if isinstance(values, np.ndarray) and values.ndim != 1:
            raise SocialmindError(
                f"{where}: column {name}: an array of {values.ndim} dimensions; "
                "expected one value for each row"
            )
        yield name, values


def _refuse_unless_tick(values: Any, tick: int, where: str) -> None:
    """Raise unless a model's own column ``tick`` says what the run's says."""
    if any(one != tick for one in values):
        raise SocialmindError(
            f"{where}: a column tick of other values than the tick; the run adds its own, "
            "so give it another name"
        )


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
    unfinished = make_room(target.with_name(target.name + ".partial"))
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
        schema = _common_schema([pq.read_schema(path) for path in paths], name)
        return pa.Table.from_batches(
            (b for t in _batches(paths, schema) for b in t.to_batches()), schema
        )
    except (OSError, pa.ArrowException, UnicodeDecodeError) as error:
        raise _unreadable(paths[0] if len(paths) == 1 else Path(name)) from error


def _unreadable(path: Path) -> SocialmindError:
    # Arrow's own words, of messages and protocols, are not about what the user can do.
    found = "cannot be read as a table; it is missing, cut off or was changed"
    return SocialmindError(f"{path}: {found}; take it from a copy of the folder")


def _arrow_table(records: Sequence[Columns], name: str) -> pa.Table:
    """The rows of several ticks as one Arrow table."""
    import pyarrow as pa

    columns, fields = [], []
    for column in records[0]:
        try:
            pieces = [to_arrow(one) for one in _joined([record[column] for record in records])]
        except SocialmindError as error:
            tick = _first_failing(records, column)
            raise SocialmindError(f"{name}{tick}: column {column}: {error}") from error
        kind = pieces[0].type
        for piece in pieces[1:]:
            kind = _common_type(kind, piece.type, name, column)
        columns.append(pa.chunked_array([p.cast(kind, safe=False) for p in pieces], kind))
        fields.append((column, kind))
    return pa.Table.from_arrays(columns, schema=pa.schema(fields))


def _first_failing(records: Sequence[Columns], column: str) -> str:
    """Where a column cannot be written: at the first tick that alone cannot, if there is one."""
    for record in records:
        try:
            to_arrow(record[column])
        except SocialmindError:
            return f" at tick {int(record['tick'][0])}"
    return ""


def _joined(pieces: list[Sequence[Any] | np.ndarray]) -> list[Sequence[Any] | np.ndarray]:
    """The same values in fewer pieces, where they are of one sort."""
    if all(type(one) is list for one in pieces):
        return [[value for one in pieces for value in one]]
    arrays = [one for one in pieces if isinstance(one, np.ndarray)]
    if 1 < len(arrays) == len(pieces) and len({one.dtype for one in arrays}) == 1:
        masked = any(isinstance(one, np.ma.MaskedArray) for one in arrays)
        return [np.ma.concatenate(arrays) if masked else np.concatenate(arrays)]
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
    paths: Sequence[Path],
    schema: pa.Schema,
    drop_tick: int | None = None,
    population: str | None = None,
) -> Iterator[pa.Table]:
    """The rows of some Parquet files, in order, in pieces of `ROW_GROUP`, the last one shorter.

    Args:
        paths: the files.
        schema: the columns to give, and their types; those of the files must convert to them.
        drop_tick: leave out the rows of this tick.
        population: give the rows of this population alone, by the files' column of that name.
    """
    import pyarrow as pa

    waiting = pa.Table.from_batches([], schema)
    for rows in _batches(paths, schema, drop_tick, population):
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
                rows = rows.select(schema.names).cast(schema, safe=False)
                if drop_tick is not None:
                    ticks = [from_arrow(chunk).values for chunk in rows["tick"].chunks]
                    rows = rows.filter(to_arrow(np.concatenate(ticks) != drop_tick))
                yield rows
