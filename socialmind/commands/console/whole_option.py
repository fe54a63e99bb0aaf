"""Whole numbers of the command line, which may be written `100000`, `100_000` or `1e5`."""

from __future__ import annotations

from collections.abc import Callable
from decimal import Decimal, InvalidOperation

import typer

LARGEST = 2**63 - 1
LARGEST_SEED = 2**64 - 1
NUMBER = "the number"
LONGEST = 60
"""Characters of a number in a message."""


def whole(low: int, high: int = LARGEST) -> Callable[[str | int], int]:
    """Return what reads a whole number between two bounds from the command line.

    >>> whole(0)("1e5"), whole(0)("1_000_000")
    (100000, 1000000)
    """

    def read(text: str | int) -> int:
        if isinstance(text, int):  # a default
            return text
        # Only here: `--help` needs no NumPy, which these import.
        from coglogo_py.border.errors import shortened
        from coglogo_py.border.numbers import whole_number

        found: object = shortened(text, LONGEST)
        try:
            number = Decimal(text.strip())
        except InvalidOperation:
            number = Decimal("nan")
        # Bounds come first: 1e400 need not be written out to be too large.
        if number.is_finite() and low <= number <= high and number == int(number):
            found = int(number)
        return whole_number(found, NUMBER, low, high, error=WrongNumberError)

    return read


class WrongNumberError(typer.BadParameter):
    """An option that is no whole number, or out of bounds; the option's name is put before it."""

    def __init__(self, message: str) -> None:
        super().__init__(message.removeprefix(f"{NUMBER}: "))
