"""The data that a model is fitted to: a series, or statistics with their errors."""

from __future__ import annotations

import csv
import io
import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from coglogo_py.border.errors import shown
from coglogo_py.border.numbers import is_number
from socialmind.errors import SocialmindError, nearest
from socialmind.experiments.calibration.distance import Values, distance, spreads
from socialmind.experiments.sweeps.one_run import Outcome

if TYPE_CHECKING:
    import pandas as pd

SERIES, STATISTICS = "series", "statistics"
TICK = "tick"
OTHERS = ("run", "point", "replicate")
"""Columns by which a file would hold the series of several runs."""


@dataclass(frozen=True, eq=False)
class Target:
    """What a model is fitted to.

    Attributes:
        kind: `SERIES` or `STATISTICS`.
        columns: of the series, or the statistics: measures, or columns of the series at the end.
        ticks: of a series' rows, ascending; none for statistics.
        values: (ticks, columns), NaN where nothing was observed; one row for statistics.
        errors: of the statistics; none for a series.
        name: of the file.
    """

    kind: str
    columns: tuple[str, ...]
    ticks: tuple[int, ...]
    values: Values
    errors: tuple[float, ...] = ()
    name: str = ""

    @cached_property
    def scales(self) -> Values:
        """What differences of each column are divided by."""
        return spreads(self.values) if self.kind == SERIES else np.array(self.errors)

    def distance(self, found: Values) -> float:
        """Return how far the means over a trial's runs are from the data."""
        return distance(found, self.values, self.scales)

    def of_data(self, runs: Values, rng: np.random.Generator) -> Target:
        """Return data like these that are made: the mean of runs, and for statistics an error.

        Args:
            runs: (runs, ticks, columns).
            rng: draws the errors, normal ones.
        """
        made = runs.mean(axis=0)
        if self.kind == STATISTICS:
            made = made + rng.normal(size=made.shape) * self.errors
        return replace(self, values=np.where(np.isnan(self.values), np.nan, made))

    def observed(self, outcome: Outcome) -> Values:
        """Return what the data speak of, as it is in a run.

        Raises:
            SocialmindError: a run has no number where the data have one.
        """
        if self.kind == STATISTICS:
            there = {**outcome.final, **outcome.measured}
            found = np.array([[_number(there[name]) for name in self.columns]])
        else:
            series = outcome.series or {}
            rows = {tick: row for row, tick in enumerate(np.asarray(series[TICK]).tolist())}
            if self.ticks[-1] not in rows:
                raise SocialmindError(
                    f"the run ended at tick {outcome.ticks}, before the data do, at "
                    f"{self.ticks[-1]}"
                )
            places = [rows[tick] for tick in self.ticks]
            columns = [[_number(series[name][row]) for row in places] for name in self.columns]
            found = np.array(columns).T
        missing = ~np.isfinite(found) & ~np.isnan(self.values)
        if missing.any():
            row, column = np.argwhere(missing)[0].tolist()
            when = f" at tick {self.ticks[row]}" if self.ticks else ""
            raise SocialmindError(f"{self.columns[column]}{when} is {found[row, column]}")
        return found

    def notes(self) -> list[str]:
        """Return what is to be said of the data before a fit."""
        empty = np.isnan(self.values).sum(axis=0).tolist()
        return [
            f"{name}: {count:,} of {len(self.values):,} ticks are empty and not compared"
            for name, count in zip(self.columns, empty, strict=True)
            if count
        ]

    def csv(self) -> bytes:
        """Return the file that a fit's folder keeps."""
        stream = io.StringIO()
        writer = csv.writer(stream, lineterminator="\n")
        if self.kind == SERIES:
            writer.writerow([TICK, *self.columns])
            for tick, row in zip(self.ticks, self.values.tolist(), strict=True):
                writer.writerow([tick, *("" if math.isnan(one) else repr(one) for one in row)])
        else:
            writer.writerow(["statistic", "value", "error"])
            both = zip(self.columns, self.values[0].tolist(), self.errors, strict=True)
            writer.writerows([name, repr(value), repr(error)] for name, value, error in both)
        return stream.getvalue().encode()

    @classmethod
    def of_csv(cls, content: bytes, name: str = "") -> Target:
        """Return the data of such a file."""
        head, *rows = csv.reader(io.StringIO(content.decode()))
        if head[0] == TICK:
            values = np.array([[float(one or "nan") for one in row[1:]] for row in rows])
            ticks = tuple(int(row[0]) for row in rows)
            return cls(SERIES, tuple(head[1:]), ticks, values, name=name)
        names, found, errors = zip(*rows, strict=True)
        return cls(STATISTICS, names, (), np.array([[*map(float, found)]]), (*map(float, errors),))


