"""Fields: what an annotated class declares of an agent, a patch or a model.

A field is a number, a whole number or a truth value (`float`, `int`, `bool`), one of these that may
be None (`int | None`), a fixed-size array of these (`list[float] = [0.0] * 5`), or a small whole
number of NumPy (`np.int16`) where memory counts.
"""

from __future__ import annotations

import inspect
import types
import typing
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from coglogo_py.border.errors import shown
from coglogo_py.border.numbers import is_number, is_truth, is_whole
from socialmind.errors import ModelError

Value = float | int | bool | None
_SCALARS: dict[type, str] = {float: "f8", int: "i8", bool: "?"}
_SMALL: dict[type, str] = {np.int8: "i1", np.int16: "i2", np.int32: "i4"}


@dataclass(frozen=True)
class Field:
    """One field: its name, the Python type of its values, how it is stored and its default.

    Attributes:
        name: the field's name.
        kind: float, int or bool.
        storage: NumPy's code of one element ("f8", "i8", "?", "i2" …).
        default: the value at birth; a tuple for an array; None for an optional field at none.
        size: the number of elements of an array, or None.
        optional: whether the value may be None.
        choices: the texts among which a parameter, or an agent's civilisation, is one; it is stored
            as its place among them.
    """

    name: str
    kind: type
    storage: str
    default: Value | tuple[Value, ...]
    size: int | None = None
    optional: bool = False
    choices: tuple[str, ...] = ()

    @property
    def dtype(self) -> list[tuple[str, str] | tuple[str, str, tuple[int]]]:
        """The columns of the record that hold the field."""
        if self.size is not None:
            return [(self.name, self.storage, (self.size,))]
        if self.optional:
            return [(self.name, self.storage), (presence(self.name), "?")]
        return [(self.name, self.storage)]

    @property
    def limits(self) -> tuple[int, int] | None:
        """The smallest and largest value of a small whole-number field, else None."""
        if self.storage in _SMALL.values():
            info = np.iinfo(self.storage)
            return int(info.min), int(info.max)
        return None


def presence(name: str) -> str:
    """Return the column that says whether an optional field holds a value."""
    return f"_has_{name}"


def class_fields(cls: type, skip: tuple[type, ...] = (object,)) -> dict[str, Field]:
    """Return the fields that an annotated class and its bases declare, bases first.

    Args:
        cls: the class.
        skip: bases whose annotations are not fields.

    Raises:
        ModelError: a field whose annotation or default is none of the kinds above.

    >>> class Human:
    ...     wheat: float = 3
    ...     land_x: int | None = None
    >>> [(f.name, f.storage, f.default) for f in class_fields(Human).values()]
    [('wheat', 'f8', 3.0), ('land_x', 'i8', None)]
    """
    fields: dict[str, Field] = {}
    for base in reversed(cls.__mro__):
        if base in skip:
            continue
        for name, annotation in inspect.get_annotations(base, eval_str=True).items():
            fields[name] = declared(cls, name, annotation, base.__dict__.get(name, _MISSING))
    return fields


_MISSING = object()


def declared(cls: type, name: str, annotation: object, default: object) -> Field:
    """Return the field of one annotation and default of a class."""
    if name.startswith("_"):
        raise _wrong(cls, name, f"the field name {name!r}", "a name without a leading underscore")
    if typing.get_origin(annotation) is list:
        return _array(cls, name, typing.get_args(annotation), default)
    kind, optional = annotation, False
    if typing.get_origin(annotation) in (typing.Union, types.UnionType):
        parts = [part for part in typing.get_args(annotation) if part is not type(None)]
        if len(parts) == 1 and len(typing.get_args(annotation)) == 2:
            kind, optional = parts[0], True
    if not isinstance(kind, type) or kind not in _SCALARS | _SMALL:
        raise _wrong(
            cls,
            name,
            f"{getattr(annotation, '__name__', annotation)} as the type of {name!r}",
            "float, int, bool, one of these or None, list[…] of these, np.int8, np.int16, np.int32",
            "keep texts and tables outside the agents; a choice among few is an int",
        )
    storage = (_SCALARS | _SMALL)[kind]
    plain = kind if kind in _SCALARS else int
    if default is _MISSING:
        default = None if optional else plain(0)
    if default is None and not optional:
        raise _wrong(
            cls,
            name,
            f"None as the default of {name!r}",
            "a number",
            f"write {plain.__name__} | None",
        )
    value = None if default is None else _converted(cls, name, plain, default)
    return _checked(cls, Field(name, plain, storage, value, optional=optional))


def _array(cls: type, name: str, args: tuple[object, ...], default: object) -> Field:
    kind = args[0] if args else None
    if not isinstance(kind, type) or kind not in _SCALARS:
        raise _wrong(cls, name, f"the array {name!r}", "list[float], list[int] or list[bool]")
    if not isinstance(default, list | tuple) or not default:
        raise _wrong(
            cls,
            name,
            f"the array {name!r} without its elements",
            "a default that says how many there are",
            f"write {name}: list[{kind.__name__}] = [{kind(0)!r}] * 5",
        )
    values = tuple(_converted(cls, name, kind, value) for value in default)
    return Field(name, kind, _SCALARS[kind], values, size=len(values))


def _converted(cls: type, name: str, kind: type, value: object) -> Value:
    fits = is_truth(value) if kind is bool else is_whole(value)
    if kind is float:  # nan and inf too
        fits = is_number(value) or isinstance(value, float | np.floating)
    if not fits:
        found = f"{shown(value)} as the default of {name!r}"
        raise _wrong(cls, name, found, f"a value of {kind.__name__}")
    return typing.cast(Value, kind(value))


def _checked(cls: type, field: Field) -> Field:
    if field.limits and isinstance(field.default, int):
        low, high = field.limits
        if not low <= field.default <= high:
            found = f"{field.default} as the default of {field.name!r}"
            raise _wrong(cls, field.name, found, f"{low} … {high}")
    return field


def _wrong(
    cls: type, name: str, found: str, expected: str, remedy: str | None = None
) -> ModelError:
    file, line = place_of_field(cls, name)
    return ModelError(found, expected, remedy, file, line)


def place_of_field(cls: type, name: str) -> tuple[str | None, int | None]:
    """Return the file and line in which a class declares a field, as far as they are known."""
    for base in cls.__mro__:
        if name not in inspect.get_annotations(base) and name not in base.__dict__:
            continue
        try:
            lines, start = inspect.getsourcelines(base)
            file = inspect.getsourcefile(base)
        except (OSError, TypeError):
            return None, None
        for offset, line in enumerate(lines):
            if line.strip().startswith((f"{name}:", f"{name} ", f"{name}=")):
                return str(Path(file)) if file else None, start + offset
        return str(Path(file)) if file else None, start
    return None, None


def set_default(rows: NDArray[Any], field: Field) -> None:
    """Give a field of all rows its default."""
    if field.size is not None:
        rows[field.name] = np.array(field.default)
    elif field.optional:
        rows[field.name] = 0 if field.default is None else field.default
        rows[presence(field.name)] = field.default is not None
    else:
        rows[field.name] = field.default
