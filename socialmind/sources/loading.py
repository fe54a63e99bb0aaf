"""Loading Python files of models and minds by path, under private names."""

from __future__ import annotations

import ast
import hashlib
import importlib.util
import os
import signal
import sys
import threading
import traceback
from collections.abc import Iterator
from contextlib import contextmanager, nullcontext
from pathlib import Path
from types import CodeType, FrameType, ModuleType

from socialmind.errors import ModelError, SocialmindError
from socialmind.language.syntax import parsed
from socialmind.sources.folders import source_hash
from socialmind.sources.trust import remember
from socialmind.sources.typed_in import CELLS, MAIN

PRIVATE = "_socialmind_"
"""How the names of modules begin that were loaded by path."""


def load_file(path: Path, alone: bool = False, modules: Path | None = None) -> ModuleType:
    """Run a Python file as a module with a private name that stands for its folder's content.

    The module is the package of its folder, so ``from .rules import eat`` finds ``rules.py``
    beside it, and two models may both have one. The same, unchanged file gives the same module.
    It is remembered as run by this user (`socialmind.sources.trust`).

    Args:
        path: the file.
        alone: whether it stands for itself, and not for the folder that it lies in.
        modules: a folder of modules that it may import.

    Raises:
        ModelError: it is no Python, or stopped with an error.
    """
    source = path.read_bytes()
    name = _private_name(path, source, alone)
    if name in sys.modules:
        return sys.modules[name]
    spec = importlib.util.spec_from_file_location(
        name, path, submodule_search_locations=[str(path.parent)]
    )
    if spec is None:
        raise ModelError("a file that Python cannot load", file=path)
    module = importlib.util.module_from_spec(spec)
    code = _compile(source, path)
    remember({str(path): source})
    sys.modules[name] = module
    with _heard_interrupts() as heard:
        try:
            with _no_bytecode(), nullcontext() if modules is None else modules_from(modules):
                exec(code, module.__dict__)
                if modules is not None:
                    spec.loader_state = modules, _of_folder(modules)
        except SocialmindError:
            _forget(name)
            raise
        except BaseException as error:
            _forget(name)
            if heard:  # the user's Ctrl-C, and not the file's own exit
                raise
            raise _failed_import(error, path) from error
    return module


def modules_of(module: ModuleType) -> Path | None:
    """Return the folder of modules that was given with a file; None where none was."""
    found = getattr(getattr(module, "__spec__", None), "loader_state", None)
    return Path(found[0]) if isinstance(found, tuple) else None


def found_by(module: ModuleType) -> dict[str, ModuleType]:
    """Return the modules of that folder as the file found them, by name.

    Another file's may have the names since.
    """
    found = getattr(getattr(module, "__spec__", None), "loader_state", None)
    return dict(found[1]) if isinstance(found, tuple) else {}


def _of_folder(folder: Path) -> dict[str, ModuleType]:
    return {
        name: one
        for name, one in list(sys.modules.items())
        if not name.startswith(PRIVATE)
        and Path(getattr(one, "__file__", None) or "").is_relative_to(folder)
    }


def is_alone(path: Path, name: str) -> bool:
    """Return whether a private name is the one of a file that stands for itself."""
    return name == _private_name(path, path.read_bytes(), alone=True)


def _private_name(path: Path, source: bytes, alone: bool) -> str:
    around = "" if alone else source_hash(path.parent)
    key = hashlib.sha256(f"{path}\0{around}\0".encode() + source).hexdigest()
    # A dot would make it the part of a package: MetaCiv's users end names in "(v2.0)".
    return f"{PRIVATE}{path.parent.name}_{path.stem}_{key[:16]}".replace(".", "_")


def _compile(source: bytes, path: Path) -> CodeType:
    """Compile the file as it stands, past any stale bytecode."""
    try:
        return compile(source, str(path), "exec", dont_inherit=True)
    except SyntaxError as error:
        raise _failed_import(error, path) from error
    except (RecursionError, MemoryError) as error:
        raise ModelError("brackets or blocks nested too deep for Python", file=path) from error
    except ValueError as error:  # null bytes
        raise ModelError(f"not a Python file ({error})", file=path) from error


