"""The types of columns: five, and which of them holds the values of two."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from socialmind.errors import SocialmindError
from socialmind.runs.tables.columns import EXPECTED

if TYPE_CHECKING:
    import pyarrow as pa


def standard_type(kind: pa.DataType, name: str, column: str) -> pa.DataType:
    """The one of the five types that holds the values of another."""
    import pyarrow as pa

    if pa.types.is_integer(kind):
        return pa.int64()
    if pa.types.is_floating(kind):
        return pa.float64()
    if pa.types.is_string(kind) or pa.types.is_large_string(kind) or pa.types.is_dictionary(kind):
        return pa.string()
    if pa.types.is_boolean(kind) or pa.types.is_null(kind):
        return kind
    raise SocialmindError(f"{name}: column {column}: values of type {kind}; expected {EXPECTED}")


def common_type(a: pa.DataType, b: pa.DataType, name: str, column: str) -> pa.DataType:
    """The type that holds the values of both."""
    import pyarrow as pa

    if a == b or pa.types.is_null(b):
        return a
    if pa.types.is_null(a):
        return b
    if {a, b} == {pa.int64(), pa.float64()}:
        return pa.float64()
    raise SocialmindError(
        f"{name}: column {column} holds {a} at one tick and {b} at another; give one kind of value"
    )


def common_schema(schemas: Sequence[pa.Schema], name: str) -> pa.Schema:
    """The column types that hold the values of every part; a later part may have more columns."""
    import pyarrow as pa

    types = {field.name: field.type for field in schemas[0]}
    for schema in schemas[1:]:
        if schema.names[: len(types)] != list(types):
            raise SocialmindError(
                f"{name}: columns {', '.join(schema.names)} in one part, {', '.join(types)} before"
            )
        for field in schema:
            before = types.get(field.name, field.type)
            types[field.name] = common_type(before, field.type, name, field.name)
    return pa.schema(list(types.items()))
