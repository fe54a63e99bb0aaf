"""Compiled modules: their code is kept under a hash of the text and of everything it depends on.

The hash covers the text, the files it calls into and the versions (`coglogo_py.code_folder` says
where the code is kept and when that is trusted).
"""

from __future__ import annotations

import hashlib
import inspect
import platform
import sys
from collections.abc import Callable, Mapping
from functools import cache
from pathlib import Path
from threading import RLock
from types import ModuleType
from typing import Any

import numba
import numpy as np

from coglogo_py.own_maker import compiled_maker

_LOADING = RLock()

_FILES = (
    "coglogo_py/kernel.py",
    "coglogo_py/streams.py",
    "coglogo_py/borrow.py",
    "coglogo_py/arrays.py",
    "coglogo_py/own_maker.py",
    "socialmind/streams.py",
    "socialmind/bookkeeping.py",
    "socialmind/language/arithmetic.py",
    "socialmind/language/memory.py",
    "socialmind/worlds/torus.py",
    "socialmind/worlds/plane/relative.py",
    "socialmind/worlds/plane/layout.py",
    "socialmind/worlds/plane/kernel/bodies.py",
    "socialmind/worlds/plane/kernel/contacts.py",
    "socialmind/worlds/plane/kernel/motion.py",
    "socialmind/worlds/plane/kernel/rays.py",
    "socialmind/worlds/plane/kernel/stones.py",
    "socialmind/mind/functions/activations.py",
    "socialmind/mind/functions/network.py",
    "socialmind/mind/regulation.py",
    "socialmind/mind/kernel/flow.py",
    "socialmind/mind/kernel/layout.py",
    "socialmind/mind/kernel/networks.py",
    "socialmind/mind/kernel/record.py",
    "socialmind/mind/kernel/reach.py",
    "socialmind/mind/kernel/signals.py",
    "socialmind/mind/kernel/variables.py",
    "socialmind/mind/kernel/weights.py",
)


@cache
def _surroundings() -> bytes:
    """Return a hash of all that a compiled module depends on beside its own text."""
    import coglogo_py
    import socialmind

    packages = {"coglogo_py": coglogo_py, "socialmind": socialmind}
    digest = hashlib.sha256()
    for name in _FILES:
        package, _, rest = name.partition("/")
        digest.update((Path(str(packages[package].__file__)).parent / rest).read_bytes())
    versions = (numba.__version__, np.__version__, sys.version, platform.machine())
    digest.update(repr(versions).encode())
    return digest.digest()


def compiled_module(text: str, own_makers: Mapping[str, Callable[..., Any]]) -> ModuleType:
    """Return the module of a text; its loops compile when they are first called, then load.

    Args:
        text: the module's source.
        own_makers: population -> the `choose` function of its scheme's own decision maker.
    """
    digest = hashlib.sha256(_surroundings() + text.encode())
    for name, choose in own_makers.items():
        digest.update(f"{name}\n{inspect.getsource(choose)}".encode())
    key = digest.hexdigest()[:24]
    name = f"socialmind_compiled_{key}"
    # Another thread must not take for whole what is still being loaded.
    with _LOADING:
        return sys.modules.get(name) or _loaded(name, text, own_makers)


def _loaded(name: str, text: str, own_makers: Mapping[str, Callable[..., Any]]) -> ModuleType:
    """Return the module of a text, which is then known by its name."""
    module = ModuleType(name)
    for population, choose in own_makers.items():
        setattr(module, f"_own_{population}", compiled_maker(choose))
    # numba looks up the module of the code that was kept by name.
    sys.modules[name] = module
    try:
        exec(compile(text, f"<{name}>", "exec"), vars(module))
    except BaseException:
        del sys.modules[name]  # or the next call would take it for whole
        raise
    return module
