"""The results of a sweep on disk: parts while it goes on, and one sorted file a table at its end.

A part is one window of finished runs: `parts/series/000012.parquet`, `parts/agents/…` and, written
last, `parts/runs/000012.parquet`, with which the window counts. Each appears whole or not at all.
So whenever the program is killed, what counts is whole; a run of a later part stands in place of
the same run of an earlier one, and the sorted tables do not hang on how windows were cut.
"""

from __future__ import annotations

import json
import os
import shutil
from collections.abc import Collection, Iterable, Iterator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from socialmind.experiments.sweeps.columns import RUN
from socialmind.experiments.sweeps.tables.merging import merged
from socialmind.experiments.sweeps.tables.parts import part, rows_of, runs_of
from socialmind.experiments.sweeps.tables.pieces import runs_in, sorted_by_run, together
from socialmind.runs.tables.columns import to_arrow
from socialmind.runs.tables.digest import TableContent
from socialmind.runs.tables.files import ROW_GROUP
from socialmind.runs.tables.names import AGENTS, SERIES
from socialmind.work.files import remove, replace_file, replacing

if TYPE_CHECKING:
    import pyarrow as pa

RUNS = "runs"
DESIGN = "design"
TABLES = (SERIES, AGENTS, RUNS)
"""The tables of a part, in the order in which they are written: the last one makes it count."""


class Store:
    """The parts of a sweep.

    Args:
        folder: the sweep's.
    """

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self._parts = folder / "parts"
        self._running = self._parts / "running.json"

    def numbers(self) -> list[int]:
        """Return the numbers of the parts that count."""
        found = (self._parts / RUNS).glob("[0-9]*.parquet")
        return sorted(int(path.stem) for path in found if path.stem.isdecimal())

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
        counting = {self._part(RUNS, number).name for number in known}
        for name in TABLES:
            (self._parts / name).mkdir(parents=True, exist_ok=True)
            for path in (self._parts / name).iterdir():
                if path.name not in counting:
                    remove(path)
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
            rows = sorted_by_run(together(pieces))
            with replacing(self._part(name, self._next)) as file:
                pq.write_table(rows, file, row_group_size=ROW_GROUP, compression="zstd")
                file.flush()
                os.fsync(file.fileno())
        self._next += 1

    def rows(self, columns: Sequence[str]) -> Iterator[dict[str, Any]]:
        """Yield some columns of the runs' table, a row for each run that counts, part by part."""
        latest = self._latest()
        for number in self.numbers():
            with part(self._part(RUNS, number)) as file:
                there = [RUN, *(one for one in columns if one in file.schema_arrow.names)]
                for batch in file.iter_batches(ROW_GROUP, columns=there, use_threads=False):
                    for row in batch.to_pylist():
                        if latest.get(row[RUN]) == number:
                            yield row

    def so_far(self, name: str) -> list[pa.Table]:
        """Return the rows of a table, as far as they are safe, part by part.

        A part that another process writes in the meantime is left out.
        """
        latest = self._latest()
        found = []
        for number in self.numbers():
            if self._part(name, number).is_file():
                rows = rows_of(self._part(name, number))
                counts = [latest.get(run) == number for run in runs_in(rows).tolist()]
                found.append(rows.filter(to_arrow(np.array(counts, bool))))
        return found

    def merge(
        self, name: str, first: Sequence[str], pending: Iterable[dict[str, Any]] = ()
    ) -> TableContent | None:
        """Write the rows of all parts, sorted by run, into one file; None where there are none.

        Args:
            name: of the table.
            first: columns that come first, in this order; the others come by name.
            pending: of the runs' table, the rows of runs that are not done yet, in order.

        Raises:
            SocialmindError: a part cannot be read.
        """
        parts = {n: self._part(name, n) for n in self.numbers() if self._part(name, n).is_file()}
        return merged(self.folder / f"{name}.parquet", parts, self._latest(), first, pending)

    def note_running(self, runs: Collection[int]) -> None:
        """Say which runs are begun and not yet safe."""
        if not runs:
            self._running.unlink(missing_ok=True)
            return
        ordered = np.unique(np.fromiter(runs, np.int64))
        stretches = np.split(ordered, np.flatnonzero(np.diff(ordered) > 1) + 1)
        said = [[int(one[0]), int(one[-1])] for one in stretches]
        replace_file(self._running, json.dumps(said).encode())

    def running(self) -> set[int]:
        """Return the runs that are begun and not yet safe; true while the sweep is going on."""
        try:
            said = json.loads(self._running.read_bytes())
        except (OSError, ValueError):
            return set()
        return {run for first, last in said for run in range(first, last + 1)}

    def clear(self) -> None:
        """Take the parts away."""
        shutil.rmtree(self._parts, ignore_errors=True)

    def _part(self, name: str, number: int) -> Path:
        return self._parts / name / f"{number:06d}.parquet"

    def _latest(self) -> dict[int, int]:
        """Return the part that each run counts in, by run."""
        found: dict[int, int] = {}
        for number in self.numbers():
            found |= dict.fromkeys(runs_of(self._part(RUNS, number)).tolist(), number)
        return found
