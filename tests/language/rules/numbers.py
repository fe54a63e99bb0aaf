"""Constructs with numbers. Each rule is tried at both speeds and as plain Python."""
# ruff: noqa

import math
from math import e, floor, pi, tau
from math import sqrt as root

import numpy as np

TEN = 10
HALF = 0.5
YES = True
OF_NUMPY = np.float64(1.25)
WHOLE_OF_NUMPY = np.int64(3)


def assignment(person):
    person.f = person.g


def augmented_assignments(person):
    person.f += 1.5
    person.f -= 0.25
    person.f *= 2
    person.f /= 4
    person.i += 3
    person.i -= 1
    person.i *= 2
    person.i //= 3
    person.i %= 4
    person.g **= 2
    person.f //= 0.5
    person.g %= 1.25


def augmented_variables(person):
    a = 3
    a += person.i
    a *= 2
    b = 1.0
    b -= person.f
    b /= 3
    person.i = a
    person.g = b


def annotated_assignments(person):
    a: float = 3
    b: int = person.i
    c: bool = person.b
    a /= 2
    person.f = a
    person.i = b + 1
    person.c = not c


def a_variable_that_becomes_a_number(person):
    total = 0
    for k in range(5):
        total += k * 0.5
    person.f = total


def a_parameter_that_becomes_a_number(person):
    person.f = _halved_until_small(person.j)


def _halved_until_small(amount):
    while amount > 1:
        amount = amount / 2
    return amount


def mixed_arithmetic(person):
    person.f = person.i + person.g * 2 - person.j / 4
    person.g = 3 * person.i + 0.5


def true_division_of_whole_numbers(person):
    person.f = person.i / person.j
    person.g = 7 / 2


def floor_division_of_whole_numbers(person):
    person.i = person.i // person.j
    person.j = -person.j // 2


def remainder_of_whole_numbers(person):
    person.i = person.i % 3
    person.j = -person.j % 5


def remainder_by_a_negative(person):
    person.i = person.i % -3
    person.j = person.j // -2
    person.vi[0] = person.vi[1] // -1
    person.vi[2] = person.vi[3] % -1


def floor_division_of_numbers(person):
    person.f = person.f // 0.75
    person.g = person.g // -0.3


def remainder_of_numbers(person):
    person.f = person.f % 0.75
    person.g = person.g % -0.3
    person.vf[0] = -0.0 % 3.0
    person.vf[1] = person.f % math.inf
    person.vf[2] = person.g % -math.inf


def remainder_of_a_heading(person):
    person.heading = (person.heading - 400) % 360


def signs(person):
    person.f = -person.f
    person.g = +person.g
    person.i = -person.i
    person.j = +person.j
    person.vf[0] = -0.0
    person.vf[1] = --3
    person.vi[0] = -(-person.i)


def whole_powers_of_whole_numbers(person):
    person.i = person.i**2
    person.vi[0] = person.j**3
    person.vi[1] = 2**person.j
    person.vi[2] = (-1) ** person.j
    person.vi[3] = 0**0


def negative_powers_of_whole_numbers(person):
    person.f = person.j**-1
    person.g = 2**-2


def powers_of_numbers(person):
    person.f = person.f**2
    person.g = abs(person.g) ** 0.5
    person.vf[0] = 1.5**person.i
    person.vf[1] = (1 + person.j) ** 0.25
    person.vf[2] = 2.0**person.g
    person.vf[3] = math.pow(person.j, 1.3)
    person.x = math.pow(2, -person.j) + math.pow(person.j, 3)


def a_power_before_a_sign(person):
    person.f = -(3.0**2)
    person.i = -(3**2)
    person.vf[0] = 2**3**2


def a_power_without_end(person):
    person.f = 0.5**math.inf
    person.g = 2**math.inf
    person.vf[0] = math.nan**0
    person.vf[1] = 1**math.nan


def rounding(person):
    person.i = round(person.f)
    person.vi[0] = round(0.5)
    person.vi[1] = round(1.5)
    person.vi[2] = round(-2.5)
    person.vi[3] = round(person.j)
    person.vi[4] = round(person.j / 2)


def cutting(person):
    person.i = int(person.f)
    person.j = int(-person.g)
    person.vi[0] = int(person.b)
    person.vi[1] = int(person.vi[2])
    person.vi[3] = math.trunc(person.f)


