"""What runs come to at the points of a design: a middle with an interval, over replicates."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from socialmind.errors import SocialmindError, nearest
from socialmind.experiments.measures.effects import compared
from socialmind.experiments.measures.intervals import (
    FEW,
    LEVEL,
    Interval,
    are_shares,
    interval_of,
    share_interval,
)
from socialmind.experiments.sweeps.columns import SEED

MEAN, MEDIAN = "mean", "median"
STATISTICS = (MEAN, MEDIAN)


@dataclass(frozen=True)
class Summary:
    """How the replicates at a point are summed up.

    Attributes:
        statistic: `mean`, with the interval of the mean by the bootstrap, or that of a share where
            the outcome is 0 or 1; or `median`, with the quantiles between which that share of the
            runs lies.
        level: of the interval, above 0 and below 1.

    Raises:
        SocialmindError: another statistic, or a level that is none.
    """

    statistic: str = MEAN
    level: float = LEVEL

    def __post_init__(self) -> None:
        if self.statistic not in STATISTICS:
            expected = f"expected {' or '.join(STATISTICS)}"
            raise SocialmindError(f"statistic: found {self.statistic!r}; {expected}")
        if not 0 < self.level < 1:
            raise SocialmindError(
                f"interval: found {self.level:g}; expected above 0 and below 1, as 0.95"
            )

    def of(self, values: NDArray[np.float64], shares: bool = False) -> Interval:
        """Return the middle of some numbers and its interval; NaN bounds for a single one.

        Args:
            values: (n,) numbers.
            shares: whether they are of an outcome that is 0 or 1 in each run.

        >>> Summary("median", 0.5).of(np.array([1.0, 2.0, 3.0, 4.0, 5.0]))
        Interval(mean=3.0, low=2.0, high=4.0)
        """
        if not len(values):
            return Interval(math.nan, math.nan, math.nan)
        if self.statistic == MEAN:
            found = share_interval if shares and len(values) > 1 else interval_of
            return found(values, self.level)
        if len(values) < 2:
            return Interval(float(values[0]), math.nan, math.nan)
        tail = (1 - self.level) / 2
        low, middle, high = np.quantile(values, (tail, 0.5, 1 - tail)).tolist()
        return Interval(middle, low, high)


@dataclass(frozen=True)
class Estimates:
    """An outcome at the points of a design.

    Attributes:
        table: a row for each combination of the columns `by`, in order of their first appearance:
            these, `runs` (with a value), `middle`, `low` and `high`; bounds are NaN where a point
            has one run.
        by: the columns that tell points apart.
        of: the outcome.
        summary: how replicates were summed up.
        without: runs that have no value of the outcome.
        shares: whether the outcome is 0 or 1 in each run, so that means are shares of the runs.
    """

    table: pd.DataFrame
    by: tuple[str, ...]
    of: str
    summary: Summary
    without: int = 0
    shares: bool = False

    @property
    def said(self) -> str:
        """What a caption says of how replicates were summed up.

        >>> runs = pd.DataFrame({"sold": [3.0, 4.0, 8.0]})
        >>> estimates(runs, [], "sold").said
        "means, 95 % intervals by Student's t"
        """
        share = f"{100 * self.summary.level:g} %"
        if self.summary.statistic == MEDIAN:
            return f"medians, quantiles that hold {share} of the runs"
        if self.shares:
            return f"shares of the runs, {share} score intervals"
        few = self.table["runs"] < FEW
        if few.all():
            return f"means, {share} intervals by Student's t"
        student = f" (Student's t of fewer than {FEW} runs)" if few.any() else ""
        return f"means, {share} bootstrap intervals{student}"

    @property
    def has_intervals(self) -> bool:
        """Whether any point has one."""
        return bool(self.table["low"].notna().any())

    def where(self, **values: Any) -> Estimates:
        """Return those of some values of columns."""
        return self.only(values)

    def only(self, values: Mapping[str, Any]) -> Estimates:
        """Return those of some values of columns, by name."""
        table = self.table
        for name, value in values.items():
            table = table[table[name] == value]
        return replace(self, table=table)


def estimates(
    runs: pd.DataFrame, by: Sequence[str], of: str, summary: Summary | None = None
) -> Estimates:
    """Return an outcome at each point, with its interval over replicates.

    Args:
        runs: a row a run, as `Sweep.runs`, or a run and tick; what did not finish has no value.
        by: the columns that tell points apart: what varies, or that and `tick`. None at all for one
            point.
        of: the outcome, a column of numbers.
        summary: how replicates are summed up; means with 95 % intervals by default.

    Raises:
        SocialmindError: no such column, or it holds no numbers.

    >>> runs = pd.DataFrame({"price": [1.0, 1.0, 2.0, 2.0], "sold": [3.0, 3.0, 4.0, 8.0]})
    >>> estimates(runs, ["price"], "sold").table[["price", "runs", "middle"]].values.tolist()
    [[1.0, 2.0, 3.0], [2.0, 2.0, 6.0]]
    """
    how = summary or Summary()
    values = numbers_of(runs, of)
    for name in by:
        if name not in runs.columns:
            raise SocialmindError(
                f"no column {name!r} of what varies; {nearest(name, map(str, runs))}"
            )
    known = np.isfinite(values)
    own = runs.loc[known, list(by)].assign(**{"": values[known]})
    rows = []
    shares = are_shares(values[known])
    groups = own.groupby(list(by), sort=False, dropna=False) if by else [((), own)]
    for key, group in groups:
        found = how.of(group[""].to_numpy(np.float64), shares)
        point = dict(zip(by, key, strict=True))
        rows.append(
            {**point, "runs": len(group), "middle": found.mean, "low": found.low,
             "high": found.high}
        )  # fmt: skip
    table = pd.DataFrame(rows, columns=[*by, "runs", "middle", "low", "high"])
    return Estimates(table, tuple(by), of, how, int((~known).sum()), shares)


@dataclass(frozen=True)
class Effects:
    """How far an outcome is from that of a baseline, at the other points of a design.

    Attributes:
        table: a row a point: what varies, `runs`, `difference`, `low` and `high`, and `paired`,
            whether the difference is of pairs of runs with the same seed.
        by: what varies.
        of: the outcome.
        baseline: the values of the baseline.
        level: of the intervals.
    """

    table: pd.DataFrame
    by: tuple[str, ...]
    of: str
    baseline: Mapping[str, Any]
    level: float

    @property
    def said(self) -> str:
        """What a caption says of them."""
        pairs = set(self.table["paired"])
        how = {(True,): "in pairs of equal seeds", (False,): "of all runs"}.get(
            tuple(pairs), "in pairs of equal seeds where there are some"
        )
        return f"differences of means {how}, {100 * self.level:g} % intervals"


def effects(
    runs: pd.DataFrame,
    by: Sequence[str],
    of: str,
    baseline: Mapping[str, Any],
    level: float = LEVEL,
) -> Effects:
    """Return how far the mean of an outcome is from that of a baseline, point by point.

    Where runs of both points have the same seeds, as with `--common`, the difference is of these
    pairs: what a seed does to both falls away. Else it is of the means of all runs, with the
    interval that `measures.effects.compared` makes of both intervals.

    Args:
        runs: a row a run, as `Sweep.runs`.
        by: what varies.
        of: the outcome, a column of numbers.
        baseline: its value of each column that varies.
        level: of the intervals.

    Raises:
        SocialmindError: no run at the baseline has a value.

    >>> runs = pd.DataFrame({"price": [1, 1, 2, 2], "seed": [5, 6, 6, 5],
    ...                      "sold": [3.0, 4.0, 9.0, 5.0]})
    >>> effects(runs, ["price"], "sold", {"price": 1}).table[["price", "difference", "paired"]]
       price  difference  paired
    0      2         3.5    True
    """
    values = numbers_of(runs, of)
    own = runs.assign(**{"": values})[np.isfinite(values)]
    at_baseline = np.logical_and.reduce([own[name] == baseline[name] for name in by])
    reference = own[at_baseline]
    if reference.empty:
        raise SocialmindError(f"no run with a value of {of} at the baseline {told(baseline)}")
    rows = []
    for key, group in own[~at_baseline].groupby(list(by), sort=False, dropna=False):
        away, paired = difference(group, reference, "", level)
        rows.append(
            {**dict(zip(by, key, strict=True)), "runs": len(group), "difference": away.mean,
             "low": away.low, "high": away.high, "paired": paired}
        )  # fmt: skip
    names = [*by, "runs", "difference", "low", "high", "paired"]
    return Effects(pd.DataFrame(rows, columns=names), tuple(by), of, dict(baseline), level)


def difference(
    runs: pd.DataFrame, reference: pd.DataFrame, of: str, level: float = LEVEL
) -> tuple[Interval, bool]:
    """Return how far the mean of some runs is from that of others, and whether pairs were taken.

    They are where half of the larger group or more have a partner of the same seed: runs that
    failed have none. A few seeds that both happen to have would say little.

    Args:
        runs: with their `seed` and a column of the outcome, finite.
        reference: likewise.
        of: the outcome.
        level: of the interval.
    """
    pairs = runs.merge(reference, on=SEED, suffixes=("", " reference"))
    once = not (runs[SEED].duplicated().any() or reference[SEED].duplicated().any())
    paired = once and 2 * len(pairs) >= max(len(runs), len(reference))
    if paired:
        own, other = pairs[of].to_numpy(float), pairs[f"{of} reference"].to_numpy(float)
    else:
        own, other = runs[of].to_numpy(float), reference[of].to_numpy(float)
    if min(len(own), len(other)) < 2:
        return Interval(float(own.mean() - other.mean()), math.nan, math.nan), paired
    return compared(own, other, paired, level).difference, paired


def numbers_of(runs: pd.DataFrame, of: str) -> NDArray[np.float64]:
    """Return an outcome of runs as numbers, NaN for none.

    Raises:
        SocialmindError: no such column, or it holds no numbers.
    """
    if of not in runs.columns:
        raise SocialmindError(
            f"no measure or end of a series called {of!r}; {nearest(of, map(str, runs))}"
        )
    column = runs[of]
    if not pd.api.types.is_numeric_dtype(column) and column.notna().any():
        raise SocialmindError(f"{of} holds {column.dropna().iloc[0]!r}; expected numbers")
    return column.to_numpy(np.float64, na_value=np.nan)


def told(values: Mapping[str, Any]) -> str:
    """Return values by name as a line says them."""
    return ", ".join(f"{name} = {value}" for name, value in values.items())
