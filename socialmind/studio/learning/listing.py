"""Which trainings there are below a folder, and how each stands."""

from __future__ import annotations

import os
import platform
from pathlib import Path
from typing import Any

from socialmind.errors import SocialmindError
from socialmind.learning.training.capsule import KIND, TrainingCapsule, TrainingManifest
from socialmind.learning.training.pausing import is_asked
from socialmind.runs import folders
from socialmind.studio.learning.resuming import resuming

DEPTH = 4
"""Folders below one another that are looked into."""
STOPPED, ELSEWHERE = "stopped", "elsewhere"
"""A training that its folder says is running, while no process holds it as far as this machine
sees: it was killed; or its process was another machine's, and may be going on there."""
_NEVER = frozenset(("node_modules", "__pycache__", "site-packages"))


def trainings_below(home: Path) -> list[Path]:
    """Return the folders of trainings below a folder, the newest first.

    Neither hidden folders nor links are looked into, nor what lies in runs and trainings.

    Args:
        home: where to look; up to `DEPTH` folders below one another.
    """
    found = []
    for place, inner, files in os.walk(home):
        folder = Path(place)
        if folders.MANIFEST in files:
            inner.clear()
            if _is_training(folder):
                found.append(folder)
            continue
        if len(folder.relative_to(home).parts) >= DEPTH:
            inner.clear()
        inner[:] = sorted(one for one in inner if not one.startswith(".") and one not in _NEVER)
    return sorted(found, key=lambda one: -(one / folders.MANIFEST).stat().st_mtime)


def _is_training(folder: Path) -> bool:
    """Whether a folder is a training's, whole or broken."""
    try:
        return folders.kind_of(folder) == KIND or folder.parent.name == TrainingCapsule.HOME
    except (SocialmindError, OSError):
        return False


def summary(folder: Path) -> dict[str, Any]:
    """Return what a list says of a training: whose, how far, since when; or what is wrong with it.

    Args:
        folder: the training's.
    """
    try:
        manifest = TrainingCapsule(folder).manifest
    except (SocialmindError, OSError) as error:
        return {"status": "broken", "error": str(error)}
    held = folders.is_held(folder)
    status = status_of(manifest, held)
    return {
        "status": status,
        "held": held,
        "process": manifest.process or None,
        "pausing": held and status == folders.RUNNING and is_asked(folder),
        "resumable": resuming(folder, manifest) is not None,
        "command": manifest.command,
        "error": manifest.error,
        "model": manifest.model["name"],
        "lessons": [one["name"] for one in lessons_in(manifest.lessons)],
        "attempts": manifest.attempts,
        "finished": manifest.finished,
        "seed": str(manifest.seed),  # a page's numbers have but 53 bits
        "created": manifest.timings.get("created"),
        "seconds": manifest.timings.get("seconds", 0.0),
    }


def status_of(manifest: TrainingManifest, held: bool) -> str:
    """Return how a training stands: its manifest's word, unless it was killed.

    Args:
        manifest: as it is on disk.
        held: whether a process holds the training's folder.

    Returns:
        ``running``, ``stopped``, ``elsewhere``, ``interrupted``, ``failed`` or ``finished``.
    """
    if manifest.status != folders.RUNNING or held:
        return manifest.status
    here = platform.node()
    return STOPPED if manifest.process.get("host", here) == here else ELSEWHERE


def lessons_in(items: list[dict[str, Any]]) -> list[dict[str, Any]]:
    """Return the lessons of a curriculum as a manifest has it, those of cycles once."""
    return [one for item in items for one in item.get("lessons", [item])]
