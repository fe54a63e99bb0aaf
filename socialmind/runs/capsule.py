"""A run's folder: the manifest that says what the run is, its lock, and where its files lie.

The manifest appears together with the folder, and every later version of it replaces the one
before in one step, so whenever the run is killed the folder says truly how far it came:

- status ``finished``: the merged tables are the run's result;
- any other status: the checkpoint, if there is one, says which parts of the tables count.
"""

from __future__ import annotations

import hashlib
import json
import os
import platform
import secrets
import shutil
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import asdict, dataclass, field, fields, replace
from pathlib import Path
from typing import Any

from coglogo_py.errors import shown
from socialmind.errors import SocialmindError
from socialmind.runs.arrays_file import make_room
from socialmind.runs.record import (
    NAME_WITHIN,
    NUMBER,
    PATH,
    SETTING,
    SHA256,
    SOURCES,
    TEXT,
    TRUTH,
    Each,
    Fields,
    Many,
    check_record,
    one_of,
    optional,
    read_record,
    whole,
    within,
)
from socialmind.runs.tables import TABLES

MANIFEST = "manifest.json"
FORMAT = 1
RUNNING, INTERRUPTED, FAILED, FINISHED = "running", "interrupted", "failed", "finished"


@dataclass(frozen=True)
class Manifest:
    """What a run is and how far it came; the content of ``manifest.json``.

    Args:
        model: ``name``, ``path`` (folder; None for a class that no file defines), ``source_sha256``
            of the folder's Python files, and ``sources``: all that decided how it runs, as
            `socialmind.sources.provenance.Sources.record` says it.
        parameters: value of every parameter.
        seed: of the run.
        compiled: whether compiled or interpreted; the result is the same.
        schemes: for each population with minds, its cognitive scheme's ``name``, ``file`` (the
            copy in the run's folder) and ``sha256`` of that copy.
        engine: on a plane, what moves the bodies: ``compiled`` or ``pymunk``.
        minds: for each population with hierarchies of skills, the mind's ``name``, ``folder`` (the
            copy in the run's folder) and ``sha256`` of that copy's files.
        ticks: length asked for.
        every: ticks between two rows of the series.
        agents_every: ticks between two recordings of the agents.
        status: ``running``, ``interrupted``, ``failed`` or ``finished``.
        ticks_done: ticks that are safe on disk.
        error: what stopped a failed run.
        tables: content of each merged table: rows, columns and their types, hash.
        idle: how often an agent found no available plan, and the first agent and tick.
        timings: ``created`` (UTC), ``seconds`` in all and ``loop_seconds`` in the model's ticks.
        versions: of what the run stood on.
        platforms: the fingerprints of the machines that computed it; one, unless it moved.
        format: of this file.
    """

    model: dict[str, Any]
    parameters: dict[str, Any]
    seed: int
    compiled: bool
    schemes: dict[str, dict[str, str]]
    ticks: int
    every: int
    agents_every: int
    status: str = RUNNING
    ticks_done: int = 0
    error: str | None = None
    engine: str = "compiled"
    minds: dict[str, dict[str, str]] = field(default_factory=dict)
    tables: dict[str, dict[str, Any]] = field(default_factory=dict)
    idle: dict[str, int | None] = field(default_factory=dict)
    timings: dict[str, Any] = field(default_factory=dict)
    versions: dict[str, str] = field(default_factory=dict)
    platforms: list[dict[str, str]] = field(default_factory=list)
    format: int = FORMAT

    @classmethod
    def load(cls, path: Path) -> Manifest:
        """Read a manifest.

        Raises:
            SocialmindError: the file is missing, not a manifest, or of a later format.
        """
        if not path.is_file():
            raise SocialmindError(
                f"{path.parent}: not a run's folder, it holds no {path.name}"
                if path.parent.is_dir()
                else f"{path.parent}: no such folder"
            )
        content = read_record(path, "a run's manifest")
        found = content.get("format")
        if found != FORMAT:
            raise SocialmindError(
                f"{path}: format {shown(found)}; expected {FORMAT}; "
                "use the version of socialmind that wrote it"
            )
        check_record(content, _FIELDS, str(path))
        check_record(content["ticks_done"], whole(0, content["ticks"]), f"{path}: ticks_done")
        if content["status"] == FINISHED:
            check_record(content.get("tables"), _BOTH_TABLES, f"{path}: tables of a finished run")
        known = {f.name for f in fields(cls)}
        return cls(**{key: value for key, value in content.items() if key in known})

    def identity(self) -> str:
        """Return a hash of what decides the result, apart from the model itself."""
        decides = {
            "parameters": self.parameters,
            "seed": self.seed,
            "engine": self.engine,
            "every": self.every,
            "agents_every": self.agents_every,
            "copies": [
                {name: one["sha256"] for name, one in copies.items()}
                for copies in (self.schemes, self.minds)
            ],
        }
        return hashlib.sha256(json.dumps(decides, sort_keys=True).encode()).hexdigest()

    def content(self) -> bytes:
        """Return the file's content."""
        return (json.dumps(asdict(self), indent=2, ensure_ascii=False) + "\n").encode()

    def save(self, path: Path) -> None:
        """Write the manifest in one step: a reader sees the old one or this one."""
        replace_file(path, self.content())


