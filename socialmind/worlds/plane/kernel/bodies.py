"""The rows of bodies as the compiled kernel reaches them: kinds, who lives, a body's record."""

from __future__ import annotations

from typing import Any

from numba import carray, types
from numba.extending import register_jitable

from socialmind.compiling.memory import as_pointer
from socialmind.worlds.plane.layout import BODY, KIND


@register_jitable(error_model="numpy")
def kinds_of(plane: Any) -> Any:
    """Return the records of the kinds of bodies."""
    return carray(as_pointer(plane.kinds), (plane.kind_count,), KIND)


@register_jitable(error_model="numpy")
def alive_of(kind: Any) -> Any:
    """Return which slots of a kind live."""
    return carray(as_pointer(kind.alive), (kind.capacity,), types.uint8)


@register_jitable(error_model="numpy")
def body_at(kind: Any, slot: int) -> Any:
    """Return a body's record, from its column x on."""
    return carray(as_pointer(kind.rows + slot * kind.stride), (1,), BODY)[0]
