"""How compiled code reaches the arrays of a model: by addresses that the model's record holds.

A rule then takes the model as one pointer, whatever the model holds, and arrays can be replaced by
larger ones between two stretches of ticks. The arrays themselves belong to the Python side, which
keeps them alive while compiled code runs.
"""

from __future__ import annotations

from typing import Any

from llvmlite import ir
from numba import types
from numba.extending import intrinsic, register_jitable


@intrinsic  # type: ignore[untyped-decorator]  # numba carries no types
def as_pointer(typing_context: Any, address: Any) -> Any:
    """Return an address, a whole number, as a pointer for `numba.carray`."""

    def generate(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        return builder.inttoptr(arguments[0], ir.IntType(8).as_pointer())

    return types.voidptr(types.int64), generate


@register_jitable
def some(there: bool, value: Any) -> Any:
    """Return an optional field's value; raise when it is None."""
    if not there:
        raise ValueError("a field that is None was used as a number")
    return value
