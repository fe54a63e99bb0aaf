"""The series of groups of runs side by side, and how they differ, with intervals."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from socialmind.errors import SocialmindError, nearest
from socialmind.experiments.measures.effects import compared
from socialmind.experiments.measures.intervals import LEVEL, Interval
from socialmind.runs.result import Run

MOMENTS = 200
"""So many ticks at most get intervals, evenly spread, the last among them."""


@dataclass(frozen=True)
class Futures:
    """Groups of runs side by side.

    Attributes:
        table: a row for each column of the series, group and tick: `column`, `group`, `tick`,
            `runs`, `mean`, `low`, `high`, and of the difference from the reference `difference`,
            `difference_low`, `difference_high`; bounds are NaN where a group is one run.
        groups: their names, the reference first.
        columns: the compared columns of the series.
        paired: whether differences are of pairs of runs with the same seed.
        branched: the tick at which the others left the reference, if they are branches of it.
    """

    table: pd.DataFrame
    groups: tuple[str, ...]
    columns: tuple[str, ...]
    paired: bool
    branched: int | None

    def of(self, column: str, group: str) -> pd.DataFrame:
        """Return the rows of one column and group, by tick."""
        table = self.table
        return table[(table["column"] == column) & (table["group"] == group)]


def futures(
    groups: Mapping[str, Sequence[Run]],
    columns: Sequence[str] | None = None,
    level: float = LEVEL,
) -> Futures:
    """Compare the series of groups of runs with those of the first group.

    At each tick that all recorded: the mean of a group with its interval, and the difference of the
    means with its own, as `compared` has them. Where two groups have the same seeds, each once,
    the differences are of pairs.

    Args:
        groups: the runs of each, by its name; the first is the reference.
        columns: of the series; all that hold numbers in every run by default.
        level: of the intervals.

    Raises:
        SocialmindError: fewer than two groups, no such column, or no tick that all recorded.
    """
    if len(groups) < 2 or not all(groups.values()):
        raise SocialmindError("two groups of runs to compare, with a run each at least")
    runs = [one for several in groups.values() for one in several]
    names = _columns(runs, columns)
    ticks = _ticks(runs, len(runs) > len(groups))
    values = {
        group: {name: np.stack([_at(one, name, ticks) for one in several]) for name in names}
        for group, several in groups.items()
    }
    first, *others = groups
    pairs = {one: _pairs(groups[one], groups[first]) for one in others}
    parts = []
    for name in names:
        parts.append(_rows(name, first, ticks, values[first][name], None, None, level))
        for one in others:
            both = values[one][name], values[first][name]
            parts.append(_rows(name, one, ticks, *both, pairs[one], level))
    return Futures(
        pd.concat(parts, ignore_index=True),
        tuple(groups),
        tuple(names),
        all(order is not None for order in pairs.values()),
        _branched(groups, first),
    )


def named(folders: Sequence[Path], against: Sequence[Path] = ()) -> dict[str, list[Run]]:
    """Return the groups that folders stand for.

    Args:
        folders: of runs. Without others to compare with, each is a group, the first the reference.
        against: the folders of the reference, if that is a group.
    """
    if against:
        names = _group_name(against), _group_name(folders)
        if names[0] == names[1]:
            names = f"{names[0]} (against)", names[1]
        groups = [[Run(one) for one in several] for several in (against, folders)]
        return dict(zip(names, groups, strict=True))
    short = [one.absolute().name for one in folders]
    full = short if len(set(short)) == len(short) else [str(one) for one in folders]
    return {name: [Run(one)] for name, one in zip(full, folders, strict=True)}


def _group_name(folders: Sequence[Path]) -> str:
    first = folders[0].absolute().name
    return first if len(folders) == 1 else f"{first} and {len(folders) - 1} more"


def _columns(runs: Sequence[Run], wanted: Sequence[str] | None) -> list[str]:
    """Return the columns to compare: in the order of the first run, or as they are asked for."""
    there = [
        name
        for name in runs[0].series.columns
        if name != "tick" and all(_is_number(one.series, name) for one in runs)
    ]
    for name in wanted or ():
        if name not in there:
            raise SocialmindError(
                f"no column {name!r} of numbers in the series of all runs; {nearest(name, there)}"
            )
    if not there:
        raise SocialmindError("no column of numbers in the series of all runs; nothing to compare")
    return list(wanted or there)


def _is_number(series: pd.DataFrame, name: str) -> bool:
    if name not in series.columns:
        return False
    kind = series[name].dtype
    return pd.api.types.is_numeric_dtype(kind) or bool(series[name].isna().all())


def _ticks(runs: Sequence[Run], thinned: bool) -> NDArray[np.int64]:
    """Return the ticks that all runs recorded; some of them, spread evenly, where asked."""
    ticks = np.asarray(runs[0].series["tick"])
    for one in runs[1:]:
        ticks = np.intersect1d(ticks, np.asarray(one.series["tick"]))
    if not len(ticks):
        raise SocialmindError("no tick that all runs recorded; run them with the same --every")
    if thinned and len(ticks) > MOMENTS:
        ticks = ticks[np.linspace(0, len(ticks) - 1, MOMENTS).round().astype(int)]
    return ticks


def _at(run: Run, name: str, ticks: NDArray[np.int64]) -> NDArray[np.float64]:
    series = run.series
    places = np.searchsorted(series["tick"].to_numpy(), ticks)
    return series[name].to_numpy(np.float64, na_value=np.nan)[places]


def _pairs(first: Sequence[Run], second: Sequence[Run]) -> list[int] | None:
    """Return which run of a second group has the seed of each of the first; None for no pairs."""
    seeds, others = [one.seed for one in first], [one.seed for one in second]
    if len(set(seeds)) < len(seeds) or sorted(seeds) != sorted(others):
        return None
    return [others.index(seed) for seed in seeds]


def _rows(
    name: str,
    group: str,
    ticks: NDArray[np.int64],
    values: NDArray[np.float64],
    reference: NDArray[np.float64] | None,
    pairs: list[int] | None,
    level: float,
) -> pd.DataFrame:
    """Return the rows of a column and group; without a reference it is the reference."""
    other = values if reference is None else reference
    if pairs is not None:
        other = other[pairs]
    found = [
        _compared(values[:, place], other[:, place], reference is None or pairs is not None, level)
        for place in range(len(ticks))
    ]
    own = np.array([(one.mean, one.low, one.high) for one, _ in found])
    apart = np.array([(one.mean, one.low, one.high) for _, one in found])
    return pd.DataFrame(
        {
            "column": name, "group": group, "tick": ticks, "runs": len(values),
            "mean": own[:, 0], "low": own[:, 1], "high": own[:, 2],
            "difference": apart[:, 0], "difference_low": apart[:, 1],
            "difference_high": apart[:, 2],
        }
    )  # fmt: skip


def _compared(
    values: NDArray[np.float64], other: NDArray[np.float64], paired: bool, level: float
) -> tuple[Interval, Interval]:
    """Return the mean of runs at a tick and its difference from others, with their intervals."""
    mean, away = float(values.mean()), float(values.mean() - other.mean())
    enough = min(len(values), len(other)) > 1
    if not enough or not (np.isfinite(values).all() and np.isfinite(other).all()):
        return Interval(mean, math.nan, math.nan), Interval(away, math.nan, math.nan)
    found = compared(values, other, paired, level)
    return found.first, found.difference


def _branched(groups: Mapping[str, Sequence[Run]], first: str) -> int | None:
    """Return the first tick at which a run left one of the reference."""
    known = {one.manifest.identity() for one in groups[first]}
    ticks = [
        one.manifest.branch["tick"]
        for name, several in groups.items()
        for one in several
        if name != first and one.manifest.branch and one.manifest.branch["identity"] in known
    ]
    return min(ticks, default=None)
