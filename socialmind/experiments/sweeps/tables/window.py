"""Finished runs that wait for being written, a window of them at a time."""

from __future__ import annotations

import time
from typing import Any

from socialmind.errors import SocialmindError
from socialmind.experiments.sweeps.columns import RUN
from socialmind.experiments.sweeps.tables.recording import from_stream
from socialmind.experiments.sweeps.tables.rows import RunRows
from socialmind.experiments.sweeps.tables.store import RUNS, Store
from socialmind.experiments.sweeps.task import Done
from socialmind.runs.tables.growing import arrow_table
from socialmind.runs.tables.names import AGENTS, SERIES

WINDOW_SECONDS = (1.0, 30.0)
"""How long finished runs wait for being written, at the begin of a sweep and after hours."""
PARTS_A_SECOND = 60
"""After so many parts they wait a second longer."""
WINDOW_BYTES = 32 << 20
"""So many bytes of tables do not wait."""


class Window:
    """Finished runs that wait for being written.

    Args:
        store: where they go.
        runs: what their numbers say.
    """

    def __init__(self, store: Store, runs: RunRows) -> None:
        self._store, self._runs = store, runs
        self._rows: list[dict[str, Any]] = []
        self._tables: dict[str, list[bytes]] = {SERIES: [], AGENTS: []}
        self._bytes = 0
        self._parts = 0
        self._last = time.monotonic()

    def add(self, done: Done) -> None:
        """Take up the runs of a job."""
        self._rows += done.rows
        for name, content in done.tables.items():
            self._tables[name].append(content)
            self._bytes += len(content)
        self.write_if_due()

    @property
    def runs(self) -> list[int]:
        """The runs that wait."""
        return [row[RUN] for row in self._rows]

    def write_if_due(self) -> None:
        """Write what waits, if it has waited long enough."""
        least, most = WINDOW_SECONDS
        wait = min(least + self._parts / PARTS_A_SECOND, most)
        if self._bytes > WINDOW_BYTES or time.monotonic() - self._last > wait:
            self.write()

    def write(self) -> None:
        """Write what waits as a part."""
        if self._rows:
            tables = {
                name: [from_stream(one) for one in several]
                for name, several in self._tables.items()
            }
            rows = [{**self._runs.of(row[RUN]), **row} for row in self._rows]
            names = dict.fromkeys(name for row in rows for name in row)
            columns = {name: [row.get(name) for row in rows] for name in names}
            try:
                pieces = [arrow_table([columns], RUNS)]
            except SocialmindError:  # a column is text in one run and a number in another
                pieces = [arrow_table([{k: [v] for k, v in row.items()}], RUNS) for row in rows]
            self._store.write({**tables, RUNS: pieces})
            self._rows, self._tables, self._bytes = [], {SERIES: [], AGENTS: []}, 0
            self._parts += 1
        self._last = time.monotonic()
