"""Arrays with a record beside them in one file: checkpoints of runs and trainings.

It is replaced in one step, and read without trust: no Python objects, no array whose header
promises more than there is, and no more in all than such a file can hold.
"""

from __future__ import annotations

import json
import os
import zipfile
import zlib
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

from socialmind.runs.record import within
from socialmind.work.files import replacing

RECORD = "record"
MOST = 1000
"""How many times its own size a compressed file may hold (deflate's limit is 1032)."""
FREE = 1 << 26
"""Bytes that any file may hold."""
LONGEST_HEADER = 1_000_000
"""Characters that say of what fields an array consists."""


def save_arrays(
    path: Path,
    record: Mapping[str, Any],
    arrays: Mapping[str, Any],
    name: str = RECORD,
    compressed: bool = False,
) -> None:
    """Write the file: whenever the process is killed, the one before or this one stands there.

    Args:
        path: where.
        record: what JSON can hold.
        arrays: by name; numbers and texts, no Python objects.
        name: of the record.
        compressed: smaller, and slower to write; it is read all the same.
    """
    whole: dict[str, Any] = {**arrays, name: np.array(json.dumps(record))}
    with replacing(path) as file:
        (np.savez_compressed if compressed else np.savez)(file, **whole)
        file.flush()
        os.fsync(file.fileno())


def load_arrays(path: Path, name: str = RECORD) -> tuple[dict[str, Any], dict[str, np.ndarray]]:
    """Return the record and the arrays of a file.

    Args:
        path: the file.
        name: of the record.

    Raises:
        SocialmindError: it is no such file, cut off, changed, or a link out of its folder.
        ValueError: likewise, with what is wrong in a few words.
    """
    within(path.parent, path.name)
    try:
        with zipfile.ZipFile(path) as archive:
            members = archive.infolist()
            held = sum(one.file_size for one in members)
            if held > max(FREE, MOST * path.stat().st_size):
                raise ValueError(f"it claims to hold {held:,} bytes")
            arrays = {}
            for member in members:
                key = member.filename.removesuffix(".npy")
                if key in arrays:
                    raise ValueError(f"{key} stands in it twice")
                arrays[key] = _array(archive, member, key)
        if name not in arrays:
            raise ValueError(f"it has no {name}")
        record = json.loads(str(arrays.pop(name)))
    except (zipfile.BadZipFile, zlib.error, EOFError, NotImplementedError, RuntimeError) as error:
        raise ValueError("it is cut off, or was changed") from error
    if not isinstance(record, dict):
        raise ValueError(f"its {name} is no record")
    return record, arrays


def _array(archive: zipfile.ZipFile, member: zipfile.ZipInfo, key: str) -> np.ndarray:
    with archive.open(member) as file:
        try:
            array: np.ndarray = np.lib.format.read_array(
                file, allow_pickle=False, max_header_size=LONGEST_HEADER
            )
            if file.read(1):
                raise ValueError
        except (ValueError, TypeError, OverflowError, MemoryError) as error:
            # The header may promise any number of values.
            raise ValueError(f"{key} is no array of numbers, is cut off or was changed") from error
    return array
