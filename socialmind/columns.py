"""Columns: what a population or a world gives of a field, and how a table of data is read into one.

A column is a copy: writing into it would change nothing of the society, so it refuses, and says
what to write instead. Whatever is computed from it is an ordinary array.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from coglogo_py.border.errors import shown
from socialmind.errors import UnknownNameError, ValueRefusedError, nearest


class Column(np.ndarray):
    """A read-only copy of a field of all agents or patches."""

    _place: str | None = None

    def __array_wrap__(self, array: Any, context: Any = None, return_scalar: bool = False) -> Any:
        plain = np.asarray(array)
        return plain[()] if plain.ndim == 0 else plain

    def __array_finalize__(self, of: Any) -> None:
        self._place = getattr(of, "_place", None)

    def __setitem__(self, key: Any, value: Any) -> None:
        self._refuse()
        super().__setitem__(key, value)

    def fill(self, value: Any) -> None:
        """Refuse: a column is a copy."""
        self._refuse()
        super().fill(value)

    def sort(self, *arguments: Any, **options: Any) -> None:
        """Refuse: a column is a copy."""
        self._refuse()
        super().sort(*arguments, **options)

    def put(self, *arguments: Any, **options: Any) -> None:
        """Refuse: a column is a copy."""
        self._refuse()
        super().put(*arguments, **options)

    def _refuse(self) -> None:
        if self._place is not None and not self.flags.writeable:
            raise ValueRefusedError(
                f"{self._place} is a copy, and read-only; to change the field write "
                f"{self._place} = …, a value or an array of {len(self)}: "
                f"new = {self._place}.copy(), change new, then {self._place} = new"
            )

    def copy(self, order: Any = "C") -> Any:
        """Return an ordinary array that can be changed."""
        return np.array(self, order=order, subok=False)

    def __reduce__(self) -> Any:
        return np.asarray(self).__reduce__()

    def __repr__(self) -> str:
        return repr(np.asarray(self))


def _in_place(name: str) -> Any:
    operation = getattr(np.ndarray, f"__{name}__")

    def operate(self: Column, other: Any) -> Any:
        # `humans.wheat += 1` then assigns what this returns.
        return operation(np.asarray(self), other)

    return operate


for _name in ("add", "sub", "mul", "truediv", "floordiv", "mod", "pow", "and", "or", "xor"):
    setattr(Column, f"__i{_name}__", _in_place(_name))


def column(values: NDArray[Any], place: str) -> Column:
    """Return values of a field as a column.

    Args:
        values: a copy of the field.
        place: what a user writes to assign to it, as `society.humans.wheat`.
    """
    values.flags.writeable = False
    made: Column = values.view(Column)
    made._place = place
    return made


def columns_of(data: Any, what: str) -> dict[str, Any]:
    """Return the columns of a data frame, an Arrow table or a mapping by their names.

    Raises:
        ValueRefusedError: it is none of these, or its columns are of several lengths.
    """
    names = getattr(data, "column_names", None)  # Arrow
    if names is None:
        names = getattr(data, "columns", None)  # pandas, polars
    if names is None and isinstance(data, Mapping):
        names = data.keys()
    if names is None or isinstance(data, str):
        raise ValueRefusedError(
            f"{what}: found {shown(data)}; expected a data frame, or columns by their names"
        )
    found = {str(name): data[name] for name in names}
    found = {name: np.asarray(one) if hasattr(one, "dtype") or hasattr(one, "type")
             else one for name, one in found.items()}  # fmt: skip
    lengths = {name: len(one) if hasattr(one, "__len__") else 0 for name, one in found.items()}
    if len(set(lengths.values())) > 1:
        listed = ", ".join(f"{name} {length}" for name, length in lengths.items())
        raise ValueRefusedError(f"{what}: columns of several lengths: {listed}")
    return found


def check_fields(names: Any, fields: Any, what: str) -> None:
    """Refuse columns that are no fields.

    Raises:
        UnknownNameError: one is none.
    """
    for name in names:
        if name not in fields:
            raise UnknownNameError(
                f"{what} has no field {shown(name)}; {nearest(name, fields)}; "
                "leave other columns out"
            )
