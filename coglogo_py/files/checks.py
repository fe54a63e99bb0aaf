"""Checks of the values that descriptions are given: each returns the value in its settled form."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from types import MappingProxyType

from coglogo_py.border.errors import SchemeError, shown
from coglogo_py.border.numbers import is_number, is_whole


def checked_name(name: object, what: str) -> str:
    """Return a name of something, which must be text that a file can hold."""
    if not isinstance(name, str) or any("\ud800" <= char <= "\udfff" for char in name):
        raise SchemeError(f"{name!r} as the name of {what}", "text")
    return name


def checked_names(names: object, where: str) -> tuple[str, ...]:
    """Return several names; a single text is refused, since it would count letter by letter."""
    if isinstance(names, str) or not isinstance(names, Iterable):
        raise SchemeError(f"{names!r} as {where}", "several names", "write ('name',) for one")
    return tuple(checked_name(name, where) for name in names)


def checked_number(value: object, where: str) -> float:
    """Return a finite number as a float.

    >>> checked_number(2, "start_value of cogniton 'Hunger'")
    2.0
    """
    if is_number(value):
        return float(value)  # type: ignore[arg-type]  # a Real
    raise SchemeError(f"{shown(value)} as {where}", "a finite number")


def checked_share(value: object, where: str) -> float:
    """Return a probability, 0 … 1."""
    if is_number(value) and 0 <= value <= 1:  # type: ignore[operator]  # a Real
        return float(value)  # type: ignore[arg-type]  # likewise
    raise SchemeError(f"{shown(value)} as {where}", "a number, 0 … 1")


def checked_colour(value: object, where: str) -> tuple[int, int, int]:
    """Return red, green and blue, each 0 … 255."""
    if (
        isinstance(value, tuple | list)
        and len(value) == 3
        and all(is_whole(part) and 0 <= part <= 255 for part in value)
    ):
        return int(value[0]), int(value[1]), int(value[2])
    raise SchemeError(f"{value!r} as the colour of {where}", "three whole numbers 0 … 255")


def checked_position(value: object, where: str) -> tuple[int, int]:
    """Return x and y in a drawing."""
    if (
        isinstance(value, tuple | list)
        and len(value) == 2
        and all(is_whole(part) and -(2**31) <= part < 2**31 for part in value)
    ):
        return int(value[0]), int(value[1])
    raise SchemeError(
        f"{value!r} as the position of {where}", "two whole numbers of 32 bits, (x, y)"
    )


def checked_weights(value: object, where: str) -> Mapping[str, float]:
    """Return the weights of links, plan → weight, in a read-only mapping of their own."""
    if not isinstance(value, Mapping):
        raise SchemeError(f"{value!r} as {where}", "plan → weight")
    return MappingProxyType(
        {
            checked_name(plan, "a plan"): checked_number(weight, f"{where} to {plan!r}")
            for plan, weight in value.items()
        }
    )


def checked_attributes(value: object, where: str) -> tuple[tuple[str, float], ...]:
    """Return the attributes of a group and their values, given by name or as such pairs."""
    try:
        pairs = dict(value)  # type: ignore[call-overload]  # refused if it is no such thing
    except (TypeError, ValueError):
        raise SchemeError(f"{value!r} as {where}", "attribute → value") from None
    return tuple(
        (checked_name(name, "an attribute"), checked_number(one, f"{name!r} among the {where}"))
        for name, one in pairs.items()
    )
