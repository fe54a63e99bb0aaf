"""Bringing a mind up to date with the conditions of its scheme: one definition for both speeds.

The conditions of a scheme are rows of whole numbers, cogniton by cogniton, with what is compared
in a second array, left and right of the operator; whoever knows the agent fills it. Functions here
are ordinary Python, and numba compiles the same text.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np
from numba.extending import register_jitable

from coglogo_py.compiled.machine_code import kept, key_of_file
from coglogo_py.conditions.condition import OPERATORS, Condition

if TYPE_CHECKING:
    from coglogo_py.arrays import Floats, Ints
    from coglogo_py.parts import Scheme

COGNITON = 0
KIND = 1
OPERATOR = 2
LAST = 3
FIELD = 4
WIDTH = 5
"""Columns of the conditions: the cogniton, what they do, the operator's code, whether it is the
last of those that must all hold, and for whoever knows the agent which field it asks for."""

WHILE = 0
ACTIVATES = 1
DEACTIVATES = 2
"""What conditions do: active exactly while they hold, made active, made inactive. What makes
inactive is asked last, so that it wins."""
KINDS = ("active_while", "activated_when", "deactivated_when")


@register_jitable
def holds(operator: int, left: float, right: float) -> bool:
    """Say whether a comparison holds; with NaN, which stands for what is not there, none does."""
    if operator == 0:
        return left < right
    if operator == 1:
        return left <= right
    if operator == 2:
        return left > right
    if operator == 3:
        return left >= right
    if operator == 4:
        return left == right
    return left < right or left > right


@register_jitable
def heed(conditions: Ints, sides: Floats, values: Floats, mind: int) -> None:
    """Make cognitons of a mind active or inactive, as its conditions say.

    Args:
        conditions: (Q, WIDTH) those of the scheme.
        sides: (Q, 3) what each compares, and the value with which its cogniton becomes active.
        values: (minds, C) the minds' cognitons, NaN where inactive; written.
        mind: which of them.
    """
    all_hold = True
    for row in range(conditions.shape[0]):
        all_hold = all_hold and holds(conditions[row, OPERATOR], sides[row, 0], sides[row, 1])
        if conditions[row, LAST]:
            cogniton = conditions[row, COGNITON]
            kind = conditions[row, KIND]
            if kind == DEACTIVATES:
                if all_hold:
                    values[mind, cogniton] = np.nan
            elif all_hold:
                if math.isnan(values[mind, cogniton]):
                    values[mind, cogniton] = sides[row, 2]
            elif kind == WHILE:
                values[mind, cogniton] = np.nan
            all_hold = True


@kept(key_of_file("heeding", __file__))
def heed_each(
    conditions: Ints, sides: Floats, compared: Floats, values: Floats, minds: Ints
) -> None:
    """Let several minds heed conditions.

    Args:
        conditions: as of `heed`.
        sides: likewise; its left column is overwritten.
        compared: (Q, n) the left sides for each mind.
        values: as of `heed`.
        minds: (n,) which minds.
    """
    for k in range(minds.shape[0]):
        for row in range(conditions.shape[0]):
            sides[row, 0] = compared[row, k]
        heed(conditions, sides, values, minds[k])


def laid_out_conditions(scheme: Scheme) -> tuple[Ints, Floats, tuple[Condition, ...]]:
    """Return the conditions of a scheme as rows, what they compare as far as it is a number.

    Returns:
        (Q, WIDTH) rows, FIELD −1; (Q, 3) sides, NaN where another knows; the conditions.
    """
    rows: list[tuple[int, ...]] = []
    found: list[Condition] = []
    starts: list[float] = []
    for cogniton, one in enumerate(scheme.cognitons):
        for kind, name in enumerate(KINDS):
            several: tuple[Condition, ...] = getattr(one, name)
            for place, condition in enumerate(several, 1):
                operator = OPERATORS.index(condition.operator)
                rows.append((cogniton, kind, operator, place == len(several), -1))
                found.append(condition)
                starts.append(one.start_value)
    sides = np.full((len(found), 3), np.nan)
    sides[:, 2] = starts
    for row, condition in enumerate(found):
        if not isinstance(condition.bound, str):
            sides[row, 1] = condition.bound
    return np.array(rows, np.int64).reshape(len(rows), WIDTH), sides, tuple(found)
