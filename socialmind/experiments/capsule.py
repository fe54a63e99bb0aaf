"""A run's folder: the manifest that says what the run is, its lock, and where its files lie.

The manifest appears together with the folder, and every later version of it replaces the one
before in one step, so whenever the run is killed the folder says truly how far it came:

- status ``finished``: the merged tables are the run's result;
- any other status: the checkpoint, if there is one, says which parts of the tables count.
"""

from __future__ import annotations

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

from socialmind.errors import SocialmindError

MANIFEST = "manifest.json"
FORMAT = 1
RUNNING, INTERRUPTED, FAILED, FINISHED = "running", "interrupted", "failed", "finished"


@dataclass(frozen=True)
class Manifest:
    """What a run is and how far it came; the content of ``manifest.json``.

    Args:
        model: ``name``, ``path`` (folder; None for a class that no file defines) and
            ``source_sha256`` of its Python files.
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

    model: dict[str, str | None]
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
        try:
            content = json.loads(path.read_text(encoding="utf-8"))
            found = content.get("format") if isinstance(content, dict) else None
            if found != FORMAT:
                raise SocialmindError(
                    f"{path}: format {found}; expected {FORMAT}; "
                    "use the version of socialmind that wrote it"
                )
            known = {f.name for f in fields(cls)}
            return cls(**{key: value for key, value in content.items() if key in known})
        except (ValueError, TypeError) as error:
            raise SocialmindError(f"{path}: not a run's manifest ({error})") from error

    def content(self) -> bytes:
        """Return the file's content."""
        return (json.dumps(asdict(self), indent=2, ensure_ascii=False) + "\n").encode()

    def save(self, path: Path) -> None:
        """Write the manifest in one step: a reader sees the old one or this one."""
        replace_file(path, self.content())


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
        return self.folder / "parts"

    @property
    def checkpoint(self) -> Path:
        """The file that the run goes on from."""
        return self.folder / "checkpoint.npz"

    @property
    def schemes(self) -> dict[str, Path]:
        """The run's own copies of its scheme files, by population."""
        return {name: self.folder / one["file"] for name, one in self.manifest.schemes.items()}

    @property
    def minds(self) -> dict[str, Path]:
        """The run's own copies of its minds' folders, by population."""
        return {name: self.folder / one["folder"] for name, one in self.manifest.minds.items()}

    def table(self, name: str) -> Path:
        """The merged file of a table."""
        return self.folder / f"{name}.parquet"

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
    unfinished = path.with_name(path.name + ".partial")
    unfinished.write_bytes(content)
    unfinished.replace(path)


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
    finally:
        shutil.rmtree(unfinished, ignore_errors=True)


@contextmanager
def held(folder: Path) -> Iterator[None]:
    """Hold a folder for this process; the lock ends with the process, however it ends.

    Raises:
        SocialmindError: another process holds it.
    """
    import filelock

    lock = filelock.FileLock(folder / ".lock", timeout=0)
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

    import socialmind

    return {
        "socialmind": socialmind.__version__,
        "python": platform.python_version(),
        "numpy": np.__version__,
        "numba": numba.__version__,
    }
