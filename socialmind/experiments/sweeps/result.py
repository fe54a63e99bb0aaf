"""Reading a sweep's folder."""

from __future__ import annotations

from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING

from socialmind.errors import SocialmindError
from socialmind.experiments.sweeps.capsule import SweepCapsule, SweepManifest
from socialmind.experiments.sweeps.columns import POINT, RUN, Names, of_ticks
from socialmind.experiments.sweeps.replicates import Replicates
from socialmind.experiments.sweeps.tables.pieces import runs_in, sorted_by_run, together
from socialmind.experiments.sweeps.tables.rows import RunRows
from socialmind.experiments.sweeps.tables.store import DESIGN, RUNS, Store
from socialmind.runs.folders import FINISHED, is_held
from socialmind.runs.tables.growing import arrow_table
from socialmind.runs.tables.names import AGENTS, SERIES

if TYPE_CHECKING:
    import pandas as pd


class Sweep:
    """A sweep as its folder tells it; every table is read when first asked for.

    A sweep that was stopped, or is going on, can be read too: what came of the runs that are safe,
    and which others are `running` at this moment or `pending`.

    >>> from socialmind.experiments import Sweep                            # doctest: +SKIP
    >>> sweep = Sweep("sweeps/farmer_artisan-001")                          # doctest: +SKIP
    >>> sweep.runs.groupby("tool_price")["farmers"].mean()                  # doctest: +SKIP

    Args:
        folder: the sweep's.

    Raises:
        SocialmindError: the folder is no sweep's.
    """

    def __init__(self, folder: str | Path) -> None:
        self._capsule = SweepCapsule(folder)

    @property
    def folder(self) -> Path:
        """The sweep's folder."""
        return self._capsule.folder

    @property
    def manifest(self) -> SweepManifest:
        """What the sweep is: model, design, seeds, versions, status."""
        return self._capsule.manifest

    @property
    def varied(self) -> list[str]:
        """What varies, as the design's columns are called."""
        return list(self.manifest.columns)

    @cached_property
    def design(self) -> pd.DataFrame:
        """One row a point: `point` and what varies."""
        return self._table(DESIGN)

    @cached_property
    def runs(self) -> pd.DataFrame:
        """One row a run: its point, seed, status, the end of its series, and measures."""
        return self._table(RUNS)

    @cached_property
    def series(self) -> pd.DataFrame:
        """One row a run and recorded tick: `run`, `tick` and the model's own columns.

        Raises:
            SocialmindError: the sweep keeps none.
        """
        return self._table(SERIES)

    @cached_property
    def agents(self) -> pd.DataFrame:
        """One row an agent, run and recorded tick.

        Raises:
            SocialmindError: the sweep keeps none.
        """
        return self._table(AGENTS)

    def _repr_html_(self) -> str:
        from socialmind.experiments.sweeps.shown import as_html

        return as_html(self)

    def _table(self, name: str) -> pd.DataFrame:
        import pandas as pd

        if name != DESIGN and not self._finished:
            try:
                found = self._so_far(name)
            except SocialmindError:
                found = None  # perhaps it has just ended, and its parts are gone
            self._capsule = SweepCapsule(self.folder)
            if not self._finished:
                return self._so_far(name) if found is None else found
        if not self._capsule.table(name).is_file():
            raise self._lacks(name)
        return pd.read_parquet(self._capsule.table(name))

    @property
    def _finished(self) -> bool:
        return self.manifest.status == FINISHED

    def _so_far(self, name: str) -> pd.DataFrame:
        """Return the rows that are safe; of runs that are not done, what is known of them."""
        store = Store(self.folder)
        pieces = store.so_far(name)
        if name == RUNS:
            running = store.running() if is_held(self.folder) else set()
            done = {run for piece in pieces for run in runs_in(piece).tolist()}
            missing = list(self._rows.missing(done, running))
            if missing:
                columns = {column: [row[column] for row in missing] for column in missing[0]}
                pieces.append(arrow_table([columns], RUNS))
        if not pieces:
            raise self._lacks(name, " so far")
        first = [RUN, "tick", *(of_ticks(one, name) for one in self.manifest.series_columns)]
        if name == RUNS:
            names = Names(tuple(self.varied), tuple(self.manifest.measures))
            first = names.first(self.manifest.series_columns)
        return sorted_by_run(together(pieces, first)).to_pandas()

    @property
    def _rows(self) -> RunRows:
        """What the design says of runs."""
        design = self.design.drop(columns=POINT)
        columns = [design[name].tolist() for name in design.columns]
        points = list(zip(*columns, strict=True)) if columns else [()] * len(self.design)
        return RunRows(
            design.columns.tolist(), points, Replicates.of_record(self.manifest.replicates)
        )

    def _lacks(self, name: str, so_far: str = "") -> SocialmindError:
        keeping = {SERIES: "; --every K keeps one", AGENTS: "; --agents last keeps one"}
        return SocialmindError(
            f"{self.folder}: has no table of {name}{so_far}{keeping.get(name, '')}"
        )
