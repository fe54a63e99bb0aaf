"""Where something is, as a body sees it; the same arithmetic interpreted and compiled."""

from __future__ import annotations

import math

from numba.extending import register_jitable


@register_jitable
def mounted(x: float, cos: float, sin: float, ahead: float, aside: float) -> float:
    """Return a coordinate of a point of a body's frame: of x, or of y with `aside` and `ahead`."""
    return x + cos * ahead - sin * aside


@register_jitable
def bearing_of(dx: float, dy: float, cos: float, sin: float, angle: float) -> float:
    """Return the direction of something, radians from -π to π, positive to the left.

    Args:
        dx: how far it is away in x.
        dy: how far it is away in y.
        cos: of the body's angle.
        sin: of the body's angle.
        angle: where the device points, from straight ahead.
    """
    bearing = math.atan2(cos * dy - sin * dx, cos * dx + sin * dy) - angle
    if bearing > math.pi:
        bearing -= 2 * math.pi
        if bearing > math.pi:
            bearing -= 2 * math.pi * math.ceil((bearing - math.pi) / (2 * math.pi))
    if bearing <= -math.pi:
        bearing += 2 * math.pi
        if bearing <= -math.pi:  # a device whose angle is beyond a full turn
            bearing += 2 * math.pi * math.floor((math.pi - bearing) / (2 * math.pi))
    return bearing


@register_jitable
def bounded(value: float) -> float:
    """Return a sensor's value held to [0, 1]."""
    number = 1.0 * value
    if math.isnan(number):
        raise ValueError("a sensor gave a value that is not a number")
    return min(max(number, 0.0), 1.0)


@register_jitable
def counted(value: float) -> float:
    """Return a reward as it is added up; it must be a finite number."""
    number = 1.0 * value
    if not math.isfinite(number):
        raise ValueError("a reward that is not a finite number")
    return number
