"""A training's folder: what is learned and from what, and where its files lie.

How far an attempt came is the word of its own checkpoint.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, ClassVar

from socialmind.errors import SocialmindError
from socialmind.runs.folders import (
    FAILED,
    FINISHED,
    FORMAT,
    INTERRUPTED,
    MANIFEST,
    RUNNING,
    FolderManifest,
    ManifestFolder,
    make_folder,
)
from socialmind.runs.record import (
    NUMBER,
    PATH,
    SETTING,
    SHA256,
    SOURCES,
    TEXT,
    Each,
    Fields,
    Kind,
    Many,
    one_of,
    optional,
    whole,
    within,
)

KIND = "training"
HOME = "trainings"
MIND = "mind"
_CHANGES = Fields(
    dict.fromkeys(("generations", "budget", "cycles"), optional(whole(1))),
    {"optimiser": optional(TEXT), "settings": Each(SETTING)},
)
_FIELDS = Fields(
    {
        "model": Fields(
            {"name": optional(TEXT), "path": optional(PATH), "source_sha256": optional(SHA256)},
            {"sources": SOURCES},
        ),
        "lessons": Many(Each(Kind("anything", lambda value: True))),
        "changes": _CHANGES,
        "mind": Fields({"name": TEXT, "sha256": SHA256}, {}),
        "seed": whole(0, 2**64 - 1),
        "engine": one_of("compiled", "pymunk"),
        "attempts": whole(1, 2**31),
    },
    {
        "chosen": Kind(
            "a list of names, or null",
            lambda value: (
                value is None
                or (isinstance(value, list) and all(isinstance(one, str) for one in value))
            ),
        ),
        "finished": whole(),
        "status": one_of(RUNNING, INTERRUPTED, FAILED, FINISHED),
        "error": optional(TEXT),
        "timings": Fields({}, {"created": TEXT, "seconds": NUMBER}),
        "versions": Each(TEXT),
        "platforms": Many(Each(TEXT)),
    },
)
"""What a manifest holds; fields that came later may be missing."""


@dataclass(frozen=True)
class TrainingManifest(FolderManifest):
    """What a training is and how far it came; the content of its ``manifest.json``.

    Args:
        model: ``name``, ``path``, ``source_sha256`` and ``sources``, as for a run; all None where
            the lessons were given without a model.
        lessons: of the curriculum: all that decides their results.
        chosen: the names or files of the lessons that were asked for; None for the model's whole
            curriculum; the empty list for lessons that were given in Python.
        changes: what was asked for in place of the lessons' own: ``optimiser``, ``settings``,
            ``generations``, ``budget``, ``cycles``.
        mind: the ``name`` of the mind that learning began from, and the ``sha256`` of the copy.
        seed: of the training.
        engine: `compiled` or `pymunk`.
        attempts: how many were asked for.
        finished: how many are finished.
        status: ``running``, ``interrupted``, ``failed`` or ``finished``.
        error: what stopped a failed training.
        curve: ``rows``, ``columns`` and ``sha256`` of the content of ``curve.parquet``, without
            the seconds.
        timings: ``created`` (UTC) and ``seconds`` in all.
        versions: of what the training stood on.
        platforms: the fingerprints of the machines that led it.
        kind: `training`.
        format: of this file.
    """

    model: dict[str, Any]
    lessons: list[dict[str, Any]]
    chosen: list[str] | None
    changes: dict[str, Any]
    mind: dict[str, str]
    seed: int
    engine: str
    attempts: int
    finished: int = 0
    status: str = RUNNING
    error: str | None = None
    curve: dict[str, Any] = field(default_factory=dict)
    timings: dict[str, Any] = field(default_factory=dict)
    versions: dict[str, str] = field(default_factory=dict)
    platforms: list[dict[str, str]] = field(default_factory=list)
    kind: str = KIND
    format: int = FORMAT

    WHAT: ClassVar[str] = KIND
    FIELDS: ClassVar[Fields] = _FIELDS

    @classmethod
    def _check_kind(cls, content: Mapping[str, Any], folder: Path) -> None:
        if content.get("kind") != KIND:
            raise SocialmindError(
                f"{folder}: not a training's folder; `socialmind run --resume` goes on with a run"
            )


class TrainingCapsule(ManifestFolder[TrainingManifest]):
    """A training's folder on disk.

    Args:
        folder: of an existing training.

    Raises:
        SocialmindError: the folder is no training's.
    """

    def __init__(self, folder: str | Path) -> None:
        self.folder = Path(folder).expanduser().absolute()
        self.manifest = TrainingManifest.load(self.folder / MANIFEST)

    MANIFEST_CLASS = TrainingManifest

    @classmethod
    def create(
        cls, out: Path | None, manifest: TrainingManifest, mind: Mapping[str, bytes]
    ) -> TrainingCapsule:
        """Make a training's folder; it appears whole or not at all.

        Args:
            out: a path where nothing is, or an empty folder; None for the next free number under
                ``trainings/``.
            manifest: what the training is.
            mind: the files of the mind that learning begins from.

        Raises:
            SocialmindError: the folder holds something, or cannot be written.
        """
        files = {f"{MIND}/{name}": content for name, content in mind.items()}
        files[MANIFEST] = manifest.content()
        return cls(make_folder(out, HOME, manifest.model["name"] or KIND, files))

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
