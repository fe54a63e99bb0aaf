"""numba's compiled functions, kept in the checked folder of `code_folder`.

numba's own cache on disk lies beside the package or wherever it finds room, misses changes in
functions of other files, and stops on a damaged file. Here a function is kept under a key that
says all that it depends on; what cannot be loaded is compiled.
"""

from __future__ import annotations

import gc
import hashlib
import os
import pickle
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from functools import cache
from pathlib import Path
from typing import Any

import llvmlite  # type: ignore[import-untyped]  # it carries no types
import numba
import numpy as np
from numba.core import sigutils
from numba.core.ccallback import CFunc
from numba.core.compiler import CompileResult
from numba.core.cpu import CPUContext
from numba.core.registry import cpu_target
from numba.core.serialize import dumps

from coglogo_py.compiled import code_folder
from coglogo_py.compiled.optimised_once import optimised_once
from coglogo_py.compiled.reached import reached_files

ADDRESSES = 600
"""Megabytes of addresses that numba, its compiler and linear algebra take, measured."""
ADDRESSES_OF_CORE = 40
"""Megabytes that the linear algebra sets aside for each core besides."""


def kept(key: str, **options: Any) -> Callable[[Callable[..., Any]], Any]:
    """Return the decorator that compiles a function when it is called, and keeps the code.

    Args:
        key: names all that the code depends on beside the function's own text.
        **options: as of `numba.njit`.
    """

    def compiled(function: Callable[..., Any]) -> Any:
        def anew(signature: Any) -> CompileResult:
            passing = numba.njit(**options)(function)
            passing.compile(signature)
            (result,) = passing.overloads.values()
            return result

        dispatcher = numba.njit(**options)(function)
        dispatcher._cache = _KeptCode(function, key, anew)
        return dispatcher

    return compiled


def kept_callback(key: str, signature: str, **options: Any) -> Callable[[Callable[..., Any]], Any]:
    """Return the decorator that compiles a function to be called by its address, and keeps it.

    Args:
        key: names all that the code depends on beside the function's own text.
        signature: the types that it takes and returns.
        **options: as of `numba.cfunc`.
    """

    def compiled(function: Callable[..., Any]) -> Any:
        def new() -> Any:
            return CFunc(function, sigutils.normalize_signature(signature), {}, options)

        made = new()
        made._cache = _KeptCode(function, key, lambda _: new()._compile_uncached())
        made.compile()
        return made

    return compiled


def key_of_file(name: str, file: str) -> str:
    """Return a key that changes with a file, what it imports, and the versions of what compiles it.

    Args:
        name: what the key begins with.
        file: the file that the code is made from.
    """
    text = Path(file).read_bytes()
    digest = hashlib.sha256(repr(versions()).encode() + text)
    for reached in reached_files(text.decode("utf-8")):
        digest.update(reached.read_bytes())
    return f"{name}_{digest.hexdigest()[:24]}"


def versions() -> tuple[str, ...]:
    """Return the versions of all that compiled code depends on; the processor comes beside."""
    return numba.__version__, llvmlite.__version__, np.__version__, sys.version


def check_memory() -> None:
    """Refuse to compile where a limit leaves too little memory for it.

    Beyond that limit the linear algebra that numba loads asks for memory for ever.

    Raises:
        MemoryError: `ulimit -v` is below what loading and compiling takes.
    """
    try:
        import resource
    except ImportError:  # Windows
        return
    allowed = resource.getrlimit(resource.RLIMIT_AS)[0]
    needed = ADDRESSES + ADDRESSES_OF_CORE * (os.cpu_count() or 1)
    if allowed != resource.RLIM_INFINITY and allowed < needed * 10**6:
        raise MemoryError(
            f"compiled code needs addresses for about {needed:,} MB, and the limit is "
            f"{allowed // 10**6:,} MB; raise it with `ulimit -v`"
        )


@cache
def _apart() -> CPUContext:
    """Return where kept code is loaded, apart from all that this process compiles.

    Code shares what it calls with what was loaded before it. A process that compiles has that
    first as it was before its callers were known, up to twice as slow as in the code that is kept.
    """
    return CPUContext(cpu_target.typing_context)


@contextmanager
def _nothing_collected() -> Iterator[None]:
    """Let the collector of cycles rest: the objects of a compiler are many and stay to its end.

    Looking through them again and again takes a sixth of the time that compiling takes.
    """
    collecting = gc.isenabled()
    gc.disable()
    try:
        yield
    finally:
        if collecting:
            gc.enable()


class _KeptCode:
    """The kept code of one function; numba calls these methods in place of its own cache's.

    numba finds all code kept: what is not there is compiled, kept, and loaded like the rest.

    Args:
        function: whose code it is.
        key: names all that the code depends on beside the function's own text.
        anew: compiles it for a signature.
    """

    def __init__(
        self, function: Callable[..., Any], key: str, anew: Callable[[Any], CompileResult]
    ) -> None:
        self._qualified = function.__qualname__
        self._name = self._qualified.replace("<", "").replace(">", "")
        self._line = function.__code__.co_firstlineno
        self._key = key
        self._anew = anew

    @property
    def cache_path(self) -> str:
        """The folder of the function's code."""
        return str(code_folder.cache_folder() or "")

    def load_overload(self, signature: Any, target: Any) -> CompileResult:
        """Return the function compiled for a signature."""
        check_memory()
        target.refresh()
        file = self._file(signature, target.codegen())
        content = code_folder.read(self._key, file)
        if content is not None:
            # Of another numba, or half of what it refers to: as if it were not there.
            with suppress(Exception):
                return CompileResult._rebuild(_apart(), *pickle.loads(content))
        with _nothing_collected(), optimised_once(self._qualified):
            result = self._anew(signature)
        # Addresses of this process have no place in another.
        if result.library.has_dynamic_globals or not all(one.can_cache for one in result.lifted):
            return result
        content = dumps(result._reduce())
        code_folder.keep(self._key, file, content)
        return CompileResult._rebuild(_apart(), *pickle.loads(content))

    def save_overload(self, signature: Any, result: Any) -> None:
        """Keep nothing: what is compiled is kept where it is compiled."""

    def flush(self) -> None:
        """Forget nothing: a key's code never changes."""

    def _file(self, signature: Any, codegen: Any) -> str:
        """Return the file's name, which says for which types and which processor the code is."""
        made_for = hashlib.sha256(repr((signature, codegen.magic_tuple())).encode()).hexdigest()
        return f"{self._name}-{self._line}-{made_for[:16]}.code"
