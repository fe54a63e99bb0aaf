"""Tuples of constants, as `DIRECTIONS = ((0, 1), (1, 0))` of a file, or written in a rule."""

from __future__ import annotations

import ast
from collections.abc import Sequence
from typing import Any

import numpy as np

from socialmind.language.nodes import constant
from socialmind.language.types import BOOL, FLOAT, INT, TableType, TupleType, Type

LARGEST = 1000
"""How many numbers a tuple may hold: they become part of the compiled rule."""


class NoTableError(ValueError):
    """A tuple that rules cannot use; the message says why."""


def table(values: tuple[Any, ...]) -> TableType:
    """Return the type of a tuple of constants, its numbers brought to one kind.

    Raises:
        NoTableError: it is empty, too large, mixed, or nested more than once.

    >>> table((1, 2.5)).values
    (1.0, 2.5)
    >>> table(((0, 1), (1, 0))).item
    TupleType(items=(Type(name='a whole number'), Type(name='a whole number')))
    """
    if not values:
        raise NoTableError("it is empty")
    if all(isinstance(one, str) for one in values):
        return TableType(values, None)
    rows = [one for one in values if isinstance(one, tuple)]
    if not rows:
        kind, column = _column(values)
        return TableType(column, kind)
    if len(rows) < len(values) or len({len(row) for row in rows}) > 1 or not rows[0]:
        raise NoTableError("its tuples differ in length")
    columns = [_column(one) for one in zip(*rows, strict=True)]
    if len(rows) * len(columns) > LARGEST:
        raise NoTableError(f"it holds more than {LARGEST} numbers")
    kinds = TupleType(tuple(kind for kind, _ in columns))
    return TableType(tuple(zip(*(column for _, column in columns), strict=True)), kinds)


def _column(values: Sequence[Any]) -> tuple[Type, tuple[Any, ...]]:
    """Return the kind that holds all of several constants, and these as that kind."""
    if len(values) > LARGEST:
        raise NoTableError(f"it holds more than {LARGEST} numbers")
    if all(isinstance(one, bool | np.bool_) for one in values):
        return BOOL, tuple(map(bool, values))
    if all(isinstance(one, int | np.integer) and not isinstance(one, bool) for one in values):
        if any(not -(2**63) <= one < 2**63 for one in values):
            raise NoTableError("it holds a whole number beyond 64 bits")
        return INT, tuple(map(int, values))
    numbers = (int, float, np.integer, np.floating)
    if all(isinstance(one, numbers) and not isinstance(one, bool) for one in values):
        return FLOAT, tuple(map(float, values))
    raise NoTableError("its values are not of one kind: numbers, truth values or texts")


def written(values: Any, near: ast.AST) -> ast.expr:
    """Return a constant, or a tuple of constants, as the trees of both speeds hold it."""
    if not isinstance(values, tuple):
        return constant(values, near)
    made = ast.Tuple([written(one, near) for one in values], ast.Load())
    return ast.copy_location(made, near)
