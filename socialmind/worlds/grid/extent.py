"""Where a world of patches begins and ends, as numbers that rules read: `model.world.width`."""

from __future__ import annotations

from collections.abc import Mapping

OF_TORUS: Mapping[str, str] = {
    "size": "_model._world_size",
    "low": "_model._world_low",
    "high": "_model._world_high",
    "width": "_model._world_size",
    "height": "_model._world_size",
    "low_x": "_model._world_low",
    "low_y": "_model._world_low",
    "high_x": "_model._world_high",
    "high_y": "_model._world_high",
    "wraps_x": "1",
    "wraps_y": "1",
}
"""How compiled code finds the numbers of a torus: by the columns that every record has."""


def of_grid(wraps: bool | str) -> Mapping[str, str]:
    """Return how compiled code finds the numbers of a grid, which wraps as its declaration says."""
    numbers = {name: f"_model._world_{name}" for name in ("width", "height", "low_x", "low_y")}
    for axis, side in (("x", "width"), ("y", "height")):
        numbers[f"high_{axis}"] = f"(_model._world_low_{axis} + _model._world_{side} - 1)"
        numbers[f"wraps_{axis}"] = str(int(wraps is True or wraps == axis))
    return numbers


def values_of(
    names: Mapping[str, str], width: int, height: int, low: tuple[int, int] | None
) -> dict[str, int]:
    """Return the numbers of a running world.

    Args:
        names: `OF_TORUS`, or what `of_grid` returns.
        width: patches across.
        height: patches up.
        low: the lowest patch; None for NetLogo's middle.

    >>> numbers = values_of(OF_TORUS, 4, 4, None)
    >>> numbers["low"], numbers["high_y"], numbers["wraps_x"]
    (-2, 1, 1)
    """
    low_x, low_y = low or (-(width // 2), -(height // 2))
    found = {
        "size": width, "low": low_x, "high": low_x + width - 1,
        "width": width, "height": height, "low_x": low_x, "low_y": low_y,
        "high_x": low_x + width - 1, "high_y": low_y + height - 1,
        "wraps_x": int(names["wraps_x"]), "wraps_y": int(names["wraps_y"]),
    }  # fmt: skip
    return {name: value for name, value in found.items() if name in names}
