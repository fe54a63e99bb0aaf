"""Functions that only compiled code calls, optimised where they end: in the code that is kept.

numba optimises and emits a function with all that it calls, and does so again in each of its
callers. A model's tick is eight levels deep, so half of the time that compiling took went into code
that nobody runs. Here a function without a door for Python stays as numba lowered it; what has one
takes in all that it needs and is optimised as a whole. That reaches into numba, so it is done with
versions where it was tried (`TRIED`); with others numba does as it does, and takes longer.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import numba
from numba.core.codegen import JITCodeLibrary
from numba.core.compiler_lock import global_compiler_lock
from numba.core.registry import cpu_target
from numba.core.targetconfig import ConfigStack

TRIED = ((0, 68),)
"""Versions of numba."""
_WHOLE: list[str] = []
"""The functions that are being compiled to be kept, the innermost last."""


@contextmanager
def optimised_once(function: str) -> Iterator[None]:
    """Let what a function calls be optimised in it alone.

    Args:
        function: the qualified name of what is compiled meanwhile; it may lack doors for Python.
    """
    if numba.version_info.short not in TRIED:
        yield
        return
    with global_compiler_lock:
        codegen = cpu_target.target_context.codegen()
        library, set_environment = codegen._library_class, codegen.set_env
        codegen._library_class = _Library
        codegen.set_env = _setting_where_there_is(codegen)
        _WHOLE.append(function)
        try:
            yield
        finally:
            _WHOLE.pop()
            codegen._library_class, codegen.set_env = library, set_environment


def _setting_where_there_is(codegen: Any) -> Any:
    """Return what tells code its Python objects, unless the code was not emitted."""

    def set_environment(name: str, environment: Any) -> None:
        if codegen._engine.get_global_value_address(name):
            type(codegen).set_env(codegen, name, environment)

    return set_environment


class _Library(JITCodeLibrary):
    """The code of one function, which may wait for its callers."""

    _waits = False

    def finalize(self) -> None:
        """Take in what is called and optimise all, or leave both to the callers."""
        flags = ConfigStack.top_or_none()
        doorless = flags is not None and flags.no_cpython_wrapper and flags.no_cfunc_wrapper
        if doorless and self.name not in _WHOLE:
            self._raise_if_finalized()
            self._finalize_dynamic_globals()
            self._finalized = self._waits = True
        else:
            self._take_in()
            super().finalize()

    def _optimize_final_module(self) -> None:
        """Optimise all; a second time, since loops of what was taken in come to light by the first.

        Code that was optimised once ran up to half again as long, a third time changes nothing.
        """
        super()._optimize_final_module()
        super()._optimize_final_module()

    def _get_module_for_linking(self) -> Any:
        """Return the code for numba's own callers, complete."""
        if self._waits:
            self._take_in()
            self._waits, self._shared_module = False, None
        return super()._get_module_for_linking()

    def _own_code(self) -> Any:
        return super()._get_module_for_linking()

    def _take_in(self) -> None:
        """Link all that is called into this code, from wherever it waits.

        LLVM drops what nothing refers to yet, so callers come before what they call.
        """
        home: dict[str, Any] = {}
        for one in _reached(self):
            waits = isinstance(one, _Library) and one._waits
            code = one._own_code() if waits else one._get_module_for_linking()
            for function in code.functions:
                if not function.is_declaration:
                    home.setdefault(function.name, code)
            self._reload_init.update(one._reload_init)
        self._linking_libraries: list[Any] = []
        while asked := [one for one in self._undefined() if one in home]:
            for name in asked:
                if self._final_module.get_function(name).is_declaration:
                    self._final_module.link_in(home[name], preserve=True)

    def _undefined(self) -> list[str]:
        return [one.name for one in self._final_module.functions if one.is_declaration]


def _reached(library: Any) -> list[Any]:
    """Return the libraries that one links, and that those link which wait."""
    found: dict[int, Any] = {}
    left = [library]
    while left:
        for one in left.pop()._linking_libraries:
            if id(one) not in found:
                found[id(one)] = one
                if isinstance(one, _Library) and one._waits:
                    left.append(one)
    return list(found.values())