def floors_and_ceilings(person):
    person.i = floor(person.f)
    person.j = math.ceil(person.g)
    person.vi[0] = math.floor(-0.5)
    person.vi[1] = math.ceil(-0.5)
    person.vi[2] = math.floor(7)


def conversions(person):
    person.f = float(person.i)
    person.g = float(person.b)
    person.b = bool(person.j)
    person.c = bool(person.f)


def absolutes(person):
    person.f = abs(person.f)
    person.i = abs(person.i)
    person.g = math.fabs(person.g)
    person.vi[0] = abs(person.b)


def extremes(person):
    person.f = min(person.f, person.g)
    person.g = max(person.f, person.g, 0.25)
    person.i = min(person.i, 3)
    person.j = max(1, person.j, person.i, 2)
    person.vf[0] = max(0, person.f)
    person.vf[1] = min(person.i, 0.5)


def extremes_with_nan(person):
    nan = math.nan
    person.vf[0] = min(nan, person.f)
    person.vf[1] = min(person.f, nan)
    person.vf[2] = max(nan, person.f)
    person.vf[3] = max(person.f, nan)


def constants_of_math(person):
    person.f = math.pi * math.e
    person.g = math.tau
    person.vf[0] = math.inf
    person.vf[1] = -math.inf
    person.vf[2] = math.nan
    person.vf[3] = pi + e + tau


def waves(person):
    person.f = math.sin(person.f) + math.cos(person.g)
    person.g = math.tan(person.g)


def arcs(person):
    person.f = math.asin(math.sin(person.f)) + math.acos(math.cos(person.g))
    person.g = math.atan(person.g) + math.atan2(person.g, person.f)


def exponentials_and_logarithms(person):
    person.f = math.exp(person.f) + math.log(person.j)
    person.g = math.log10(person.j) + math.log2(person.j + 1)
    person.vf[0] = math.tanh(person.f)


def roots_and_angles(person):
    person.f = root(abs(person.f)) + math.sqrt(person.j)
    person.g = math.degrees(person.g)
    person.vf[0] = math.radians(person.heading)


def kinds_of_numbers(person):
    person.b = math.isnan(person.f) or math.isinf(person.g)
    person.c = math.isfinite(person.f)


def written_numbers(person):
    person.f = 1e-3
    person.g = 1_000.5
    person.i = 0x10 + 0b11
    person.j = 9_223_372_036_854_775_807


def constants_of_the_file(person):
    person.f = TEN * HALF
    person.i = TEN
    person.b = YES
    person.g = OF_NUMPY
    person.j = WHOLE_OF_NUMPY


def truth_values_as_numbers(person):
    person.i = person.b + person.c
    person.f = person.b * 2.5
    person.j = -person.b
    person.g = person.c
    person.vi[0] = True


def a_variable_named_like_a_function(person):
    sum = 0.0
    for k in range(3):
        sum += k
    min = 2
    e = sum + min
    person.f = e


def a_variable_named_like_a_module(person):
    math = 3.5
    np = 2
    person.f = math * np


def many_brackets(person):
    person.f = ((((((((person.f + 1) * 2) - 3) / 4) + 5) * 6) - 7) / 8) + (9)


def a_long_sum(person):
    person.f = (
        person.f
        + person.g
        + person.i
        + person.j
        + person.x
        + person.y
        + person.heading
        + person.f * person.g
        - person.i * person.j
    )


def unicode_names(person):
    größe = person.f * 2
    λ = 0.5
    person.g = größe**2 + λ


def several_statements_in_a_line(person):
    a = 1
    b = 2  # noqa: E702
    person.i = a + b


def a_line_that_goes_on(person):
    person.f = person.f + 1


def swap(person):
    a = person.f
    b = person.g
    a, b = b, a
    person.f = a
    person.g = b


def tuples(person):
    a, b, c = person.i, person.i + 0.5, person.b
    (d, f) = b, a
    person.f = d
    person.i = f
    person.c = not c


def fibonacci(person):
    a, b = 0, 1
    for _ in range(20):
        a, b = b, a + b
    person.i = a


def a_tuple_of_both_kinds(person):
    low, high = 0, 1
    for k in range(4):
        low, high = low + 0.5, high * 2
    person.f = low
    person.i = high
