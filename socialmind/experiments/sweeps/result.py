"""Reading a sweep's folder."""

from __future__ import annotations

from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING

from socialmind.errors import SocialmindError
from socialmind.experiments.sweeps.capsule import SweepCapsule, SweepManifest
from socialmind.experiments.sweeps.columns import RUN
from socialmind.experiments.sweeps.store import DESIGN, RUNS, Store
from socialmind.runs.folders import FINISHED
from socialmind.runs.tables.names import AGENTS, SERIES

if TYPE_CHECKING:
    import pandas as pd


class Sweep:
    """A sweep as its folder tells it; every table is read when first asked for.

    A sweep that was stopped, or is going on, can be read too: it gives the runs that are safe.

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

        finished = name == DESIGN or self.manifest.status == FINISHED
        if finished and self._capsule.table(name).is_file():
            return pd.read_parquet(self._capsule.table(name))
        found = [] if finished else Store(self.folder).frames(name)
        if not found:
            keeping = {SERIES: "; --every K keeps one", AGENTS: "; --agents last keeps one"}
            so_far = "" if finished else " so far"
            raise SocialmindError(
                f"{self.folder}: has no table of {name}{so_far}{keeping.get(name, '')}"
            )
        return pd.concat(found).sort_values(RUN, kind="stable", ignore_index=True)
