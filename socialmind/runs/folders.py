"""What folders of runs and trainings have in common: a manifest, a lock, and files replaced whole.

The manifest appears together with the folder, and every later version of it replaces the one
before in one step, so whenever the program is killed the folder says truly how far it came.
"""

from __future__ import annotations

import json
import os
import platform
import secrets
import shutil
from collections.abc import Collection, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import MISSING, asdict, dataclass, fields, replace
from pathlib import Path
from typing import Annotated, Any, ClassVar, Generic, Self, TypeVar, get_origin, get_type_hints

from coglogo_py.border.errors import shown
from socialmind.errors import SocialmindError
from socialmind.runs.record import Expected, Fields, check_record, one_of, read_record
from socialmind.version import __version__
from socialmind.work.files import replace_file

MANIFEST = "manifest.json"
FORMAT = 1
RUNNING, INTERRUPTED, FAILED, FINISHED = "running", "interrupted", "failed", "finished"
STATUS = one_of(RUNNING, INTERRUPTED, FAILED, FINISHED)
GOES_ON = {"run": "run", "training": "learn", "sweep": "sweep", "fit": "fit"}
"""The command that goes on with what a folder is of."""
PATIENCE = 0.5
"""Seconds that a lock may take: who asks whether a folder is held, holds it for a moment."""
OWN_MODEL = "model"
"""The folder within a run's that holds the model itself, where it was written for this run."""
MOST_TAKEN = 1000
"""How often another program may take a number before something else must be wrong."""


@dataclass(frozen=True)
class FolderManifest:
    """What stands in a folder and how far it came; the content of its ``manifest.json``."""

    model: dict[str, Any]

    WHAT: ClassVar[str]
    """What it is the manifest of."""
    NEEDED: ClassVar[tuple[str, ...]] = ()
    """Fields that a file has from the first version on, although they have a default."""

    @classmethod
    def load(cls, path: Path) -> Self:
        """Read a manifest.

        Raises:
            SocialmindError: the file is missing, not such a manifest, or of another format.
        """
        folder = path.parent
        if not path.is_file():
            what = f"not a {cls.WHAT}'s folder, it holds no {path.name}"
            raise SocialmindError(f"{folder}: {what if folder.is_dir() else 'no such folder'}")
        content = read_record(path, f"a {cls.WHAT}'s manifest")
        cls._check_kind(content, folder)
        if content.get("format") != FORMAT:
            raise SocialmindError(
                f"{path}: format {shown(content.get('format'))}; expected {FORMAT}; "
                "use the version of socialmind that wrote it"
            )
        check_record(content, cls.expected(), str(path))
        cls._check(content, path)
        known = {one.name for one in fields(cls)}
        return cls(**{key: value for key, value in content.items() if key in known})

    @classmethod
    def expected(cls) -> Fields:
        """Return what fields hold, as they are annotated; what came later may be missing."""
        hints = get_type_hints(cls, include_extras=True)
        needed: dict[str, Expected] = {}
        others: dict[str, Expected] = {}
        for one in fields(cls):
            if get_origin(hints[one.name]) is Annotated:
                first = one.default is MISSING and one.default_factory is MISSING
                holds = needed if first or one.name in cls.NEEDED else others
                holds[one.name] = hints[one.name].__metadata__[0]
        return Fields(needed, others)

    @classmethod
    def _check_kind(cls, content: Mapping[str, Any], folder: Path) -> None:
        """Refuse the manifest of another kind of folder; a run's does not say that it is one."""
        told = next((one.default for one in fields(cls) if one.name == "kind"), None)
        if content.get("kind") != told:
            kind = content.get("kind") or "run"
            command = GOES_ON.get(str(kind))
            remedy = f"; `socialmind {command} --resume` goes on with a {kind}" if command else ""
            raise SocialmindError(f"{folder}: not a {cls.WHAT}'s folder{remedy}")

    @classmethod
    def _check(cls, content: Mapping[str, Any], path: Path) -> None:
        """Refuse fields that do not fit together."""

    def content(self) -> bytes:
        """Return the file's content."""
        return (json.dumps(asdict(self), indent=2, ensure_ascii=False) + "\n").encode()


M = TypeVar("M", bound=FolderManifest)


class ManifestFolder(Generic[M]):
    """A folder with a manifest on disk.

    Args:
        folder: an existing one.

    Raises:
        SocialmindError: the folder is none of the kind.
    """

    MANIFEST_CLASS: type[M]
    HOME: str
    """The folder that numbered ones are made in."""

    def __init__(self, folder: str | Path) -> None:
        self.folder = Path(folder).expanduser().absolute()
        self.manifest = self._manifest_on_disk()

    @classmethod
    def create(
        cls,
        out: Path | None,
        manifest: M,
        files: Mapping[str, bytes],
        holding: Collection[str] = (),
    ) -> Self:
        """Make a folder; it appears whole, with its manifest and files, or not at all.

        Args:
            out: a path where nothing is, or an empty folder; None for the next free number
                under `HOME`.
            manifest: what it is the folder of.
            files: content of the other files that it holds from the start, by their paths.
            holding: what `out` may hold already.

        Raises:
            SocialmindError: the folder holds something, or cannot be written.
        """
        name = str(manifest.model["name"] or manifest.WHAT)
        return cls(
            make_folder(out, cls.HOME, name, {**files, MANIFEST: manifest.content()}, holding)
        )

    def _manifest_on_disk(self) -> M:
        return self.MANIFEST_CLASS.load(self.folder / MANIFEST)

    def update(self, **changes: Any) -> None:
        """Change fields of the manifest, in memory and on disk."""
        self.manifest = replace(self.manifest, **changes)
        replace_file(self.folder / MANIFEST, self.manifest.content())

    @contextmanager
    def locked(self) -> Iterator[None]:
        """Hold the folder for this process; the lock ends with the process, however it ends.

        Raises:
            SocialmindError: another process holds it.
        """
        with hold(self.folder):
            # What another process wrote while this one waited to begin.
            self.manifest = self._manifest_on_disk()
            yield


