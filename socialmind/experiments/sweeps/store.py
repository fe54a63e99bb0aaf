"""The results of a sweep on disk: parts while it goes on, and one sorted file a table at its end.

A part is one window of finished runs: `parts/series/000012.parquet`, `parts/agents/…` and, written
last, `parts/runs/000012.parquet`, with which the window counts. Each appears whole or not at all.
So whenever the program is killed, what counts is whole; a run of a later part stands in place of
the same run of an earlier one, and the sorted tables do not hang on how windows were cut.
"""

from __future__ import annotations

import itertools
import os
import shutil
from collections import OrderedDict
from collections.abc import Iterable, Iterator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from socialmind.errors import SocialmindError
from socialmind.runs.tables.column_types import common_type
from socialmind.runs.tables.columns import from_arrow
from socialmind.runs.tables.digest import ContentDigest, TableContent
from socialmind.runs.tables.files import ROW_GROUP
from socialmind.runs.tables.growing import arrow_table
from socialmind.runs.tables.names import AGENTS, SERIES
from socialmind.work.files import make_room, replacing

if TYPE_CHECKING:
    import pyarrow as pa

RUNS = "runs"
DESIGN = "design"
TABLES = (SERIES, AGENTS, RUNS)
"""The tables of a part, in the order in which they are written: the last one makes it count."""
RUN = "run"
KEPT_GROUPS = 16
"""So many pieces of parts are held in memory while they are sorted."""


