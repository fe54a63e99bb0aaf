"""The tables of a run or a sweep for other programs: CSV, Excel, Stata, LaTeX.

Parquet is what a folder holds, and what pandas, polars, DuckDB and R's arrow read as it is. This is
for programs that do not. pandas writes; openpyxl for Excel and Jinja2 for LaTeX are the extra
`export`.
"""

from __future__ import annotations

import importlib.util
import re
import warnings
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any, BinaryIO

from socialmind.errors import SocialmindError, nearest
from socialmind.runs.folders import FINISHED, MANIFEST
from socialmind.work.files import replacing

if TYPE_CHECKING:
    import pandas as pd

FORMS = ("csv", "xlsx", "dta", "latex")
EXTRA = {"xlsx": "openpyxl", "latex": "jinja2"}
"""What pandas needs to write a form."""
SHEET_ROWS, SHEET_COLUMNS = 1_048_576, 16_384
"""Of a sheet of Excel, the line of names included."""
PAGE_ROWS = 2_000
"""Of a LaTeX table: more than a hundred pages."""
STATA_NAME = 32
"""Characters of a variable's name in Stata."""
STATA_COLUMNS = 32_767
STATA_TAKEN = frozenset({
    "aggregate", "array", "boolean", "break", "byte", "case", "catch", "class", "colvector",
    "complex", "const", "continue", "default", "delegate", "delete", "do", "double", "else",
    "eltypedef", "end", "enum", "explicit", "export", "external", "float", "for", "friend",
    "function", "global", "goto", "if", "inline", "int", "local", "long", "null", "pragma",
    "protected", "quad", "rowvector", "short", "typedef", "typename", "virtual", "_all", "_n",
    "_N", "_skip", "_b", "_pi", "str", "in", "_pred", "_rc", "_coef", "_cons", "_se", "with",
    "using",
})  # fmt: skip
"""Names that Stata keeps for itself."""
WHOLE = {"xlsx": 10**15 - 1, "dta": 2**53}
"""The largest whole number that a form holds; columns with larger ones, as seeds, are texts.

Stata has doubles, Excel shows and keeps fifteen digits.
"""


@dataclass
class Exported:
    """What was written.

    Attributes:
        files: in order.
        renamed: by table, the names that Stata could not hold, with those that it got.
    """

    files: list[Path] = field(default_factory=list)
    renamed: dict[str, dict[str, str]] = field(default_factory=dict)


def export(folder: Path, to: str, out: Path | None = None, only: Iterable[str] = ()) -> Exported:
    """Write the tables of a run or a sweep for another program.

    Args:
        folder: the run's, or the sweep's.
        to: one of `FORMS`.
        out: the folder for what is written; ``export`` in the run's unless given.
        only: the names of the tables to write; all unless given.

    Returns:
        The files, and what was renamed.

    Raises:
        SocialmindError: there is no such folder, form or table; a table does not fit, and then
            nothing is written; or a library is missing.
    """
    if to not in FORMS:
        raise SocialmindError(f"--to {to}: expected one of {', '.join(FORMS)}")
    library = EXTRA.get(to)
    if library is not None and importlib.util.find_spec(library) is None:
        raise SocialmindError(f'--to {to} needs {library}: pip install "socialmind[export]"')
    paths = _tables(folder)
    wanted = list(only) or list(paths)
    for name in wanted:
        if name not in paths:
            raise SocialmindError(f"{folder}: no table {name!r}; {nearest(name, paths)}")
    for name in wanted:
        _refuse_too_large(name, paths[name], to)
    tables = {name: exact(_read(paths[name]), WHOLE.get(to)) for name in wanted}
    made = Exported()
    home = out or folder / "export"
    if to == "dta":
        for name, table in tables.items():
            made.renamed[name], tables[name] = for_stata(name, table)
    home.mkdir(parents=True, exist_ok=True)
    if to == "xlsx":
        path = home / f"{folder.resolve().name}.xlsx"
        _write(path, lambda file: _workbook(file, tables))
        made.files.append(path)
        return made
    for name, table in tables.items():
        path = home / f"{name}.{'tex' if to == 'latex' else to}"
        labels = {new: old for old, new in made.renamed.get(name, {}).items()}
        _write(path, WRITERS[to](table, labels))
        made.files.append(path)
    return made


