"""The tables of a run while it goes on: rows kept in Parquet parts, of which a checkpoint tells.

pyarrow is imported by the functions that write: a run reaches its first tick without it.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence, Set
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from coglogo_py.border.errors import shown
from socialmind.agents.events import columns_of_events
from socialmind.errors import SocialmindError
from socialmind.runs.tables.column_types import common_type
from socialmind.runs.tables.columns import to_arrow
from socialmind.runs.tables.files import ROW_GROUP, part_name, seal
from socialmind.runs.tables.names import EVENTS
from socialmind.work.files import make_room

if TYPE_CHECKING:
    import pyarrow as pa

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
        changing: whether columns may come and go, as where a scheme gives way to another; what a
            tick does not have is missing there.
    """

    def __init__(
        self,
        name: str,
        folder: Path,
        parts: Iterable[str] = (),
        source: str = "",
        sums: Mapping[str, list[Any]] | None = None,
        changing: bool = False,
    ) -> None:
        self.name = name
        self._changing = changing
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

            schema = pq.read_schema(folder / self.parts[-1])  # none has more columns
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
        elif names != self.columns and self._changing:
            rows = self._in_columns(rows, length)
        elif names != self.columns:
            raise SocialmindError(
                f"{where}: columns {', '.join(names) or 'none'}; expected those of the ticks "
                f"before, {', '.join(self.columns) or 'none'}; give the same columns at every tick"
            )
        self._waiting.append({"tick": np.full(length, tick, dtype=np.int64), **rows})
        self._rows += length
        if self._rows >= WAITING_ROWS:
            self.flush()

    def _in_columns(self, rows: Columns, length: int) -> dict[str, Sequence[Any] | np.ndarray]:
        """Return rows in the table's columns; those that are new stand behind all others."""
        known = self.columns or ()
        new = tuple(name for name in rows if name not in known)
        if new:
            self.flush()  # a part has the same columns throughout
            self.columns = (*known, *new)
        return {name: rows.get(name, [None] * length) for name in (*known, *new)}

    def flush(self) -> None:
        """Write the waiting rows as a part."""
        if not self._waiting:
            return
        import pyarrow.parquet as pq

        table = arrow_table(self._waiting, self.source)
        for field in table.schema:
            before = self._types.get(field.name, field.type)
            self._types[field.name] = common_type(before, field.type, self.source, field.name)
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


def arrow_table(records: Sequence[Columns], name: str) -> pa.Table:
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
            kind = common_type(kind, piece.type, name, column)
        columns.append(pa.chunked_array([p.cast(kind, safe=False) for p in pieces], kind))
        fields.append((column, kind))
    return pa.Table.from_arrays(columns, schema=pa.schema(fields))


def _first_failing(records: Sequence[Columns], column: str) -> str:
    """Where a column cannot be written: at the first tick that alone cannot, if there is one."""
    for record in records:
        try:
            to_arrow(record[column])
        except SocialmindError:
            return f" at tick {int(record['tick'][0])}" if "tick" in record else ""
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
