"""Fields of patches from maps: CSV files, pictures in grey, arrays.

A file looks like the map: its first line is the world's north, its first column the west. An array
is as the world gives fields: by column, from the south-west.
"""

from __future__ import annotations

import csv
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from coglogo_py.border.errors import shown
from coglogo_py.border.numbers import is_number
from socialmind.errors import SocialmindError, ValueRefusedError
from socialmind.fields import Field

PICTURES = (".png", ".jpg", ".jpeg", ".bmp", ".gif", ".tif", ".tiff", ".webp", ".pgm")


def raster(
    source: Any,
    field: Field,
    width: int,
    height: int,
    low: float | None,
    high: float | None,
    folder: Path,
) -> Any:
    """Return the values of a field of all patches from a map.

    Args:
        source: a CSV file, a picture, or an array (width, height).
        field: the field.
        width: patches across.
        height: patches up.
        low: what black is in a picture; 0 unless given.
        high: what white is; 1 unless given.
        folder: where files lie, unless their path is absolute.

    Raises:
        SocialmindError: the file cannot be read, or it is a map of another size.
    """
    if not isinstance(source, str | Path):
        if low is not None or high is not None:
            raise ValueRefusedError("low= and high= for an array; expected them for a picture")
        return source
    path = folder / source
    if field.size is not None:
        raise ValueRefusedError(f"{path}: a map for {field.name!r}; expected a field of one number")
    suffix = path.suffix.lower()
    if suffix in PICTURES:
        ends = (0.0 if low is None else low), (1.0 if high is None else high)
        if not all(is_number(one) for one in ends):
            raise ValueRefusedError(
                f"{path}: low={shown(low)}, high={shown(high)}; expected numbers"
            )
        shares = _picture(path, width, height)
        values: Any = ends[0] + shares * (float(ends[1]) - ends[0])
        if field.kind is bool:
            return shares >= 0.5
        return np.rint(values).astype(np.int64) if field.kind is int else values
    if suffix != ".csv":
        raise SocialmindError(
            f"{path}: found a file of the kind {shown(suffix)}; expected .csv, or a picture: "
            f"{', '.join(PICTURES)}"
        )
    if low is not None or high is not None:
        raise ValueRefusedError(f"{path}: low= and high= for a CSV; expected them for a picture")
    return _csv(path, field, width, height)


def _picture(path: Path, width: int, height: int) -> NDArray[np.float64]:
    """Return how bright a picture is, 0 … 1, by column from the south-west."""
    from PIL import Image

    try:
        # Opened by Python, so that what watches over a run's files sees it.
        with path.open("rb") as file, Image.open(file) as image:
            if image.size != (width, height):
                raise _of_another_size(path, *image.size, width, height)
            if image.mode == "F":
                raise ValueError("found numbers with fractions, of which none is white")
            deep = image.mode.startswith("I")  # 16 bits
            grey = np.asarray(image if deep else image.convert("L"), float)
            white = 65535.0 if deep else 255.0
    except (OSError, ValueError, SyntaxError, Image.DecompressionBombError) as error:
        if isinstance(error, SocialmindError):
            raise
        raise _unreadable(path, error, "a picture") from None
    return np.ascontiguousarray((grey / white)[::-1].T)


def _csv(path: Path, field: Field, width: int, height: int) -> NDArray[Any]:
    try:
        with path.open(newline="", encoding="utf-8-sig") as file:
            lines = [(number, line) for number, line in enumerate(csv.reader(file), 1) if line]
    except (OSError, UnicodeDecodeError, csv.Error) as error:
        raise _unreadable(path, error, "a CSV file of numbers") from None
    for number, line in lines:
        if len(line) != width:
            raise ValueRefusedError(
                f"{path}, line {number}: found {len(line)} values; expected {width}, one for each "
                "column of patches"
            )
    if len(lines) != height:
        raise _of_another_size(path, width, len(lines), width, height)
    values = np.zeros((width, height), object)
    for row, (number, line) in enumerate(lines):
        for column, text in enumerate(line):
            values[column, height - 1 - row] = _number(path, number, column + 1, text, field)
    return values


def _number(path: Path, line: int, column: int, text: str, field: Field) -> Any:
    text = text.strip()
    if not text and field.optional:
        return None
    truth = {"true": True, "false": False, "1": True, "0": False}.get(text.lower())
    if field.kind is bool and truth is not None:
        return truth
    for kind in (int, float):
        try:
            return kind(text)
        except ValueError:
            continue
    raise ValueRefusedError(
        f"{path}, line {line}, column {column}: found {shown(text)}; expected a number"
    )


def _of_another_size(
    path: Path, across: int, up: int, width: int, height: int
) -> ValueRefusedError:
    return ValueRefusedError(
        f"{path}: found a map of {across} × {up}; expected {width} × {height}, a value for each "
        "patch; give the world this size, or the map another"
    )


def _unreadable(path: Path, error: Exception, expected: str) -> SocialmindError:
    reason = error.strerror if isinstance(error, OSError) and error.strerror else error
    return SocialmindError(f"{path}: {reason}; expected {expected}")