def _tables(folder: Path) -> dict[str, Path]:
    """Return the Parquet files, or data sets of parts, of a folder, by the tables' names."""
    if not (folder / MANIFEST).is_file():
        found = "holds no manifest.json" if folder.is_dir() else "no such folder"
        raise SocialmindError(f"{folder}: {found}; expected the folder of a run or a sweep")
    found_tables = {path.stem: path for path in sorted(folder.glob("*.parquet"))}
    if not found_tables:
        raise SocialmindError(
            f"{folder}: has no tables yet, as it is not {FINISHED}; finish it with --resume"
        )
    return found_tables


def _size(path: Path) -> tuple[int, int]:
    """Return how many rows and columns a table has, without reading it."""
    from pyarrow import dataset

    table = dataset.dataset(path, format="parquet")
    return table.count_rows(), len(table.schema)


def _read(path: Path) -> pd.DataFrame:
    import pandas as pd

    return pd.read_parquet(path, dtype_backend="numpy_nullable")


def _refuse_too_large(name: str, path: Path, to: str) -> None:
    """Refuse a table that a form cannot hold.

    Raises:
        SocialmindError: so it is.
    """
    rows, columns = _size(path)
    limits = {"xlsx": (SHEET_ROWS - 1, SHEET_COLUMNS), "latex": (PAGE_ROWS, SHEET_COLUMNS)}
    most_rows, most_columns = limits.get(to, (rows, STATA_COLUMNS if to == "dta" else columns))
    remedy = "nothing was written; leave it out with --table, or take --to csv or the Parquet"
    where = {"xlsx": "a sheet of Excel", "dta": "a file of Stata", "latex": "a table in print"}
    if rows > most_rows:
        raise SocialmindError(
            f"the table {name} has {rows:,} rows; {where[to]} holds {most_rows:,}; {remedy}"
        )
    if columns > most_columns:
        raise SocialmindError(
            f"the table {name} has {columns:,} columns; {where[to]} holds {most_columns:,}; "
            f"{remedy}"
        )


def _write(path: Path, write: Callable[[BinaryIO], None]) -> None:
    with replacing(path) as file:
        write(file)


def _workbook(file: BinaryIO, tables: Mapping[str, pd.DataFrame]) -> None:
    """Write tables as sheets of one workbook; what is missing is an empty cell.

    Excel has no control characters: a replacement character stands for each.
    """
    import pandas as pd
    from openpyxl.cell.cell import ILLEGAL_CHARACTERS_RE

    with pd.ExcelWriter(file, engine="openpyxl") as book:
        for name, table in tables.items():
            table = table.replace(ILLEGAL_CHARACTERS_RE, "\N{REPLACEMENT CHARACTER}", regex=True)
            table.to_excel(book, sheet_name=name[:31], index=False, freeze_panes=(1, 0))
            sheet = book.sheets[name[:31]]
            texts = [place for place, kind in enumerate(table.dtypes, 1) if kind.kind == "O"]
            columns = [next(sheet.iter_cols(place, place)) for place in texts]
            for cell in (one for cells in (*columns, sheet[1]) for one in cells):
                if cell.data_type == "f":
                    cell.data_type = "s"  # a text that begins with = is no formula


def exact(table: pd.DataFrame, largest: int | None) -> pd.DataFrame:
    """Return a table whose whole numbers a form can hold: as texts where some are too large.

    Args:
        table: with pandas' nullable types.
        largest: that the form holds exactly; None if it holds all.
    """
    import pandas as pd

    beyond = [
        name
        for name, kind in table.dtypes.items()
        if largest is not None
        and pd.api.types.is_integer_dtype(kind)
        and table[name].dropna().astype(object).abs().gt(largest).any()
    ]
    return table.astype(dict.fromkeys(beyond, "string"))


def _csv(table: pd.DataFrame, labels: Mapping[str, str]) -> Callable[[BinaryIO], None]:
    return lambda file: table.to_csv(file, index=False, encoding="utf-8", lineterminator="\n")


