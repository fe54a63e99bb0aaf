"""Measures of runs: expressions, and functions of a file, of a run that is still in memory."""

from __future__ import annotations

import inspect
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from coglogo_py.border.errors import shown
from socialmind.errors import SocialmindError, nearest
from socialmind.experiments.sweeps.measures.expressions import Expression
from socialmind.sources.folders import digest
from socialmind.sources.loading import failure_in_model, load_file
from socialmind.sources.trust import require

if TYPE_CHECKING:
    from socialmind.model import Model

TAKEN = ("model", "series", "agents")
"""What a function may take: the society at its end, the series and the agents as columns."""


@dataclass(frozen=True)
class Function:
    """A measure as a function.

    Args:
        name: of the measure.
        function: takes some of `TAKEN`, by their names.
        file: that it stands in, and its name there; empty for one of Python alone.
    """

    name: str
    function: Callable[..., Any]
    file: str = ""

    @cached_property
    def takes(self) -> tuple[str, ...]:
        """The names of what it takes.

        Raises:
            SocialmindError: there is no such thing.
        """
        names = tuple(inspect.signature(self.function).parameters)
        for name in names:
            if name not in TAKEN:
                raise SocialmindError(
                    f"measure {self.name}: its function takes {name!r}; {nearest(name, TAKEN)}"
                )
        return names

    @property
    def columns(self) -> tuple[str, ...]:
        """The columns of the series that it names: of a function nobody knows which."""
        return ()

    @property
    def of_series(self) -> bool:
        """Whether it looks at the series."""
        return "series" in self.takes

    def value(self, source: Recorded) -> float | int | bool:
        """Return the measure of a run; raises as `Expression.value`."""
        given = {"model": lambda: source.model, "series": source.arrays, "agents": source.columns}
        try:
            found = self.function(**{name: given[name]() for name in self.takes})
        except Exception as error:
            place = Path(self.function.__code__.co_filename)
            raise failure_in_model(error, place, f"measure {self.name}") from error
        number = found.item() if isinstance(found, np.generic) else found
        if isinstance(number, bool | int | float):
            return number
        raise SocialmindError(f"measure {self.name}: returned {shown(found)}; expected a number")


AMeasure = Expression | Function


def of_series(measure: AMeasure) -> bool:
    """Return whether a measure looks at more of a run than its end."""
    if isinstance(measure, Function):
        return measure.of_series
    return bool(measure.columns)


@dataclass(eq=False)
class Recorded:
    """What measures look at: a run's series, as rows, and its society at the end.

    Args:
        model: the society.
        ticks: of the rows.
        rows: what `series()` gave at each.
    """

    model: Model
    ticks: list[int]
    rows: list[Mapping[str, Any]]
    _arrays: dict[str, NDArray[Any]] = field(default_factory=dict)

    def column(self, name: str) -> NDArray[Any]:
        """Return a column of the series; `tick` is one."""
        if name not in self._arrays:
            if name == "tick":
                self._arrays[name] = np.array(self.ticks, np.int64)
            elif name not in self.rows[-1]:
                raise KeyError(["tick", *self.rows[-1]])
            else:
                self._arrays[name] = numbers(name, [row[name] for row in self.rows])
        return self._arrays[name]

    def arrays(self) -> dict[str, NDArray[Any]]:
        """Return the series as an array a column; texts as they are."""
        found = {}
        for name in ("tick", *self.rows[-1]):
            try:
                found[name] = self.column(name)
            except TypeError:
                found[name] = np.array([row[name] for row in self.rows], object)
        return found

    @cached_property
    def _columns(self) -> dict[str, Any]:
        return dict(self.model.agents())

    def columns(self) -> dict[str, Any]:
        """Return what the model records of its agents now."""
        return self._columns

    def agents(self, population: str | None, name: str) -> NDArray[Any]:
        """Return a field of the agents: as the model records it, or of a population's own."""
        tables = self.model.tables
        if population is not None:
            if population not in tables:
                raise KeyError(list(tables))
            fields = self.model.shape.populations[population].fields
            if name in fields:
                return numbers(name, getattr(tables[population], name))
            whose = self.columns().get("population")
            if name not in self.columns() or whose is None:
                raise KeyError([*fields])
            of_it = np.array([one == population for one in whose], bool)
            return numbers(name, self.columns()[name])[of_it]
        if name in self.columns():
            return numbers(name, self.columns()[name])
        owners = [n for n in tables if name in self.model.shape.populations[n].fields]
        if len(owners) == 1:
            return numbers(name, getattr(tables[owners[0]], name))
        raise KeyError([*self.columns()])


