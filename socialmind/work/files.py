"""Files that appear whole in the place of others, whatever was left there."""

from __future__ import annotations

import shutil
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import BinaryIO

from socialmind.errors import SocialmindError


def refuse_folder(path: Path) -> None:
    """Raise when a folder is where a file is to be.

    Raises:
        SocialmindError: so it is.
    """
    if path.is_dir() and not path.is_symlink():
        raise SocialmindError(f"{path}: is a folder, in the place of a file; remove it")


def make_room(path: Path) -> Path:
    """Return a path at which nothing is: a file or a link that was left there is taken away.

    Raises:
        SocialmindError: a folder is there.
    """
    refuse_folder(path)
    path.unlink(missing_ok=True)
    return path


def remove(path: Path) -> None:
    """Take away a folder with all that is in it, or a file or a link; links are not followed."""
    if path.is_dir() and not path.is_symlink():
        shutil.rmtree(path)
    else:
        path.unlink(missing_ok=True)


def emptied(folder: Path) -> Path:
    """Return where a folder is made before it gets its name; what was left there is removed."""
    made = folder.with_name(f"{folder.name}.begun")
    if made.exists():
        remove(made)
    return made


@contextmanager
def replacing(path: Path) -> Iterator[BinaryIO]:
    """Give a file to write into, which takes the place of the one before in one step."""
    unfinished = make_room(path.with_name(path.name + ".partial"))
    try:
        with unfinished.open("xb") as file:
            yield file
        unfinished.replace(path)
    except OSError as error:
        unfinished.unlink(missing_ok=True)  # on a full disk it would take the last room
        error.filename = error.filename or str(path)  # what is written does not know where
        raise


def replace_file(path: Path, content: bytes) -> None:
    """Write a file in one step: a reader sees the one before or this one."""
    with replacing(path) as file:
        file.write(content)