def target_of(given: Any) -> Target:
    """Return the data that were given.

    Args:
        given: a data frame with the column `tick`; the path of a CSV or Parquet file of one, after
            which columns may stand, `FILE.csv:farmers,artisans`; statistics by name, each a pair of
            value and error; or texts as `--target` takes them.

    Raises:
        SocialmindError: it is none, ticks are missing, an error is.
    """
    import pandas as pd

    if isinstance(given, Target):
        return given
    if isinstance(given, pd.DataFrame):
        return _of_frame(given, "the target")
    if isinstance(given, Mapping):
        return _of_statistics(given)
    texts = [str(given)] if isinstance(given, str | Path) else list(given or ())
    if not texts or not all(isinstance(one, str) for one in texts):
        raise SocialmindError(
            f"target: found {shown(given)}; expected a file of a series, or NAME=VALUE±ERROR"
        )
    if len(texts) == 1 and not _is_statistic(texts[0]):
        return _of_file(texts[0])
    found: dict[str, tuple[float, float]] = {}
    for text in texts:
        name, pair = _statistic(text)
        if name in found:
            raise SocialmindError(f"--target {name}: stands twice; give it once")
        found[name] = pair
    return _of_statistics(found)


def check_columns(target: Target, series: Sequence[str], measures: Sequence[str]) -> None:
    """Refuse data of what the model does not have.

    Args:
        target: the data.
        series: the columns of the model's series.
        measures: by which statistics may be called, too.

    Raises:
        SocialmindError: there are such.
    """
    known = [*series, *(measures if target.kind == STATISTICS else ())]
    for name in target.columns:
        if name in known:
            continue
        hint = nearest(name, known)
        if target.kind == SERIES:
            raise SocialmindError(
                f"{target.name or 'target'}: the model's series has no column {name!r}; {hint}; to "
                "leave columns out, name those that count: FILE.csv:NAME,NAME"
            )
        raise SocialmindError(
            f"--target {name}: neither a measure nor a column of the series; {hint}, or say what "
            f"it is: --measure {name}=EXPRESSION"
        )


def _is_statistic(text: str) -> bool:
    return not Path(text).is_file() and ("±" in text or "+-" in text or "=" in text)


def _statistic(text: str) -> tuple[str, tuple[float, float]]:
    """Read `NAME=VALUE±ERROR`; `+-` will do for `±`."""
    name, equals, said = (part.strip() for part in text.partition("="))
    if not equals or not name:
        what = "a file beside others; give it alone" if Path(text).is_file() else "no statistic"
        raise SocialmindError(f"--target {text}: {what}; expected NAME=VALUE±ERROR")
    value, sign, error = said.replace("+-", "±").partition("±")
    if not sign:
        raise SocialmindError(
            f"--target {text}: without an error nobody knows what is near; write "
            f"{name}={said or 'VALUE'}±ERROR"
        )
    try:
        return name, (float(value), float(error))
    except ValueError:
        raise SocialmindError(
            f"--target {text}: expected two numbers, {name}=VALUE±ERROR"
        ) from None


