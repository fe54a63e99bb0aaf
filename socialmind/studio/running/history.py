"""What the series of a live run were, at the ticks where somebody looked."""

from __future__ import annotations

import math
from typing import Any

POINTS = 4000
"""Rows kept at most; each second one goes when there are more."""


class History:
    """Rows of the series in the order of ticks, as many as a plot can show."""

    def __init__(self) -> None:
        self.rows: list[tuple[int, dict[str, Any]]] = []

    def note(self, tick: int, series: dict[str, Any]) -> dict[str, Any] | None:
        """Take a row, unless one of this tick or a later one is there.

        Returns:
            The row as a page has it, if it is new.
        """
        if self.rows and self.rows[-1][0] >= tick:
            return None
        row = {name: _number(value) for name, value in series.items() if name != "tick"}
        self.rows.append((tick, row))
        if len(self.rows) > POINTS:
            self.rows = self.rows[::2]
        return {"tick": tick, **row}

    def forget_after(self, tick: int) -> None:
        """Forget what was after a tick: it will be otherwise."""
        self.rows = [one for one in self.rows if one[0] <= tick]

    def columns(self) -> dict[str, list[Any]]:
        """Return all rows as columns, ``tick`` first."""
        names = list(self.rows[-1][1]) if self.rows else []
        columns: dict[str, list[Any]] = {"tick": [tick for tick, _ in self.rows]}
        return columns | {name: [row.get(name) for _, row in self.rows] for name in names}


def _number(value: Any) -> float | str | None:
    if value is None or isinstance(value, str):
        return value
    number = float(value)
    return number if math.isfinite(number) else None
