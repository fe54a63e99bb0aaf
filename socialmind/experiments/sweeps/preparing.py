"""What a sweep needs before its first run, taken from its folder, whether it begins or goes on."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any

from coglogo_py import CognitiveScheme
from coglogo_py.border.errors import shown
from socialmind.errors import SocialmindError
from socialmind.experiments.sweeps.capsule import SweepCapsule
from socialmind.experiments.sweeps.columns import Names
from socialmind.experiments.sweeps.measures.of_runs import (
    AMeasure,
    of_records,
)
from socialmind.experiments.sweeps.one_run import Common
from socialmind.experiments.sweeps.points.settings import Key, Settings
from socialmind.experiments.sweeps.points.table import (
    Points,
    points_of_parquet,
)
from socialmind.experiments.sweeps.points.varied import Nameable
from socialmind.experiments.sweeps.replicates import Replicates
from socialmind.experiments.sweeps.tables.rows import RunRows
from socialmind.interventions.shock import Shock
from socialmind.mind.description import MindDescription
from socialmind.runs.branching.kept import interventions_of
from socialmind.runs.sources import checked_class
from socialmind.society.founding.making import schemes_of
from socialmind.sources.folders import digest

if TYPE_CHECKING:
    from socialmind.model import Model


@dataclass(frozen=True)
class Prepared:
    """A sweep that can begin, or go on.

    Attributes:
        common: what its runs have in common.
        points: of the design.
        replicates: at each.
        names: of the columns.
        series: the columns of the series, as the first society has them.
    """

    common: Common
    points: Points
    replicates: Replicates
    names: Names
    series: tuple[str, ...]

    @cached_property
    def rows(self) -> RunRows:
        """What the design says of runs."""
        names = [self.names.of_varied(one.name) for one in self.points.columns]
        return RunRows(names, self.points.values, self.replicates)

    def job_of(self, run: int) -> tuple[int, int, tuple[Any, ...]]:
        """Return a run as workers take it."""
        point, _ = self.replicates.place_of(run)
        return run, self.replicates.seed_of(run), self.points.values[point]


def nameable(model_class: type[Model]) -> Nameable:
    """Return what designs of a model can name, by its own schemes and minds."""
    schemes, _ = schemes_of(
        model_class.populations,
        model_class.folder,
        None,
        model_class.name,
        model_class._blueprint.schemes,
    )
    return Nameable(model_class, schemes, tuple(model_class.steerings()))


def taken_up(
    capsule: SweepCapsule,
    model_class: type[Model] | None = None,
    measures: Mapping[str, Any] | None = None,
    trust: bool = False,
    functions: bool = True,
    shocks: Sequence[Shock] | None = None,
) -> Prepared:
    """Return the sweep that a folder keeps.

    Args:
        capsule: the folder.
        model_class: the model; loaded from where the manifest says by default.
        measures: functions in place of those that stand in no file.
        trust: run programs that this user has neither named nor run before.
        functions: whether measures are wanted at all.
        shocks: those of the sweep, where they are at hand; from its copies by default.

    Raises:
        SocialmindError: its model, schemes, shocks or socialmind were changed since.
    """
    manifest = capsule.manifest
    cls = checked_class(capsule, model_class, trust=trust, what="sweep")
    makers = {name: one.decision_makers for name, one in cls.populations.items()}
    schemes: dict[Key, CognitiveScheme] = {}
    for key, path in capsule.schemes.items():
        record = manifest.schemes[key]
        owner = record["population"]
        schemes[owner, record["given"]] = CognitiveScheme.load(path, makers[owner])
    minds: dict[Key, MindDescription] = {}
    for key, path in capsule.minds.items():
        record = manifest.minds[key]
        minds[record["population"], record["given"]] = MindDescription.load(path)
    own = {owner: scheme for (owner, given), scheme in schemes.items() if not given}
    there = Nameable(cls, own, tuple(owner for owner, given in minds if not given))
    columns = tuple(there.called(name) for name in manifest.columns)
    fixed = tuple((there.called(name), value) for name, value in manifest.fixed.items())
    found: dict[str, AMeasure] = {}
    if functions:
        found = of_records(manifest.measures, measures or {}, str(capsule.folder), trust)
    names = Names(tuple(manifest.columns), tuple(manifest.measures))
    common = Common(
        cls,
        Settings(columns, fixed, schemes, minds, makers),
        manifest.ticks,
        manifest.every,
        manifest.keeps_series,
        manifest.agents_every,
        found,
        manifest.timeout,
        manifest.compiled,
        checked_shocks(interventions_of(capsule, trust) if shocks is None else shocks),
    )
    table = capsule.table("design")
    content = table.read_bytes() if table.is_file() else b""
    if digest(content) != manifest.design.get("sha256"):
        raise SocialmindError(
            f"{table}: is not the design that the sweep was begun with; take it from a copy of the "
            "folder, or start another sweep"
        )
    points = points_of_parquet(content, columns, names)
    replicates = Replicates.of_record(manifest.replicates)
    return Prepared(common, points, replicates, names, tuple(manifest.series_columns))


def checked_shocks(shocks: Sequence[Any]) -> tuple[Shock, ...]:
    """Return shocks in the order of their ticks.

    Raises:
        SocialmindError: there is something else.
    """
    for one in shocks:
        if not isinstance(one, Shock):
            raise SocialmindError(f"shocks: found {shown(one)}; expected Shock(TICK, FUNCTION)")
    return tuple(sorted(shocks, key=lambda one: one.tick))
