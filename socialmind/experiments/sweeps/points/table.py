"""The points of a design: a table of any origin, as values that were checked, row by row."""

from __future__ import annotations

import csv
import io
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from coglogo_py.border.errors import shown
from socialmind.errors import SocialmindError
from socialmind.experiments.sweeps.columns import POINT, Names
from socialmind.experiments.sweeps.points.varied import Nameable, Varied
from socialmind.runs.tables.growing import arrow_table

if TYPE_CHECKING:
    import pandas as pd


@dataclass(frozen=True)
class Points:
    """The points of a design.

    Attributes:
        columns: what varies.
        values: of each point, in the order of the columns.
        made: how the design was made.
    """

    columns: tuple[Varied, ...]
    values: tuple[tuple[Any, ...], ...]
    made: Mapping[str, Any]

    def parquet(self, names: Names) -> bytes:
        """Return `design.parquet`: a column `point`, from 0, and one for all that varies."""
        import pyarrow.parquet as pq

        columns: dict[str, Any] = {POINT: np.arange(len(self.values))}
        for place, one in enumerate(self.columns):
            columns[names.of_varied(one.name)] = [row[place] for row in self.values]
        sink = io.BytesIO()
        pq.write_table(arrow_table([columns], "design"), sink, compression="zstd")
        return sink.getvalue()


def points_of(design: pd.DataFrame | Mapping[str, Sequence[Any]] | None, there: Nameable) -> Points:
    """Return the points of a table.

    Args:
        design: a column for each thing that varies, a row a point; a mapping of lists is one too;
            None for one point at which nothing varies.
        there: what columns can name.

    Raises:
        SocialmindError: an unknown column, or a value that cannot be; says in which row.
    """
    import pandas as pd

    if design is None:
        return Points((), ((),), {"name": "none"})
    try:
        frame = design if isinstance(design, pd.DataFrame) else pd.DataFrame(design)
    except (ValueError, TypeError) as error:
        raise SocialmindError(f"a design that is no table ({error})") from None
    if frame.empty:
        raise SocialmindError("a design without points; give one row at least, and a column")
    names = [str(name) for name in frame.columns]
    columns = _columns(names, there)
    values = [_checked(one, frame.iloc[:, n].tolist()) for n, one in enumerate(columns)]
    rows = tuple(zip(*values, strict=True))
    return Points(columns, rows, dict(frame.attrs.get("design", {"name": "table"})))


def points_in(path: Path, there: Nameable) -> Points:
    """Return the points of a CSV file, whose first line names the columns; commas or semicolons.

    Raises:
        SocialmindError: it cannot be read, or as for `points_of`.
    """
    try:
        with path.expanduser().open(encoding="utf-8-sig", newline="") as file:
            first = file.readline()
            file.seek(0)
            reader = csv.reader(file, delimiter=";" if ";" in first and "," not in first else ",")
            lines = [(reader.line_num, [cell.strip() for cell in cells]) for cells in reader]
    except OSError as error:
        raise SocialmindError(f"{path}: {error.strerror or error}") from None
    except (csv.Error, UnicodeDecodeError) as error:
        raise SocialmindError(f"{path}: not a CSV file in UTF-8 ({error})") from None
    lines = [(number, cells) for number, cells in lines if any(cells)]
    if len(lines) < 2:
        raise SocialmindError(f"{path}: no points; expected a line of names, then a line a point")
    (_, names), *rows = lines
    columns = _columns(names, there, f"{path}: ")
    for number, cells in rows:
        if len(cells) != len(names):
            raise SocialmindError(
                f"{path}:{number}: found {len(cells)} values; expected {len(names)}, one for each "
                f"of {', '.join(names)}"
            )
    values = tuple(
        tuple(_said(one, text, f"{path}:{n}") for one, text in zip(columns, cells, strict=True))
        for n, cells in rows
    )
    return Points(columns, values, {"name": "table", "file": path.name})


def points_of_parquet(content: bytes, columns: Sequence[Varied], names: Names) -> Points:
    """Return the points that a sweep's `design.parquet` keeps."""
    import pyarrow.parquet as pq

    rows = pq.read_table(io.BytesIO(content), use_threads=False)
    read = [
        [one.parameter.checked(v) if one.parameter else v for v in rows[column].to_pylist()]
        for one in columns
        for column in [names.of_varied(one.name)]
    ]
    values = tuple(zip(*read, strict=True)) if read else ((),) * rows.num_rows
    return Points(tuple(columns), values, {})


def _columns(names: Sequence[str], there: Nameable, where: str = "") -> tuple[Varied, ...]:
    if POINT in names and POINT not in there.model_class.parameters:
        raise SocialmindError(f"{where}a column called {POINT}, which a sweep makes; leave it out")
    columns = []
    for name in names:
        try:
            columns.append(there.called(name))
        except SocialmindError as error:
            raise SocialmindError(f"{where}{error}") from None
    refuse_twice(columns, where)
    return tuple(columns)


def refuse_twice(columns: Sequence[Varied], where: str = "") -> None:
    """Refuse two columns that set the same.

    Raises:
        SocialmindError: there are some.
    """
    seen: dict[tuple[Any, ...], str] = {}
    for one in columns:
        said = () if one.word is None else one.word[1:]  # whatever its text is
        target = (one.kind, one.population, said, one.name if one.parameter else "")
        if target in seen:
            raise SocialmindError(
                f"{where}{one.name} is set twice, by {seen[target]} too; leave one out"
            )
        seen[target] = one.name


def _checked(one: Varied, values: Sequence[Any]) -> list[Any]:
    found = []
    for number, value in enumerate(values):
        if isinstance(value, np.generic):
            value = value.item()
        try:
            found.append(one.checked(value))
        except SocialmindError as error:
            raise SocialmindError(f"row {number} of the design: {error}") from None
    return found


def _said(one: Varied, text: str, where: str) -> Any:
    if not text:
        raise SocialmindError(f"{where}: {one.name}: found {shown(text)}; expected a value")
    try:
        return one.read(text)
    except SocialmindError as error:
        raise SocialmindError(f"{where}: {error}") from None
