"""What a finished fit leaves in its folder: tables, the values found, figures, and the report."""

from __future__ import annotations

import csv
import io
import json
import math
import shlex
from collections.abc import Sequence
from dataclasses import replace
from typing import Any

from socialmind.experiments.calibration.capsule import FitCapsule
from socialmind.experiments.calibration.finding import Found
from socialmind.experiments.calibration.plan import Plan
from socialmind.experiments.calibration.reporting import tables
from socialmind.experiments.calibration.result import BEST, Fit
from socialmind.experiments.calibration.search import Search
from socialmind.experiments.sweeps.one_run import Common
from socialmind.experiments.sweeps.points.varied import MIND, PARAMETER, SCHEME, WORD
from socialmind.runs.folders import FINISHED
from socialmind.runs.schemes import as_kept
from socialmind.sources.folders import catalogue
from socialmind.work.files import replace_file

POINT = "best.csv"
REPORT = "report.md"
FIGURES = "figures"


def write_results(
    capsule: FitCapsule,
    common: Common,
    plan: Plan,
    searches: Sequence[Search],
    found: Sequence[Found],
) -> None:
    """Write all that a fit leaves; the same fit writes the same bytes, figures in PNG apart.

    Args:
        capsule: its folder.
        common: what its runs have in common.
        plan: what it did.
        searches: at their end, the fit's own first.
        found: what each found.
    """
    from socialmind.drawing import style as paper
    from socialmind.experiments.calibration.reporting.pictures import figures_of
    from socialmind.experiments.calibration.reporting.report import report_of

    frames = {
        tables.TRIALS: tables.trials_table(plan, searches),
        tables.RECOVERY: tables.recovery_table(plan, found),
        tables.PROFILES: tables.profiles_table(plan, searches[0], found[0].luck),
        tables.BEST_RUNS: tables.best_runs_table(plan, searches[0]),
    }
    for name, frame in frames.items():
        replace_file(capsule.table(name), tables.parquet(frame))
    values = found[0].values or ()
    schemes = _schemes(common, values)
    for name, content in schemes.items():
        replace_file(capsule.folder / name, content)
    stream = io.StringIO()
    writer = csv.writer(stream, lineterminator="\n")
    writer.writerow(plan.space.names)
    writer.writerow([repr(one) for one in values])
    replace_file(capsule.folder / POINT, stream.getvalue().encode())
    best = {
        **_said(plan, found[0]),
        "run": _run(capsule, common, values, schemes),
        "sweep": _sweep(capsule),
    }
    text = json.dumps(best, indent=2, ensure_ascii=False, allow_nan=False)
    replace_file(capsule.folder / BEST, (text + "\n").encode())
    made = _seen(capsule)
    paper.save(figures_of(made), capsule.folder / FIGURES)
    replace_file(capsule.folder / REPORT, report_of(made).encode())


def _seen(capsule: FitCapsule) -> Fit:
    """Return the fit as it will be read, before it says that it is finished."""
    made = Fit.__new__(Fit)
    seen = FitCapsule(capsule.folder)
    seen.manifest = replace(seen.manifest, status=FINISHED)
    made._capsule = seen
    return made


def _said(plan: Plan, found: Found) -> dict[str, Any]:
    names = plan.space.names
    return {
        "values": dict(zip(names, found.values or (), strict=True)),
        "intervals": {
            name: None if one is None else list(one)
            for name, one in zip(names, found.intervals, strict=True)
        },
        "trial": found.trial,
        "distance": _known(found.distance),
        "distance_on_new_seeds": _known(found.again),
        "luck": _known(found.luck),
        "plausible_trials": found.plausible,
    }


def _known(value: float) -> float | None:
    return value if math.isfinite(value) else None


def _schemes(common: Common, values: Sequence[Any]) -> dict[str, bytes]:
    """Return the schemes that differ from the model's own, by their files."""
    settings = common.settings
    every = (*settings.columns, *(one for one, _ in settings.fixed))
    changed = {one.population for one in every if one.kind in (SCHEME, WORD)}
    schemes = settings.arguments(values)["scheme"] or {}
    return {f"best_{owner}.yaml": as_kept(schemes[owner])[1] for owner in sorted(changed)}


def _model(capsule: FitCapsule) -> str:
    """Return the model as a command names it."""
    name, path = capsule.manifest.model["name"], capsule.manifest.model.get("path")
    return str(name) if name in catalogue() or not path else shlex.quote(str(path))


def _run(
    capsule: FitCapsule, common: Common, values: Sequence[Any], schemes: dict[str, bytes]
) -> str:
    settings = common.settings
    words = ["socialmind run", _model(capsule), f"--ticks {common.ticks}"]
    pairs = [*settings.fixed, *zip(settings.columns, values, strict=True)]
    for one, value in pairs:
        if one.kind == PARAMETER:
            words.append(f"--set {shlex.quote(f'{one.name}={value}')}")
        elif one.kind == MIND:
            words.append(f"--mind {shlex.quote(f'{one.population}={value}')}")
    for file in schemes:
        owner = file.removeprefix("best_").removesuffix(".yaml")
        words.append(f"--scheme {owner}={file}")
    return " ".join(words)


def _sweep(capsule: FitCapsule) -> str:
    manifest = capsule.manifest
    words = [f"socialmind sweep {_model(capsule)} --design {POINT}"]
    words += [f"--set {shlex.quote(f'{name}={value}')}" for name, value in manifest.fixed.items()]
    for name, one in manifest.measures.items():
        said = one.get("expression") or one.get("file")
        if said:
            words.append(f"--measure {shlex.quote(f'{name}={said}')}")
    return " ".join([*words, f"--ticks {manifest.ticks} --seeds 0:50"])