def kind_of(folder: Path) -> str:
    """Return what a folder is of: `run`, `sweep`, `training`, as its manifest says.

    Raises:
        SocialmindError: it holds no manifest.
    """
    path = folder / MANIFEST
    if not path.is_file():
        found = f"holds no {MANIFEST}" if folder.is_dir() else "no such folder"
        raise SocialmindError(f"{folder}: {found}; expected the folder of a run or a sweep")
    try:
        kind = json.loads(path.read_text("utf-8")).get("kind")
    except (ValueError, AttributeError):
        kind = None  # reading it as a run's says what is wrong
    return str(kind or "run")


def make_folder(
    out: Path | None,
    home: str,
    name: str,
    files: Mapping[str, bytes],
    holding: Collection[str] = (),
) -> Path:
    """Make a folder of files, at a given path or under the next free number.

    Args:
        out: a path where nothing is, or an empty folder; None for the next free number.
        home: the folder of numbered folders.
        name: which they begin with.
        files: their content by name, the manifest's among them.
        holding: what `out` may hold already.

    Returns:
        The folder.

    Raises:
        SocialmindError: the folder holds something, or cannot be written.
    """
    if out is not None:
        target = out.expanduser().absolute()
        refuse_unless_free(target, holding)
        try:
            _fill(target, files)
        except FileExistsError as error:
            raise SocialmindError(str(error)) from error
        return target
    number, taken = 1, 0
    while taken < MOST_TAKEN:
        target = Path(home).absolute() / f"{name}-{number:03d}"
        if not target.exists():
            try:
                _fill(target, files)
                return target
            except FileExistsError:
                taken += 1  # another program took this number just now
        number += 1
    raise SocialmindError(f"{Path(home).absolute()}: no folder can be made in it; give another")


def _fill(target: Path, files: Mapping[str, bytes]) -> None:
    """Make a folder of files; it appears whole or not at all.

    It is filled beside the target under another name, and then renamed.

    Args:
        target: a path where nothing is, or a folder; one that holds something gets the
            manifest last.
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
        if target.is_dir() and (target == Path.cwd() or any(target.iterdir())):
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
def hold(folder: Path) -> Iterator[None]:
    """Hold a folder for this process; the lock ends with the process, however it ends.

    Raises:
        SocialmindError: another process holds it.
    """
    import filelock

    path = folder / ".lock"
    if path.is_symlink() or path.is_dir():
        raise SocialmindError(f"{path}: expected the file of a lock; remove it")
    lock = filelock.FileLock(path, timeout=PATIENCE)
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


def is_held(folder: Path) -> bool:
    """Return whether another process holds a folder now, as far as this one may ask."""
    import filelock

    if not (folder / ".lock").is_file():
        return False
    try:
        with filelock.FileLock(folder / ".lock", timeout=0):
            return False
    except filelock.Timeout:
        return True
    except OSError:  # of a folder that may only be read
        return False


def refuse_unless_free(folder: Path, holding: Collection[str] = ()) -> None:
    """Raise unless the path is free or an empty folder: nothing is ever overwritten.

    Args:
        folder: the path.
        holding: what it may hold all the same.
    """
    if folder.is_dir():
        if (folder / MANIFEST).is_file():
            kind = kind_of(folder)
            raise SocialmindError(
                f"{folder}: holds a {kind}; go on with it by --resume, or give another folder"
            )
        if any(one.name not in holding for one in folder.iterdir()):
            raise SocialmindError(f"{folder}: is not empty; give a fresh folder")
    elif folder.exists() or folder.is_symlink():
        raise SocialmindError(f"{folder}: is a file; give a folder")


def refuse_other_version(folder: Path, what: str, made_with: Mapping[str, str]) -> None:
    """Refuse to go on with a run or a training that another version of the program made.

    Args:
        folder: its own.
        what: "run" or "training".
        made_with: the versions of what it stood on.

    Raises:
        SocialmindError: the program's is another.
    """
    then = made_with.get("socialmind")
    if then != __version__:
        raise SocialmindError(
            f"{folder}: made by socialmind {then}, this is {__version__}, whose {what}s may "
            f"differ; install {then}, or start another {what}"
        )


def with_this_machine(platforms: list[dict[str, str]]) -> list[dict[str, str]]:
    """Return the fingerprints of machines, with that of this one."""
    machine = fingerprint()
    return platforms if machine in platforms else [*platforms, machine]


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

    return {
        "socialmind": __version__,
        "python": platform.python_version(),
        "numpy": np.__version__,
        "numba": numba.__version__,
    }
