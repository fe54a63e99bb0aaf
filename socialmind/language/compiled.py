"""Compiled modules on disk: one folder for each text and everything it depends on.

numba's own cache on disk misses changes in functions of other files, so the folder's name is a
hash of the text, of the files it calls into and of the versions, and a text is never changed.
"""

from __future__ import annotations

import hashlib
import importlib.util
import os
import platform
import sys
import tempfile
from collections.abc import Callable, Mapping
from pathlib import Path
from threading import RLock
from types import ModuleType
from typing import Any

import numba
import numpy as np
import platformdirs

from socialmind.language.reached import fingerprint, reached_files

_LOADING = RLock()

CACHE_VARIABLE = "SOCIALMIND_CACHE_DIR"
"""Environment variable that names the folder of compiled modules."""


def cache_folder() -> Path:
    """Return the folder of compiled modules: the user's cache, or what the variable names."""
    named = os.environ.get(CACHE_VARIABLE)
    return Path(named) if named else Path(platformdirs.user_cache_dir("socialmind"))


def compiled_module(text: str, own_makers: Mapping[str, Callable[..., Any]]) -> ModuleType:
    """Return the module of a text; its loops compile when they are first called, then load.

    Args:
        text: the module's source.
        own_makers: population -> the `choose` function of its scheme's own decision maker.
    """
    key = _key(text, own_makers)
    name = f"socialmind_compiled_{key}"
    # Another thread must not take for whole what is still being loaded.
    with _LOADING:
        if name in sys.modules:
            return sys.modules[name]
        return _loaded(name, _written(key, text), own_makers)


def _key(text: str, own_makers: Mapping[str, Callable[..., Any]]) -> str:
    """Return a hash of all that the machine code of a text depends on."""
    digest = hashlib.sha256(text.encode())
    for file in reached_files(text):
        digest.update(f"{file.name}\n".encode() + file.read_bytes())
    for name, choose in own_makers.items():
        digest.update(f"{name}\n{fingerprint(choose)}".encode())
    versions = (numba.__version__, np.__version__, sys.version, platform.machine())
    digest.update(repr(versions).encode())
    return digest.hexdigest()[:24]


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
