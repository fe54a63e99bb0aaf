"""Tables that populations begin with: a row an agent, a column a field.

A table is a CSV or Parquet file beside the model, or given in Python: a data frame, an Arrow table,
columns by their names.
"""

from __future__ import annotations

import csv
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

import numpy as np

from coglogo_py.border.errors import shown
from socialmind.columns import columns_of
from socialmind.errors import SocialmindError, UnknownNameError, ValueRefusedError, nearest
from socialmind.fields import Field

FILES = (".csv", ".parquet")


class Beginning:
    """A table that a population begins with.

    Args:
        what: how to call it in errors: its file, or whose it is.
        columns: by field, one value for each agent.
        lines: of a file, the line in which each row stands.

    Attributes:
        count: how many agents there are.
    """

    def __init__(self, what: str, columns: dict[str, Any], lines: list[int] | None = None) -> None:
        self.what = what
        self.columns = {name: _with_texts(one) for name, one in columns.items()}
        self.lines = lines
        self.count = len(next(iter(columns.values()))) if columns else 0

    def row(self, place: int) -> str:
        """Return what errors call a row."""
        return f"row {place}" if self.lines is None else f"line {self.lines[place]}"


def _with_texts(values: Any) -> Any:
    """Return values such that a text among numbers makes no texts of these."""
    texts = isinstance(values, list | tuple) and any(isinstance(one, str) for one in values)
    return np.array(values, dtype=object) if texts else values


def is_table(source: Any) -> bool:
    """Return whether this may be a table: a file by its name, or columns."""
    if isinstance(source, str | Path):
        return Path(source).suffix.lower() in FILES
    return isinstance(source, Mapping) or hasattr(source, "columns")


def beginning_of(
    source: Any, name: str, fields: Mapping[str, Field], folder: Callable[[], Path]
) -> Beginning:
    """Return the table that a population begins with.

    Args:
        source: the file, beside the model unless its path is absolute; or the table.
        name: the population's.
        fields: those of its agents.
        folder: gives the model's.

    Raises:
        SocialmindError: there is no such file, it is no table, or a column is no field.
    """
    if isinstance(source, str | Path):
        path = Path(source) if Path(source).is_absolute() else folder() / source
        found = _read(path, fields)
    else:
        what = f"the table of {name!r}"
        found = Beginning(what, columns_of(source, what))
    for column in found.columns:
        if column not in fields:
            raise UnknownNameError(
                f"{found.what}: the column {shown(column)} is no field of {name!r}; "
                f"{nearest(column, fields)}; leave other columns out"
            )
    return found


def _read(path: Path, fields: Mapping[str, Field]) -> Beginning:
    try:
        if path.suffix.lower() == ".parquet":
            from pyarrow import parquet

            # Through Python, so that what the provenance of a run sees is this file.
            with path.open("rb") as file:
                return Beginning(str(path), columns_of(parquet.read_table(file), str(path)))
        with path.open(newline="", encoding="utf-8-sig") as file:
            return _from_csv(path, list(csv.reader(file)), fields)
    except (OSError, UnicodeDecodeError, csv.Error, ValueError) as error:
        if isinstance(error, SocialmindError):
            raise
        reason = error.strerror if isinstance(error, OSError) and error.strerror else error
        raise SocialmindError(
            f"{path}: {reason}; expected a table, a CSV or Parquet file"
        ) from None


def _from_csv(path: Path, lines: list[list[str]], fields: Mapping[str, Field]) -> Beginning:
    """Return the columns of a CSV file, whose first line names them."""
    rows = [(number, line) for number, line in enumerate(lines, 1) if line]
    if not rows:
        raise ValueRefusedError(
            f"{path}: found nothing; expected names of fields in its first line"
        )
    names = [name.strip() for name in rows[0][1]]
    twice = next((name for place, name in enumerate(names) if name in names[:place]), None)
    if twice is not None:
        raise ValueRefusedError(f"{path}: found the column {shown(twice)} twice; expected it once")
    for number, line in rows[1:]:
        if len(line) != len(names):
            raise ValueRefusedError(
                f"{path}, line {number}: found {len(line)} values; expected {len(names)}, one for "
                "each name of the first line"
            )
    columns = {
        name: [_value(line[place], fields.get(name)) for _, line in rows[1:]]
        for place, name in enumerate(names)
    }
    return Beginning(str(path), columns, [number for number, _ in rows[1:]])


_TRUTH = {"true": True, "false": False, "1": True, "0": False}


def _value(text: str, field: Field | None) -> Any:
    """Return what a cell says, or its text where that is no value of the field."""
    text = text.strip()
    if field is None or (not text and field.optional):
        return None
    if field.kind is bool:
        return _TRUTH.get(text.lower(), text)
    for kind in (int, float):
        try:
            return kind(text)
        except ValueError:
            continue
    return text
