"""Attributes of rows: fields as properties over arrays, for agents and for patches."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

from coglogo_py.border.errors import shown
from socialmind.errors import UnknownNameError, nearest
from socialmind.fields import Field, presence
from socialmind.values import fitted


class ArrayField:
    """An array field of a row."""

    __slots__ = ("_values",)

    def __init__(self, values: Any) -> None:
        self._values = values

    def __len__(self) -> int:
        return len(self._values)

    def __getitem__(self, place: int) -> Any:
        return self._values.item(place)

    def __setitem__(self, place: int, value: float) -> None:
        self._values[place] = value

    def __iter__(self) -> Any:
        # One after another, as compiled rules see them: a loop may change what lies ahead.
        for place in range(len(self._values)):
            yield self._values.item(place)

    def __repr__(self) -> str:
        return repr(self._values.tolist())


class HeldArray(ArrayField):
    """An array field as users hold it: what is written into it is checked."""

    __slots__ = ("_field",)

    def __init__(self, values: Any, field: Field) -> None:
        super().__init__(values)
        self._field = field

    def __getitem__(self, place: int | slice) -> Any:
        return self._values[place].tolist()

    def __setitem__(self, place: int | slice, value: Any) -> None:
        name = f"the field {self._field.name!r}"
        several = isinstance(value, Iterable)
        field = Field(name, self._field.kind, self._field.storage, self._field.default)
        checked = [fitted(field, one, name) for one in (value if several else [value])]
        self._values[place] = checked if several else checked[0]


def field_property(field: Field, place: Any) -> property:
    """Return a field as a property; `place(row)` gives the columns and the place in them."""
    name = field.name
    if field.size is not None:

        def read_array(row: Any) -> ArrayField:
            columns, slot = place(row)
            return ArrayField(columns[name][slot])

        return property(read_array)
    if field.optional:
        there = presence(name)

        def read_optional(row: Any) -> Any:
            columns, slot = place(row)
            return columns[name].item(slot) if columns[there][slot] else None

        def write_optional(row: Any, value: Any) -> None:
            columns, slot = place(row)
            columns[there][slot] = value is not None
            columns[name][slot] = 0 if value is None else value

        return property(read_optional, write_optional)

    if field.choices:

        def read_choice(row: Any) -> str:
            columns, slot = place(row)
            return field.choices[columns[name].item(slot)]

        def write_choice(row: Any, value: str) -> None:
            columns, slot = place(row)
            columns[name][slot] = field.choices.index(value)

        return property(read_choice, write_choice)

    def read(row: Any) -> Any:
        columns, slot = place(row)
        return columns[name].item(slot)

    def write(row: Any, value: Any) -> None:
        columns, slot = place(row)
        columns[name][slot] = value

    return property(read, write)


def held_array(field: Field, place: Any) -> property:
    """Return an array field as users hold it; `place` as of `field_property`."""
    name = field.name

    def read(row: Any) -> HeldArray:
        columns, slot = place(row)
        return HeldArray(columns[name][slot], field)

    def write(row: Any, values: Any) -> None:
        columns, slot = place(row)
        columns[name][slot] = fitted(field, values, f"the field {name!r}")

    return property(read, write)


def unknown(name: str, owner: str, kind: type, fields: Iterable[str]) -> UnknownNameError:
    """Return the error for a name that agents or patches do not have, or that cannot be set."""
    fields = list(fields)
    if name == "id" or name in fields or hasattr(kind, name):
        return UnknownNameError(
            f"{name!r} of {owner!r} cannot be set; its fields are {', '.join(fields) or 'none'}"
        )
    return UnknownNameError(
        f"{owner!r} has no field {shown(name)}; {nearest(name, fields)}; "
        "a further field is declared in the class"
    )