def numbers(name: str, values: Any) -> NDArray[Any]:
    """Return a column as an array of numbers; where there is no value it is NaN.

    Raises:
        TypeError: texts are in it.
    """
    if isinstance(values, np.ma.MaskedArray):
        values = np.ma.filled(values.astype(np.float64), np.nan)
    array = np.asarray(values)
    if array.dtype.kind in "bif":
        return array
    if array.dtype.kind == "u":
        return array.astype(np.int64)
    try:
        return np.array([np.nan if one is None else one for one in values], np.float64)
    except (TypeError, ValueError):
        raise TypeError(f"{name} holds texts, expected numbers") from None


def measure_called(name: str, said: Any) -> AMeasure:
    """Return a measure.

    Args:
        name: its name, which a column of the table gets.
        said: an expression, `FILE.py:FUNCTION`, or a function.

    Raises:
        SocialmindError: it is none.
    """
    if not name.isprintable() or not name.strip():
        raise SocialmindError(f"a measure called {shown(name)}; expected a name")
    if callable(said):
        one = Function(name, said)
        one.takes  # noqa: B018  # which refuses what it cannot take
        return one
    if not isinstance(said, str):
        raise SocialmindError(f"measure {name}: found {shown(said)}; expected an expression")
    file, colon, function = said.rpartition(":")
    if colon and file.endswith(".py"):
        return _of_file(name, Path(file), function)
    return Expression(name, said)


def _of_file(name: str, path: Path, function: str) -> Function:
    path = path.expanduser().absolute()
    if not path.is_file():
        raise SocialmindError(f"measure {name}: {path}: no such file")
    module = load_file(path, alone=True)
    found = getattr(module, function, None)
    if not inspect.isfunction(found):
        there = [n for n, one in vars(module).items() if inspect.isfunction(one)]
        raise SocialmindError(
            f"measure {name}: {path} has no function {function!r}; {nearest(function, there)}"
        )
    one = Function(name, found, f"{path}:{function}")
    one.takes  # noqa: B018  # likewise
    return one


def read_measures(texts: Sequence[str]) -> dict[str, str]:
    """Return measures of the command line, `NAME=EXPRESSION` each, by their names.

    Raises:
        SocialmindError: a name stands twice, or there is none.
    """
    found: dict[str, str] = {}
    for text in texts:
        name, equals, said = (part.strip() for part in text.partition("="))
        if not equals or not name or not said or not name.replace("_", "a").isalnum():
            raise SocialmindError(f"--measure {text}: expected NAME=EXPRESSION")
        if name in found:
            raise SocialmindError(f"--measure {name}: stands twice; give each its own name")
        found[name] = said
    return found


def record_of(measure: AMeasure) -> dict[str, str]:
    """Return what a manifest says of a measure."""
    if isinstance(measure, Expression):
        return {"expression": measure.text}
    if not measure.file:
        return {"function": measure.function.__qualname__}
    path = Path(measure.file.rpartition(":")[0])
    return {"file": measure.file, "sha256": digest(path.read_bytes())}


def of_records(
    records: Mapping[str, Mapping[str, str]], given: Mapping[str, Any], where: str, trust: bool
) -> dict[str, AMeasure]:
    """Return the measures that a manifest tells of.

    Args:
        records: by name.
        given: functions in place of those that stand in no file.
        where: the sweep's folder, for errors.
        trust: run programs that this user has neither named nor run before.

    Raises:
        SocialmindError: a function is missing, or its file was changed since.
    """
    found: dict[str, AMeasure] = {}
    for name, record in records.items():
        if name in given:
            found[name] = measure_called(name, given[name])
        elif "expression" in record:
            found[name] = Expression(name, record["expression"])
        elif "file" in record:
            file, _, function = record["file"].rpartition(":")
            path = Path(file)
            if not path.is_file() or digest(path.read_bytes()) != record["sha256"]:
                raise SocialmindError(
                    f"{where}: {file}, of the measure {name}, is not the file that the sweep was "
                    "begun with; put the old one back"
                )
            require({file: path.read_bytes()}, trust, f"{where}: the measure {name}")
            found[name] = _of_file(name, path, function)
        else:
            raise SocialmindError(
                f"{where}: the measure {name} is the function {record['function']} of Python; "
                f"give it again: measures={{{name!r}: …}}"
            )
    return found
