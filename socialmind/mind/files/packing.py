"""A mind as the files of its folder: to be kept, compared, and found on another machine."""

from __future__ import annotations

import tempfile
import weakref
from collections.abc import Mapping
from pathlib import Path

from socialmind.mind.description import MindDescription
from socialmind.mind.files.folder import files_of

__all__ = ["files_of", "mind_of"]


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
