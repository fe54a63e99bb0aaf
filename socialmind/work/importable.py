"""Classes and functions by file and name, as another process finds them."""

from __future__ import annotations

import sys
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from socialmind.sources.folders import catalogue
from socialmind.sources.loading import PRIVATE, load_file


@dataclass(frozen=True)
class Reference:
    """A class or function of a file that `socialmind.catalogue.load_file` loaded.

    Such modules have private names, which other processes cannot import.

    Args:
        model: the catalogue's model in whose folder the file lies, which may stand elsewhere on
            another machine; empty for none.
        file: the file's path, in that folder or absolute.
        name: the qualified name in it.
    """

    model: str
    file: str
    name: str

    def found(self) -> Any:
        """Return what it refers to."""
        home = catalogue().get(self.model, Path()) if self.model else Path()
        found: Any = load_file(home / self.file)
        for part in self.name.split("."):
            found = getattr(found, part)
        return found


def referred(something: Any) -> Any:
    """Return a reference to a class or function of a model's file, and anything else as it is.

    >>> referred(Path) is Path
    True
    """
    module = getattr(something, "__module__", None) or ""
    if not module.startswith(PRIVATE):
        return something
    file = Path(str(sys.modules[module].__file__)).resolve()
    for model, folder in catalogue().items():
        if file.is_relative_to(folder.resolve()):
            place = file.relative_to(folder.resolve()).as_posix()
            return Reference(model, place, something.__qualname__)
    return Reference("", str(file), something.__qualname__)


def found(something: Any) -> Any:
    """Return what a reference refers to, and anything else as it is."""
    return something.found() if isinstance(something, Reference) else something
