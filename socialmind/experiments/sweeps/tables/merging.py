"""Parts put together into one file, sorted by run, with a few of their row groups in memory."""

from __future__ import annotations

import itertools
from collections import OrderedDict
from collections.abc import Iterable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from socialmind.experiments.sweeps.columns import RUN
from socialmind.experiments.sweeps.tables.parts import group_of, runs_of, schema_of
from socialmind.experiments.sweeps.tables.pieces import cast, united
from socialmind.runs.tables.columns import to_arrow
from socialmind.runs.tables.digest import ContentDigest, TableContent
from socialmind.runs.tables.files import ROW_GROUP
from socialmind.runs.tables.growing import arrow_table
from socialmind.work.files import make_room

if TYPE_CHECKING:
    import pyarrow as pa

KEPT_GROUPS = 16
"""So many pieces of parts are held in memory while they are sorted."""


def merged(
    target: Path,
    parts: Mapping[int, Path],
    latest: Mapping[int, int],
    first: Sequence[str],
    pending: Iterable[dict[str, Any]] = (),
) -> TableContent | None:
    """Write the rows of all parts, sorted by run, into one file; None where there are none.

    Args:
        target: the file, which appears whole.
        parts: of the table, by number.
        latest: the part that each run counts in.
        first: columns that come first, in this order; the others come by name.
        pending: of the runs' table, the rows of runs that are not done yet, in order.

    Raises:
        SocialmindError: a part cannot be read.
    """
    import pyarrow.parquet as pq

    pending = iter(pending)
    first_pending = next(pending, None)
    schemas = [schema_of(path) for path in parts.values()]
    if first_pending is not None:
        schemas.append(
            arrow_table([{k: [v] for k, v in first_pending.items()}], target.stem).schema
        )
        pending = itertools.chain([first_pending], pending)
    if not schemas:
        return None
    schema = united(schemas, first)
    unfinished = make_room(target.with_name(target.name + ".partial"))
    digest = ContentDigest(schema)
    try:
        with pq.ParquetWriter(unfinished, schema, compression="zstd") as writer:
            for piece in _in_groups(_in_order(parts, latest, schema, pending), schema):
                digest.update(piece)
                writer.write_table(piece, row_group_size=ROW_GROUP)
        unfinished.replace(target)
    except OSError as error:
        unfinished.unlink(missing_ok=True)  # on a full disk it would take the last room
        error.filename = error.filename or str(target)
        raise
    return digest.content()


def _in_groups(pieces: Iterable[pa.Table], schema: pa.Schema) -> Iterator[pa.Table]:
    """Yield rows in row groups; the last one has what is left, and is there where nothing is."""
    import pyarrow as pa

    waiting, count, any_yet = [pa.Table.from_batches([], schema)], 0, False
    for rows in pieces:
        waiting.append(rows)
        count += rows.num_rows
        while count >= ROW_GROUP:
            together = pa.concat_tables(waiting)
            yield together.slice(0, ROW_GROUP).combine_chunks()
            waiting, any_yet = [together.slice(ROW_GROUP)], True
            count -= ROW_GROUP
    if count or not any_yet:
        yield pa.concat_tables(waiting).combine_chunks()


def _in_order(
    parts: Mapping[int, Path],
    latest: Mapping[int, int],
    schema: pa.Schema,
    pending: Iterator[dict[str, Any]],
) -> Iterator[pa.Table]:
    """Yield the rows of a table by run, in as few pieces as they lie in."""
    groups = _Groups(parts, schema)
    waiting = _Pending(pending, schema)
    part = begin = end = -1
    for run, number, first, last in _lying(parts, latest).tolist():
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


def _lying(parts: Mapping[int, Path], latest: Mapping[int, int]) -> NDArray[np.int64]:
    """Return where the rows of each run lie, by run: run, part, first row, end."""
    blocks = [np.zeros((0, 4), np.int64)]
    for number, path in parts.items():
        runs = runs_of(path)
        if len(runs):
            begins = np.flatnonzero(np.diff(runs, prepend=runs[0] - 1))
            ends = np.append(begins[1:], len(runs))
            counts = np.array([latest.get(run) == number for run in runs[begins].tolist()], bool)
            where = np.full(len(begins), number, np.int64)
            blocks.append(np.stack([runs[begins], where, begins, ends], axis=1)[counts])
    lying = np.concatenate(blocks)
    return lying[np.argsort(lying[:, 0], kind="stable")]


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
            yield cast(arrow_table([columns], "runs"), self._schema)


class _Groups:
    """Pieces of parts, the last ones that were asked for."""

    def __init__(self, parts: Mapping[int, Path], schema: pa.Schema) -> None:
        self._parts, self._schema = parts, schema
        self._kept: OrderedDict[tuple[int, int], pa.Table] = OrderedDict()

    def rows(self, part: int, begin: int, end: int) -> pa.Table:
        """Return some rows of a part, in the schema of all."""
        import pyarrow as pa

        pieces = []
        for group in range(begin // ROW_GROUP, (end - 1) // ROW_GROUP + 1):
            rows = self._group(part, group)
            low, high = max(begin - group * ROW_GROUP, 0), min(end - group * ROW_GROUP, ROW_GROUP)
            # A slice would keep the whole group in memory, of each part that has a row of these.
            few = 2 * (high - low) < rows.num_rows
            some = rows.take(to_arrow(np.arange(low, high))) if few else rows.slice(low, high - low)
            pieces.append(some)
        return pa.concat_tables(pieces)

    def _group(self, part: int, group: int) -> pa.Table:
        if (part, group) not in self._kept:
            rows = group_of(self._parts[part], group)
            self._kept[part, group] = cast(rows, self._schema)
            while len(self._kept) > KEPT_GROUPS:
                self._kept.popitem(last=False)
        self._kept.move_to_end((part, group))
        return self._kept[part, group]
