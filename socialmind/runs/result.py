"""Reading a run's folder, for figures and analysis."""

from __future__ import annotations

from collections.abc import Container
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any

from socialmind.errors import SocialmindError
from socialmind.runs.capsule import Capsule, Manifest
from socialmind.runs.checkpoint import Checkpoint
from socialmind.runs.folders import FINISHED
from socialmind.runs.sources import recorded_class, require_minds
from socialmind.runs.tables.files import check_content, read
from socialmind.runs.tables.names import AGENTS, EVENTS, GROUPS, LINKS, SERIES

if TYPE_CHECKING:
    import pandas as pd

    from coglogo_py import CognitiveScheme
    from socialmind.mind.description import MindDescription


class Run:
    """A run as its folder tells it; every table is read when first asked for.

    A run that was stopped can be read too: it gives what its last checkpoint made safe.

    >>> from socialmind.experiments import Run                              # doctest: +SKIP
    >>> run = Run("runs/farmer_artisan-001")                                # doctest: +SKIP
    >>> run.series.plot(x="tick", y=["farmers", "artisans"])                # doctest: +SKIP

    Args:
        folder: the run's.
        trust: run programs that this user has neither named nor run before.

    Raises:
        SocialmindError: the folder is no run's.
    """

    def __init__(self, folder: str | Path, trust: bool = False) -> None:
        self._capsule = Capsule(folder)
        self._trust = trust

    @property
    def folder(self) -> Path:
        """The run's folder."""
        return self._capsule.folder

    @property
    def manifest(self) -> Manifest:
        """What the run is: model, seed, versions, timings, status."""
        return self._capsule.manifest

    @property
    def model(self) -> str:
        """Name of the model."""
        return str(self.manifest.model["name"])

    @property
    def parameters(self) -> dict[str, Any]:
        """Value of every parameter, by name."""
        return dict(self.manifest.parameters)

    @property
    def seed(self) -> int:
        """Seed of the run."""
        return self.manifest.seed

    @property
    def ticks(self) -> int:
        """Ticks done."""
        return self.manifest.ticks_done

    @cached_property
    def series(self) -> pd.DataFrame:
        """One row a recorded tick: ``tick`` and the model's own columns."""
        return self._table(SERIES)

    @cached_property
    def agents(self) -> pd.DataFrame:
        """One row an agent and recorded tick: ``tick`` and the model's own columns."""
        return self._table(AGENTS)

    @cached_property
    def groups(self) -> pd.DataFrame:
        """One row a living group and recorded tick: its type, identity, members and culturons.

        Raises:
            SocialmindError: the run recorded none.
        """
        return self._table(GROUPS)

    @cached_property
    def links(self) -> pd.DataFrame:
        """One row a link and recorded tick: ``tick``, ``network``, ends and fields.

        Raises:
            SocialmindError: the run recorded none.
        """
        return self._table(LINKS)

    @cached_property
    def events(self) -> pd.DataFrame:
        """One row a birth or death: ``tick``, ``population``, ``agent``, ``event``, ``parent``.

        Raises:
            SocialmindError: the run recorded none.
        """
        return self._table(EVENTS)

    @cached_property
    def schemes(self) -> dict[str, CognitiveScheme]:
        """The cognitive schemes that the run used, by the population that has such minds."""
        from coglogo_py import CognitiveScheme, SchemeError

        schemes = {}
        for population, path in self._capsule.schemes.items():
            try:
                schemes[population] = CognitiveScheme.load(path)
            except SchemeError:
                # It may name a decision maker that only the model's own file defines.
                declared = recorded_class(self._capsule, self._trust).populations[population]
                schemes[population] = CognitiveScheme.load(path, declared.decision_makers)
        return schemes

    @property
    def scheme(self) -> CognitiveScheme | None:
        """The scheme of the first population with minds; None where nobody has one."""
        return next(iter(self.schemes.values()), None)

    @cached_property
    def minds(self) -> dict[str, MindDescription]:
        """The hierarchies of skills that the run used, by the population that has them."""
        from socialmind.mind.description import MindDescription

        require_minds(self._capsule, self._trust)
        return {name: MindDescription.load(path) for name, path in self._capsule.minds.items()}

    def _repr_html_(self) -> str:
        from socialmind.runs.shown import as_html

        return as_html(self)

    def _table(self, name: str) -> pd.DataFrame:
        if self.manifest.status == FINISHED:
            self._check_recorded(name, self.manifest.tables)
            paths = [self._capsule.table(name)]
            check_content(paths[0], self.manifest.tables[name]["sha256"])
        elif self._capsule.checkpoint.is_file():
            checkpoint = Checkpoint.load(self._capsule.checkpoint)
            self._check_recorded(name, checkpoint.parts)
            checkpoint.check_parts(self._capsule.parts)
            paths = [self._capsule.parts / part for part in checkpoint.parts[name]]
        else:
            raise SocialmindError(
                f"{self.folder}: the run was stopped before its first checkpoint; "
                "finish it with --resume"
            )
        return read(paths, name).to_pandas()

    def _check_recorded(self, name: str, tables: Container[str]) -> None:
        if name not in tables:
            raise SocialmindError(
                f"{self.folder}: has no table of {name}; only runs {_RECORDING[name]} record one, "
                "from their beginning"
            )


_RECORDING = {
    GROUPS: "of models whose minds can form groups",
    LINKS: "with --links, or of models with networks that say record_links = True,",
    EVENTS: "of models in whose ticks agents are born or die, not with --no-events,",
}
"""Which runs have the tables that not every run has."""
