"""How a place in what the user wrote is called: by file and line, or by a notebook's cell."""

from __future__ import annotations

import re
import sys
from collections.abc import Mapping
from pathlib import Path
from typing import Any

_MARIMO = re.compile(r"__marimo__cell_([^_]+)_")
_told: dict[str, str] = {}
"""What cells of another process are called there, by the names of their files."""


def place(file: str | Path | None, line: int | None = None) -> str:
    """Return a place in words; nothing where nothing is known.

    >>> place("model.py", 12), place("model.py"), place(None, 3), place(None)
    ('model.py:12', 'model.py', 'line 3', '')
    """
    if file is None:
        return "" if line is None else f"line {line}"
    cell = cell_of(str(file))
    if cell is not None:
        return cell if line is None else f"{cell}, line {line}"
    return str(file) if line is None else f"{file}:{line}"


def cell_of(file: str) -> str | None:
    """Return what a notebook calls the cell that it keeps under a file's name; None for a file.

    >>> cell_of("/tmp/marimo_23/__marimo__cell_Hbol_.py"), cell_of("model.py")
    ('cell Hbol', None)
    """
    if file in _told:
        return _told[file]
    found = _MARIMO.search(file)
    if found:
        return f"cell {found[1]}"
    ipython = sys.modules.get("IPython")
    shell: Any = None if ipython is None else ipython.get_ipython()
    naming = getattr(getattr(shell, "compile", None), "format_code_name", None)
    named = None if naming is None else naming(file)
    return None if named is None else f"cell {named[1]}"


def tell(names: Mapping[str, str]) -> None:
    """Take over what cells are called in the process that they were typed into."""
    _told.update(names)
