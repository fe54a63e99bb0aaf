"""Interventions as a run keeps them: what its manifest says of them, and copies of their files."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from dataclasses import asdict
from pathlib import Path
from typing import TYPE_CHECKING, Any

from coglogo_py import CognitiveScheme
from socialmind.errors import SocialmindError
from socialmind.interventions.change import Change
from socialmind.interventions.edit import Edit
from socialmind.interventions.following import Intervention, in_order
from socialmind.interventions.shock import Shock, loaded
from socialmind.interventions.steer import Steer
from socialmind.runs.record import within
from socialmind.runs.schemes import as_kept
from socialmind.sources.folders import digest
from socialmind.sources.provenance import KEPT, difference_of_copies, sources_of_module
from socialmind.sources.trust import programs_in, remember, require

if TYPE_CHECKING:
    from socialmind.model import Model
    from socialmind.runs.sources import Made

FOLDER = "interventions"
Records = list[dict[str, Any]]


def copies_of(
    interventions: Iterable[Intervention], model_class: type[Model], first: int = 0
) -> tuple[Records, dict[str, bytes]]:
    """Return interventions as a run keeps them.

    Args:
        interventions: in order.
        model_class: of the run.
        first: the number of the first, in its folder's name.

    Returns:
        What the manifest says of each; and the content of each file, by its place in the folder.

    Raises:
        SocialmindError: a function stands in no file, or in one that was edited since; or a scheme
            cannot be read.
    """
    records: Records = []
    files: dict[str, bytes] = {}
    for number, one in enumerate(interventions, first):
        if isinstance(one, Shock):
            home = f"{FOLDER}/{number:02d}-{re.sub(r'[^0-9A-Za-z_]', '_', one.name)}"
            record, own = _kept_shock(one, home)
        elif isinstance(one, Edit | Steer):
            record, own = asdict(one), {}
        else:
            record, own = _kept_change(one, f"{FOLDER}/{number:02d}", model_class)
        records.append(record)
        files |= own
    return records, files


def _kept_shock(shock: Shock, home: str) -> tuple[dict[str, Any], dict[str, bytes]]:
    file = shock.file
    if file is None:
        raise SocialmindError(
            f"the shock {shock.name} at tick {shock.tick} is not at the top of a file, so a run "
            "could not repeat it; write it in one, and give FILE.py:FUNCTION"
        )
    sources = sources_of_module(shock.function.__module__)
    record = sources.record()
    copies = sources.copies()
    remember({path: content for path, content in copies.items() if path.endswith(".py")})
    said = {
        "tick": shock.tick,
        "function": shock.name,
        "file": f"{home}/{KEPT}/model/{file.name}",
        "sources": record,
    }
    return said, {f"{home}/{path}": content for path, content in copies.items()}


def _kept_change(
    change: Change, home: str, model_class: type[Model]
) -> tuple[dict[str, Any], dict[str, bytes]]:
    schemes, files = {}, {}
    for name, source in change.schemes.items():
        makers = model_class.populations[name].decision_makers
        if isinstance(source, CognitiveScheme):
            scheme = source
        else:
            scheme = CognitiveScheme.load(source, makers)
        suffix, content = as_kept(source)
        file = f"{home}/scheme-{name}{suffix}"
        schemes[name] = {"name": scheme.name, "file": file, "sha256": digest(content)}
        files[file] = content
    checked = {
        name: model_class.parameters[name].checked(value)
        for name, value in change.parameters.items()
    }
    return {"tick": change.tick, "parameters": checked, "schemes": schemes}, files


def interventions_of(capsule: Made, trust: bool = False) -> tuple[Intervention, ...]:
    """Return the interventions of a run or a sweep, from the copies that it keeps.

    Args:
        capsule: the run, or the sweep.
        trust: run programs that this user has neither named nor run before.

    Raises:
        SocialmindError: a copy is missing or was changed, or holds unknown programs.
    """
    return in_order(_intervention(capsule, one, trust) for one in capsule.manifest.interventions)


def _intervention(capsule: Made, record: Mapping[str, Any], trust: bool) -> Intervention:
    if "function" in record:
        return _shock_of(capsule, record, trust)
    if "commands" in record:
        return Steer(**record)
    return Edit(**record) if "agent" in record else _change_of(capsule, record)


def _shock_of(capsule: Made, record: Mapping[str, Any], trust: bool) -> Shock:
    file = within(capsule.folder, record["file"])
    home = file.parents[1]
    changed = difference_of_copies(record["sources"], home.parent)
    if changed:
        raise SocialmindError(f"{changed}; take it from a copy of the folder")
    what = f"{capsule.folder}: its copy of the shock {record['function']}"
    require(programs_in(home), trust, what)
    return Shock(record["tick"], loaded(file, record["function"], home / "modules"))


def _change_of(capsule: Made, record: Mapping[str, Any]) -> Change:
    schemes: dict[str, CognitiveScheme | Path] = {}
    for name, one in record["schemes"].items():
        path = within(capsule.folder, one["file"])
        if not path.is_file() or digest(path.read_bytes()) != one["sha256"]:
            raise SocialmindError(
                f"{path}: this scheme of the run is missing or was changed; take it from a copy "
                "of the folder"
            )
        schemes[name] = path
    return Change(record["tick"], record["parameters"], schemes)
