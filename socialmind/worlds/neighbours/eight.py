"""Eight entries looked at in one step: who of them is near enough, as bits.

Processors compare eight distances, or four or two, as quickly as one, and need not guess how many
of them will be near. Each is rounded as `questions.square_of_distance` rounds it.
"""

from __future__ import annotations

from typing import Any

from llvmlite import ir  # type: ignore[import-untyped]  # it carries no types
from numba import types
from numba.core import cgutils
from numba.extending import intrinsic, register_jitable

from socialmind.compiling.memory import index
from socialmind.worlds.neighbours.entries import ENTRY

EIGHT = 8
"""So many entries are read at once: as many may be read behind the last."""
_WORDS = ENTRY.itemsize // 8
_NUMBERS = ir.VectorType(ir.DoubleType(), EIGHT)


def _short_way(builder: Any, way: Any, round_it: Any) -> Any:
    """Return eight ways along an axis, or the other way round the world where that is shorter."""
    kind = ir.FunctionType(_NUMBERS, [_NUMBERS])
    fabs = cgutils.get_or_insert_function(builder.module, kind, f"llvm.fabs.v{EIGHT}f64")
    way = builder.call(fabs, [way])
    other = builder.fsub(round_it, way)
    return builder.select(builder.fcmp_ordered("<", other, way), other, way)


def _all_eight(builder: Any, number: Any) -> Any:
    """Return a number eight times."""
    one = builder.insert_element(
        ir.Constant(_NUMBERS, ir.Undefined), number, ir.Constant(ir.IntType(32), 0)
    )
    places = ir.Constant(ir.VectorType(ir.IntType(32), EIGHT), [0] * EIGHT)
    return builder.shuffle_vector(one, one, places)


@intrinsic
def _near_bits(
    typing_context: Any, entries: Any, first: Any, x: Any, y: Any, round_x: Any, round_y: Any,
    limit: Any,
) -> Any:  # fmt: skip
    def generate(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        entries, first, *numbers = arguments
        x, y, round_x, round_y, limit = (_all_eight(builder, one) for one in numbers)
        data = context.make_array(signature.args[0])(context, builder, entries).data
        size = ir.Constant(ir.IntType(64), ENTRY.itemsize)
        place = builder.add(builder.ptrtoint(data, ir.IntType(64)), builder.mul(first, size))
        words = ir.VectorType(ir.DoubleType(), EIGHT * _WORDS)
        read = builder.load(builder.inttoptr(place, words.as_pointer()), align=8)
        ways = []
        for name, own, round_it in (("x", x, round_x), ("y", y, round_y)):
            word = ENTRY.fields[name][1] // 8  # type: ignore[index]
            which = [word + _WORDS * number for number in range(EIGHT)]
            taken = ir.Constant(ir.VectorType(ir.IntType(32), EIGHT), which)
            theirs = builder.shuffle_vector(read, read, taken)
            ways.append(_short_way(builder, builder.fsub(theirs, own), round_it))
        squares = [builder.fmul(way, way) for way in ways]
        near = builder.fcmp_ordered("<=", builder.fadd(*squares), limit)
        return builder.zext(builder.bitcast(near, ir.IntType(EIGHT)), ir.IntType(64))

    number = types.float64
    return types.int64(entries, types.int64, number, number, number, number, number), generate


@register_jitable
def push_near(
    entries: Any, begin: int, last: int, spot: int, found: Any, end: int, x: float, y: float,
    round_x: float, round_y: float, limit: float,
) -> int:  # fmt: skip
    """Push those entries from begin to last that are near; return where they end on the stack.

    Args:
        entries: the index's.
        begin: the first.
        last: the one behind the last.
        spot: one that is not wanted, or −1.
        found: the stack.
        end: where it ends so far.
        x: where they shall be near.
        y: likewise.
        round_x: the way round the world from west to east, infinite where it does not wrap.
        round_y: likewise, from south to north.
        limit: the largest square of a distance.
    """
    for first in range(begin, last, EIGHT):
        bits = _near_bits(entries, first, x, y, round_x, round_y, limit)
        bits &= (1 << min(last - first, EIGHT)) - 1
        away = spot - first
        bits &= ~((1 if 0 <= away < EIGHT else 0) << (away & 7))
        for one in range(EIGHT):
            found[index(end)] = entries[index(first + one)].place
            end += (bits >> one) & 1
    return end
