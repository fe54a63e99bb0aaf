"""The folder in which compiled code is kept from one start of Python to the next.

What lies in it is machine code, so it is read only from a folder and out of files that belong to
this user (or to root) and that nobody else may write. A file that does not hold what was written
into it counts as not there. Whatever goes wrong with the folder, code is compiled in memory, and a
`CacheWarning` says so.

- `<folder>/<key>/<name>`: a content after its SHA-256; the key names a text and all it depends on.
"""

from __future__ import annotations

import hashlib
import os
import stat
import tempfile
import warnings
from contextlib import suppress
from functools import cache
from pathlib import Path

import platformdirs

CACHE_VARIABLE = "SOCIALMIND_CACHE_DIR"
"""Environment variable that names the folder of compiled code."""
_DIGEST = hashlib.sha256().digest_size
_OTHERS_WRITE = stat.S_IWGRP | stat.S_IWOTH


class CacheWarning(UserWarning):
    """Compiled code cannot be kept, so every start compiles anew."""


class _UnfitError(Exception):
    """The folder is not to be used; the message says why."""


def cache_folder() -> Path | None:
    """Return the folder of compiled code: what the variable names, or the user's cache.

    Returns:
        An absolute path, whether or not it is there; None where the user has no home.
    """
    named = os.environ.get(CACHE_VARIABLE)
    try:
        folder = Path(named or platformdirs.user_cache_dir("socialmind")).expanduser()
        return folder.absolute() if folder.parts[:1] != ("~",) else None
    except (RuntimeError, OSError):  # no home, or no working folder
        return None


def read(key: str, name: str) -> bytes | None:
    """Return what was kept; None when it is not there, damaged, or not ours.

    Args:
        key: the folder within the cache.
        name: the file in it.
    """
    try:
        folder = _folder(key, make=False)
        if folder is None:
            return None
        with (folder / name).open("rb") as stream:
            _check_owner(os.fstat(stream.fileno()), str(folder / name))
            kept = stream.read()
    except (_UnfitError, OSError):
        return None
    content = kept[_DIGEST:]
    return content if hashlib.sha256(content).digest() == kept[:_DIGEST] else None


def keep(key: str, name: str, content: bytes) -> None:
    """Write a content to where `read` finds it; where that fails, warn.

    Arguments as of `read`.
    """
    draft = None
    try:
        folder = _folder(key, make=True)
        if folder is None:
            return
        handle, draft = tempfile.mkstemp(dir=folder, prefix="draft-")
        with os.fdopen(handle, "wb") as stream:
            stream.write(hashlib.sha256(content).digest() + content)
        Path(draft).replace(folder / name)
    except (_UnfitError, OSError) as error:
        if draft is not None:
            with suppress(OSError):
                Path(draft).unlink()
        why = str(error)
        if isinstance(error, OSError):
            why = f"{cache_folder()}: {error.strerror}"
        _warn_once(why)


@cache
def _warn_once(why: str) -> None:
    # Not left to the filters of warnings: numba resets what they remember.
    warnings.warn(
        f"compiled code is not kept, so every start compiles anew: {why}; "
        f"set {CACHE_VARIABLE} to a folder of your own that can be written",
        CacheWarning,
        stacklevel=2,
    )


def _folder(key: str, make: bool) -> Path | None:
    """Return the folder of a key, checked; None when it is not there and not to be made."""
    root = cache_folder()
    if root is None:
        raise _UnfitError("there is no home folder")
    folder = root / key
    if make:
        root.parent.mkdir(parents=True, exist_ok=True)
        for one in (root, folder):
            with suppress(FileExistsError):
                one.mkdir(mode=0o700)
    elif not folder.is_dir():
        return None
    # The user may have made the root a link to a larger disk; what it leads to is what counts.
    _check_owner(os.lstat(root), str(root))
    _check_folder(root.stat(), root)
    _check_folder(os.lstat(folder), folder)
    return folder


def _check_folder(found: os.stat_result, folder: Path) -> None:
    if not stat.S_ISDIR(found.st_mode):
        raise _UnfitError(f"{folder} is no folder")
    _check_owner(found, str(folder))


def _check_owner(found: os.stat_result, what: str) -> None:
    """Refuse what belongs to another user, or what others may write."""
    if not hasattr(os, "geteuid"):
        return  # Windows keeps a user's folders apart by other means
    if found.st_uid not in (os.geteuid(), 0):
        raise _UnfitError(f"{what} belongs to another user")
    if not stat.S_ISLNK(found.st_mode) and found.st_mode & _OTHERS_WRITE:
        mode = stat.S_IMODE(found.st_mode)
        raise _UnfitError(f"others may write into {what} (mode {mode:o}; `chmod go-w` helps)")