def _of_statistics(given: Mapping[Any, Any]) -> Target:
    found = {}
    for name, pair in given.items():
        both: Any = pair if isinstance(pair, Sequence) and len(pair) == 2 else (None, None)
        value, error = both
        if not is_number(value) or not is_number(error) or not math.isfinite(value):
            raise SocialmindError(
                f"target {name}: found {shown(pair)}; expected a value and its error"
            )
        if not 0 < error < math.inf:
            raise SocialmindError(
                f"target {name}: found an error of {error:g}; expected one above 0"
            )
        found[str(name)] = float(value), float(error)
    if not found:
        raise SocialmindError("no target; give --target FILE.csv or --target NAME=VALUE±ERROR")
    values = np.array([[value for value, _ in found.values()]])
    return Target(STATISTICS, tuple(found), (), values, tuple(e for _, e in found.values()))


def _of_file(text: str) -> Target:
    import pandas as pd

    path, wanted = Path(text).expanduser(), ""
    if not path.is_file() and ":" in text:
        before, _, wanted = text.rpartition(":")
        path = Path(before).expanduser()
    try:
        read = pd.read_parquet if path.suffix == ".parquet" else pd.read_csv
        frame: pd.DataFrame = read(path)
    except OSError as error:
        raise SocialmindError(f"{path}: {error.strerror or error}") from None
    except (ValueError, UnicodeDecodeError) as error:  # those of pandas and Arrow are such
        raise SocialmindError(f"{path}: cannot be read as a table ({error})") from None
    frame.columns = [str(name).strip() for name in frame.columns]
    if wanted:
        names = [one.strip() for one in wanted.split(",")]
        for name in names:
            if name not in frame.columns:
                hint = nearest(name, frame.columns)
                raise SocialmindError(f"{path}: no column {name!r}; {hint}")
        frame = frame[[*(one for one in frame.columns if one == TICK and one not in names), *names]]
    return replace(_of_frame(frame, str(path)), name=path.name)


def _of_frame(frame: pd.DataFrame, where: str) -> Target:
    import pandas as pd

    columns = [str(name) for name in frame.columns if name != TICK]
    if TICK not in frame.columns:
        raise SocialmindError(
            f"{where}: no column called {TICK}, which says when each row was observed; it has "
            f"{', '.join(columns) or 'none'}"
        )
    several = next((name for name in OTHERS if name in columns), None)
    if several is not None:
        raise SocialmindError(
            f"{where}: the column {several} says that it holds several runs; keep the rows of one, "
            "or means over all, without that column"
        )
    if not columns or frame.empty:
        raise SocialmindError(f"{where}: no data; expected rows with {TICK} and a column of values")
    ticks = pd.to_numeric(frame[TICK], errors="coerce").tolist()
    for row, tick in enumerate(ticks):
        if not math.isfinite(tick) or tick != int(tick) or tick < 0:
            found = shown(frame[TICK].tolist()[row])
            raise SocialmindError(
                f"{where}: row {row + 1}: tick: found {found}; expected a whole number, 0 or more"
            )
        if row and tick <= ticks[row - 1]:
            raise SocialmindError(
                f"{where}: row {row + 1}: tick {int(tick)} after {int(ticks[row - 1])}; expected "
                "each tick once, ascending"
            )
    values = {}
    for name in columns:
        numbers = pd.to_numeric(frame[name], errors="coerce")
        odd = numbers.isna() & frame[name].notna() | np.isinf(numbers)
        if odd.any():
            row = int(odd.to_numpy().argmax())
            found = shown(frame[name].tolist()[row])
            raise SocialmindError(
                f"{where}: row {row + 1}: {name}: found {found}; expected a number, or nothing"
            )
        values[name] = numbers.to_numpy(np.float64)
        if np.isnan(values[name]).all():
            raise SocialmindError(f"{where}: {name} has no value at any tick; leave it out")
    whole = tuple(map(int, ticks))
    return Target(SERIES, tuple(columns), whole, np.column_stack([*values.values()]))


def _number(value: Any) -> float:
    if isinstance(value, bool | int | float | np.generic):
        return float(value)
    if value is None:
        return math.nan
    raise SocialmindError(f"found {shown(value)}; expected a number")
