"""What any design tells: a straight line, a monotone one, and how much of the output they hold."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from socialmind.experiments.sensitivity.resampling import library, with_intervals
from socialmind.experiments.sensitivity.variance import Rows

SRC, RANK, PARTIAL_RANK = "src", "rank_correlation", "partial_rank_correlation"
R_SQUARED, RANK_R_SQUARED = "r_squared", "rank_r_squared"
RATIO = "correlation_ratio"
_SINGULAR = 1e-9


@dataclass(frozen=True)
class Regressors:
    """The columns of a design, as far as lines can be drawn through them.

    Attributes:
        numbers: names of columns of numbers.
        texts: names of columns whose values have no order: schemes, minds, words.
        matrix: (points, columns) of `numbers`, then 0 or 1 for each value of `texts` but the first.
        groups: for each of `texts`, the number of its value at each point.
        notes: what was left out, and why.
    """

    numbers: tuple[str, ...]
    texts: tuple[str, ...]
    matrix: NDArray[np.float64]
    groups: tuple[NDArray[np.int64], ...]
    notes: tuple[str, ...]


def regressors(points: pd.DataFrame) -> Regressors:
    """Return the columns of a design as a regression takes them.

    Left out is what has one value, and what follows from the columns before it.
    """
    notes: list[str] = []
    numbers: list[str] = []
    texts: list[str] = []
    groups: list[NDArray[np.int64]] = []
    columns: list[NDArray[np.float64]] = []
    dummies: list[NDArray[np.float64]] = []
    names = [str(name) for name in points.columns]
    for name in sorted(names, key=lambda name: not _is_number(points, name)):
        column = points[name]
        if column.nunique() < 2:
            notes.append(f"{name} is {column.iloc[0]} at all points: nothing is known of it.")
        elif _is_number(points, name):
            values = column.to_numpy(np.float64)
            if _follows(values, columns):
                others = ", ".join(numbers)
                notes.append(f"{name} follows from {others} in this design: left out.")
                continue
            numbers.append(name)
            columns.append(values)
        else:
            codes, values_of = pd.factorize(column)
            texts.append(name)
            groups.append(codes.astype(np.int64))
            for code in range(1, len(values_of)):
                dummy = (codes == code).astype(np.float64)
                if not _follows(dummy, [*columns, *dummies]):
                    dummies.append(dummy)
    if texts:
        notes.append(
            f"{', '.join(texts)}: names have no order, so no line leads through them. The others' "
            "coefficients allow for them; the correlation ratio is the share of the variance that "
            "lies between the names."
        )
    rows = len(points)
    matrix = np.column_stack([*columns, *dummies]) if columns or dummies else np.empty((rows, 0))
    return Regressors(tuple(numbers), tuple(texts), matrix, tuple(groups), tuple(notes))


def _is_number(points: pd.DataFrame, name: str) -> bool:
    return bool(pd.api.types.is_numeric_dtype(points[name].dtype))


def correlated(found: Regressors) -> str:
    """Return the two columns of numbers that go together most, in words; empty below 0.3."""
    count = len(found.numbers)
    if count < 2:
        return ""
    between = np.abs(np.corrcoef(found.matrix[:, :count].T)) - np.eye(count)
    one, other = np.unravel_index(int(between.argmax()), between.shape)
    if between[one, other] < 0.3:
        return ""
    return (
        f"{found.numbers[one]} and {found.numbers[other]} go together in this design (correlation "
        f"{between[one, other]:.2f}): what is whose can be told less well."
    )


def regression_indices(
    means: NDArray[np.float64], found: Regressors, level: float, seed: int
) -> Rows:
    """Return coefficients, correlations and what they hold.

    Args:
        means: of each point.
        found: the columns.
        level: of the intervals.
        seed: of the draws.
    """
    rankdata = library("scipy.stats").rankdata
    matrix, count = found.matrix, len(found.numbers)

    def of_points(points: NDArray[np.int64]) -> NDArray[np.float64]:
        x, y = matrix[points], means[points]
        line, _, held = _line(x, y)
        ranks, rank_of_y = rankdata(x, axis=0), rankdata(y)
        _, partial, rank_held = _line(ranks, rank_of_y)
        rank = _correlations(ranks[:, :count], rank_of_y)
        ratios = [_between(codes[points], y) for codes in found.groups]
        lines = [*line[:count], *rank, *partial[:count], held, rank_held]
        return np.array([*(lines if count else ()), *ratios])

    def statistic(drawn: NDArray[np.int64]) -> NDArray[np.float64]:
        return np.stack([of_points(points) for points in drawn.T], axis=1)

    numbers = with_intervals(statistic, len(means), level, seed)
    labels = [
        *((index, name) for index in (SRC, RANK, PARTIAL_RANK) for name in found.numbers),
        *(((R_SQUARED, ""), (RANK_R_SQUARED, "")) if count else ()),
        *((RATIO, name) for name in found.texts),
    ]
    return [(index, name, "", one) for (index, name), one in zip(labels, numbers, strict=True)]


def _line(
    x: NDArray[np.float64], y: NDArray[np.float64]
) -> tuple[NDArray[np.float64], NDArray[np.float64], float]:
    """Return standardised coefficients, partial correlations and R²; NaN where there are none."""
    none = np.full(x.shape[1], np.nan)
    spread, spread_of_y = x.std(axis=0), y.std()
    if not (spread > 0).all() or not spread_of_y > 0 or len(x) <= x.shape[1] + 1:
        return none, none, np.nan
    z, target = (x - x.mean(axis=0)) / spread, (y - y.mean()) / spread_of_y
    u, s, v = np.linalg.svd(z, full_matrices=False)
    if not len(s) or s[-1] < _SINGULAR * s[0]:
        return none, none, np.nan
    inverse = (v.T / s) @ u.T
    line = inverse @ target
    rest = float(((target - z @ line) ** 2).sum())
    if rest < _SINGULAR**2 * len(y):  # the line holds all: what it does not need correlates with 0
        return line, np.where(np.abs(line) > _SINGULAR, np.sign(line), np.nan), 1.0
    partial = line / np.sqrt(line**2 + rest * (inverse**2).sum(axis=1))
    return line, partial, 1 - rest / len(y)


def _correlations(x: NDArray[np.float64], y: NDArray[np.float64]) -> NDArray[np.float64]:
    x, y = x - x.mean(axis=0), y - y.mean()
    with np.errstate(divide="ignore", invalid="ignore"):
        return (x.T @ y) / np.sqrt((x**2).sum(axis=0) * (y**2).sum())


def _between(groups: NDArray[np.int64], y: NDArray[np.float64]) -> float:
    """Return the share of the variance that lies between groups."""
    counts = np.bincount(groups)
    sums = np.bincount(groups, y - y.mean())
    known = counts > 0
    total = float(((y - y.mean()) ** 2).sum())
    return float((sums[known] ** 2 / counts[known]).sum()) / total if total > 0 else np.nan


def _follows(values: NDArray[np.float64], others: Sequence[NDArray[np.float64]]) -> bool:
    """Return whether a column is a sum of others and a constant."""
    if not others:
        return False
    known = np.column_stack([np.ones(len(values)), *((o - o.mean()) / o.std() for o in others)])
    target = (values - values.mean()) / values.std()
    rest = target - known @ np.linalg.lstsq(known, target, rcond=None)[0]
    return bool((rest**2).mean() < _SINGULAR**2)
