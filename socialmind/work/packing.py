"""Models and minds as bytes that another process can read, and as copies in this one.

Classes and functions of a model's folder stand in modules with private names (`catalogue`), which
no other process can import. In bytes made here they are known by their file, which is loaded again.
What was typed into a notebook goes as its text.
"""

from __future__ import annotations

import importlib
import io
import pickle
import sys
import threading
from pathlib import Path
from types import FunctionType
from typing import Any
from weakref import WeakValueDictionary

from socialmind.errors import ModelError
from socialmind.sources.cells import cells_of
from socialmind.sources.folders import catalogue, digest
from socialmind.sources.loading import PRIVATE, is_alone, load_file, modules_of
from socialmind.sources.typed_in import CELLS, is_typed_in

_packed_here = WeakValueDictionary[tuple[str, str], Any]()
"""What was typed into this process and packed, by what it is called elsewhere."""
_waiting = threading.local()
"""What is being packed: a value that it reads may hold it again."""


def packed(content: Any) -> bytes:
    """Return anything as bytes; `unpacked` is the way back, in this or another process.

    Args:
        content: what is to be packed.

    Raises:
        pickle.PicklingError: a class or function in it is in no file, or within a function.
    """
    stream = io.BytesIO()
    try:
        _Packer(stream, pickle.HIGHEST_PROTOCOL).dump(content)
    except (pickle.PicklingError, AttributeError, TypeError) as error:
        raise pickle.PicklingError(
            f"a part that another process cannot find ({error}); write classes and functions at "
            "the top of a file, such as a model.py"
        ) from None
    return stream.getvalue()


def unpacked(content: bytes) -> Any:
    """Return what was packed.

    Raises:
        ModelError: a model's file has changed since, or is gone.
    """
    return pickle.loads(content)


class _Packer(pickle.Pickler):
    def reducer_override(self, something: Any) -> Any:
        if isinstance(something, type | FunctionType):
            if is_private(something) or is_typed_in(something):
                return reference(something)
        elif getattr(something, "py_func", None) is not None and is_typed_in(something.py_func):
            return reference(something.py_func)
        return NotImplemented


def is_private(something: Any) -> bool:
    """Return whether a class or function stands in a module that was loaded by its path."""
    return str(getattr(something, "__module__", None)).startswith(PRIVATE)


def reference(something: Any) -> tuple[Any, tuple[Any, ...]]:
    """Return a class or function as a call that finds it elsewhere, for `__reduce__`.

    Args:
        something: of a module that was loaded by its path, or typed in.
    """
    if "<locals>" in something.__qualname__:
        raise pickle.PicklingError(f"{something.__qualname__} is made within a function")
    if is_typed_in(something):
        return _typed_in, (_packed_cells(something), something.__qualname__)
    cells = getattr(sys.modules[something.__module__], CELLS, None)
    if cells is not None:
        return _typed_in, (cells, something.__qualname__)
    name, _, inner = something.__module__.partition(".")
    file = Path(str(sys.modules[name].__file__)).resolve()
    modules = modules_of(sys.modules[name])
    elsewhere = () if modules in (None, file.parent) else (str(modules),)
    model = ""
    for known, folder in catalogue().items():
        if file.is_relative_to(folder.resolve()):
            model = known
    return _in_file, (name, str(file), model, inner, something.__qualname__, *elsewhere)


def _packed_cells(something: Any) -> bytes:
    """Return what was typed in as bytes: a class or function, and all that it needs."""
    waiting: list[Any] = _waiting.__dict__.setdefault("one", [])
    if something in waiting:
        raise pickle.PicklingError(f"a value that {something.__name__} reads holds itself of it")
    waiting.append(something)
    try:
        cells = packed(cells_of(something))
    finally:
        waiting.pop()
    _packed_here[_name_of(cells), something.__qualname__] = something
    return cells


def _typed_in(cells: bytes, qualified: str) -> Any:
    """Return a class or function that was typed into another process.

    Args:
        cells: with all that it needs.
        qualified: its name.
    """
    name = _name_of(cells)
    if (name, qualified) in _packed_here:
        return _packed_here[name, qualified]  # come home
    if name not in sys.modules:
        setattr(unpacked(cells).module(name), CELLS, cells)
    return getattr(sys.modules[name], qualified)


def _name_of(cells: bytes) -> str:
    return f"{PRIVATE}cells_{digest(cells)[:24]}"


def _in_file(
    name: str, file: str, model: str, inner: str, qualified: str, modules: str = ""
) -> Any:
    """Return a class or function by its module's name and file.

    Args:
        name: the module's private name.
        file: its file.
        model: the model of the catalogue whose folder the file lies in, which may stand elsewhere
            on another machine; empty for none.
        inner: the module within it, where the folder has several.
        qualified: the qualified name.
        modules: the folder of modules that it may import, where that is not its own.
    """
    module = sys.modules.get(name)
    if module is None:
        path = Path(file)
        elsewhere = bool(model) and not path.is_file()
        if elsewhere:
            path = catalogue().get(model, path.parent) / path.name
        if not path.is_file():
            raise ModelError("a file that is gone", "the one that was packed", file=path)
        if is_alone(path, name):
            module = load_file(path, alone=True, modules=Path(modules) if modules else path.parent)
        else:
            module = load_file(path)
        if module.__name__ != name and not elsewhere:
            raise ModelError(
                "another file than the one that was packed",
                "the same, unchanged",
                "make the model anew, or put the old file back",
                path,
            )
    found: Any = module
    if inner:
        found = importlib.import_module(f"{module.__name__}.{inner}")
    for part in qualified.split("."):
        found = getattr(found, part)
    return found
