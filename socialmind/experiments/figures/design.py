"""What a design calls for: what varies, whether all combinations are there, where it begins."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import pandas as pd

from socialmind.errors import SocialmindError, nearest
from socialmind.experiments.figures.estimates import told

MOST_CROSSED = 4
"""So many columns fit into one figure: along the axis, as lines, as columns and rows of panels."""


@dataclass(frozen=True)
class Varying:
    """A column of a design that takes more than one value.

    Attributes:
        name: of the column.
        values: each once; numbers in order, others as they first appear.
        numeric: whether they are numbers, which truth values are not.
    """

    name: str
    values: tuple[Any, ...]
    numeric: bool

    @property
    def logarithmic(self) -> bool:
        """Whether the values lie more evenly on a scale of ratios than on one of differences.

        >>> Varying("a", (0.25, 0.5, 1.0, 4.0), True).logarithmic
        True
        >>> Varying("a", (0.0, 1.0, 2.0), True).logarithmic
        False
        """
        if not self.numeric or len(self.values) < 3 or self.values[0] <= 0:
            return False
        values = np.array(self.values, float)
        if values[-1] < 8 * values[0]:
            return False
        steps = [np.diff(one) for one in (np.log(values), values)]
        return bool(np.std(steps[0]) / np.mean(steps[0]) < np.std(steps[1]) / np.mean(steps[1]))


@dataclass(frozen=True)
class Design:
    """What varies in a design.

    Attributes:
        points: a row a point.
        columns: what varies, those first that ask for the longest axis: numbers before names, many
            values before few.
        crossed: whether each combination of their values is a point, and they are few enough for
            one figure.
    """

    points: pd.DataFrame
    columns: tuple[Varying, ...]
    crossed: bool

    @property
    def names(self) -> list[str]:
        """The columns that vary, in the order of the table."""
        there = {one.name for one in self.columns}
        return [name for name in self.points.columns if name in there]


def design_of(points: pd.DataFrame, varied: Sequence[str]) -> Design:
    """Return what varies in a design.

    Args:
        points: a row a point, as `Sweep.design`.
        varied: its columns that may vary.

    >>> table = pd.DataFrame({"n": [1, 2, 1, 2], "kind": ["a", "a", "b", "b"], "x": [3] * 4})
    >>> found = design_of(table, ["kind", "n", "x"])
    >>> [one.name for one in found.columns], found.crossed
    (['n', 'kind'], True)
    """
    columns = []
    for name in varied:
        own = points[name]
        numeric = pd.api.types.is_numeric_dtype(own) and not pd.api.types.is_bool_dtype(own)
        values = own.drop_duplicates().tolist()
        if len(values) > 1:
            columns.append(Varying(name, tuple(sorted(values) if numeric else values), numeric))
    columns.sort(key=lambda one: (not one.numeric, -len(one.values)))
    combinations = math.prod(len(one.values) for one in columns)
    different = len(points[[one.name for one in columns]].drop_duplicates()) if columns else 1
    crossed = len(columns) <= MOST_CROSSED and different == combinations
    return Design(points, tuple(columns), crossed)


def baseline_of(
    design: Design, given: Mapping[str, Any], defaults: Mapping[str, Any]
) -> dict[str, Any] | None:
    """Return the point that others are compared with.

    Args:
        design: the design.
        given: values of some columns, as text or as they are.
        defaults: those of the model, as far as they are known.

    Returns:
        Its value of each column that varies: the first point that has what is given, and else
        the model's defaults, as far as the design has them. None where one point is all.

    Raises:
        SocialmindError: an unknown column, or no such point.
    """
    names = design.names
    if len(design.points) < 2 or not names:
        return None
    rows = design.points
    for name, value in given.items():
        if name not in names:
            raise SocialmindError(f"baseline: {name} does not vary; {nearest(name, names)}")
        rows = rows[[_is(one, value) for one in rows[name]]]
        if rows.empty:
            there = ", ".join(map(str, dict.fromkeys(design.points[name])))
            raise SocialmindError(
                f"baseline: no point with {told(given)}; values of {name}: {there}"
            )
    for name in names:
        if name in defaults and name not in given:
            usual = rows[[_is(one, defaults[name]) for one in rows[name]]]
            rows = rows if usual.empty else usual
    return {name: rows[name].tolist()[0] for name in names}


def _is(value: Any, other: Any) -> bool:
    """Whether a value of a design is another, which may be text."""
    if isinstance(other, str) and not isinstance(value, str):
        try:
            return bool(float(value) == float(other))
        except ValueError:
            return str(value).lower() == other.lower()
    return bool(value == other)
