"""Arithmetic has one definition: both speeds agree, and agree with Python where it promises to."""

import math
import operator
import random
import struct

import numba
import pytest

from socialmind.language import arithmetic

LARGEST, SMALLEST = 2**63 - 1, -(2**63)
DRAWN = random.Random(4)
FLOATS = [
    *(0.0, -0.0, 0.5, -0.5, 1.0, -1.0, 1.5, 2.5, -2.5, 3.0, 0.1, -0.3, 7.25, 10.0, 1 / 3, -1e-3),
    *(0.49999999999999994, 4503599627370497.5, 9007199254740993.0, 1e15, -1e16, 1e19, -9.3e18),
    *(9223372036854774784.0, -9223372036854774784.0, 9223372036854775808.0, 5e-324, 2.3e-308),
    *(1e308, -1e308, 709.782712893384, 709.7827128933841, 710.0, -745.2, 1e-200, 1e200),
    *(math.pi, -math.e, math.inf, -math.inf, math.nan),
    *(DRAWN.uniform(-4, 4) for _ in range(12)),
    *(math.ldexp(DRAWN.random(), DRAWN.randrange(-60, 60)) for _ in range(8)),
]
INTS = [
    *(0, 1, -1, 2, -2, 3, 5, -7, 10, 63, 255, 2**31, -(2**31) - 1, 3_037_000_499, 3_037_000_500),
    *(2**32, 2**53 + 1, 2**62, -(2**62), LARGEST, LARGEST - 1, SMALLEST + 1, SMALLEST),
    *(DRAWN.randrange(-(2**40), 2**40) for _ in range(6)),
    *(DRAWN.randrange(SMALLEST, LARGEST) for _ in range(6)),
]
SMALL_INTS = [*range(-3, 12), 40, 62, 63, 64, 1000]

ONE = {  # of one number: what Python calls it
    "square": lambda x: x**2,
    "to_int": int,
    "trunc": math.trunc,
    "floor": math.floor,
    "ceil": math.ceil,
    "round_half_even": round,
    "sqrt": math.sqrt,
    "log": math.log,
    "log2": math.log2,
    "log10": math.log10,
    "exp": math.exp,
    "sin": math.sin,
    "cos": math.cos,
    "tan": math.tan,
    "asin": math.asin,
    "acos": math.acos,
    "atan": math.atan,
    "tanh": math.tanh,
    "radians": math.radians,
    "degrees": math.degrees,
    "fabs": math.fabs,
    "isnan": math.isnan,
    "isinf": math.isinf,
    "isfinite": math.isfinite,
}
TWO = {
    "atan2": math.atan2,
    "power": math.pow,
    "least": min,
    "greatest": max,
    "hypot": None,  # Python's is rounded once, ours at each step
}
WHOLE = {
    "add_int": operator.add,
    "subtract_int": operator.sub,
    "multiply_int": operator.mul,
    "floor_divide_int": operator.floordiv,
    "modulo_int": operator.mod,
    "least": min,
    "greatest": max,
}


def outcome(function, *arguments):
    """Return a result to the last bit, or the kind of error; -0.0 differs from 0.0, NaN is NaN."""
    try:
        value = function(*arguments)
    except (ValueError, OverflowError, ZeroDivisionError, IndexError) as error:
        return type(error).__name__
    if isinstance(value, float):
        return "nan" if math.isnan(value) else struct.pack("d", value)
    return value


def within(value, low=SMALLEST, high=LARGEST):
    return not isinstance(value, int) or low <= value <= high


def compiled(name):
    """Return a function of arithmetic as compiled rules call it."""
    function = getattr(arithmetic, name)
    if name in ONE or name in ("absolute_int", "opaque", "turned"):
        return numba.njit(lambda x: function(x))
    if name in ("fitting", "brought_back", "within_walls"):
        return numba.njit(lambda x, y, z: function(x, y, z))
    return numba.njit(lambda x, y: function(x, y))


