"""What counts as a number, a whole number and a truth value, wherever a user gives one.

Python's and NumPy's numbers count alike; truth values are no numbers. Whole numbers may be given
as floats without a fraction only where `whole_number` is told so.
"""

from __future__ import annotations

import math
from numbers import Integral, Real

from coglogo_py.border.errors import CogLogoError, shown


def is_whole(value: object) -> bool:
    """Return whether a value is a whole number, Python's or NumPy's.

    >>> import numpy as np
    >>> is_whole(np.int16(3)), is_whole(3.0), is_whole(True), is_whole(np.True_)
    (True, False, False, False)
    """
    return isinstance(value, Integral) and not isinstance(value, bool)


def is_number(value: object) -> bool:
    """Return whether a value is a finite real number that a float can hold.

    >>> import numpy as np
    >>> is_number(np.float32(1.5)), is_number(math.nan), is_number(10**400), is_number(True)
    (True, False, False, False)
    """
    if not isinstance(value, Real) or isinstance(value, bool):
        return False
    try:
        return math.isfinite(float(value))
    except OverflowError:
        return False


def is_truth(value: object) -> bool:
    """Return whether a value is a truth value, Python's or NumPy's."""
    import numpy as np  # here: what only reads a command line need not wait for it

    return isinstance(value, bool | np.bool_)


def whole_number(
    value: object,
    what: str,
    low: int | None = None,
    high: int | None = None,
    error: type[Exception] = CogLogoError,
) -> int:
    """Return a whole number as Python's int.

    Args:
        value: what was given.
        what: how to call it in the error.
        low: the smallest that is allowed, None for no bound.
        high: the largest that is allowed, None for no bound.
        error: what to raise.

    Raises:
        error: it is no whole number, or out of bounds.

    >>> import numpy as np
    >>> whole_number(np.int64(3), "seed", 0, 2**64 - 1)
    3
    >>> whole_number(2.5, "ticks", 0)
    Traceback (most recent call last):
    coglogo_py.border.errors.CogLogoError: ticks: found 2.5; expected a whole number, 0 or more
    """
    if is_whole(value):
        found = int(value)  # type: ignore[call-overload]  # an Integral
        if (low is None or found >= low) and (high is None or found <= high):
            return int(found)
    raise error(f"{what}: found {shown(value)}; expected a whole number{_bounds(low, high)}")


def number(
    value: object,
    what: str,
    low: float | None = None,
    high: float | None = None,
    error: type[Exception] = CogLogoError,
) -> float:
    """Return a finite number as a float; arguments as of `whole_number`.

    Raises:
        error: it is no finite number, or out of bounds.

    >>> import numpy as np
    >>> number(np.float32(0.5), "spread", 0.0)
    0.5
    """
    if is_number(value):
        found = float(value)  # type: ignore[arg-type]  # a Real
        if (low is None or found >= low) and (high is None or found <= high):
            return found
    raise error(f"{what}: found {shown(value)}; expected a finite number{_bounds(low, high)}")


def _bounds(low: float | None, high: float | None) -> str:
    if low is None and high is None:
        return ""
    if high is None:
        return f", {low} or more"
    if low is None:
        return f", up to {_figure(high)}"
    return f", {low} … {_figure(high)}"


def _figure(bound: float) -> str:
    # 18446744073709551615 tells a reader less than where it comes from.
    if isinstance(bound, int) and bound >= 2**31 and (bound + 1).bit_count() == 1:
        return f"2**{bound.bit_length()} - 1"
    return str(bound)
