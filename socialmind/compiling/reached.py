"""What compiled code stands on beside its own text: files that it imports, values that it reads.

numba writes both into machine code, and its cache on disk notices neither when it changes.
"""

from __future__ import annotations

import hashlib
import sys
import sysconfig
from collections.abc import Callable, Iterator
from functools import cache, lru_cache
from pathlib import Path
from types import CodeType, FunctionType, ModuleType
from typing import Any

import numpy as np


def fingerprint(function: Callable[..., Any]) -> str:
    """Return a hash of what a function does: its code, and all constants and helpers it reads.

    Args:
        function: a plain function that numba is to compile.

    Returns:
        64 hexadecimal digits, the same in any process of this Python.
    """
    digest = hashlib.sha256()
    for part in _parts(function, set()):
        digest.update(f"{len(part)}:{part}".encode())
    return digest.hexdigest()


def _parts(value: Any, seen: set[int]) -> Iterator[str]:
    """Yield what tells a value from others, as texts."""
    value = getattr(value, "py_func", value)  # what numba has compiled already
    yield type(value).__qualname__
    if isinstance(value, FunctionType):
        yield f"{value.__module__}.{value.__qualname__}"
        if id(value) not in seen and not is_of_a_package(value.__code__.co_filename):
            seen.add(id(value))
            yield from _parts_of_function(value, seen)
    elif isinstance(value, tuple | list):
        yield str(len(value))
        for one in value:
            yield from _parts(one, seen)
    elif isinstance(value, np.ndarray):
        yield f"{value.dtype} {value.shape} {hashlib.sha256(value.tobytes()).hexdigest()}"
    elif isinstance(value, type | ModuleType):
        yield value.__name__
    elif isinstance(value, CodeType):
        yield value.co_code.hex()
        yield from _parts((value.co_names, value.co_varnames, value.co_consts), seen)
    elif " at 0x" not in (text := repr(value)):
        yield text


def _parts_of_function(function: FunctionType, seen: set[int]) -> Iterator[str]:
    yield from _parts(function.__code__, seen)
    yield from _parts(function.__defaults__ or (), seen)
    for cell in function.__closure__ or ():
        yield from _parts(cell.cell_contents, seen)
    names = sorted(_names(function.__code__))
    for name in names:
        if name not in function.__globals__:
            continue
        value = function.__globals__[name]
        yield name
        yield from _parts(value, seen)
        if isinstance(value, ModuleType):
            for attribute in names:
                if attribute in vars(value):
                    yield from _parts(vars(value)[attribute], seen)


def _names(code: CodeType) -> set[str]:
    """Return the names that a function and those within it read, attributes among them."""
    inner = [one for one in code.co_consts if isinstance(one, CodeType)]
    return set(code.co_names).union(*(_names(one) for one in inner))


@cache  # one for each file that is loaded
def is_of_a_package(file: str) -> bool:
    """Return whether a file is Python's or of an installed package; their versions stand for it."""
    return file.startswith("<frozen") or any(
        Path(file).is_relative_to(home) for home in [*_homes(), *_shared_homes()]
    )


@lru_cache(maxsize=1)
def _homes() -> tuple[str, ...]:
    """Return where Python and its packages lie; asking takes longer than all the rest."""
    names = ("stdlib", "platstdlib", "purelib", "platlib")
    return tuple(dict.fromkeys(one for one in map(sysconfig.get_path, names) if one))


def _shared_homes() -> list[str]:
    return [one for one in sys.path if one.endswith(("site-packages", "dist-packages"))]
