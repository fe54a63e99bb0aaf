"""A mind as the files of its folder: to be kept, compared, and found on another machine."""

from __future__ import annotations

import tempfile
import weakref
from collections.abc import Mapping
from pathlib import Path

from socialmind.mind.description import MindDescription


def files_of(mind: MindDescription) -> dict[str, bytes]:
    """Return the files of a mind's folder, by their paths in it."""
    with tempfile.TemporaryDirectory() as folder:
        mind.save(folder)
        paths = sorted(path for path in Path(folder).rglob("*") if path.is_file())
        return {
            path.relative_to(folder).as_posix(): path.read_bytes()
            for path in paths
            if "__pycache__" not in path.parts  # installing leaves one beside a mind's programs
        }


def mind_of(files: Mapping[str, bytes]) -> MindDescription:
    """Return the mind of such files, which lie in a temporary folder as long as it lives."""
    folder = tempfile.TemporaryDirectory()
    for name, content in files.items():
        path = Path(folder.name) / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(content)
    mind = MindDescription.load(folder.name)
    weakref.finalize(mind, folder.cleanup)
    return mind
