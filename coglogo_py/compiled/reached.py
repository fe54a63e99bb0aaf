"""Which files of this program compiled code stands on: those that its text imports, and so on.

numba writes them into machine code, and its cache on disk does not notice when one changes.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from functools import lru_cache
from pathlib import Path

_ROOT = Path(__file__).resolve().parent.parent.parent
_OURS = ("socialmind", "coglogo_py")
# Syntax trees would say the same, ten times as slowly, in each start of a run.
_IMPORT = re.compile(
    r"^(?:from|import)\s+([\w.]+)(?:\s+import\s+(\([^)]*\)|[^\n#]*))?", re.MULTILINE
)


def reached_files(text: str) -> tuple[Path, ...]:
    """Return the files of this program that a module's text imports, and those that these import.

    Imports within functions, and those for annotations alone, are left out: compiled code has none.

    >>> [one.name for one in reached_files("from coglogo_py import streams")]
    ['streams.py']
    """
    found: dict[Path, None] = {}
    waiting = list(_imported(text))
    while waiting:
        file = waiting.pop()
        if file not in found:
            found[file] = None
            waiting += _imported_by(file, file.stat().st_mtime_ns)
    return tuple(sorted(found))


@lru_cache(maxsize=256)
def _imported_by(file: Path, changed: int) -> tuple[Path, ...]:
    return tuple(_imported(file.read_text(encoding="utf-8")))


def _imported(text: str) -> Iterator[Path]:
    """Yield the files of modules that the statements at the left margin of a text import."""
    for module, names in _IMPORT.findall(text):
        for name in names.strip("()").split(",") or [""]:
            words = name.split()
            yield from (_files_of(f"{module}.{words[0]}") if words else []) or _files_of(module)


def _files_of(module: str) -> list[Path]:
    """Return the file of a module of ours; none for a package, whose names come from elsewhere."""
    file = _ROOT.joinpath(*module.split(".")).with_suffix(".py")
    return [file] if module.split(".")[0] in _OURS and file.is_file() else []