def test_every_function_is_tried():
    others = {
        "absolute_int",
        "power_int",
        "power_whole",
        "power_of_odd_ends",
        "position",
        "fitting",
        "brought_back",
        "within_walls",
        "turned",
        "within",
    }
    others |= {"total", "total_int", "least_of", "greatest_of", "found_in", "mean_of", "opaque"}
    functions = {
        name
        for name, one in vars(arithmetic).items()
        if getattr(one, "__module__", "") == arithmetic.__name__ and name[0] != "_"
    }
    assert functions == {*ONE, *TWO, *WHOLE, *others}


@pytest.mark.parametrize("name", ONE)
def test_functions_of_a_number(name):
    fast, slow = compiled(name), getattr(arithmetic, name)
    for x in FLOATS:
        here = outcome(slow, x)
        assert outcome(fast, x) == here, x
        python = outcome(ONE[name], x)
        if python == -(2**63) or not within(python):
            assert here == "OverflowError"
        else:
            assert here == python, x


@pytest.mark.parametrize("name", TWO)
def test_functions_of_two_numbers(name):
    fast, slow = compiled(name), getattr(arithmetic, name)
    for x in FLOATS:
        for y in FLOATS:
            here = outcome(slow, x, y)
            assert outcome(fast, x, y) == here, (x, y)
            python = TWO[name] and outcome(TWO[name], x, y)
            if name == "power" and x == 0 and y < 0:
                python = "ZeroDivisionError"  # as `0.0 ** -1`; math.pow calls it a ValueError
            if python is not None:
                assert here == python, (x, y)


@pytest.mark.parametrize("name", WHOLE)
def test_functions_of_whole_numbers(name):
    fast, slow = compiled(name), getattr(arithmetic, name)
    for x in INTS:
        for y in INTS:
            here = outcome(slow, x, y)
            assert outcome(fast, x, y) == here, (x, y)
            python = outcome(WHOLE[name], x, y)
            exact = name != "multiply_int" or python == 0
            if not exact and (SMALLEST in (x, y) or not within(python, -LARGEST)):
                python = "OverflowError"
            assert here == (python if within(python) else "OverflowError"), (x, y)


