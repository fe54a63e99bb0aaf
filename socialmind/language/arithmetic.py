"""The one definition of arithmetic that both speeds share.

CPython and numba agree on most of floating-point arithmetic to the last bit, and differ on the
rest: whole numbers grow in Python and wrap in machine code, `x ** 3` and `hypot` round differently,
`log(0)` raises here and is minus infinity there. What differs is written here once; the front end
puts these functions in the place of the operators and of `math`. They run as ordinary Python and,
unchanged, under numba.
"""

import math
from typing import Any

from llvmlite import ir  # type: ignore[import-untyped]  # it carries no types
from numba import types
from numba.core import cgutils
from numba.extending import intrinsic, overload, register_jitable

LARGEST = 2**63 - 1
SMALLEST = -(2**63)
# Just under 2**63: what a float may be to become a whole number.
LARGEST_FLOAT = 9223372036854774784.0
NEAR_64_BITS = 9.2e18


@register_jitable
def add_int(a: int, b: int) -> int:
    """Return a + b, or raise OverflowError beyond 64 bits."""
    if b > 0:
        if a > LARGEST - b:
            raise OverflowError("a whole number went beyond 64 bits")
    elif a < SMALLEST - b:
        raise OverflowError("a whole number went beyond 64 bits")
    return a + b


@register_jitable
def subtract_int(a: int, b: int) -> int:
    """Return a − b, or raise OverflowError beyond 64 bits."""
    if b > 0:
        if a < SMALLEST + b:
            raise OverflowError("a whole number went beyond 64 bits")
    elif a > LARGEST + b:
        raise OverflowError("a whole number went beyond 64 bits")
    return a - b


@register_jitable
def multiply_int(a: int, b: int) -> int:
    """Return a · b, or raise OverflowError unless |a · b| < 2⁶³."""
    # The product of the floats is off by a few parts in 10¹⁶: near the end whole numbers decide.
    if abs(float(a) * float(b)) > NEAR_64_BITS and (
        a == SMALLEST or b == SMALLEST or abs(a) > LARGEST // abs(b)
    ):
        raise OverflowError("a whole number went beyond 64 bits")
    return a * b


@register_jitable
def floor_divide_int(a: int, b: int) -> int:
    """Return a // b; division by zero raises ZeroDivisionError."""
    if b == -1:
        return subtract_int(0, a)
    return a // b


@register_jitable
def modulo_int(a: int, b: int) -> int:
    """Return a % b; modulo zero raises ZeroDivisionError."""
    if b == -1:
        return 0
    return a % b


@register_jitable
def power_int(a: int, n: int) -> int:
    """Return aⁿ for n ≥ 0 by repeated squaring."""
    if n < 0:
        raise ValueError("a whole number to a negative power; write float(x) ** n")
    result = 1
    square = a
    while n > 0:
        if n % 2 == 1:
            result = multiply_int(result, square)
        n = n // 2
        if n > 0:
            square = multiply_int(square, square)
    return result


@register_jitable
def power_whole(x: float, n: int) -> float:
    """Return xⁿ for a written whole n, multiplied from left to right."""
    result = 1.0
    for _ in range(abs(n)):
        result = result * x
    if n < 0:
        if x == 0.0:
            raise ZeroDivisionError("zero to a negative power")
        if result == 0.0:
            raise OverflowError("a power beyond the range of floats")
        result = 1.0 / result
    if math.isinf(result) and not math.isinf(x):
        raise OverflowError("a power beyond the range of floats")
    return result


@register_jitable
def square(x: float) -> float:
    """Return x², as `power_whole(x, 2)` does."""
    result = x * x
    if math.isinf(result) and not math.isinf(x):
        raise OverflowError("a power beyond the range of floats")
    return result


