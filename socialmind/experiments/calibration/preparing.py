"""What a fit needs before its first run: all that was asked for, checked, and its folder.

What runs have in common (model, schemes, minds, measures, copies of the source) is checked and kept
as a sweep keeps it, in the folder `setting`: a sweep over the middle and the ends of the ranges.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from datetime import UTC, datetime
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING, Any

import numpy as np

from socialmind.errors import SocialmindError
from socialmind.experiments.calibration.capsule import SETTING, TARGET, FitCapsule, FitManifest
from socialmind.experiments.calibration.methods.registry import libraries, method_called
from socialmind.experiments.calibration.plan import Plan, data_runs_of
from socialmind.experiments.calibration.space import Range, Space, space_of
from socialmind.experiments.calibration.target import (
    SERIES,
    Target,
    check_columns,
    target_of,
)
from socialmind.experiments.sweeps.beginning import begun as begun_sweep
from socialmind.experiments.sweeps.one_run import Common
from socialmind.experiments.sweeps.preparing import nameable, taken_up
from socialmind.experiments.sweeps.replicates import Replicates
from socialmind.runs import folders
from socialmind.sources.folders import digest

if TYPE_CHECKING:
    from socialmind.model import Model


@dataclass(frozen=True)
class Asked:
    """What is asked of a fit, as `fit` takes it."""

    target: Any
    vary: Mapping[str, Range]
    budget: int
    ticks: int | None
    method: str
    seeds: int
    recover: int
    data_runs: int | None
    seed: int
    fixed: Mapping[str, Any]
    measures: Mapping[str, Any]
    every: int | None
    compiled: bool


@dataclass(frozen=True)
class Prepared:
    """A fit that can begin, or go on.

    Attributes:
        common: what its runs have in common.
        plan: what it will do.
    """

    common: Common
    plan: Plan


def begun(
    model_class: type[Model], asked: Asked, out: str | Path | None
) -> tuple[FitCapsule, list[str]]:
    """Check all that was asked for, and make the folder of a fit.

    Returns:
        The folder, and what is to be said of the fit before it starts.

    Raises:
        SocialmindError: what was asked for cannot be.
    """
    place = None if out is None else Path(out).expanduser()
    if place is not None:
        folders.refuse_unless_free(place)
    target = target_of(asked.target)
    there = nameable(model_class)
    space = space_of(asked.vary, there)
    plan = Plan(
        space, target, asked.method, asked.budget, asked.seeds, asked.recover,
        data_runs_of(target, asked.data_runs), asked.seed,
    )  # fmt: skip
    method_called(plan.method)(len(space.dimensions), plan.trials, 0)  # is its library there?
    ticks, every = _lengths(target, asked)
    import pandas as pd

    corners = [space.values(np.full(len(space.dimensions), at)) for at in (0.5, 0.0, 1.0)]
    design = pd.DataFrame(corners, columns=space.names).astype(object)
    with TemporaryDirectory() as home:
        setting, _ = begun_sweep(
            model_class, design, ticks, Replicates((0,)), asked.fixed, every, "none",
            asked.measures, None, asked.compiled, (), Path(home) / SETTING,
        )  # fmt: skip
        check_columns(target, setting.manifest.series_columns, list(asked.measures))
        files = {
            f"{SETTING}/{path.relative_to(setting.folder).as_posix()}": path.read_bytes()
            for path in sorted(setting.folder.rglob("*"))
            if path.is_file()
        }
        kept = setting.manifest
    files[TARGET] = target.csv()
    manifest = FitManifest(
        model=kept.model,
        target={"kind": target.kind, "file": target.name, "sha256": digest(files[TARGET])},
        vary=space.record(),
        method=plan.method,
        budget=plan.budget,
        seeds=plan.seeds,
        recover=plan.recover,
        data_runs=plan.data_runs,
        seed=plan.seed,
        ticks=kept.ticks,
        runs=plan.runs,
        fixed=kept.fixed,
        measures=kept.measures,
        timings={"created": datetime.now(UTC).isoformat(timespec="seconds"), "seconds": 0.0},
        versions={**folders.versions(), **libraries(plan.method)},
        platforms=[folders.fingerprint()],
    )
    clashes = there.clashes([*space.names, *asked.fixed])
    return FitCapsule.create(place, manifest, files), [*clashes, *plan.said(kept.ticks)]


def taken_up_from(
    capsule: FitCapsule,
    model_class: type[Model] | None = None,
    measures: Mapping[str, Any] | None = None,
    trust: bool = False,
) -> Prepared:
    """Return the fit that a folder keeps.

    Args:
        capsule: the folder.
        model_class: the model; loaded from where the manifest says by default.
        measures: functions in place of those that stand in no file.
        trust: run programs that this user has neither named nor run before.

    Raises:
        SocialmindError: its model, target, socialmind or the method's library were changed since.
    """
    manifest = capsule.manifest
    method_called(manifest.method)
    for library, now in libraries(manifest.method).items():
        then = manifest.versions.get(library)
        if then != now:
            raise SocialmindError(
                f"{capsule.folder}: made with {library} {then}, this is {now}, which may draw "
                f"other trials; install {then}, or start another fit"
            )
    setting = taken_up(capsule.setting(), model_class, measures, trust)
    path = capsule.folder / TARGET
    content = path.read_bytes() if path.is_file() else b""
    if digest(content) != manifest.target["sha256"]:
        raise SocialmindError(
            f"{path}: is not the target that the fit was begun with; take it from a copy of the "
            "folder, or start another fit"
        )
    ranges = {
        one["name"]: [one["low"], one["high"], *(["log"] if one["log"] else [])]
        for one in manifest.vary
    }
    space = Space(space_of(ranges, nameable(setting.common.model_class)).dimensions)
    plan = Plan(
        space, Target.of_csv(content, manifest.target.get("file", "")), manifest.method,
        manifest.budget, manifest.seeds, manifest.recover, manifest.data_runs, manifest.seed,
    )  # fmt: skip
    return Prepared(setting.common, plan)


def _lengths(target: Target, asked: Asked) -> tuple[int | None, int | None]:
    """Return how long runs are, and how often their series are looked at; 0 for as a measure does.

    Raises:
        SocialmindError: runs end before the data do.
    """
    if target.kind != SERIES:
        return asked.ticks, asked.every or 0
    last = target.ticks[-1]
    ticks = last if asked.ticks is None else asked.ticks
    if ticks < last:
        raise SocialmindError(
            f"{target.name or 'target'}: its last tick is {last:,}, and runs end at {ticks:,}; "
            f"give --ticks {last}, or cut the data"
        )
    if asked.every:
        raise SocialmindError(
            "--every is for measures of statistics; a series is looked at when the data were"
        )
    return ticks, math.gcd(*target.ticks) or max(1, ticks)
