"""What a user writes into fields from outside the rules, held against what the fields can hold."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from coglogo_py.border.errors import shown
from coglogo_py.border.numbers import is_number, is_truth, is_whole
from socialmind.errors import ValueRefusedError
from socialmind.fields import Field

_ENDS = -(2**63), 2**63 - 1


def fitted(field: Field, value: Any, what: str) -> Any:
    """Return a value as a field holds it.

    Args:
        field: the field.
        value: a number, a truth value, None, or a sequence for an array field.
        what: how to call the field in the error.

    Raises:
        ValueRefusedError: the field cannot hold it.

    >>> fitted(Field("age", int, "i2", 0), 3.0, "the field 'age'")
    3
    """
    if field.size is not None:
        return _elements(field, value, what)
    if value is None and field.optional:
        return None
    if _fits(field, value):
        return value if field.choices else field.kind(value)
    raise ValueRefusedError(f"{what}: found {shown(value)}; expected {_expected(field)}")


def fitted_column(
    field: Field, values: Any, count: int, what: str, whose: Callable[[int], str]
) -> tuple[NDArray[Any], NDArray[np.bool_]]:
    """Return values of a field, one for each of so many agents or patches.

    Args:
        field: the field.
        values: one value for all, or a sequence of values; of an array field one row for all, or
            a row for each.
        count: how many there are.
        what: how to call the field in an error.
        whose: how to call the one at a place in an error.

    Returns:
        The values as the field stores them, and which of them are there, not None.

    Raises:
        ValueRefusedError: there are more or fewer, or the field cannot hold one.
    """
    size = () if field.size is None else (field.size,)
    there = np.ones(count, np.bool_)
    if field.choices:
        return _choices(field, values, count, what, whose), there
    given = _array_of(values, what)
    if given.ndim == len(size):
        one = fitted(field, values, what)
        there[:] = one is not None
        return np.full((count, *size), 0 if one is None else one, field.storage), there
    if given.shape != (count, *size):
        found = " × ".join(map(str, given.shape))
        wanted = " × ".join(map(str, (count, *size)))
        raise ValueRefusedError(f"{what}: found {found} values; expected {wanted}, or one for all")
    if field.optional:
        there = ~_missing(given)
        given = np.where(there, given, field.kind(0))
    wrong = np.flatnonzero(~_fitting(field, given))
    if len(wrong):
        place = int(wrong[0])
        bad = given.reshape(-1).tolist()[place]
        whom = whose(place // (field.size or 1))
        raise ValueRefusedError(
            f"{what} of {whom}: found {shown(bad)}; expected {_expected(field)}"
        )
    return given.astype(field.storage), there


def _choices(
    field: Field, values: Any, count: int, what: str, whose: Callable[[int], str]
) -> NDArray[Any]:
    """Return the places of texts among the choices of a field."""
    texts = [values] * count if isinstance(values, str) else list(values)
    if len(texts) != count:
        raise ValueRefusedError(f"{what}: found {len(texts)} values; expected {count}")
    for place, text in enumerate(texts):
        if text not in field.choices:
            raise ValueRefusedError(
                f"{what} of {whose(place)}: found {shown(text)}; expected {_expected(field)}"
            )
    return np.array([field.choices.index(text) for text in texts], field.storage)


def _array_of(values: Any, what: str) -> NDArray[Any]:
    try:
        given = np.asarray(values)
    except ValueError:
        raise ValueRefusedError(f"{what}: found rows of several lengths; expected one") from None
    # Text-like arrays of pandas and the like are looked at one by one.
    return given if given.dtype.kind in "biuf" else given.astype(object)


def _missing(given: NDArray[Any]) -> NDArray[np.bool_]:
    """Return where values are None, or NaN, which tables write for None."""
    if given.dtype.kind == "f":
        found: NDArray[np.bool_] = np.isnan(given)
        return found
    if given.dtype.kind != "O":
        return np.zeros(given.shape, np.bool_)
    alone = [
        one is None
        or type(one).__name__ in ("NAType", "NaTType")  # pandas' own, without loading it
        or (isinstance(one, float) and one != one)
        for one in given.tolist()
    ]
    return np.array(alone, np.bool_)


def _fitting(field: Field, given: NDArray[Any]) -> NDArray[np.bool_]:
    """Return for each value whether a field can hold it, flat."""
    flat = given.reshape(-1)
    kind = flat.dtype.kind
    if kind == "O":
        return np.array([_fits(field, one) for one in flat.tolist()], np.bool_)
    if field.kind is bool or kind == "b":
        return np.full(len(flat), (field.kind is bool) == (kind == "b"), np.bool_)
    if field.kind is float:
        return np.isfinite(flat) if _finite(field) else np.ones(len(flat), np.bool_)
    low, high = field.limits or _ENDS
    if kind == "f":
        # 2**63 is a float, 2**63 - 1 is none.
        return (flat == np.floor(flat)) & (flat >= low) & (flat < float(high) + 1.0)
    return (flat >= low) & (flat <= high)


def _fits(field: Field, value: Any) -> bool:
    if field.choices:
        return isinstance(value, str) and value in field.choices
    if field.kind is bool:
        return is_truth(value)
    if field.kind is float:
        plain = isinstance(value, float | np.floating)
        return is_number(value) or (plain and not _finite(field))
    whole = is_whole(value) or (is_number(value) and float(value).is_integer())
    low, high = field.limits or _ENDS
    return whole and low <= int(value) <= high


def _finite(field: Field) -> bool:
    """Return whether a number field is for finite numbers: its default is one."""
    default = field.default if isinstance(field.default, tuple) else (field.default,)
    return all(one is None or one - one == 0 for one in default)


def _elements(field: Field, values: Any, what: str) -> list[Any]:
    size = field.size or 0
    lengthy = isinstance(values, Sequence | np.ndarray) or hasattr(values, "__len__")
    if not lengthy or isinstance(values, str) or len(values) != size:
        raise ValueRefusedError(f"{what}: found {shown(values)}; expected {size} values")
    for place, value in enumerate(values):
        if not _fits(field, value):
            raise ValueRefusedError(
                f"{what}, place {place}: found {shown(value)}; expected {_expected(field)}"
            )
    return [field.kind(value) for value in values]


def _expected(field: Field) -> str:
    if field.choices:
        expected = f"one of {', '.join(field.choices)}"
    elif field.kind is bool:
        expected = "True or False"
    elif field.kind is float:
        expected = "a finite number" if _finite(field) else "a number"
    elif field.limits is not None:
        expected = "a whole number, {} … {}".format(*field.limits)
    else:
        expected = "a whole number of 64 bits"
    return f"{expected}, or None" if field.optional else expected
