"""A package's names, each imported when it is first used: who needs few of them starts fast."""

from __future__ import annotations

import sys
from collections.abc import Callable, Mapping
from importlib import import_module


def on_demand(
    package: str, names: Mapping[str, str]
) -> tuple[Callable[[str], object], Callable[[], list[str]], list[str]]:
    """Return a package's `__getattr__`, `__dir__` and `__all__`.

    Args:
        package: its `__name__`.
        names: of each module that defines some of them, the names, with blanks between.

    >>> get, _, names = on_demand("coglogo_py", {"math": "pi tau"})
    >>> get("pi"), names
    (3.141592653589793, ['pi', 'tau'])
    """
    homes = {name: module for module, several in names.items() for name in several.split()}

    def get(name: str) -> object:
        if name not in homes:
            raise AttributeError(f"module {package!r} has no attribute {name!r}")
        found = getattr(import_module(homes[name]), name)
        setattr(sys.modules[package], name, found)
        return found

    def names_there() -> list[str]:
        return sorted({*vars(sys.modules[package]), *homes})

    return get, names_there, sorted(homes)
