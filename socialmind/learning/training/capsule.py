"""A training's folder: what is learned and from what, and where its files lie.

How far an attempt came is the word of its own checkpoint.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from shlex import quote
from typing import Annotated, Any, ClassVar

from socialmind.runs import folders
from socialmind.runs import record as kinds
from socialmind.runs.record import within

KIND = "training"
MIND = "mind"
COMMIT = "commit"
_CHANGES = kinds.Fields(
    dict.fromkeys(("generations", "budget", "cycles"), kinds.optional(kinds.whole(1))),
    {"optimiser": kinds.optional(kinds.TEXT), "settings": kinds.Each(kinds.SETTING)},
)
_LESSONS = kinds.Many(kinds.Each(kinds.Kind("anything", lambda value: True)))
_CHOSEN = kinds.Kind(
    "a list of names, or null",
    lambda value: value is None or (isinstance(value, list) and all(map(kinds.TEXT.holds, value))),
)
_PROCESS = kinds.Fields({}, {"host": kinds.TEXT, "pid": kinds.whole()})
_TIMINGS = kinds.Fields({}, {"created": kinds.TEXT, "seconds": kinds.NUMBER})


def _is_plan(value: Any) -> bool:
    if not isinstance(value, dict) or not value:
        return value == {}
    module, name = value.get("module"), value.get("name")
    named = isinstance(name, str) and name.isprintable()
    return named and isinstance(module, str) and all(map(str.isidentifier, module.split(".")))


_PLAN = kinds.Kind("a module and the name of its plan, or nothing", _is_plan)


@dataclass(frozen=True)
class TrainingManifest(folders.FolderManifest):
    """What a training is and how far it came; the content of its ``manifest.json``.

    Args:
        model: ``name``, ``path``, ``source_sha256`` and ``sources``, as for a run; all None where
            the lessons were given without a model.
        lessons: of the curriculum: all that decides their results.
        chosen: the names or files of the lessons that were asked for; None for the model's whole
            curriculum; the empty list for lessons that were given in Python.
        changes: what was asked for in place of the lessons' own: ``optimiser``, ``settings``,
            ``generations``, ``budget``, ``cycles``.
        plan: ``module`` and ``name`` of the study's plan that gives its lessons, as `python -m`
            takes them (`TrainingPlans.main`); empty for others.
        mind: the ``name`` of the mind that learning began from, and the ``sha256`` of the copy.
        seed: of the training.
        engine: `compiled` or `pymunk`.
        attempts: how many were asked for.
        finished: how many are finished.
        status: ``running``, ``interrupted``, ``failed`` or ``finished``.
        error: what stopped a failed training.
        process: ``host`` and ``pid`` of the process that goes on with it; empty while none does,
            left as it was by one that was killed.
        curve: ``rows``, ``columns`` and ``sha256`` of the content of ``curve.parquet``, without
            the seconds.
        timings: ``created`` (UTC) and ``seconds`` in all.
        versions: of what the training stood on; ``commit``, of the program, where that runs from an
            unedited clone of its repository, and ``commit from attempt 3`` where it is another one;
            ``commit from lesson 7 to attempt 10`` where lessons were added to attempts. They are
            the programs that began attempts and added lessons; another one may have gone on. Where
            the commit is younger than the training it was filled in later: a program that gives
            the same first generations, and where `rerun` found so the same weights.
        platforms: the fingerprints of the machines that led it.
        kind: `training`.
        format: of this file.
    """

    model: Annotated[dict[str, Any], kinds.model_called(kinds.optional(kinds.TEXT))]
    lessons: Annotated[list[dict[str, Any]], _LESSONS]
    chosen: Annotated[list[str] | None, _CHOSEN]
    changes: Annotated[dict[str, Any], _CHANGES]
    mind: Annotated[dict[str, str], kinds.Fields({"name": kinds.TEXT, "sha256": kinds.SHA256})]
    seed: Annotated[int, kinds.SEED]
    engine: Annotated[str, kinds.ENGINE]
    attempts: Annotated[int, kinds.whole(1, 2**31)]
    finished: Annotated[int, kinds.whole()] = 0
    status: Annotated[str, folders.STATUS] = folders.RUNNING
    error: Annotated[str | None, kinds.optional(kinds.TEXT)] = None
    plan: Annotated[dict[str, str], _PLAN] = field(default_factory=dict)
    process: Annotated[dict[str, Any], _PROCESS] = field(default_factory=dict)
    curve: dict[str, Any] = field(default_factory=dict)
    timings: Annotated[dict[str, Any], _TIMINGS] = field(default_factory=dict)
    versions: Annotated[dict[str, str], kinds.TEXTS] = field(default_factory=dict)
    platforms: Annotated[list[dict[str, str]], kinds.Many(kinds.TEXTS)] = field(
        default_factory=list
    )
    kind: str = KIND
    format: int = folders.FORMAT

    WHAT: ClassVar[str] = KIND

    @property
    def command(self) -> str | None:
        """The command of the study's plan that goes on with it; None where it is of none."""
        if not self.plan:
            return None
        return f"python -m {self.plan['module']} {quote(self.plan['name'])}"


