"""Sums, means and extremes of a field over agents or patches, in their order."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from coglogo_py.border.errors import shown
from socialmind.errors import UnknownNameError, nearest
from socialmind.fields import Field
from socialmind.language.arithmetic import greatest_of, least_of, total, total_int

AGGREGATES = ("sum", "mean", "min", "max")


def number_fields(fields: Mapping[str, Field], kinds: tuple[type, ...]) -> dict[str, Field]:
    """Return the fields that hold one number, or truth value, of some Python types, never None."""
    return {
        name: one
        for name, one in fields.items()
        if one.size is None and not one.optional and not one.choices and one.kind in kinds
    }


def field_called(
    name: Any, fields: Mapping[str, Field], whose: str, kinds: tuple[type, ...]
) -> Field:
    """Return a field of numbers by its name.

    Raises:
        UnknownNameError: there is none of this name.
    """
    known = number_fields(fields, kinds)
    if not isinstance(name, str) or name not in known:
        raise UnknownNameError(
            f"{whose} have no field of numbers called {shown(name)}; {nearest(str(name), known)}"
        )
    return known[name]


def aggregated(what: str, values: list[Any], field: Field, whose: str) -> Any:
    """Return the sum, mean, smallest or largest of values, added from the first to the last.

    Args:
        what: one of `AGGREGATES`.
        values: plain Python numbers.
        field: what they are of.
        whose: what has none where they are empty, for errors.

    Raises:
        ValueError: the mean or an extreme of no values.

    >>> aggregated("mean", [1, 2], Field("age", int, "i8", 0), "the population")
    1.5
    """
    if not values and what != "sum":
        raise ValueError(f"{what}() of {whose}")
    if field.kind is bool:
        values = [int(one) for one in values]
    if what in ("min", "max"):
        return least_of(values) if what == "min" else greatest_of(values)
    found = total(values, 0.0) if field.kind is float else total_int(values)
    return found / len(values) if what == "mean" else found
