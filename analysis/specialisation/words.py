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


def side(row: Mapping[str, Any]) -> int:
    """Say on which side of 0 a difference is: 1 above, −1 below, 0 for neither.

    >>> side({"difference_low": 0.1, "difference_high": 0.3}), side({"difference_low": math.nan})
    (1, 0)
    """
    low, high = row.get("difference_low", math.nan), row.get("difference_high", math.nan)
    return 1 if low > 0 else -1 if high < 0 else 0


def one_of(table: pd.DataFrame, measure: str, **where: Any) -> dict[str, Any]:
    """The row of a measure; where several columns are given, that with these values."""
    found = table[table["measure"] == measure]
    for name, value in where.items():
        found = found[found[name] == value]
    return {str(name): value for name, value in found.iloc[0].items()}
