"""Compiled modules: their code is kept under a hash of the text and of everything it depends on.

The hash covers the text, the files it calls into and the versions;
`coglogo_py.compiled.code_folder` says where the code is kept and when that is trusted.
"""

from __future__ import annotations

import hashlib
import platform
import sys
from collections.abc import Callable, Mapping
from threading import RLock
from types import ModuleType
from typing import Any

import numba
import numpy as np

from coglogo_py.compiled.own_maker import compiled_maker
from coglogo_py.compiled.reached import reached_files
from socialmind.compiling.reached import fingerprint

_LOADING = RLock()
_MAKERS = """from coglogo_py.compiled.own_maker import compiled_maker
from coglogo_py.decision import weight_shares"""
"""What a decision maker of the modeller's own stands on."""


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
        return sys.modules.get(name) or _loaded(name, text, own_makers)


def _key(text: str, own_makers: Mapping[str, Callable[..., Any]]) -> str:
    """Return a hash of all that the machine code of a text depends on."""
    digest = hashlib.sha256(text.encode())
    for file in reached_files(text):
        digest.update(f"{file.name}\n".encode() + file.read_bytes())
    for file in reached_files(_MAKERS) if own_makers else ():
        digest.update(file.read_bytes())
    for name, choose in own_makers.items():
        digest.update(f"{name}\n{fingerprint(choose)}".encode())
    versions = (numba.__version__, np.__version__, sys.version, platform.machine())
    digest.update(repr(versions).encode())
    return digest.hexdigest()[:24]


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
