"""What lies below the folders of the studio: runs, sweeps, by their manifests."""

from __future__ import annotations

import os
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from socialmind.errors import SocialmindError
from socialmind.runs.folders import MANIFEST
from socialmind.runs.record import read_record
from socialmind.studio.server.folders import Folders

DEPTH = 3
"""How far below a folder it is looked."""
HOMES = {"run": "runs", "sweep": "sweeps", "training": "trainings", "fit": "fits"}
"""The folders in which what is not given a place is made, by kind."""
MOST = 400
"""How many are told of, the youngest first."""


def folders_of(folders: Folders, kind: str) -> list[dict[str, Any]]:
    """Return the runs or sweeps below the folders, the youngest first.

    What cannot be read is told of with an ``error``.

    Args:
        folders: where pages may read.
        kind: "run" or "sweep".
    """
    found = []
    for manifest in _manifests(folders.home, DEPTH):
        said: dict[str, Any] = {"folder": folders.shown(manifest.parent)}
        try:
            said["changed"] = manifest.stat().st_mtime
            record = read_record(manifest, "a manifest")
            if (record.get("kind") or "run") != kind:
                continue
            said |= _told(record)
        except (SocialmindError, OSError, KeyError, TypeError) as error:
            if manifest.parent.parent.name in set(HOMES.values()) - {HOMES[kind]}:
                continue  # a broken one of another kind
            said["error"] = str(error)
        found.append(said)
    found.sort(key=lambda one: -one.get("changed", 0.0))
    return found[:MOST]


def _told(record: dict[str, Any]) -> dict[str, Any]:
    told = {name: record.get(name) for name in ("seed", "ticks", "ticks_done", "status", "points")}
    told["seed"] = str(told["seed"])  # a page's numbers have but 53 bits
    told["created"] = record.get("timings", {}).get("created")
    told["branch"] = (record.get("branch") or {}).get("run")
    return {"model": record["model"]["name"], "columns": record.get("columns"), **told}


def _manifests(folder: Path, depth: int) -> Iterator[Path]:
    """Yield the manifests below a folder; what lies within a run is its own."""
    if (folder / MANIFEST).is_file():
        yield folder / MANIFEST
        return
    if depth == 0:
        return
    try:
        below = sorted(os.scandir(folder), key=lambda one: one.name)
    except OSError:
        return
    for one in below:
        if one.is_dir(follow_symlinks=False) and not one.name.startswith((".", "_")):
            yield from _manifests(Path(one.path), depth - 1)
