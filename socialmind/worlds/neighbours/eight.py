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
_WHOLE = ir.IntType(64)
_ROW = ir.VectorType(ir.IntType(8), EIGHT)
_BITS_SET = ir.Constant(
    ir.ArrayType(_ROW, 2**EIGHT),
    [
        ir.Constant(_ROW, (set_ + [0] * EIGHT)[:EIGHT])
        for set_ in ([one for one in range(EIGHT) if bits >> one & 1] for bits in range(2**EIGHT))
    ],
)
"""For each eight bits the numbers of those that are set, filled up with zeros."""


def _short_way(builder: Any, way: Any, round_it: Any) -> Any:
    """Return eight ways along an axis, or the other way round the world where that is shorter."""
    kind = ir.FunctionType(_NUMBERS, [_NUMBERS])
    fabs = cgutils.get_or_insert_function(builder.module, kind, f"llvm.fabs.v{EIGHT}f64")
    way = builder.call(fabs, [way])
    other = builder.fsub(round_it, way)
    return builder.select(builder.fcmp_ordered("<", other, way), other, way)


def _all_eight(builder: Any, number: Any) -> Any:
    """Return a number eight times."""
    eight = ir.VectorType(number.type, EIGHT)
    one = builder.insert_element(
        ir.Constant(eight, ir.Undefined), number, ir.Constant(ir.IntType(32), 0)
    )
    places = ir.Constant(ir.VectorType(ir.IntType(32), EIGHT), [0] * EIGHT)
    return builder.shuffle_vector(one, one, places)


def _bits(builder: Any, theirs: Any, numbers: Any) -> Any:
    """Return as bits which of eight places, their x and y, are near; numbers as of `push_near`."""
    x, y, round_x, round_y, limit = (_all_eight(builder, one) for one in numbers)
    way_x = _short_way(builder, builder.fsub(theirs[0], x), round_x)
    way_y = _short_way(builder, builder.fsub(theirs[1], y), round_y)
    square = builder.fadd(builder.fmul(way_x, way_x), builder.fmul(way_y, way_y))
    near = builder.fcmp_ordered("<=", square, limit)
    return builder.zext(builder.bitcast(near, ir.IntType(EIGHT)), _WHOLE)


def _read(context: Any, builder: Any, kind: Any, array: Any, first: Any, vector: Any) -> Any:
    """Return the pointer to a vector that begins at an element of an array."""
    data = context.make_array(kind)(context, builder, array).data
    size = _WHOLE(context.get_abi_sizeof(context.get_data_type(kind.dtype)))
    place = builder.add(builder.ptrtoint(data, _WHOLE), builder.mul(first, size))
    return builder.inttoptr(place, vector.as_pointer())


@intrinsic
def _near_bits(
    typing_context: Any, entries: Any, first: Any, x: Any, y: Any, round_x: Any, round_y: Any,
    limit: Any,
) -> Any:  # fmt: skip
    def generate(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        entries, first, *numbers = arguments
        words = ir.VectorType(ir.DoubleType(), EIGHT * _WORDS)
        place = _read(context, builder, signature.args[0], entries, first, words)
        read = builder.load(place, align=8)
        theirs = []
        for name in ("x", "y"):
            word = ENTRY.fields[name][1] // 8  # type: ignore[index]
            which = [word + _WORDS * number for number in range(EIGHT)]
            taken = ir.Constant(ir.VectorType(ir.IntType(32), EIGHT), which)
            theirs.append(builder.shuffle_vector(read, read, taken))
        return _bits(builder, theirs, numbers)

    number = types.float64
    return types.int64(entries, types.int64, number, number, number, number, number), generate


@intrinsic
def near_bits_apart(
    typing_context: Any, places: Any, first_x: Any, first_y: Any, x: Any, y: Any, round_x: Any,
    round_y: Any, limit: Any,
) -> Any:  # fmt: skip
    """Return as bits which of eight places are near, whose x and y stand apart in an array."""

    def generate(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        places, first_x, first_y, *numbers = arguments
        theirs = [
            builder.load(
                _read(context, builder, signature.args[0], places, first, _NUMBERS), align=8
            )
            for first in (first_x, first_y)
        ]
        return _bits(builder, theirs, numbers)

    whole, number = types.int64, types.float64
    return whole(places, whole, whole, number, number, number, number, number), generate


@intrinsic
def patch_bits(
    typing_context: Any, places: Any, first_x: Any, first_y: Any, own_x: Any, own_y: Any,
    round_x: Any, round_y: Any, low_x: Any, low_y: Any, width: Any, height: Any, last_x: Any,
    last_y: Any, steps: Any, least: Any, most: Any,
) -> Any:  # fmt: skip
    """Return as bits which of eight places, apart in an array, are on patches around one.

    Columns and rows are counted from 0. A place beyond the end, by rounding, is in the last ones.
    Both ways are at most so many steps, and together at least and at most so many.
    """

    def generate(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        places, first_x, first_y, *numbers = arguments
        eight = [_all_eight(builder, one) for one in numbers]
        *axes, steps, least, most = eight
        kind = ir.FunctionType(_NUMBERS, [_NUMBERS])
        floor = cgutils.get_or_insert_function(builder.module, kind, f"llvm.floor.v{EIGHT}f64")
        half = ir.Constant(_NUMBERS, [0.5] * EIGHT)
        ways = []
        for axis, first in enumerate((first_x, first_y)):
            own, round_it, low, size, last = axes[axis::2]
            place = _read(context, builder, signature.args[0], places, first, _NUMBERS)
            theirs = builder.fadd(builder.load(place, align=8), half)
            theirs = builder.fsub(builder.call(floor, [theirs]), low)
            beyond = builder.fcmp_ordered(">=", theirs, size)
            theirs = builder.select(beyond, last, theirs)
            ways.append(_short_way(builder, builder.fsub(theirs, own), round_it))
        both = builder.fadd(*ways)
        near = builder.and_(
            builder.and_(*(builder.fcmp_ordered("<=", way, steps) for way in ways)),
            builder.and_(
                builder.fcmp_ordered(">=", both, least), builder.fcmp_ordered("<=", both, most)
            ),
        )
        return builder.zext(builder.bitcast(near, ir.IntType(EIGHT)), _WHOLE)

    whole = types.int64
    return whole(places, whole, whole, *[types.float64] * 13), generate


@intrinsic
def push_bits(typing_context: Any, found: Any, end: Any, first: Any, bits: Any) -> Any:
    """Push the numbers of the bits that are set, counted from a first; return the stack's end.

    There is room for eight whatever is pushed.
    """

    def generate(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        found, end, first, bits = arguments
        name = "socialmind_bits_set"
        known = builder.module.globals.get(name)
        table = known or cgutils.global_constant(builder.module, name, _BITS_SET)
        row = builder.load(builder.gep(table, [_WHOLE(0), bits], inbounds=True))
        wide = ir.VectorType(_WHOLE, EIGHT)
        numbers = builder.add(builder.zext(row, wide), _all_eight(builder, first))
        place = _read(context, builder, signature.args[0], found, end, wide)
        builder.store(numbers, place, align=8)
        return builder.add(end, builder.ctpop(bits))

    whole = types.int64
    return whole(found, whole, whole, whole), generate


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