@intrinsic
def _through_memory(typing_context: Any, x: Any) -> Any:
    def generate(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        place = cgutils.alloca_once(builder, ir.DoubleType())
        builder.store_atomic(arguments[0], place, "monotonic", 8)
        return builder.load_atomic(place, "monotonic", 8)

    return types.float64(types.float64), generate


def opaque(x: float) -> float:
    """Return x; the optimiser is kept from knowing it.

    LLVM rewrites `pow` with a constant base or exponent (2ˣ, x^0.5, 10ˣ) into other functions that
    round differently from the one CPython calls.
    """
    return x


@overload(opaque)
def _opaque(x: float) -> Any:
    def through_memory(x: float) -> Any:
        return _through_memory(x)

    return through_memory


@register_jitable
def power(x: float, y: float) -> float:
    """Return x^y; a negative x wants a whole y, results beyond the range of floats raise."""
    if x == 0.0 and y < 0.0:
        raise ZeroDivisionError("zero to a negative power")
    if x < 0.0 and math.isfinite(x) and math.isfinite(y) and y != math.floor(y):
        raise ValueError("a negative number to a power that is not whole")
    if math.isfinite(x) and math.isfinite(y) and x != 0.0:
        result = math.pow(opaque(x), opaque(y))
        if math.isinf(result):  # CPython's own pow() has raised by now
            raise OverflowError("math range error")
        return result
    return power_of_odd_ends(x, y)


@register_jitable
def power_of_odd_ends(x: float, y: float) -> float:
    """Return x^y where x is zero or one of the two is not finite (IEEE 754)."""
    if y == 0.0 or x == 1.0:
        return 1.0
    if math.isnan(x) or math.isnan(y):
        return math.nan
    if math.isinf(y):
        if abs(x) == 1.0:
            return 1.0
        return math.inf if (abs(x) > 1.0) == (y > 0.0) else 0.0
    odd = y == math.floor(y) and abs(y) < 9007199254740992.0 and y % 2.0 == 1.0
    size = math.inf if (x != 0.0) == (y > 0.0) else 0.0
    return -size if odd and math.copysign(1.0, x) < 0.0 else size


@register_jitable
def to_int(x: float) -> int:
    """Return x without its fraction, as `int(x)`; NaN, infinity and 2⁶³ and beyond raise."""
    if math.isnan(x):
        raise ValueError("NaN has no whole number")
    if x > LARGEST_FLOAT or x < -LARGEST_FLOAT:
        raise OverflowError("a number too large for a whole number")
    return int(x)


@register_jitable
def trunc(x: float) -> int:
    """Return x without its fraction, as `int(x)`."""
    return to_int(x)


@register_jitable
def floor(x: float) -> int:
    """Return the largest whole number not above x."""
    whole = to_int(x)
    return whole - 1 if whole > x else whole


@register_jitable
def ceil(x: float) -> int:
    """Return the smallest whole number not below x."""
    whole = to_int(x)
    return whole + 1 if whole < x else whole


@register_jitable
def round_half_even(x: float) -> int:
    """Return the nearest whole number, the even one of two equally near, as `round(x)`."""
    below = floor(x)
    rest = x - below
    if rest > 0.5 or (rest == 0.5 and below % 2 == 1):
        return below + 1
    return below


@register_jitable
def least(a: Any, b: Any) -> Any:
    """Return b if b < a, else a, as `min(a, b)`."""
    return b if b < a else a


@register_jitable
def greatest(a: Any, b: Any) -> Any:
    """Return b if b > a, else a, as `max(a, b)`."""
    return b if b > a else a


@register_jitable
def absolute_int(a: int) -> int:
    """Return |a|."""
    return subtract_int(0, a) if a < 0 else a


@register_jitable
def hypot(x: float, y: float) -> float:
    """Return √(x² + y²), rounded at each of its steps."""
    return math.sqrt(x * x + y * y)


@register_jitable
def sqrt(x: float) -> float:
    """Return √x; a negative x raises ValueError."""
    if x < 0.0:
        raise ValueError("the square root of a negative number")
    return math.sqrt(x)


@register_jitable
def log(x: float) -> float:
    """Return the natural logarithm; x ≤ 0 raises ValueError."""
    if x <= 0.0:
        raise ValueError("the logarithm of a number that is not above zero")
    return math.log(x)


@register_jitable
def log2(x: float) -> float:
    """Return the logarithm to base 2; x ≤ 0 raises ValueError."""
    if x <= 0.0:
        raise ValueError("the logarithm of a number that is not above zero")
    return math.log2(x)


@register_jitable
def log10(x: float) -> float:
    """Return the decimal logarithm; x ≤ 0 raises ValueError."""
    if x <= 0.0:
        raise ValueError("the logarithm of a number that is not above zero")
    return math.log10(x)


@register_jitable
def exp(x: float) -> float:
    """Return eˣ; beyond the range of floats it raises OverflowError."""
    if x > 709.782712893384 and not math.isinf(x):
        raise OverflowError("exp() beyond the range of floats")
    return math.exp(x)


@register_jitable
def sin(x: float) -> float:
    """Return the sine of x radians."""
    if math.isinf(x):
        raise ValueError("the sine of infinity")
    return math.sin(x)


@register_jitable
def cos(x: float) -> float:
    """Return the cosine of x radians."""
    if math.isinf(x):
        raise ValueError("the cosine of infinity")
    return math.cos(x)


@register_jitable
def tan(x: float) -> float:
    """Return the tangent of x radians."""
    if math.isinf(x):
        raise ValueError("the tangent of infinity")
    return math.tan(x)


@register_jitable
def asin(x: float) -> float:
    """Return the arc sine; |x| > 1 raises ValueError."""
    if x > 1.0 or x < -1.0:
        raise ValueError("the arc sine of a number beyond -1 … 1")
    return math.asin(x)


@register_jitable
def acos(x: float) -> float:
    """Return the arc cosine; |x| > 1 raises ValueError."""
    if x > 1.0 or x < -1.0:
        raise ValueError("the arc cosine of a number beyond -1 … 1")
    return math.acos(x)


@register_jitable
def atan(x: float) -> float:
    """Return the arc tangent."""
    return math.atan(x)


@register_jitable
def tanh(x: float) -> float:
    """Return the hyperbolic tangent."""
    return math.tanh(x)


@register_jitable
def atan2(y: float, x: float) -> float:
    """Return the angle of the point (x, y) in radians."""
    return math.atan2(y, x)


@register_jitable
def radians(x: float) -> float:
    """Return x degrees in radians."""
    return x * 0.017453292519943295


@register_jitable
def degrees(x: float) -> float:
    """Return x radians in degrees."""
    return x * 57.29577951308232


@register_jitable
def fabs(x: float) -> float:
    """Return |x|."""
    return abs(x)


@register_jitable
def isnan(x: float) -> bool:
    """Say whether x is NaN."""
    return x != x


@register_jitable
def isinf(x: float) -> bool:
    """Say whether x is infinite."""
    return x == math.inf or x == -math.inf


@register_jitable
def isfinite(x: float) -> bool:
    """Say whether x is neither infinite nor NaN."""
    return x - x == 0.0


@register_jitable
def total(values: Any, start: Any) -> Any:
    """Return the sum of an array's elements, added from the first to the last."""
    result = start
    for value in values:
        result = result + value
    return result


@register_jitable
def total_int(values: Any) -> int:
    """Return the sum of whole numbers, added from the first to the last."""
    result = 0
    for value in values:
        result = add_int(result, value)
    return result


@register_jitable
def found_in(counted: Any) -> Any:
    """Return what was found among how many values; nothing has no least and no largest."""
    if counted[0] == 0:
        raise ValueError("min() or max() of nothing; write default=…")
    return counted[1]


@register_jitable
def mean_of(counted: Any) -> float:
    """Return the mean of values of which there are so many, with that sum."""
    if counted[0] == 0:
        raise ValueError("the mean of nothing; ask before whether there is any")
    return counted[1] / counted[0]


@register_jitable
def least_of(values: Any) -> Any:
    """Return an array's smallest element, the first of equals."""
    result = values[0]
    for value in values:
        result = least(result, value)
    return result


@register_jitable
def greatest_of(values: Any) -> Any:
    """Return an array's largest element, the first of equals."""
    result = values[0]
    for value in values:
        result = greatest(result, value)
    return result


@register_jitable
def position(index: int, size: int) -> int:
    """Return a place in an array of a size, counted from the end when negative."""
    if index < -size or index >= size:
        raise IndexError("no such place in the array")
    return index + size if index < 0 else index


@register_jitable
def fitting(value: int, low: int, high: int) -> int:
    """Return the value, or raise OverflowError when a small whole-number field cannot hold it."""
    if value < low or value > high:
        raise OverflowError("a whole number beyond what its field can hold")
    return value


NOWHERE = 1e15
"""Beyond it coordinates say no more in which patch they are."""


@register_jitable
def brought_back(value: float, low: int, size: int) -> float:
    """Return a coordinate as a torus keeps it: what leaves on one side comes back on the other.

    Args:
        value: the coordinate.
        low: the first column of patches.
        size: how many there are.
    """
    edge = low - 0.5
    if edge <= value < edge + size:
        return value
    if not abs(value) < NOWHERE:
        raise ValueError("a point that is nowhere")
    value = value - size * math.floor((value - edge) / size)
    if value < edge or value >= edge + size:  # a hair off, by rounding
        value = edge
    return value


@register_jitable
def within_walls(value: float, low: int, size: int) -> float:
    """Return a coordinate between two walls; beyond them it raises ValueError.

    Args:
        value: the coordinate.
        low: the first column of patches.
        size: how many there are.
    """
    edge = low - 0.5
    if not edge <= value < edge + size:
        raise ValueError("a place outside the world; ask world.is_inside(x, y) before")
    return value


@register_jitable
def within(value: float, half_width: float) -> float:
    """Return a coordinate of a body as a plane has it, which has room for bodies inside alone.

    Args:
        value: the coordinate.
        half_width: of the arena; 0 for one without borders.
    """
    if half_width > 0.0 and not abs(value) <= half_width:
        raise ValueError("a place outside the arena")
    return value


@register_jitable
def turned(heading: float) -> float:
    """Return a heading in [0, 360) degrees."""
    if 0.0 <= heading < 360.0:
        return heading
    if not heading - heading == 0.0:
        raise ValueError("a heading that is not finite")
    heading = heading % 360.0
    if heading >= 360.0:  # a hair below 0, rounded up
        heading = 0.0
    return heading
