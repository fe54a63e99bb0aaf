"""The modules that a model reaches, as they were loaded, and the files that their code reads.

Python's own table of modules says what is loaded; an audit hook sees what is opened.
"""

from __future__ import annotations

import ast
import os
import sys
from collections.abc import Iterator, Mapping
from functools import lru_cache
from importlib.util import resolve_name
from pathlib import Path
from types import FrameType, ModuleType
from typing import Any

from socialmind.compiling.reached import is_of_a_package
from socialmind.language.syntax import parsed
from socialmind.sources.folders import digest
from socialmind.sources.loading import PRIVATE

_HOME = Path(__file__).resolve().parents[1]
_OURS = (f"{_HOME}{os.sep}", f"{_HOME.parent / 'coglogo_py'}{os.sep}")
_loaded: dict[str, tuple[ModuleType, str]] = {}
"""Each module of the user's, and the hash of its file when the module was first seen."""
_read_by: dict[str, dict[str, None]] = {}
"""What the code of each module read while it was loaded, or when a society asked it something."""
_defining: set[str] = set()
"""The modules in which a model was defined."""


def note_definition(module_name: str) -> None:
    """Note the contents of the user's modules as a model is defined, which has just loaded them.

    Args:
        module_name: the module in which the model's class stands.
    """
    _defining.add(module_name)
    for name, module in list(sys.modules.items()):
        known = name in _loaded and _loaded[name][0] is module and name != module_name
        if not known and _is_of_the_user(module):
            file = file_of(module)
            if file is not None:
                _loaded[name] = module, hash_of(file)


def note_module(name: str) -> None:
    """Note the contents of a module of functions, and of those it imports, when it is first met."""
    module = sys.modules.get(name)
    if module is not None and (name not in _loaded or _loaded[name][0] is not module):
        note_definition(name)


def hash_as_loaded(name: str, module: ModuleType) -> str | None:
    """Return the hash of a module's file when the module was first seen; None if it was not."""
    known = _loaded.get(name)
    return known[1] if known is not None and known[0] is module else None


def read_by(name: str) -> list[Path]:
    """Return the files that the code of a module read."""
    return [Path(one) for one in _read_by.get(name, ())]


def _note_read(event: str, arguments: tuple[Any, ...]) -> None:
    """Note a file that a model's own code opens: while it is loaded, or when a society asks it."""
    if event != "open" or not isinstance(arguments[0], str | bytes | os.PathLike):
        return
    mode, flags = arguments[1], arguments[2]
    if set(mode) & set("wax+") if mode else (flags or 0) & (os.O_WRONLY | os.O_RDWR):
        return
    asked: list[str] = []
    frame: FrameType | None = sys._getframe(1)
    while frame is not None:
        file = frame.f_code.co_filename
        if file.startswith(_OURS):
            break  # a society asks; what it reads for itself has nobody before it in the list
        name = frame.f_globals.get("__name__")
        if isinstance(name, str) and not is_of_a_package(file):
            asked.append(name)
            # What a script reads once its model is defined are results, unless a society asks.
            if frame.f_code.co_name == "<module>" and (name != "__main__" or name not in _defining):
                break
        frame = frame.f_back
    else:
        return
    try:
        path = os.path.abspath(os.fsdecode(arguments[0]))  # noqa: PTH100  # of each file opened
    except OSError:  # the working folder is gone; opening the file says so
        return
    for name in asked:
        _read_by.setdefault(name, {})[path] = None


sys.addaudithook(_note_read)

# Modules ------------------------------------------------------------------------------------------

_KNOWN = frozenset((*sys.stdlib_module_names, "socialmind", "coglogo_py", "numpy"))


def reached_modules(
    names: list[str], known: Mapping[str, ModuleType]
) -> tuple[dict[str, ModuleType], dict[str, str]]:
    """Return the user's modules that some modules reach, and the versions of packages.

    Args:
        names: of the modules.
        known: what is called otherwise in Python's own table by now, by name.
    """
    modules: dict[str, ModuleType] = {}
    packages: dict[str, str] = {}
    waiting = list(names)
    while waiting:
        name = waiting.pop()
        module = known.get(name) or sys.modules.get(name)
        root = name.partition(".")[0]
        if module is None or name in modules or root in _KNOWN:
            continue
        if _is_of_the_user(module):
            modules[name] = module
            waiting += _imports_of(module)
        else:
            version = getattr(sys.modules.get(root), "__version__", None)
            packages |= {root: str(version)} if version is not None else {}
    return modules, dict(sorted(packages.items()))


def _is_of_the_user(module: Any) -> bool:
    """Return whether a module is neither Python's, nor an installed package's, nor ours."""
    name, file = getattr(module, "__name__", ""), getattr(module, "__file__", None)
    if name == "__main__" or str(name).startswith(PRIVATE):
        return True
    if not isinstance(file, str) or not file.endswith(".py") or file.startswith(_OURS):
        return False
    return not is_of_a_package(file)


def file_of(module: Any) -> Path | None:
    """Return the file that a module was loaded from, if it is there."""
    file = getattr(module, "__file__", None)
    path = Path(file) if isinstance(file, str) else None
    return path.resolve() if path is not None and path.is_file() else None


def _imports_of(module: ModuleType) -> Iterator[str]:
    """Yield the names of the modules that a module may have imported."""
    file = file_of(module)
    if file is None:
        for value in list(vars(module).values()):
            named = "__name__" if isinstance(value, ModuleType) else "__module__"
            yield str(getattr(value, named, None) or "")
        return
    package = module.__package__ or ""
    for level, name, part in _imports_in(file, file.stat().st_mtime_ns):
        try:
            base = resolve_name("." * level + name, package) if level else name
        except ImportError:
            continue
        yield base
        if part:
            yield f"{base}.{part}"
        while "." in base:
            base = base.rpartition(".")[0]
            yield base


@lru_cache(maxsize=512)
def _imports_in(file: Path, changed: int) -> tuple[tuple[int, str, str], ...]:
    found: list[tuple[int, str, str]] = []
    for node in nodes_of(file):
        if isinstance(node, ast.Import):
            found += [(0, one.name, "") for one in node.names]
        elif isinstance(node, ast.ImportFrom):
            found += [(node.level, node.module or "", one.name) for one in node.names]
    return tuple(found)


def nodes_of(file: Path) -> Iterator[ast.AST]:
    """Return what a Python file is made of; nothing where it cannot be read."""
    try:
        return ast.walk(parsed(file.read_bytes()))
    except (OSError, SyntaxError, ValueError):
        return iter(())  # loading it says what is wrong


def hash_of(path: Path) -> str:
    """Return the hash of a file's contents."""
    return digest(path.read_bytes())
