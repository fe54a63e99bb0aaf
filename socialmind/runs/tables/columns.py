"""Columns between NumPy and Arrow, by their buffers.

`pyarrow.array`, `to_numpy` and Arrow's scalars import pandas when it is installed, which takes
longer than a short run; the buffers do not. A column has one of five types: ``int64``, ``double``,
``bool``, ``string``, and ``null`` where there is nothing but None.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from socialmind.errors import SocialmindError

if TYPE_CHECKING:
    import pyarrow as pa

EXPECTED = "whole numbers, numbers, truth values, texts or None"


@dataclass(frozen=True)
class Values:
    """A column's content.

    Args:
        missing: bool (n,), where there is no value.
        values: (n,) int64, float64 or uint8, with 0 where one is missing; for strings int64
            lengths in bytes; empty for a column of nulls.
        text: the UTF-8 bytes of all strings, one after another.
    """

    missing: np.ndarray
    values: np.ndarray
    text: bytes = b""


def to_arrow(values: Sequence[Any] | np.ndarray) -> pa.Array:
    """Make an Arrow array of a sequence.

    Args:
        values: a list, or a one-dimensional array, masked or not; None is a missing value.

    Raises:
        SocialmindError: values of other types, of several types, or too large for 64 bits.

    >>> to_arrow([1, None, 2.5]).to_pylist()
    [1.0, None, 2.5]
    >>> to_arrow(["a", None]).type
    DataType(string)
    """
    missing = None
    if isinstance(values, np.ma.MaskedArray):
        missing, values = np.ma.getmaskarray(values), values.filled()
    if isinstance(values, np.ndarray):
        if values.ndim != 1:
            raise SocialmindError(f"an array of {values.ndim} dimensions; expected one value a row")
        if values.dtype.kind not in "iufbU":
            values = values.tolist()
    if isinstance(values, np.ndarray) and values.dtype.kind != "U":
        return _numbers(values, missing)
    if isinstance(values, np.ndarray) and missing is None:
        return _texts(values)
    listed = list(values)
    if missing is not None:
        listed = [None if m else v for v, m in zip(listed, missing, strict=True)]
    return _from_list(listed)


def _from_list(values: list[Any]) -> pa.Array:
    import pyarrow as pa

    kinds = {_kind(one) for one in set(map(type, values))}
    known = {one for one in kinds if one is not None}
    if known == {"i", "f"}:
        known = {"f"}
    if "?" in known or len(known) > 1:
        found = sorted({one.__name__ for one in set(map(type, values))} - {"NoneType"})
        raise SocialmindError(f"values of type {' and '.join(found)}; expected {EXPECTED}")
    if not known:
        return pa.Array.from_buffers(pa.null(), len(values), [None])
    (kind,) = known
    missing = np.array([one is None for one in values]) if None in kinds else None
    if kind == "s":
        return _strings(values, missing)
    dtype = {"i": np.int64, "f": np.float64, "b": np.bool_}[kind]
    filled = values if missing is None else [0 if one is None else one for one in values]
    try:
        return _numbers(np.array(filled, dtype), missing)
    except OverflowError:
        raise SocialmindError("a whole number of more than 64 bits") from None


def _kind(kind: type) -> str | None:
    if kind is type(None):
        return None
    if issubclass(kind, bool | np.bool_):
        return "b"
    if issubclass(kind, int | np.integer):
        return "i"
    if issubclass(kind, float | np.floating):
        return "f"
    return "s" if issubclass(kind, str) else "?"


def _numbers(values: np.ndarray, missing: np.ndarray | None) -> pa.Array:
    import pyarrow as pa

    kind = values.dtype.kind
    if values.dtype == np.uint64 and len(values) and values.max() > np.iinfo(np.int64).max:
        raise SocialmindError("a whole number of more than 63 bits and a sign")
    if kind == "b":
        arrow, data = pa.bool_(), np.packbits(values, bitorder="little")
    elif kind == "f":
        arrow, data = pa.float64(), np.ascontiguousarray(values, np.float64)
    else:
        arrow, data = pa.int64(), np.ascontiguousarray(values, np.int64)
    return pa.Array.from_buffers(arrow, len(values), [_validity(missing), pa.py_buffer(data)])


def _strings(values: list[str | None], missing: np.ndarray | None) -> pa.Array:
    try:
        encoded = [b"" if one is None else one.encode() for one in values]
    except UnicodeEncodeError:
        raise SocialmindError("a text with half a character, which UTF-8 does not hold") from None
    return _joined_texts([len(one) for one in encoded], b"".join(encoded), missing)


def _texts(values: np.ndarray) -> pa.Array:
    """An array of texts, all at once where they are plain, as names are."""
    native = np.ascontiguousarray(values, values.dtype.newbyteorder("="))
    letters = native.view(np.uint32).reshape(len(values), values.itemsize // 4)
    there = letters != 0
    if (letters >= 128).any() or (there[:, 1:] & ~there[:, :-1]).any():
        return _strings(values.tolist(), None)
    text = letters.astype(np.uint8)[there].tobytes()
    return _joined_texts(np.count_nonzero(there, axis=1), text, None)


def _joined_texts(
    lengths: Sequence[int] | np.ndarray, text: bytes, missing: np.ndarray | None
) -> pa.Array:
    import pyarrow as pa

    offsets = np.zeros(len(lengths) + 1, np.int64)
    np.cumsum(lengths, out=offsets[1:])
    if offsets[-1] > np.iinfo(np.int32).max:
        raise SocialmindError("more than 2 GB of text at a time")
    buffers = [_validity(missing), pa.py_buffer(offsets.astype(np.int32)), pa.py_buffer(text)]
    return pa.Array.from_buffers(pa.string(), len(lengths), buffers)


def _validity(missing: np.ndarray | None) -> pa.Buffer | None:
    import pyarrow as pa

    if missing is None or not missing.any():
        return None
    return pa.py_buffer(np.packbits(~missing, bitorder="little"))


def from_arrow(array: pa.Array) -> Values:
    """Take the content out of an Arrow array of one of the five types.

    >>> found = from_arrow(to_arrow(["ab", None, "c"]))
    >>> found.missing.tolist(), found.values.tolist(), found.text
    ([False, True, False], [2, 0, 1], b'abc')
    """
    import pyarrow as pa

    begin, end = array.offset, array.offset + len(array)
    if pa.types.is_null(array.type):
        return Values(np.ones(len(array), bool), np.zeros(0, np.int64))
    buffers = array.buffers()
    missing = np.zeros(len(array), bool)
    if buffers[0] is not None and array.null_count:
        missing = ~_bits(buffers[0], begin, end)
    if len(array) == 0:
        return Values(missing, np.zeros(0, np.int64))
    if pa.types.is_string(array.type):
        offsets = np.frombuffer(buffers[1], np.int32)[begin : end + 1].astype(np.int64)
        lengths = np.diff(offsets)
        text = b"" if buffers[2] is None else buffers[2][offsets[0] : offsets[-1]].to_pybytes()
        if missing.any() and lengths[missing].any():  # bytes behind a null, from another writer
            text = b"".join(
                text[a:b]
                for a, b, gone in zip(
                    offsets - offsets[0], offsets[1:] - offsets[0], missing, strict=False
                )
                if not gone
            )
            lengths[missing] = 0
        return Values(missing, lengths, text)
    if pa.types.is_boolean(array.type):
        content: np.ndarray = _bits(buffers[1], begin, end).astype(np.uint8)
    else:
        kind = np.float64 if pa.types.is_floating(array.type) else np.int64
        content = np.frombuffer(buffers[1], kind)[begin:end]
    return Values(missing, np.where(missing, content.dtype.type(0), content))


def _bits(buffer: pa.Buffer, begin: int, end: int) -> np.ndarray:
    bits = np.unpackbits(np.frombuffer(buffer, np.uint8), bitorder="little")
    return bits[begin:end].astype(bool)
