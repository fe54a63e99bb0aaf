"""Who is near whom, asked of all agents one by one: for interpreted rules, and between ticks."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from socialmind.worlds.contract import Extent

Slots = NDArray[np.int64]


def near(extent: Extent, slots: Slots, columns: Any, x: float, y: float, radius: float) -> Slots:
    """Return the slots of those at most a radius from a place.

    Args:
        extent: where agents may be.
        slots: those of the agents that are asked, in order of birth, as what is returned.
        columns: their fields, by slot.
        x: of the place.
        y: likewise.
        radius: 0 or more.
    """
    return slots[_away(extent, slots, columns, x, y) <= radius * radius]


def nearest(
    extent: Extent, slots: Slots, columns: Any, x: float, y: float, radius: float
) -> int | None:
    """Return the slot of the nearest at most a radius from a place, of several the first born."""
    away = _away(extent, slots, columns, x, y)
    if not len(away):
        return None
    first = int(np.argmin(away))
    return int(slots[first]) if away[first] <= radius * radius else None


def _away(extent: Extent, slots: Slots, columns: Any, x: float, y: float) -> NDArray[np.float64]:
    """Return the squares of distances, the short way round where the world wraps."""
    dx = columns["x"][slots] - x
    dy = columns["y"][slots] - y
    for difference, size, wraps in (
        (dx, extent.width, extent.wraps_x),
        (dy, extent.height, extent.wraps_y),
    ):
        if wraps:
            beyond, before = difference > size / 2, difference < -size / 2
            difference[beyond] -= size
            difference[before] += size
    away: NDArray[np.float64] = dx * dx + dy * dy
    return away


def on_patches(
    extent: Extent, slots: Slots, columns: Any, x: float, y: float, steps: int, kind: int
) -> Slots:
    """Return the slots of those on the patches around a place.

    Args:
        extent: of a world of patches.
        slots: as `near` takes them.
        columns: likewise.
        x: of the place.
        y: likewise.
        steps: at most so many king's moves away.
        kind: 0 with the patch of the place, 8 without it, 4 for those that share a side.
    """
    dx = _steps(columns["x"][slots], x, extent.low_x, extent.width, extent.wraps_x)
    dy = _steps(columns["y"][slots], y, extent.low_y, extent.height, extent.wraps_y)
    if kind == 4:
        return slots[dx + dy == 1]
    return slots[(dx <= steps) & (dy <= steps) & ((kind == 0) | (dx + dy > 0))]


def _steps(
    values: NDArray[np.float64], value: float, low: float, size: float, wraps: bool
) -> NDArray[np.float64]:
    """Return how many columns, or rows, of patches lie between places and one place."""
    first = math.floor(low + 0.5)
    columns = np.floor(np.append(values, value) + 0.5) - first
    columns[columns >= size] = 0 if wraps else size - 1  # a hair before the end, rounded up
    steps: NDArray[np.float64] = np.abs(columns[:-1] - columns[-1])
    return np.minimum(steps, size - steps) if wraps else steps
