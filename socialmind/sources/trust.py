"""Which programs run without asking: those that ship, and those that this user named or ran before.

The Python files of a model or a mind are code, and can do whatever the user can. Those that the
user names are run, and the hashes of their contents remembered; those that are only met on the way
(in somebody's run, or where its manifest leads) are refused unless they are known, or trusted.

`<data folder>/programs` holds one SHA-256 a line. It counts only if it belongs to this user and
nobody else may write it or into its folder; where it cannot be kept, this process remembers alone.
"""

from __future__ import annotations

import os
import stat
from collections.abc import Iterator, Mapping
from contextlib import suppress
from importlib.machinery import all_suffixes
from pathlib import Path

from socialmind.errors import SocialmindError
from socialmind.sources.folders import STUDIES_FILE, catalogue, digest, shipped

DATA_VARIABLE = "SOCIALMIND_DATA_DIR"
"""Environment variable that names the folder of what is remembered."""
PROGRAMS_FILE = "programs"
LISTED = 10
"""Programs that a refusal names; of the others it says how many they are."""
_OTHERS_WRITE = stat.S_IWGRP | stat.S_IWOTH
_here: set[str] = set()
"""Hashes that could not be written down: known until this process ends."""


def programs_in(folder: Path) -> dict[str, bytes]:
    """Return what Python could import from a folder: the content of each file by its path.

    Args:
        folder: a folder, whose links are followed; or one file.
    """
    if folder.is_file():
        return {str(folder): folder.read_bytes()}
    return {str(path): path.read_bytes() for path in sorted(_files_below(folder))}


def _files_below(folder: Path) -> Iterator[Path]:
    seen: set[str] = set()
    suffixes = tuple(all_suffixes())
    for place, folders, files in os.walk(folder, followlinks=True):
        real = os.path.realpath(place)
        # Bytecode in __pycache__ is not read when a model is loaded.
        folders[:] = [one for one in folders if not one.startswith((".", "__pycache__"))]
        if real in seen:
            folders.clear()
            continue
        seen.add(real)
        yield from (
            Path(place, one)
            for one in files
            if one.endswith(suffixes) and Path(place, one).is_file()
        )


def remember(programs: Mapping[str, bytes]) -> None:
    """Note programs that the user named or ran; they run without asking from now on.

    Args:
        programs: the content of each by its path.
    """
    known = _remembered()
    found = [*map(digest, programs.values()), *map(_place, filter(os.path.isabs, programs))]
    new = [one for one in dict.fromkeys(found) if one not in known]
    if not new:
        return
    folder = _data_folder()
    try:
        if folder is None:
            raise PermissionError
        folder.parent.mkdir(parents=True, exist_ok=True)
        with suppress(FileExistsError):
            folder.mkdir(mode=0o700)
        if not _is_own(folder.lstat()):
            raise PermissionError
        flags = os.O_WRONLY | os.O_APPEND | os.O_CREAT | getattr(os, "O_NOFOLLOW", 0)
        handle = os.open(folder / PROGRAMS_FILE, flags, 0o600)
        try:
            if not _is_own(os.fstat(handle)):
                raise PermissionError
            # In one piece: another process may be writing as well.
            os.write(handle, "".join(f"{one}\n" for one in new).encode("ascii"))
        finally:
            os.close(handle)
    except OSError:
        _here.update(new)


def require(programs: Mapping[str, bytes], trusted: bool, what: str, edited: bool = False) -> None:
    """Refuse programs that neither ship nor were named or run before, unless they are trusted.

    Args:
        programs: the content of each by its path.
        trusted: the user said that they may run; they are remembered.
        what: whose they are, for the message: `"runs/a: its model"`.
        edited: whether a file counts as known that stands where one was named before, whatever
            it holds by now: the user's own figures are drawn, edited and drawn again.

    Raises:
        SocialmindError: unknown programs; lists them.
    """
    if trusted:
        remember(programs)
        return
    known = _remembered()
    unknown = {
        path: content
        for path, content in programs.items()
        if content.strip()
        and digest(content) not in known
        and not (edited and _place(path) in known)
    }
    if unknown:
        shipped = _shipped()
        unknown = {path: one for path, one in unknown.items() if digest(one) not in shipped}
    if unknown:
        named = [path if path.isprintable() else repr(path) for path in unknown]
        more = f" and {len(named) - LISTED} more" if len(named) > LISTED else ""
        raise SocialmindError(
            f"{what} holds programs that you have not named or run before, and that could do "
            f"whatever you can: {', '.join(named[:LISTED])}{more}; look at them, then run them "
            "with --trust (in Python trust=True)"
        )


def _place(path: str) -> str:
    return digest(f"place {path}".encode(errors="surrogateescape"))


def _data_folder() -> Path | None:
    """Return the folder of what is remembered, whether or not it is there; None without a home."""
    import platformdirs

    named = os.environ.get(DATA_VARIABLE)
    try:
        folder = Path(named or platformdirs.user_data_dir("socialmind")).expanduser()
        return folder.absolute() if folder.parts[:1] != ("~",) else None
    except (RuntimeError, OSError):  # no home, or no working folder
        return None


def _remembered() -> set[str]:
    """Return the hashes that are remembered; none that somebody else may have written."""
    folder, known = _data_folder(), set(_here)
    with suppress(OSError):
        if folder is not None and _is_own(folder.lstat()):
            flags = os.O_RDONLY | getattr(os, "O_NOFOLLOW", 0) | getattr(os, "O_NONBLOCK", 0)
            handle = os.open(folder / PROGRAMS_FILE, flags)
            with os.fdopen(handle, "rb") as file:
                found = os.fstat(handle)
                if stat.S_ISREG(found.st_mode) and _is_own(found):
                    known.update(file.read().decode("ascii", "replace").split())
    return known


def _is_own(found: os.stat_result) -> bool:
    """Whether a file or folder belongs to this user and nobody else may write it."""
    if not hasattr(os, "geteuid"):
        return True  # Windows keeps a user's folders apart by other means
    return found.st_uid == os.geteuid() and not (
        stat.S_ISLNK(found.st_mode) or found.st_mode & _OTHERS_WRITE
    )


def _shipped() -> set[str]:
    """Return the hashes of the programs of the models and studies that ship."""
    homes = [*catalogue().values(), *shipped("analysis", STUDIES_FILE).values()]
    return {digest(content) for home in homes for content in programs_in(home).values()}
