"""Asking a training to pause, wherever it goes on: a file in its folder, looked for at checkpoints.

Ctrl-C is for who sits at its terminal; this is for any other program of the machine, and reaches
notebooks, trainings without a terminal, and those of other terminals alike.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

from socialmind.errors import SocialmindError
from socialmind.learning.training.capsule import TrainingCapsule
from socialmind.runs.folders import RUNNING, is_held
from socialmind.work.files import replace_file

REQUEST = "pause"
"""The file in a training's folder that asks for it; it holds who does."""
LONGEST = 60
"""Characters of who asks."""

Asked = Callable[[], str | None]
"""Returns who asks for a pause; None while nobody does."""


def pause(folder: str | Path, asker: str = "another program") -> None:
    """Ask a training to pause; it does when the generation or the finals in hand are over.

    Nothing is lost: what goes on later is the training that was never stopped.

    Args:
        folder: the training's.
        asker: who asks, as its terminal is told.

    Raises:
        SocialmindError: no training's folder, or one that does not go on or cannot be asked.
    """
    capsule = TrainingCapsule(folder)
    name = capsule.folder.name
    if capsule.manifest.status != RUNNING or not is_held(capsule.folder):
        raise SocialmindError(f"{name} does not go on, as far as this machine knows")
    if not capsule.manifest.process:
        raise SocialmindError(
            f"{name} was begun by a version of socialmind that cannot be asked; press Ctrl-C where "
            "it was begun"
        )
    replace_file(capsule.folder / REQUEST, f"{asker}\n".encode())


def is_asked(folder: Path) -> bool:
    """Return whether a training that goes on is asked to pause.

    Args:
        folder: the training's.
    """
    return (folder / REQUEST).is_file()


@contextmanager
def requests(folder: Path) -> Iterator[Asked]:
    """Hear who asks for a pause while a block lasts, which holds the training's folder.

    What was asked of a process that was killed before it heard it is forgotten.

    Args:
        folder: the training's.

    Yields:
        What tells who asks; it costs a look at the folder.
    """
    path = folder / REQUEST
    _forget(path)
    try:
        yield lambda: _asker(path) if path.is_file() else None
    finally:
        with suppress(OSError):  # a pause must not fail by what is left of asking for it
            _forget(path)


def _forget(path: Path) -> None:
    if path.is_file() or path.is_symlink():
        path.unlink(missing_ok=True)


def _asker(path: Path) -> str:
    """Return who asks; whatever the file holds, it is a word for a terminal."""
    found = b""
    with suppress(OSError), path.open("rb") as file:
        found = file.read(4 * LONGEST)
    said = found.decode("utf-8", "replace").strip()
    return said if said and said.isprintable() and len(said) <= LONGEST else "another program"
