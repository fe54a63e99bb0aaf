"""How a training that stopped is gone on with from a page: by which command, if there is one."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from socialmind.learning.training.capsule import TrainingManifest
from socialmind.sources.folders import STUDIES_FILE, shipped

STUDIES = "analysis"


@dataclass(frozen=True)
class Command:
    """What goes on with a training.

    Attributes:
        words: what follows `python -m`.
        folder: in which it is given; None for wherever.
    """

    words: Sequence[str]
    folder: Path | None = None


def resuming(folder: Path, manifest: TrainingManifest) -> Command | None:
    """Return what goes on with a training: `socialmind learn`, or the command of a study's plans.

    A manifest only names a plan: what is run is a module of a study that ships, on a training that
    lies where this study makes it.

    Args:
        folder: the training's.
        manifest: its own.

    Returns:
        The command; None where lessons were given in Python by somebody else.
    """
    if manifest.chosen != []:
        return Command(["socialmind", "learn", "--resume", str(folder), "--quiet"])
    module, name = (manifest.plan.get(one, "") for one in ("module", "name"))
    found = re.fullmatch(rf"{STUDIES}\.(\w+)\.(\w+)", module)
    home = shipped(STUDIES, STUDIES_FILE).get(found[1]) if found else None
    if found is None or home is None or home.parent.name != STUDIES:
        return None
    made = home / "trainings" / name
    if not (home / f"{found[2]}.py").is_file() or made.resolve() != folder.resolve():
        return None
    return Command([module, made.name], home.parents[1])
