"""What is printed of a sweep's sensitivity: tables, and what its design can and cannot tell."""

from __future__ import annotations

import math
from collections.abc import Sequence

import pandas as pd

from socialmind.experiments.sensitivity import effects, regression, variance
from socialmind.experiments.sensitivity.indices import FAST, MORRIS, REGRESSION, SOBOL, Sensitivity
from socialmind.text_table import aligned

TITLES = {
    variance.FIRST: "first order",
    variance.TOTAL: "total order",
    variance.SECOND: "second order",
    effects.MU_STAR: "mu*",
    effects.MU: "mu",
    effects.SIGMA: "sigma",
    regression.SRC: "regression",
    regression.RANK: "rank correlation",
    regression.PARTIAL_RANK: "partial rank correlation",
    regression.RATIO: "correlation ratio",
}
COLUMNS = {
    SOBOL: (variance.FIRST, variance.TOTAL),
    FAST: (variance.FIRST, variance.TOTAL),
    MORRIS: (effects.MU_STAR, effects.MU, effects.SIGMA),
    REGRESSION: (regression.SRC, regression.PARTIAL_RANK, regression.RANK),
}
"""The indices of a method that stand side by side."""
TELLS = {
    SOBOL: "Sobol indices share out the variance of an output: the first order is what a parameter "
    "does by itself, the total order adds all its interactions. They hold for parameters that vary "
    "independently and evenly over these ranges; with other ranges the shares are others.",
    FAST: "FAST shares out the variance of an output as Sobol indices do, without pairs, for "
    "parameters that vary independently and evenly over these ranges; its intervals are indicative "
    "alone, and the indices themselves are off by some hundredths.",
    MORRIS: "Morris's design screens: mu* says how far an output moves over a parameter's range, "
    "and a sigma beside it that this depends on where and on other parameters, but not what share "
    "of the variance is whose; that is for saltelli, with the parameters that count.",
    REGRESSION: "Coefficients tell of a straight line and rank correlations of what only rises or "
    "only falls: an effect that turns back, or hangs on another parameter, can hide from both, and "
    "R² says how much is left over; that is for saltelli.",
}
"""What a design can tell, and what it cannot."""


def report(found: Sensitivity) -> list[str]:
    """Return the sensitivity of all outputs as lines of text."""
    lines: list[str] = []
    for output in found.outputs:
        lines += [*_heading(found, output), *_indices(found, output), ""]
    lines.append(TELLS[found.method])
    if found.ranges:
        ranges = (f"{name} {low:g} … {high:g}" for name, (low, high) in found.ranges.items())
        lines.append(f"Ranges: {', '.join(ranges)}.")
    return [*lines, *found.notes]


def _heading(found: Sensitivity, output: str) -> list[str]:
    luck = found.luck[found.luck["output"] == output].iloc[0]
    lines = [
        f"{output}: {luck['points']:,} points ({found.design}), {luck['runs']:,} runs, mean "
        f"{luck['mean']:.4g}, deviation of the points {luck['deviation']:.3g}"
    ]
    if math.isfinite(luck["luck_of_a_run"]):
        bounds = f"{_percent(luck['luck_of_a_run_low'])} … {_percent(luck['luck_of_a_run_high'])}"
        lines.append(
            f"luck: {_percent(luck['luck_of_a_run'])} of the variance of single runs ({bounds}), "
            f"{_percent(luck['luck_of_means'])} of that of the points' means"
        )
    if math.isfinite(luck["floor"]):
        index = "mu*" if found.method == MORRIS else "total order"
        lines.append(f"a parameter without effect has a {index} of {luck['floor']:.3g} by luck")
    if found.method == REGRESSION:
        straight = found.of(output, regression.R_SQUARED)
        monotone = found.of(output, regression.RANK_R_SQUARED)
        if len(straight):
            both = _cell(straight.iloc[0]), _cell(monotone.iloc[0])
            lines.append(f"R² of the line {both[0]}, of the ranks {both[1]}")
    return lines


def _indices(found: Sensitivity, output: str) -> list[str]:
    names = found.ordered(output)
    columns = [(TITLES[one], found.of(output, one)) for one in COLUMNS[found.method]]
    digits = 2
    if found.method == MORRIS:
        digits = _digits(max(rows["value"].abs().max() for _, rows in columns))
    lines = _table("parameter", names, columns, digits) if names else []
    ratios = found.of(output, regression.RATIO)
    if len(ratios):
        named = ratios["parameter"].tolist()
        lines += _table("names", named, [(TITLES[regression.RATIO], ratios)], digits)
    pairs = found.of(output, variance.SECOND)
    if len(pairs):
        sure = pairs[pairs["low"] > 0].sort_values("value", ascending=False, kind="stable")
        told = [f"{row['parameter']} × {row['other']} {_cell(row)}" for _, row in sure.iterrows()]
        lines.append(
            f"second order, of {len(pairs)} pair{'s' * (len(pairs) > 1)}, with an interval above "
            f"0: {'; '.join(told) or 'none'}"
        )
    return lines


def _table(
    head: str, names: Sequence[str], columns: Sequence[tuple[str, pd.DataFrame]], digits: int
) -> list[str]:
    cells = [
        {row["parameter"]: _cell(row, digits) for _, row in rows.iterrows()} for _, rows in columns
    ]
    first = (head, *(title for title, _ in columns))
    return aligned([first, *((name, *(one[name] for one in cells)) for name in names)])


def _cell(row: pd.Series, digits: int = 2) -> str:
    value, low, high = (round(float(row[name]), digits) + 0.0 for name in ("value", "low", "high"))
    if not math.isfinite(value):
        return "–"
    if not math.isfinite(low):
        return f"{value:.{digits}f}"
    return f"{value:.{digits}f} ({low:.{digits}f} … {high:.{digits}f})"


def _digits(size: float) -> int:
    """Return how many digits after the point show three of a number of a size.

    >>> _digits(0.5), _digits(42.0), _digits(1234.0), _digits(0.0012)
    (3, 1, 0, 5)
    """
    return min(max(2 - math.floor(math.log10(size)), 0), 12) if size > 0 else 2


def _percent(share: float) -> str:
    return f"{100 * share:.0f} %"