def tree_of(source: bytes | str, path: Path) -> ast.Module:
    """Return the syntax tree of a Python file of a model or mind; nothing of it is run.

    Args:
        source: what the file holds.
        path: the file.

    Raises:
        ModelError: it is no Python.
    """
    try:
        tree: ast.Module = parsed(source)
    except SyntaxError as error:
        raise ModelError(f"not valid Python ({error.msg})", file=path, line=error.lineno) from None
    except ValueError as error:  # null bytes
        raise ModelError(f"not a Python file ({error})", file=path) from None
    return tree


@contextmanager
def _no_bytecode() -> Iterator[None]:
    """Neither leave a ``__pycache__`` in a model's folder nor run what lies in one there."""
    before = sys.dont_write_bytecode, sys.pycache_prefix
    sys.dont_write_bytecode, sys.pycache_prefix = True, os.devnull
    try:
        yield
    finally:
        sys.dont_write_bytecode, sys.pycache_prefix = before


@contextmanager
def _heard_interrupts() -> Iterator[list[int]]:
    """Note the signals of Ctrl-C, to tell them from an exception that a file raises itself."""
    heard: list[int] = []
    before = signal.getsignal(signal.SIGINT)
    if threading.current_thread() is not threading.main_thread() or not callable(before):
        yield heard
        return

    def noted(number: int, frame: FrameType | None) -> None:
        heard.append(number)
        before(number, frame)

    signal.signal(signal.SIGINT, noted)
    try:
        yield heard
    finally:
        # Unless the file set a handler of its own, which then stays.
        if signal.getsignal(signal.SIGINT) is noted:
            signal.signal(signal.SIGINT, before)


def _forget(name: str) -> None:
    """Take a module that failed, and its siblings, out of Python's table of modules."""
    for loaded in [m for m in sys.modules if m == name or m.startswith(name + ".")]:
        del sys.modules[loaded]


def _failed_import(error: BaseException, path: Path) -> ModelError:
    """Say in one line why a file of a model or mind cannot be loaded."""
    if isinstance(error, SyntaxError):
        return ModelError(
            f"not valid Python ({error.msg})", file=error.filename or path, line=error.lineno
        )
    missing = error.name if isinstance(error, ModuleNotFoundError) else None
    remedy = None
    if missing and (path.parent / f"{missing}.py").is_file():
        remedy = f"write `from . import {missing}` for a file of the model's own folder"
    elif missing:
        remedy = f"install {missing}, or correct the name"
    return failure_in_model(error, path, "loading", remedy)


def failure_in_model(
    error: BaseException, path: Path | None, doing: str, remedy: str | None = None
) -> ModelError:
    """Say in one line where in a model's own files an error came from.

    Args:
        error: what was raised.
        path: the file that was called; None for what was typed in.
        doing: what the file was called for.
        remedy: what to do.

    Returns:
        An error that names the innermost line that lies in the folder of `path`, or was typed in.
    """
    file, line = path, None
    for frame, number in traceback.walk_tb(error.__traceback__):
        place = Path(frame.f_code.co_filename)
        typed_in = frame.f_globals.get("__name__") == MAIN or CELLS in frame.f_globals
        if typed_in if path is None else place.is_relative_to(path.parent):
            file, line = place, number
    try:
        said = f": {error}"
    except Exception:  # an exception of the file's own, which cannot be written
        said = ""
    return ModelError(
        f"{doing} stopped with {type(error).__name__}{said}", remedy=remedy, file=file, line=line
    )


@contextmanager
def modules_from(folder: Path) -> Iterator[None]:
    """Let imports find the modules of a folder first, and load those anew.

    Args:
        folder: which need not exist.
    """
    own = {one.stem for one in folder.iterdir()} if folder.is_dir() else set()
    before = {name: one for name, one in sys.modules.items() if name.partition(".")[0] in own}
    from_elsewhere = {
        name
        for name, one in before.items()
        if not str(getattr(one, "__file__", None) or "").startswith(str(folder))
        and name.partition(".")[0] not in sys.stdlib_module_names
    }
    for name in from_elsewhere:
        del sys.modules[name]
    sys.path.insert(0, str(folder))
    try:
        yield
    finally:
        sys.path.remove(str(folder))
        for name in from_elsewhere:
            sys.modules[name] = before[name]
