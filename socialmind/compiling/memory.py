"""How compiled code reaches the arrays of a model: by addresses that the model's record holds.

A rule then takes the model as one pointer, whatever the model holds, and arrays can be replaced by
larger ones between two stretches of ticks. The arrays themselves belong to the Python side, which
keeps them alive while compiled code runs.
"""

from __future__ import annotations

import ctypes
from typing import Any

import numpy as np
from llvmlite import ir  # type: ignore[import-untyped]  # it carries no types
from numba import types
from numba.extending import intrinsic, register_jitable

CACHE_LINE = 64
"""Bytes that processors fetch at once."""
_PLACE = ctypes.c_char * 0


def address(array: Any) -> int:
    """Return where an array lies in memory."""
    try:  # `array.ctypes` takes five times as long, the interface of an array of records more
        return ctypes.addressof(_PLACE.from_buffer(array))
    except TypeError:  # it is not to be written to
        return int(array.ctypes.data)


@intrinsic
def as_pointer(typing_context: Any, address: Any) -> Any:
    """Return an address, a whole number, as a pointer for `numba.carray`."""

    def generate(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        return builder.inttoptr(arguments[0], ir.IntType(8).as_pointer())

    return types.voidptr(types.int64), generate


@intrinsic
def call_at(typing_context: Any, function: Any, one: Any, two: Any, three: Any) -> Any:
    """Call the compiled function at an address with three whole numbers; it returns one.

    What is called so is compiled for itself, not again in every module that calls it.
    """

    def generate(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        whole = ir.IntType(64)
        kind = ir.FunctionType(whole, [whole, whole, whole])
        pointer = builder.inttoptr(arguments[0], kind.as_pointer())
        return builder.call(pointer, arguments[1:])

    whole_number = types.int64
    return whole_number(whole_number, whole_number, whole_number, whole_number), generate


@intrinsic
def fetch_ahead(typing_context: Any, array: Any, row: Any) -> Any:
    """Ask the processor to fetch a row of an array that will be needed soon.

    Agents come in random order, so in large populations each would else wait for its memory.
    """

    def generate(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        parts = context.make_array(array)(context, builder, arguments[0])
        stride = builder.extract_value(parts.strides, 0)
        byte = ir.IntType(8).as_pointer()
        place = builder.ptrtoint(parts.data, ir.IntType(64))
        place = builder.add(place, builder.mul(stride, arguments[1]))
        flag = ir.IntType(32)
        kind = ir.FunctionType(ir.VoidType(), [byte, flag, flag, flag])
        prefetch = builder.module.declare_intrinsic("llvm.prefetch", [byte], kind)
        to_write, keep, data = flag(1), flag(3), flag(1)
        size = array.dtype.size if hasattr(array.dtype, "size") else CACHE_LINE
        for offset in range(0, size, CACHE_LINE):
            line = builder.inttoptr(builder.add(place, ir.IntType(64)(offset)), byte)
            builder.call(prefetch, [line, to_write, keep, data])
        return context.get_dummy_value()

    return types.none(array, types.int64), generate


@intrinsic
def lowest_bit(typing_context: Any, bits: Any) -> Any:
    """Return the number of the lowest bit of a whole number that is set; it is not 0."""

    def generate(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        return builder.cttz(arguments[0], ir.Constant(ir.IntType(1), 1))

    return types.int64(types.int64), generate


@register_jitable
def some(there: bool, value: Any) -> Any:
    """Return an optional field's value; raise when it is None."""
    if not there:
        raise ValueError("a field that is None was used as a number")
    return value


@register_jitable
def index(number: int) -> Any:
    """Return a whole number that is not below 0 as an index, which numba need not look at for that.

    Else each element of an array costs four instructions more, for those counted from the end.
    """
    return np.uint64(number)