def test_products_at_the_very_end_of_64_bits():
    fast = compiled("multiply_int")
    drawn = random.Random(9)
    for _ in range(3000):
        x = drawn.randrange(1, 2 ** drawn.randrange(2, 62))
        for y in (LARGEST // x, LARGEST // x + 1, LARGEST // x + 2):
            if y <= LARGEST:
                for a, b in ((x, y), (-x, y), (x, -y), (y, x)):
                    expected = a * b if abs(a * b) <= LARGEST else "OverflowError"
                    assert outcome(fast, a, b) == expected, (a, b)
                    assert outcome(arithmetic.multiply_int, a, b) == expected, (a, b)


def test_whole_powers_of_whole_numbers():
    fast = compiled("power_int")
    for x in INTS:
        for n in SMALL_INTS:
            expected = "ValueError" if n < 0 else x**n
            if not isinstance(expected, str) and abs(expected) > LARGEST and n != 1:
                expected = "OverflowError"
            if (x, n) == (SMALLEST, 1):
                continue  # the smallest whole number is no product
            assert outcome(fast, x, n) == outcome(arithmetic.power_int, x, n) == expected, (x, n)


def test_written_powers():
    fast = compiled("power_whole")
    for x in FLOATS:
        for n in range(-16, 17):
            here = outcome(arithmetic.power_whole, x, n)
            assert outcome(fast, x, n) == here, (x, n)
            python = outcome(operator.pow, x, n)
            if isinstance(python, str) or isinstance(here, str):
                assert here == python, (x, n)
                continue
            (exact,), (mine,) = struct.unpack("d", python), struct.unpack("d", here)
            if 1e-290 < abs(exact) < 1e290 or exact == mine == 0:
                assert mine == pytest.approx(exact, rel=1e-14), (x, n)
    assert arithmetic.power_whole(1.1, 2) == 1.1 * 1.1
    assert arithmetic.power_whole(1.1, -2) == 1 / (1.1 * 1.1)


def test_the_absolute_of_whole_numbers():
    fast = compiled("absolute_int")
    for x in INTS:
        expected = "OverflowError" if x == SMALLEST else abs(x)
        assert outcome(fast, x) == outcome(arithmetic.absolute_int, x) == expected


def test_places_in_arrays():
    fast = compiled("position")
    for index in range(-7, 8):
        expected = "IndexError" if not -5 <= index < 5 else range(5)[index]
        assert outcome(fast, index, 5) == outcome(arithmetic.position, index, 5) == expected


def test_small_fields():
    fast = compiled("fitting")
    for value in (-129, -128, 0, 127, 128):
        expected = value if -128 <= value <= 127 else "OverflowError"
        assert outcome(fast, value, -128, 127) == expected
        assert outcome(arithmetic.fitting, value, -128, 127) == expected


def test_places_on_a_torus():
    fast = compiled("brought_back")
    for value in FLOATS:
        here = outcome(arithmetic.brought_back, value, -2, 5)
        assert outcome(fast, value, -2, 5) == here, value
        if not abs(value) < 1e15:
            assert here == "ValueError"
        elif -2.5 <= value < 2.5:
            assert here == struct.pack("d", value)
        else:
            assert -2.5 <= arithmetic.brought_back(value, -2, 5) < 2.5
    assert arithmetic.brought_back(2.5, -2, 5) == -2.5
    assert arithmetic.brought_back(3.25, -2, 5) == -1.75
    assert arithmetic.brought_back(-2.5000000000000004, -2, 5) < 2.5


def test_places_between_walls():
    fast = compiled("within_walls")
    for value in FLOATS:
        here = outcome(arithmetic.within_walls, value, -2, 5)
        assert outcome(fast, value, -2, 5) == here, value
        assert here == (struct.pack("d", value) if -2.5 <= value < 2.5 else "ValueError")


def test_headings():
    fast = compiled("turned")
    for value in [*FLOATS, 360.0, 359.99999999999994, -1e-20, 725.0, -90.0]:
        here = outcome(arithmetic.turned, value)
        assert outcome(fast, value) == here, value
        if not math.isfinite(value):
            assert here == "ValueError"
        else:
            assert 0.0 <= arithmetic.turned(value) < 360.0
    found = [arithmetic.turned(value) for value in (360.0, -1e-20, 725.0, -90.0, 12.5)]
    assert found == [0.0, 0.0, 5.0, 270.0, 12.5]


def test_hypot_is_rounded_at_each_step():
    assert arithmetic.hypot(3.0, 4.0) == 5.0
    x, y = 0.1, 0.7
    assert arithmetic.hypot(x, y) == math.sqrt(x * x + y * y)
    for x in FLOATS:
        for y in FLOATS:
            if 1e-150 < max(abs(x), abs(y)) < 1e150 and not math.isnan(x + y):
                assert arithmetic.hypot(x, y) == pytest.approx(math.hypot(x, y), rel=1e-15)


def test_operators_of_python_that_the_front_end_leaves_alone():
    """+ − * / // % of numbers and comparisons agree without our help; this holds them to it."""
    operators = [operator.add, operator.sub, operator.mul, operator.truediv]
    operators += [operator.floordiv, operator.mod]
    operators += [operator.lt, operator.le, operator.eq, operator.ne, operator.gt, operator.ge]
    for one in operators:
        fast = numba.njit(lambda x, y, one=one: one(x, y))
        for x in FLOATS:
            for y in FLOATS:
                assert outcome(fast, x, y) == outcome(one, x, y), (one, x, y)


def test_powers_do_not_pile_up_on_the_stack():
    @numba.njit
    def many(n):
        total = 0.0
        for k in range(n):
            total += arithmetic.power(1.0 + k % 7, 0.3)
        return total

    assert many(5_000_000) > 0