def commit_of(versions: Mapping[str, str], attempt: int) -> str:
    """Return the commit of the program that an attempt comes out by, empty where none is known.

    >>> commit_of({"commit": "3d4ad57", "commit from attempt 3": "8e6425c"}, attempt=2)
    '3d4ad57'
    """
    for number in range(attempt, 1, -1):
        if (key := f"{COMMIT} from attempt {number}") in versions:
            return versions[key]
    return versions.get(COMMIT, "")


def with_commit(versions: Mapping[str, str], attempt: int, commit: str) -> dict[str, str]:
    """Return the versions of a training whose next attempt is begun by the program of a commit.

    >>> with_commit({"commit": "3d4ad57"}, 3, "8e6425c")
    {'commit': '3d4ad57', 'commit from attempt 3': '8e6425c'}
    """
    if commit == commit_of(versions, attempt):
        return dict(versions)
    key = COMMIT if attempt == 1 else f"{COMMIT} from attempt {attempt}"
    return {**versions, key: commit}


def with_commit_of_added(
    versions: Mapping[str, str], lesson: int, attempt: int, commit: str
) -> dict[str, str]:
    """Return the versions of a training to whose attempts lessons are added.

    Args:
        versions: as they were.
        lesson: the number of the first one that is added, from 1; a cycle counts as one.
        attempt: the last one that is begun.
        commit: of the program that adds them.

    >>> with_commit_of_added({"commit": "3d4ad57"}, 7, 10, "8e6425c")
    {'commit': '3d4ad57', 'commit from lesson 7 to attempt 10': '8e6425c'}
    """
    return {**versions, f"{COMMIT} from lesson {lesson} to attempt {attempt}": commit}


def stages_of(versions: Mapping[str, str], attempt: int, lessons: int) -> list[tuple[str, int]]:
    """Return the commits of the programs that taught an attempt, and up to which lesson each did.

    Args:
        versions: of the training.
        attempt: its number.
        lessons: how many it has in all; a cycle counts as one.

    >>> versions = {"commit": "3d4ad57", "commit from lesson 7 to attempt 10": "8e6425c"}
    >>> stages_of(versions, 10, 8), stages_of(versions, 11, 8)
    ([('3d4ad57', 6), ('8e6425c', 8)], [('3d4ad57', 8)])
    """
    found = [re.fullmatch(rf"{COMMIT} from lesson (\d+) to attempt (\d+)", one) for one in versions]
    added = sorted(
        (int(one[1]), versions[one[0]]) for one in found if one and attempt <= int(one[2])
    )
    commits = [commit_of(versions, attempt), *(commit for _, commit in added)]
    return list(zip(commits, [*(lesson - 1 for lesson, _ in added), lessons], strict=True))


class TrainingCapsule(folders.ManifestFolder[TrainingManifest]):
    """A training's folder on disk.

    Args:
        folder: of an existing training.

    Raises:
        SocialmindError: the folder is no training's.
    """

    MANIFEST_CLASS = TrainingManifest
    HOME = "trainings"

    @property
    def mind(self) -> Path:
        """The copy of the mind that learning began from."""
        return within(self.folder, MIND)

    @property
    def curve(self) -> Path:
        """The table of all generations."""
        return self.folder / "curve.parquet"

    @property
    def figures(self) -> Path:
        """The folder of the figures."""
        return self.folder / "figures"

    def attempt(self, number: int) -> Path:
        """The folder of an attempt's own files."""
        return within(self.folder, f"attempts/{number}")

    def learned(self, number: int) -> Path:
        """The folder of the mind that an attempt has learned."""
        return within(self.folder, f"mind-attempt-{number}")
