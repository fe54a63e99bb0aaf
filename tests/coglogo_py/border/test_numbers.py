"""One definition of numbers for all that a user gives."""

import math
from fractions import Fraction

import numpy as np
import pytest

from coglogo_py.border.errors import LONGEST_MESSAGE, CogLogoError, one_line, shown
from coglogo_py.border.numbers import number, whole_number
from socialmind.errors import SocialmindError

WHOLE = [0, 7, np.int64(7), np.uint8(7), np.int16(-3), 2**64 - 1]
NOT_WHOLE = [True, np.True_, 3.0, np.float64(3.0), "3", None, math.nan, [3], np.array([3])]


@pytest.mark.parametrize("value", WHOLE)
def test_whole_numbers_of_python_and_numpy_come_back_as_int(value):
    found = whole_number(value, "seed")
    assert type(found) is int
    assert found == value


@pytest.mark.parametrize("value", NOT_WHOLE)
def test_all_else_is_refused(value):
    with pytest.raises(CogLogoError, match=r"^seed: found .*; expected a whole number$"):
        whole_number(value, "seed")


def test_bounds_are_part_of_the_message_and_the_error_is_the_callers():
    with pytest.raises(SocialmindError, match=r"seed: found -1; expected .*, 0 … 2\*\*64 - 1"):
        whole_number(-1, "seed", 0, 2**64 - 1, SocialmindError)
    with pytest.raises(CogLogoError, match="more than 4300 digits; expected"):
        whole_number(10**5000, "seed", 0, 2**64 - 1)


@pytest.mark.parametrize("value", [1, 0.5, np.float32(0.5), np.int8(2), Fraction(1, 2)])
def test_numbers_come_back_as_float(value):
    assert type(number(value, "spread")) is float
    assert number(value, "spread") == value


@pytest.mark.parametrize("value", [True, np.False_, math.inf, math.nan, 10**400, "1", None, 1j])
def test_what_no_float_can_hold_is_no_number(value):
    with pytest.raises(CogLogoError, match=r"^spread: found .*; expected a finite number"):
        number(value, "spread")


def test_messages_are_one_line_of_limited_length():
    assert len(one_line("x" * 10**6)) <= LONGEST_MESSAGE
    assert "\n" not in str(SocialmindError("one\ntwo"))
    assert len(str(SocialmindError("x" * 10**6))) <= LONGEST_MESSAGE
    assert len(shown("y" * 10**6)) < 100
    assert "\n" not in shown(np.zeros((3, 3)))
