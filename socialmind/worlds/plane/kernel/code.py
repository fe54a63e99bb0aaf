"""The compiled kernel of the plane as a module: three functions that are called by address."""

from __future__ import annotations

from functools import cache
from typing import Any

from socialmind.compiling.modules import compiled_module

# No error can pass a call by address; the functions raise none, and say what is wrong by a number.
_TEXT = '''"""The kernel of the plane; see socialmind/worlds/plane/kernel."""

from coglogo_py.compiled.machine_code import kept_callback as _kept_callback

from socialmind.worlds.plane.kernel import motion as _motion
from socialmind.worlds.plane.kernel import rays as _rays
from socialmind.worlds.plane.kernel import stones as _stones

_SIGNATURE = "int64(int64, int64, int64)"


@_kept_callback(__name__, _SIGNATURE, error_model="numpy")
def build(plane, _, __):
    return _stones.build(plane)


@_kept_callback(__name__, _SIGNATURE, error_model="numpy")
def move(plane, _, __):
    return _motion.move(plane)


@_kept_callback(__name__, _SIGNATURE, error_model="numpy")
def look(plane, eyes, _):
    return _rays.look(plane, eyes)
'''


@cache
def kernel() -> Any:
    """Return the module of the compiled functions `build`, `move` and `look`.

    Each takes three whole numbers, the first the address of a plane's record; `look` the address of
    the eyes as its second; the others are 0. Each returns 0, or what `stones.build`, `motion.move`
    and `rays.look` say. Compiled code calls them by `call_at(kernel().move.address, …)`, Python by
    `kernel().move.ctypes(…)`, which lets other threads run meanwhile.
    """
    return compiled_module(_TEXT, {})
