"""Compiled modules on disk: one folder for each text and everything it depends on.

numba's own cache on disk misses changes in functions of other files, so the folder's name is a
hash of the text, of the files it calls into and of the versions, and a text is never changed.
"""

from __future__ import annotations

import hashlib
import importlib.util
import inspect
import os
import platform
import sys
import tempfile
from collections.abc import Callable, Mapping
from functools import cache
from pathlib import Path
from threading import RLock
from types import ModuleType
from typing import Any

import numba
import numpy as np
import platformdirs

_LOADING = RLock()

CACHE_VARIABLE = "SOCIALMIND_CACHE_DIR"
"""Environment variable that names the folder of compiled modules."""

_FILES = (
    "coglogo_py/kernel.py",
    "coglogo_py/streams.py",
    "coglogo_py/borrow.py",
    "coglogo_py/arrays.py",
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


def cache_folder() -> Path:
    """Return the folder of compiled modules: the user's cache, or what the variable names."""
    named = os.environ.get(CACHE_VARIABLE)
    return Path(named) if named else Path(platformdirs.user_cache_dir("socialmind"))


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
        if name in sys.modules:
            return sys.modules[name]
        return _loaded(name, _written(key, text), own_makers)


def _loaded(name: str, file: Path, own_makers: Mapping[str, Callable[..., Any]]) -> ModuleType:
    """Return the module of a file, which is then known by its name."""
    spec = importlib.util.spec_from_file_location(name, file)
    if spec is None or spec.loader is None:
        raise ImportError(f"cannot load {file}")
    module = importlib.util.module_from_spec(spec)
    # numba looks up the module of what it loads from its cache by name.
    sys.modules[name] = module
    try:
        spec.loader.exec_module(module)
    except BaseException:
        del sys.modules[name]  # or the next call would take it for whole
        raise
    for population, choose in own_makers.items():
        setattr(module, f"_own_{population}", numba.njit(choose))
    return module


def _written(key: str, text: str) -> Path:
    """Write a module's text into its folder, unless it stands there, and return the file."""
    for root in (cache_folder(), Path(tempfile.gettempdir()) / "socialmind-cache"):
        file = root / key / "loop.py"
        if file.is_file():
            return file
        try:
            file.parent.mkdir(parents=True, exist_ok=True)
            handle, draft = tempfile.mkstemp(dir=file.parent, suffix=".py")
            with os.fdopen(handle, "w", encoding="utf-8") as stream:
                stream.write(text)
            Path(draft).replace(file)
        except OSError:
            continue
        return file
    raise OSError(f"no folder for compiled modules can be written; set {CACHE_VARIABLE}")
