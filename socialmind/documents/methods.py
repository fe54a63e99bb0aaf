"""The paragraph of methods that a paper says of a run or a sweep, from the folder's manifest."""

from __future__ import annotations

import json
import shlex
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from socialmind.documents.methods_of_sweeps import paragraph_of_sweep
from socialmind.documents.methods_said import (
    as_argument,
    as_option,
    interventions_said,
    listed,
    luck,
    minds_used,
    opening,
    ticks_said,
    valued,
)  # fmt: skip
from socialmind.documents.odd.entities import written
from socialmind.errors import SocialmindError
from socialmind.runs.folders import FINISHED, MANIFEST, kind_of

if TYPE_CHECKING:
    from socialmind.model import Model


def methods(folder: Path, trust: bool = False) -> str:
    """Return the paragraph of methods of a run or a sweep.

    Args:
        folder: the run's, or the sweep's.
        trust: load the run's model, whose declaration has units and defaults, also if this user has
            neither named nor run it before.

    Raises:
        SocialmindError: the folder holds neither.
    """
    return _of_sweep(folder, trust) if kind_of(folder) == "sweep" else _of_run(folder, trust)


def _of_run(folder: Path, trust: bool) -> str:
    from socialmind.runs.capsule import Capsule
    from socialmind.runs.sources import changes_since, recorded_class

    capsule = Capsule(folder)
    manifest = capsule.manifest
    try:
        model_class: type[Model] | None = recorded_class(capsule, trust=trust)
    except SocialmindError:
        model_class = None  # the paragraph then says all values, without units
    parts = [opening(manifest.model, manifest.versions, manifest.platforms, model_class)]
    length = f"{manifest.ticks:,} ticks"
    parts.append(f"One run of {length} was made with the seed {manifest.seed}.")
    if manifest.status != FINISHED:
        parts.append(f"It is {manifest.status}, after {manifest.ticks_done:,} ticks.")
    parts.append(settings(manifest.parameters, model_class))
    parts += minds_used(manifest.schemes, manifest.minds)
    if manifest.branch is not None:
        parts.append(f"It left {manifest.branch['run']} at tick {manifest.branch['tick']:,}.")
    parts.append(interventions_said(manifest.interventions))
    if manifest.engine != "compiled":
        parts.append(f"Bodies were moved by {manifest.engine}.")
    parts.append(
        f"The society was recorded every {ticks_said(manifest.every)}, its agents every "
        f"{ticks_said(manifest.agents_every)}."
    )
    changed = changed_from_defaults(manifest.parameters, model_class)
    command = ["socialmind", "run", as_argument(manifest.model), "--ticks", str(manifest.ticks),
               "--seed", str(manifest.seed), "--every", str(manifest.every), "--agents-every",
               str(manifest.agents_every)]  # fmt: skip
    for one, value in changed.items():
        command += ["--set", f"{one}={as_option(value)}"]
    for option, copies in (("--scheme", capsule.schemes), ("--mind", capsule.minds)):
        for population, copy in copies.items():
            if not _is_own_scheme(copy, population, model_class):
                command += [option, f"{population}={copy}"]
    if manifest.engine != "compiled":
        command += ["--engine", manifest.engine]
    shocks = _as_options(manifest.interventions, capsule.folder)
    parts.append(luck())
    place = shlex.quote(str(folder))
    replay = f"`socialmind replay {place}`"
    if model_class is None or changes_since(capsule, model_class) is not None:
        parts.append("The model's files are not at hand as they ran; the run keeps copies of them:")
        replay = f"`socialmind replay {place} --source kept`"
    elif manifest.model["path"] is None:
        parts.append("The model was typed into a notebook; the run keeps it as a file:")
    elif shocks is not None:
        parts.append(f"The run is repeated by `{shlex.join(command + shocks)}`;")
    parts.append(f"{replay} repeats it from its folder and compares every number.")
    return " ".join(part for part in parts if part)


def _of_sweep(folder: Path, trust: bool) -> str:
    import pandas as pd

    from socialmind.experiments.sweeps.capsule import SweepCapsule
    from socialmind.runs.sources import recorded_class

    content = json.loads((folder / MANIFEST).read_text("utf-8"))
    design = folder / "design.parquet"
    points = pd.read_parquet(design) if design.is_file() else None
    try:
        model_class: type[Model] | None = recorded_class(SweepCapsule(folder), trust=trust)
    except SocialmindError:
        model_class = None  # the paragraph then lacks units and defaults
    return paragraph_of_sweep(content, points, folder, model_class)


def _as_options(records: Sequence[Mapping[str, Any]], folder: Path) -> list[str] | None:
    """Return interventions as options of `socialmind run`; None where these cannot say them."""
    options: list[str] = []
    for one in records:
        # A copy that imports others of the user's finds them in a replay alone.
        if "function" not in one or len(one["sources"]["files"]) > 1:
            return None
        options += ["--shock", f"{one['tick']}:{folder / one['file']}:{one['function']}"]
    return options


def _is_own_scheme(copy: Path, population: str, model_class: type[Model] | None) -> bool:
    """Whether a run's copy of a scheme is the file that its model has."""
    if model_class is None or not copy.is_file():
        return False
    scheme = model_class.folder() / str(model_class.populations[population].mind)
    return scheme.is_file() and scheme.read_bytes() == copy.read_bytes()


def settings(parameters: Mapping[str, Any], model_class: type[Model] | None) -> str:
    """Return the sentence of the parameters: what differs from the defaults, then those.

    Args:
        parameters: the value of each.
        model_class: what declares them; None where it is not at hand.
    """
    if not parameters:
        return ""
    if model_class is None:
        return f"Its parameters were {listed([valued(*one) for one in parameters.items()])}."
    declared = model_class.parameters
    changed = changed_from_defaults(parameters, model_class)
    told = [
        f"{valued(name, value, declared[name].unit)} (default {written(declared[name].default)})"
        for name, value in changed.items()
    ]
    usual = [
        valued(name, value, declared[name].unit)
        for name, value in parameters.items()
        if name not in changed and name in declared
    ]
    sentences = []
    if told:
        sentences.append(f"{listed(told)} differed from the defaults.")
    if usual:
        lead = "All other parameters had" if told else "All parameters had"
        sentences.append(f"{lead} their defaults: {listed(usual)}.")
    return " ".join(sentences)


def changed_from_defaults(
    parameters: Mapping[str, Any], model_class: type[Model] | None
) -> dict[str, Any]:
    """Return the parameters that have other values than the defaults; all without a model."""
    if model_class is None:
        return dict(parameters)
    declared = model_class.parameters
    return {
        name: value
        for name, value in parameters.items()
        if name in declared and value != declared[name].default
    }
