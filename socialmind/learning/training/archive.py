"""Arrays with a record beside them in one file, which is replaced in one step."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import numpy as np

from coglogo_py.border.errors import CogLogoError, one_line
from socialmind.errors import SocialmindError
from socialmind.runs.arrays_file import load_arrays
from socialmind.runs.record import Expected, Fields, check_record

ANYTHING = Fields({})


def load(path: Path, expected: Expected = ANYTHING) -> tuple[dict[str, Any], dict[str, np.ndarray]]:
    """Return the record and the arrays of a file.

    Args:
        path: the file.
        expected: what its record holds.

    Raises:
        SocialmindError: the file is no such file, cut off, or holds something else.
    """
    try:
        record, arrays = load_arrays(path)
    except (OSError, ValueError) as error:
        raise SocialmindError(
            f"{path}: not a whole file of a training ({error}); take it from a copy of the folder"
        ) from error
    check_record(record, expected, str(path))
    return record, arrays


@contextmanager
def reading(path: Path) -> Iterator[None]:
    """Use what a file held; what does not fit there is the file's fault.

    Raises:
        SocialmindError: something is missing, or not of the kind that a training writes.
    """
    try:
        yield
    except (LookupError, TypeError, ValueError, AttributeError, OverflowError) as error:
        if isinstance(error, CogLogoError):
            raise
        raise SocialmindError(
            f"{path}: not what a training wrote ({one_line(str(error)) or type(error).__name__}); "
            "take it from a copy of the folder"
        ) from error


def part(arrays: Mapping[str, Any], prefix: str) -> dict[str, Any]:
    """Return the arrays whose names begin with a prefix, by the rest of their names.

    >>> part({"optimiser/best": 1, "rows": 2}, "optimiser/")
    {'best': 1}
    """
    return {
        name.removeprefix(prefix): array
        for name, array in arrays.items()
        if name.startswith(prefix)
    }


def under(prefix: str, arrays: Mapping[str, Any]) -> dict[str, Any]:
    """Return arrays with a prefix before their names.

    >>> under("optimiser/", {"best": 1})
    {'optimiser/best': 1}
    """
    return {prefix + name: array for name, array in arrays.items()}
