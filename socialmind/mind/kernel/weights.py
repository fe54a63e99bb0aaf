"""Between a cogniton mind and a hierarchy that weighs its plans: both ways, at both speeds."""

from __future__ import annotations

import math

from numba.extending import register_jitable


@register_jitable
def sensed(value: float, reach: float) -> float:
    """Return what a sensor reads of a cogniton: 0.5 + value / (2 · reach), held to 0 … 1.

    Args:
        value: of the cogniton; NaN, inactive, reads as 0.
        reach: the value at which the sensor reads 1, above 0.

    >>> sensed(-800.0, 1600.0), sensed(math.nan, 3.0), sensed(9.0, 3.0)
    (0.25, 0.5, 1.0)
    """
    if math.isnan(value):
        return 0.5
    return min(max(0.5 + 0.5 * value / reach, 0.0), 1.0)


@register_jitable
def weighed(command: float, reach: float) -> float:
    """Return the weight of a plan that an actuator's command stands for: (2c − 1) · reach.

    Args:
        command: c, 0 … 1.
        reach: the weight of the command 1, above 0.

    >>> weighed(0.5, 100.0), weighed(1.0, 100.0)
    (0.0, 100.0)
    """
    return (2.0 * command - 1.0) * reach
