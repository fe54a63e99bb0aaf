"""Minds of folders that many societies are made with: looked into each time, understood once."""

from __future__ import annotations

import os
from pathlib import Path

from socialmind.mind.description import MindDescription
from socialmind.mind.files.python_file import runs_programs
from socialmind.sources.folders import models_in, source_hash

MOST = 16
"""So many minds are kept, those that came last."""

Content = tuple[tuple[str, bytes], ...]


class KeptMinds:
    """Reads minds; one whose folder holds what it held is not read again."""

    def __init__(self) -> None:
        self._known: dict[tuple[str, bool], tuple[Content, MindDescription]] = {}

    def load(self, path: str | Path) -> MindDescription:
        """Return the mind of a folder or a YAML file as it is now, as `MindDescription.load` does.

        Raises:
            ModelError: there is none, or one of its files is wrong.
        """
        content = _content(Path(path))
        if content is None:
            return MindDescription.load(path)
        key = str(path), runs_programs()
        known = self._known.get(key)
        if known is not None and known[0] == content:
            return known[1]
        mind = MindDescription.load(path)
        if _content(Path(path)) == content:  # else it changed while it was read
            while len(self._known) >= MOST:
                self._known.pop(next(iter(self._known)), None)
            self._known[key] = content, mind
        return mind


def _content(folder: Path) -> Content | None:
    """Return the names and bytes of all files of a folder; None where there is no such folder."""
    found = []
    others = False
    try:
        for home, folders, names in os.walk(folder):
            folders.sort()
            for name in sorted(names):
                file = os.path.join(home, name)  # noqa: PTH118  # of each society that is made
                if not os.path.isfile(file):  # noqa: PTH113  # a pipe, say, may never end
                    continue
                with open(file, "rb") as stream:  # noqa: PTH123
                    found.append((file, stream.read()))
                others = others or (name.endswith(".py") and bool(models_in(found[-1][1])))
    except OSError:
        return None
    if others:  # what a program loads decides about it too
        found.append(("", source_hash(folder).encode()))
    return tuple(found) or None