def _stata(table: pd.DataFrame, labels: Mapping[str, str]) -> Callable[[BinaryIO], None]:
    texts = [name for name in table if table[name].dtype == object]

    def write(file: BinaryIO) -> None:
        table.to_stata(
            file, write_index=False, version=118,
            variable_labels={new: old[:80] for new, old in labels.items()},
            convert_strl=texts if any(table[name].str.len().max() > 2045 for name in texts) else [],
        )  # fmt: skip

    return write


def _latex(table: pd.DataFrame, labels: Mapping[str, str]) -> Callable[[BinaryIO], None]:
    styled = table.style.hide(axis="index").format(escape="latex", na_rep="", precision=4)
    styled = styled.format_index(escape="latex", axis="columns")
    text = styled.to_latex(hrules=True, environment="longtable").encode()

    def write(file: BinaryIO) -> None:
        file.write(text)

    return write


WRITERS: dict[str, Callable[[Any, Mapping[str, str]], Callable[[BinaryIO], None]]] = {
    "csv": _csv,
    "dta": _stata,
    "latex": _latex,
}


def stata_names(names: Iterable[str]) -> dict[str, str]:
    """Return the names that Stata cannot hold, each with one that it can.

    It takes letters, digits and `_`, not a digit first, 32 characters at most, and no word of its
    own.

    >>> stata_names(["tick", "cows.agent", "cows_agent", "in", "2nd"])
    {'cows.agent': 'cows_agent_2', 'in': '_in', '2nd': '_2nd'}
    """
    names = list(names)
    good = [name for name in names if _fits_stata(name)]
    taken = set(good)
    renamed = {}
    for name in names:
        if name in good:
            continue
        plain = re.sub(r"[^A-Za-z0-9_]", "_", name)
        if plain[:1].isdigit() or plain in STATA_TAKEN or not plain:
            plain = f"_{plain}"
        new, number = plain[:STATA_NAME], 1
        while new in taken or not _fits_stata(new):
            number += 1
            ending = f"_{number}"
            new = plain[: STATA_NAME - len(ending)] + ending
        taken.add(new)
        renamed[name] = new
    return renamed


def _fits_stata(name: str) -> bool:
    plain = re.fullmatch(r"[A-Za-z_][A-Za-z0-9_]{0,31}", name) is not None
    return plain and name not in STATA_TAKEN and not re.fullmatch(r"str\d+", name)


def for_stata(name: str, table: pd.DataFrame) -> tuple[dict[str, str], pd.DataFrame]:
    """Return a table as Stata holds it: its names, numbers, texts; and what was renamed.

    Missing numbers stay missing, a missing text is empty, true and false are 1 and 0.

    Args:
        name: the table's, for errors.
        table: with pandas' nullable types, its whole numbers within ±2⁵³.

    Raises:
        SocialmindError: a number is infinite, which Stata does not have.
    """
    import numpy as np
    import pandas as pd

    columns: dict[str, Any] = {}
    names = [str(one) for one in table]
    for one in names:
        values = table[one]
        if pd.api.types.is_bool_dtype(values.dtype) or pd.api.types.is_integer_dtype(values.dtype):
            # to_stata takes the narrowest of its own types.
            columns[one] = values.to_numpy(np.float64, na_value=np.nan)
            if not values.isna().any():
                columns[one] = columns[one].astype(np.int64)
                if abs(columns[one]).max(initial=0) >= 2**31 - 101:
                    columns[one] = columns[one].astype(np.float64)
        elif pd.api.types.is_float_dtype(values.dtype):
            columns[one] = values.to_numpy(np.float64, na_value=np.nan)
            if np.isinf(columns[one]).any():
                raise SocialmindError(
                    f"{one} of {name}: found an infinite number; Stata has none; leave the table "
                    "out with --table, or take --to csv"
                )
        elif values.isna().all():
            columns[one] = np.full(len(values), np.nan)
        else:
            columns[one] = values.fillna("").astype(object)
    renamed = stata_names(names)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", pd.errors.PerformanceWarning)
        made = pd.DataFrame(columns).rename(columns=renamed)
    return renamed, made