class Store:
    """The parts of a sweep.

    Args:
        folder: the sweep's.
    """

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self._parts = folder / "parts"

    def numbers(self) -> list[int]:
        """Return the numbers of the parts that count."""
        return sorted(int(path.stem) for path in (self._parts / RUNS).glob("[0-9]*.parquet"))

    def begin(self, again: bool = False) -> None:
        """Make ready to write: what does not count is taken away.

        Args:
            again: whether the sorted tables of a finished sweep are the first part.
        """
        if again and 0 not in self.numbers():
            for name in TABLES:
                if (self.folder / f"{name}.parquet").is_file():
                    self._part(name, 0).parent.mkdir(parents=True, exist_ok=True)
                    with (
                        (self.folder / f"{name}.parquet").open("rb") as source,
                        replacing(self._part(name, 0)) as target,
                    ):
                        shutil.copyfileobj(source, target)
        known = self.numbers()
        for name in TABLES:
            (self._parts / name).mkdir(parents=True, exist_ok=True)
            for path in (self._parts / name).iterdir():
                if path.suffix != ".parquet" or int(path.stem) not in known:
                    path.unlink()
        self._next = max(known, default=-1) + 1

    def write(self, tables: dict[str, list[pa.Table]]) -> None:
        """Write a window of runs.

        Args:
            tables: pieces of each table, with a column `run`.

        Raises:
            OSError: no room on the disk; the window does not count.
        """
        import pyarrow.parquet as pq

        for name in TABLES:
            pieces = [one for one in tables.get(name, []) if one.num_columns]
            if not pieces:
                continue
            rows = _sorted(together(pieces))
            with replacing(self._part(name, self._next)) as file:
                pq.write_table(rows, file, row_group_size=ROW_GROUP, compression="zstd")
                file.flush()
                os.fsync(file.fileno())
        self._next += 1

    def rows(self, columns: Sequence[str]) -> Iterator[dict[str, Any]]:
        """Yield some columns of the runs' table, a row for each run that counts, part by part."""
        import pyarrow as pa
        import pyarrow.parquet as pq

        latest = self._latest()
        for number in self.numbers():
            path = self._part(RUNS, number)
            try:
                with pq.ParquetFile(path) as file:
                    there = [RUN, *(one for one in columns if one in file.schema_arrow.names)]
                    for batch in file.iter_batches(ROW_GROUP, columns=there, use_threads=False):
                        for row in batch.to_pylist():
                            if latest[row[RUN]] == number:
                                yield row
            except (OSError, pa.ArrowException) as error:
                raise _unreadable(path) from error

    def frames(self, name: str) -> list[Any]:
        """Return the rows of a table, as far as they are safe, in data frames."""
        latest = self._latest()
        found = []
        for number in self.numbers():
            if self._part(name, number).is_file():
                frame = self._read(name, number).to_pandas()
                found.append(frame[frame[RUN].map(latest) == number])
        return found

    def merge(
        self,
        name: str,
        first: Sequence[str],
        pending: Iterable[dict[str, Any]] | None = None,
    ) -> TableContent | None:
        """Write the rows of all parts, sorted by run, into one file; None where there are none.

        Args:
            name: of the table.
            first: columns that come first, in this order; the others come by name.
            pending: of the runs' table, the rows of runs that are not done yet, in order.

        Raises:
            SocialmindError: a part cannot be read.
        """
        import pyarrow as pa
        import pyarrow.parquet as pq

        paths = {n: self._part(name, n) for n in self.numbers() if self._part(name, n).is_file()}
        pending = iter(()) if pending is None else iter(pending)
        first_pending = next(pending, None)
        schemas = [_schema(path) for path in paths.values()]
        if first_pending is not None:
            schemas.append(arrow_table([{k: [v] for k, v in first_pending.items()}], name).schema)
            pending = itertools.chain([first_pending], pending)
        if not schemas:
            return None
        schema = _ordered(schemas, first)
        target = self.folder / f"{name}.parquet"
        unfinished = make_room(target.with_name(target.name + ".partial"))
        digest = ContentDigest(schema)
        try:
            with pq.ParquetWriter(unfinished, schema, compression="zstd") as writer:
                waiting = pa.Table.from_batches([], schema)
                for rows in self._in_order(name, paths, schema, pending):
                    waiting = pa.concat_tables([waiting, rows])
                    while waiting.num_rows >= ROW_GROUP:
                        piece = waiting.slice(0, ROW_GROUP).combine_chunks()
                        digest.update(piece)
                        writer.write_table(piece, row_group_size=ROW_GROUP)
                        waiting = waiting.slice(ROW_GROUP)
                if waiting.num_rows or digest.rows == 0:
                    waiting = waiting.combine_chunks()
                    digest.update(waiting)
                    writer.write_table(waiting, row_group_size=ROW_GROUP)
            unfinished.replace(target)
        except OSError as error:
            unfinished.unlink(missing_ok=True)  # on a full disk it would take the last room
            error.filename = error.filename or str(target)
            raise
        return digest.content()

    def clear(self) -> None:
        """Take the parts away."""
        shutil.rmtree(self._parts, ignore_errors=True)

    def _part(self, name: str, number: int) -> Path:
        return self._parts / name / f"{number:06d}.parquet"

    def _read(self, name: str, number: int) -> pa.Table:
        import pyarrow as pa
        import pyarrow.parquet as pq

        path = self._part(name, number)
        try:
            with pq.ParquetFile(path) as file:
                return file.read(use_threads=False)
        except (OSError, pa.ArrowException) as error:
            raise _unreadable(path) from error

    def _latest(self) -> dict[int, int]:
        """Return the part that each run counts in, by run."""
        found: dict[int, int] = {}
        for number in self.numbers():
            found |= dict.fromkeys(_runs_of(self._part(RUNS, number)).tolist(), number)
        return found

    def _in_order(
        self,
        name: str,
        paths: dict[int, Path],
        schema: pa.Schema,
        pending: Iterator[dict[str, Any]],
    ) -> Iterator[pa.Table]:
        """Yield the rows of a table by run, in as few pieces as they lie in."""
        latest = self._latest()
        blocks: list[NDArray[np.int64]] = []
        for number, path in paths.items():
            runs = _runs_of(path)
            if not len(runs):
                continue
            begins = np.flatnonzero(np.diff(runs, prepend=runs[0] - 1))
            ends = np.append(begins[1:], len(runs))
            counts = np.array([latest.get(run) == number for run in runs[begins].tolist()], bool)
            where = np.full(len(begins), number, np.int64)
            blocks.append(np.stack([runs[begins], where, begins, ends], axis=1)[counts])
        lying = np.concatenate([np.zeros((0, 4), np.int64), *blocks])
        lying = lying[np.argsort(lying[:, 0], kind="stable")]
        groups = _Groups(paths, schema)
        waiting = _Pending(pending, schema)
        part = begin = end = -1
        for run, number, first, last in lying.tolist():
            if waiting.before(run):
                if end > begin:
                    yield groups.rows(part, begin, end)
                begin = end = -1
                yield from waiting.until(run)
            if number == part and first == end:
                end = last
                continue
            if end > begin:
                yield groups.rows(part, begin, end)
            part, begin, end = number, first, last
        if end > begin:
            yield groups.rows(part, begin, end)
        yield from waiting.until(None)


