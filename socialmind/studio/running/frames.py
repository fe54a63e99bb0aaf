"""Frames: a moment of a society as bytes, columns behind a small header.

A frame is four bytes, the length of the header (little-endian), the header (JSON, padded with
blanks to a multiple of 8 with those four), and the columns, each at a multiple of 8. The header
names each column's type ("f4", "u4", "u1"), shape and place behind the header. Colours are u1:
places among words, or along a scale, so that a page looks each up in a table.
"""

from __future__ import annotations

import json
from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

STEP = 8
Columns = Mapping[str, NDArray[Any]]


def packed(said: Mapping[str, Any], columns: Columns, before: bytes = b"") -> bytes:
    """Return a frame.

    Args:
        said: what the header says beside its columns; JSON.
        columns: by name, of float32, uint32 and uint8.
        before: what stands before it, so that nothing large is copied to put it there.

    >>> frame = packed({"tick": 3}, {"x": np.array([1.0, 2.5])})
    >>> header, columns = unpacked(frame)
    >>> header["tick"], columns["x"].tolist()
    (3, [1.0, 2.5])
    """
    places, at = {}, 0
    pieces: list[Any] = []
    for name, column in columns.items():
        stored = np.ascontiguousarray(column)
        places[name] = {"type": stored.dtype.str[1:], "shape": stored.shape, "at": at}
        gap = -stored.nbytes % STEP
        pieces += [stored.data, bytes(gap)]
        at += stored.nbytes + gap
    header = json.dumps({**said, "columns": places}, separators=(",", ":")).encode()
    header += b" " * (-(len(header) + 4) % STEP)
    return b"".join([before, len(header).to_bytes(4, "little"), header, *pieces])


def unpacked(frame: bytes) -> tuple[dict[str, Any], dict[str, NDArray[Any]]]:
    """Return the header and the columns of a frame."""
    begin = 4 + int.from_bytes(frame[:4], "little")
    header = json.loads(frame[4:begin])
    columns = {}
    for name, place in header.pop("columns").items():
        dtype, shape = np.dtype(f"<{place['type']}"), tuple(place["shape"])
        count = int(np.prod(shape))
        column = np.frombuffer(frame, dtype, count, begin + place["at"])
        columns[name] = column.reshape(shape)
    return header, columns
