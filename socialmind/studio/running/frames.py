"""Frames: a moment of a society as bytes, columns behind a small header.

A frame is four bytes, the length of the header (little-endian), the header (JSON, padded with
blanks to a multiple of 8 with those four), and the columns, each at a multiple of 8. The header
names each column's type ("f4", "u4", "u1"), shape and place behind the header.
"""

from __future__ import annotations

import json
from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

STEP = 8
TYPES = {"f": np.dtype("<f4"), "u": np.dtype("<u4"), "b": np.dtype("u1")}

Columns = Mapping[str, NDArray[Any]]


def packed(said: Mapping[str, Any], columns: Columns) -> bytes:
    """Return a frame.

    Args:
        said: what the header says beside its columns; JSON.
        columns: by name; numbers become f4, u4 and u1.

    >>> frame = packed({"tick": 3}, {"x": np.array([1.0, 2.5])})
    >>> header, columns = unpacked(frame)
    >>> header["tick"], columns["x"].tolist()
    (3, [1.0, 2.5])
    """
    places, pieces, at = {}, [], 0
    for name, column in columns.items():
        stored = np.ascontiguousarray(column)
        places[name] = {"type": stored.dtype.str[1:], "shape": stored.shape, "at": at}
        content = stored.tobytes()
        pieces += [content, bytes(-len(content) % STEP)]
        at += len(content) + -len(content) % STEP
    header = json.dumps({**said, "columns": places}, separators=(",", ":")).encode()
    header += b" " * (-(len(header) + 4) % STEP)
    return b"".join([len(header).to_bytes(4, "little"), header, *pieces])


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