class _Pending:
    """Rows of runs that are not done yet, some at a time."""

    def __init__(self, rows: Iterator[dict[str, Any]], schema: pa.Schema) -> None:
        self._rows, self._schema = rows, schema
        self._following = next(rows, None)

    def before(self, run: int | None) -> bool:
        """Return whether there are some before a run; at all, for None."""
        return self._following is not None and (run is None or self._following[RUN] < run)

    def until(self, run: int | None) -> Iterator[pa.Table]:
        """Yield those before a run; all, for None."""
        while self.before(run):
            some: list[dict[str, Any]] = []
            while self._following is not None and self.before(run) and len(some) < ROW_GROUP:
                some.append(self._following)
                self._following = next(self._rows, None)
            columns = {name: [row[name] for row in some] for name in some[0]}
            yield _cast(arrow_table([columns], RUNS), self._schema)


class _Groups:
    """Pieces of parts, the last ones that were asked for."""

    def __init__(self, paths: dict[int, Path], schema: pa.Schema) -> None:
        self._paths, self._schema = paths, schema
        self._kept: OrderedDict[tuple[int, int], pa.Table] = OrderedDict()

    def rows(self, part: int, begin: int, end: int) -> pa.Table:
        """Return some rows of a part, in the schema of all."""
        import pyarrow as pa

        pieces = []
        for group in range(begin // ROW_GROUP, (end - 1) // ROW_GROUP + 1):
            rows = self._group(part, group)
            low, high = max(begin - group * ROW_GROUP, 0), min(end - group * ROW_GROUP, ROW_GROUP)
            pieces.append(rows.slice(low, high - low))
        return pa.concat_tables(pieces)

    def _group(self, part: int, group: int) -> pa.Table:
        import pyarrow as pa
        import pyarrow.parquet as pq

        if (part, group) not in self._kept:
            try:
                with pq.ParquetFile(self._paths[part]) as file:
                    rows = file.read_row_group(group, use_threads=False)
            except (OSError, pa.ArrowException) as error:
                raise _unreadable(self._paths[part]) from error
            self._kept[part, group] = _cast(rows, self._schema)
            while len(self._kept) > KEPT_GROUPS:
                self._kept.popitem(last=False)
        self._kept.move_to_end((part, group))
        return self._kept[part, group]


def _unreadable(path: Path) -> SocialmindError:
    return SocialmindError(
        f"{path}: cannot be read as a table; it is missing, cut off or was changed; take it from a "
        "copy of the folder"
    )


def _schema(path: Path) -> pa.Schema:
    import pyarrow as pa
    import pyarrow.parquet as pq

    try:
        return pq.read_schema(path)
    except (OSError, pa.ArrowException) as error:
        raise _unreadable(path) from error


def _runs_of(path: Path) -> NDArray[np.int64]:
    import pyarrow as pa
    import pyarrow.parquet as pq

    try:
        with pq.ParquetFile(path) as file:
            column = file.read([RUN], use_threads=False)[RUN]
    except (OSError, pa.ArrowException) as error:
        raise _unreadable(path) from error
    found = [from_arrow(chunk).values for chunk in column.chunks]
    return np.concatenate([np.zeros(0, np.int64), *found])


def _ordered(schemas: Sequence[pa.Schema], first: Sequence[str]) -> pa.Schema:
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


def _cast(rows: pa.Table, schema: pa.Schema) -> pa.Table:
    """Return rows in the columns of a schema; of a column that they lack, nothing."""
    import pyarrow as pa

    columns = []
    for one in schema:
        if one.name in rows.column_names:
            columns.append(rows[one.name].cast(one.type, safe=False))
        else:
            columns.append(pa.nulls(rows.num_rows, one.type))
    return pa.Table.from_arrays(columns, schema=schema)


def together(pieces: Sequence[pa.Table]) -> pa.Table:
    """Return the rows of several tables as one, with the columns of all."""
    import pyarrow as pa

    names = dict.fromkeys(n for one in pieces for n in one.column_names)
    schema = _ordered([one.schema for one in pieces], list(names))
    return pa.concat_tables([_cast(one, schema) for one in pieces])


def _sorted(rows: pa.Table) -> pa.Table:
    """Return rows by run; those of one run stay in order."""
    found = np.concatenate([from_arrow(chunk).values for chunk in rows[RUN].chunks])
    if (np.diff(found) >= 0).all():
        return rows.combine_chunks()
    from socialmind.runs.tables.columns import to_arrow

    return rows.take(to_arrow(np.argsort(found, kind="stable"))).combine_chunks()