IDLE = Fields(
    {}, {"count": whole(), "first_agent": optional(whole()), "first_tick": optional(whole())}
)
_TABLE = Fields({"rows": whole(), "columns": Each(TEXT), "sha256": SHA256}, {})
_BOTH_TABLES = Fields(dict.fromkeys(TABLES, _TABLE), {})
_FIELDS = Fields(
    {
        "model": Fields(
            {"name": TEXT, "path": optional(PATH), "source_sha256": optional(SHA256)},
            {"sources": SOURCES},
        ),
        "parameters": Each(SETTING),
        "seed": whole(0, 2**64 - 1),
        "compiled": TRUTH,
        "schemes": Each(Fields({"file": NAME_WITHIN, "sha256": SHA256}, {"name": TEXT})),
        "ticks": whole(),
        "every": whole(1),
        "agents_every": whole(1),
        "status": one_of(RUNNING, INTERRUPTED, FAILED, FINISHED),
        "ticks_done": whole(),
    },
    {
        "error": optional(TEXT),
        "engine": one_of("compiled", "pymunk"),
        "minds": Each(Fields({"folder": NAME_WITHIN, "sha256": SHA256}, {"name": TEXT})),
        "tables": Each(_TABLE),
        "idle": IDLE,
        "timings": Fields({}, {"created": TEXT, "seconds": NUMBER, "loop_seconds": NUMBER}),
        "versions": Each(TEXT),
        "platforms": Many(Each(TEXT)),
    },
)
"""What a manifest holds; fields that came later may be missing."""


class Capsule:
    """A run's folder on disk.

    Args:
        folder: of an existing run.

    Raises:
        SocialmindError: the folder is no run's.
    """

    def __init__(self, folder: str | Path) -> None:
        self.folder = Path(folder).expanduser().absolute()
        self.manifest = Manifest.load(self.folder / MANIFEST)

    @classmethod
    def create(cls, out: Path | None, manifest: Manifest, files: Mapping[str, bytes]) -> Capsule:
        """Make a run's folder; it appears whole, with its manifest and schemes, or not at all.

        Args:
            out: a path where nothing is, or an empty folder; None for the next free number
                under ``runs/``.
            manifest: what the run is.
            files: content of the other files that it holds from the start, by name.

        Raises:
            SocialmindError: the folder holds something, or cannot be written.
        """
        content = {**files, MANIFEST: manifest.content()}
        return cls(placed(out, "runs", str(manifest.model["name"]), content))

    @property
    def parts(self) -> Path:
        """The folder of the tables' parts, there while the run is not finished."""
        return within(self.folder, "parts")

    @property
    def checkpoint(self) -> Path:
        """The file that the run goes on from."""
        return within(self.folder, "checkpoint.npz")

    @property
    def schemes(self) -> dict[str, Path]:
        """The run's own copies of its scheme files, by population."""
        return {n: within(self.folder, one["file"]) for n, one in self.manifest.schemes.items()}

    @property
    def minds(self) -> dict[str, Path]:
        """The run's own copies of its minds' folders, by population."""
        return {n: within(self.folder, one["folder"]) for n, one in self.manifest.minds.items()}

    def table(self, name: str) -> Path:
        """The merged file of a table."""
        return within(self.folder, f"{name}.parquet")

    def update(self, **changes: Any) -> None:
        """Change fields of the manifest, in memory and on disk."""
        self.manifest = replace(self.manifest, **changes)
        self.manifest.save(self.folder / MANIFEST)

    @contextmanager
    def locked(self) -> Iterator[None]:
        """Hold the folder for this process; the lock ends with the process, however it ends.

        Raises:
            SocialmindError: another process holds it.
        """
        with held(self.folder):
            # What another process wrote while this one waited to begin.
            self.manifest = Manifest.load(self.folder / MANIFEST)
            yield


def replace_file(path: Path, content: bytes) -> None:
    """Write a file in one step: a reader sees the one before or this one."""
    unfinished = make_room(path.with_name(path.name + ".partial"))
    try:
        with unfinished.open("xb") as file:
            file.write(content)
        unfinished.replace(path)
    except OSError as error:
        unfinished.unlink(missing_ok=True)  # on a full disk it would take the last room
        error.filename = error.filename or str(path)  # what is written does not know where
        raise


