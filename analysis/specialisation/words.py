"""Numbers as a text has them, and the rows of tables that they come from."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

import pandas as pd


def number(value: float, digits: int = 2) -> str:
    """A number as a text has it.

    >>> number(-1234.5, 0), number(0.004), number(math.nan)
    ('−1,234', '0.00', 'unknown')
    """
    if math.isnan(value):
        return "unknown"
    if math.isinf(value):
        return "never"
    return f"{round(value, digits) + 0.0:,.{digits}f}".replace("-", "−")


def spread(row: Mapping[str, Any], digits: int = 2) -> str:
    """A mean with its interval.

    >>> spread({"mean": 0.5, "low": 0.4, "high": 0.62}), spread({"mean": 1, "low": 1, "high": 1})
    ('0.50 (0.40 to 0.62)', '1.00')
    """
    mean = number(row["mean"], digits)
    if not math.isfinite(row["low"]) or row["low"] == row["high"]:
        return mean
    return f"{mean} ({number(row['low'], digits)} to {number(row['high'], digits)})"


def capital(text: str) -> str:
    """The text with a capital letter at its beginning."""
    return text[:1].upper() + text[1:]


def percent(share: float) -> str:
    """A share as a text has it; halves, as of forty worlds, are not rounded.

    >>> percent(0.904), percent(0.825)
    ('90 %', '82.5 %')
    """
    if math.isnan(share):
        return "unknown"
    halves = round(200 * share, 6)
    return f"{100 * share:.1f} %" if halves % 2 == 1 else f"{round(100 * share)} %"


def shares(row: Mapping[str, Any]) -> str:
    """A mean share with its interval, as far as a share can be.

    >>> shares({"mean": 0.5, "low": 0.4, "high": 0.62}), shares({"mean": 1.0, "low": 1, "high": 1})
    ('50 % (40 % to 62 %)', '100 %')
    """
    low, high = float(row["low"]), float(row["high"])
    if not math.isfinite(low) or low == high:
        return percent(float(row["mean"]))
    ends = percent(max(low, 0.0)), percent(min(high, 1.0))
    return f"{percent(float(row['mean']))} ({ends[0]} to {ends[1]})"


def one_of(table: pd.DataFrame, measure: str, **where: Any) -> dict[str, Any]:
    """The row of a measure; where several columns are given, that with these values."""
    found = table[table["measure"] == measure]
    for name, value in where.items():
        found = found[found[name] == value]
    return {str(name): value for name, value in found.iloc[0].items()}