MOST_TAKEN = 1000
"""How often another program may take a number before something else must be wrong."""


def placed(out: Path | None, home: str, name: str, files: Mapping[str, bytes]) -> Path:
    """Make a folder of files, at a given path or under the next free number.

    Args:
        out: a path where nothing is, or an empty folder; None for the next free number.
        home: the folder of numbered folders.
        name: which they begin with.
        files: their content by name, the manifest's among them.

    Returns:
        The folder.

    Raises:
        SocialmindError: the folder holds something, or cannot be written.
    """
    if out is not None:
        target = out.expanduser().absolute()
        refuse_unless_free(target)
        try:
            place(target, files)
        except FileExistsError as error:
            raise SocialmindError(str(error)) from error
        return target
    number, taken = 1, 0
    while taken < MOST_TAKEN:
        target = Path(home).absolute() / f"{name}-{number:03d}"
        if not target.exists():
            try:
                place(target, files)
                return target
            except FileExistsError:
                taken += 1  # another program took this number just now
        number += 1
    raise SocialmindError(f"{Path(home).absolute()}: no folder can be made in it; give another")


def place(target: Path, files: Mapping[str, bytes]) -> None:
    """Make a folder of files; it appears whole or not at all.

    It is filled beside the target under another name, and then renamed.

    Args:
        target: a path where nothing is, or an empty folder.
        files: their content by name, the manifest's among them.

    Raises:
        FileExistsError: another program made it in the meantime.
    """
    target.parent.mkdir(parents=True, exist_ok=True)
    unfinished = target.parent / f".{target.name}-{secrets.token_hex(4)}.partial"
    unfinished.mkdir()
    try:
        for name, content in files.items():
            (unfinished / name).parent.mkdir(parents=True, exist_ok=True)
            (unfinished / name).write_bytes(content)
        if target.is_dir() and target == Path.cwd():
            # Renaming over the current folder would leave the user's shell nowhere.
            for path in sorted(unfinished.iterdir(), key=lambda p: p.name == MANIFEST):
                path.rename(target / path.name)
            return
        if os.name == "nt" and target.is_dir():
            target.rmdir()  # only POSIX renames over an empty folder
        try:
            unfinished.rename(target)
        except OSError as error:
            if target.exists():
                raise FileExistsError(f"{target}: was made by another program") from error
            raise
    except OSError as error:
        error.filename = error.filename or str(target)
        raise
    finally:
        shutil.rmtree(unfinished, ignore_errors=True)


@contextmanager
def held(folder: Path) -> Iterator[None]:
    """Hold a folder for this process; the lock ends with the process, however it ends.

    Raises:
        SocialmindError: another process holds it.
    """
    import filelock

    path = folder / ".lock"
    if path.is_symlink() or path.is_dir():
        raise SocialmindError(f"{path}: expected the file of a lock; remove it")
    lock = filelock.FileLock(path, timeout=0)
    try:
        lock.acquire()
    except filelock.Timeout:
        raise SocialmindError(
            f"{folder}: another process is running in this folder; wait for it to end"
        ) from None
    try:
        yield
    finally:
        lock.release()


def refuse_unless_free(folder: Path) -> None:
    """Raise unless the path is free or an empty folder: nothing is ever overwritten."""
    if folder.is_dir():
        if (folder / MANIFEST).is_file():
            raise SocialmindError(
                f"{folder}: holds a run; go on with it by --resume, or give another folder"
            )
        if any(folder.iterdir()):
            raise SocialmindError(f"{folder}: is not empty; give a fresh folder")
    elif folder.exists() or folder.is_symlink():
        raise SocialmindError(f"{folder}: is a file; give a folder")


def fingerprint() -> dict[str, str]:
    """What the last bit of a result depends on: processor, C library, Python, numpy, numba.

    Two runs on equal fingerprints are equal exactly; elsewhere they agree within rounding.
    """
    import llvmlite.binding  # type: ignore[import-untyped]  # ships no types
    import numba
    import numpy as np

    return {
        "system": platform.system(),
        "machine": platform.machine(),
        "processor": llvmlite.binding.get_host_cpu_name(),
        "c_library": " ".join(platform.libc_ver()).strip() or platform.release(),
        "python": f"{platform.python_implementation()} {platform.python_version()}",
        "numpy": np.__version__,
        "numba": numba.__version__,
    }


def versions() -> dict[str, str]:
    """The versions a run stands on."""
    import numba
    import numpy as np

    from socialmind.version import __version__

    return {
        "socialmind": __version__,
        "python": platform.python_version(),
        "numpy": np.__version__,
        "numba": numba.__version__,
    }
