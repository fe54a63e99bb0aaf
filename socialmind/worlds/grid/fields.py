"""Steps over fields of all patches: diffusing, evaporating, summing up."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from socialmind.compiling.aggregates import aggregate_text
from socialmind.fields import Field
from socialmind.language.aggregates import AGGREGATES
from socialmind.language.shape import FIELD, WorldCall
from socialmind.language.types import FLOAT, NONE

NEIGHBOURS = {"diffuse": 8, "diffuse4": 4}
SCRATCH = ("world_scratch", "world_scratch_0")

CALLS: Mapping[str, WorldCall] = {
    **{
        name: WorldCall((FIELD, FLOAT), NONE, f'{name}("field", share)', (float,), SCRATCH)
        for name in NEIGHBOURS
    },
    "evaporate": WorldCall((FIELD, FLOAT), NONE, 'evaporate("field", share)', (float,)),
    **{
        name: WorldCall(
            (FIELD,),
            FLOAT if name == "mean" else FIELD,
            f'{name}("field")',
            (float, int, bool) if name in ("sum", "mean") else (float, int),
        )
        for name in AGGREGATES
    },
}
"""What rules call on fields of the patches; `of_field` says what a sum of truth values is."""


def scratch_size(width: int, height: int) -> int:
    """Return how much room a step needs: the world, and a patch more at each side."""
    return (width + 2) * (height + 2)


def goes_round(size: int, wraps: int) -> bool:
    """Return whether an axis has a neighbour beyond its end that is not one within already."""
    return bool(wraps) and size > 2


# Interpreted --------------------------------------------------------------------------------------


def share_of(share: float) -> float:
    """Return a share, or refuse it."""
    if not 0.0 <= share <= 1.0:
        raise ValueError("a share beyond 0 … 1")
    return float(share)


def diffused(
    values: NDArray[np.float64], share: float, count: int, wraps_x: int, wraps_y: int
) -> NDArray[np.float64]:
    """Return a field after each patch gave a share of its value to its neighbours.

    NetLogo's `diffuse` and `diffuse4`: each of 8 (or 4) neighbours gets as much, each once in a
    small world; what is for a neighbour that is not there stays.

    Args:
        values: the field, (width, height).
        share: the share, 0 … 1.
        count: 8 or 4.
        wraps_x: whether the first column is beside the last.
        wraps_y: whether the first row is beside the last.
    """
    width, height = values.shape
    round_x, round_y = goes_round(width, wraps_x), goes_round(height, wraps_y)
    around = np.zeros((width + 2, height + 2))
    around[1:-1, 1:-1] = values
    if round_x:
        around[0, 1:-1], around[-1, 1:-1] = values[-1], values[0]
    if round_y:
        around[:, 0], around[:, -1] = around[:, -2], around[:, 1]
    west, east = around[:-2], around[2:]
    total = (west[:, 1:-1] + east[:, 1:-1]) + (around[1:-1, :-2] + around[1:-1, 2:])
    if count == 8:
        corners = (west[:, :-2] + east[:, 2:]) + (west[:, 2:] + east[:, :-2])
        total = total + corners
    part = share / count
    found = values * (1.0 - share) + total * part
    missing = count - neighbours_there(width, height, round_x, round_y, count)
    edge = missing > 0
    found[edge] = found[edge] + (missing[edge] * part) * values[edge]
    return found


def neighbours_there(
    width: int, height: int, round_x: bool, round_y: bool, count: int
) -> NDArray[np.int64]:
    """Return how many neighbours each patch has."""
    there = np.zeros((width + 2, height + 2), np.int64)
    there[1:-1, 1:-1] = 1
    if round_x:
        there[0, 1:-1] = there[-1, 1:-1] = 1
    if round_y:
        there[:, 0], there[:, -1] = there[:, -2], there[:, 1]
    found = there[:-2, 1:-1] + there[2:, 1:-1] + there[1:-1, :-2] + there[1:-1, 2:]
    if count == 8:
        found = found + there[:-2, :-2] + there[2:, 2:] + there[:-2, 2:] + there[2:, :-2]
    return found


# Compiled -----------------------------------------------------------------------------------------

_SCRATCH = """@_inner
def _world_scratch(_model):
    return carray(_as_pointer(_model._world_scratch), (_model._world_scratch_0,), np.float64)


@_inner
def _world_share(share):
    if not 0.0 <= share <= 1.0:
        raise ValueError("a share beyond 0 … 1")
    return share"""

_SHARE = _SCRATCH.split("\n\n\n")[1]

_DIFFUSE = """@_inner
def _world_CALL_FIELD(_model, share):
    share = _world_share(share)
    rows = _patches(_model)
    around = _world_scratch(_model)
    width = WIDTH
    height = HEIGHT
    long = height + 2
    round_x = WRAPS_X != 0 and width > 2
    round_y = WRAPS_Y != 0 and height > 2
    for column in range(width):
        first = (column + 1) * long + 1
        for row in range(height):
            around[first + row] = rows[column * height + row].FIELD
    last = (width + 1) * long
    for row in range(1, height + 1):
        around[row] = around[width * long + row] if round_x else 0.0
        around[last + row] = around[long + row] if round_x else 0.0
    for first in range(0, last + long, long):
        around[first] = around[first + height] if round_y else 0.0
        around[first + height + 1] = around[first + 1] if round_y else 0.0
    part = share / COUNT
    keep = 1.0 - share
    for column in range(width):
        here = (column + 1) * long + 1
        west = here - long
        east = here + long
        for row in range(height):
            total = (around[west + row] + around[east + row]) + (
                around[here + row - 1] + around[here + row + 1]
            )
            CORNERS
            rows[column * height + row].FIELD = around[here + row] * keep + total * part
    if round_x and round_y:
        return
    for column in range(width):
        across = 3 - (0 if round_x else (column == 0) + (column == width - 1))
        inner = across == 3 and not round_y
        step = height - 1 if inner and height > 1 else 1
        for row in range(0, height, step):
            up = 3 - (0 if round_y else (row == 0) + (row == height - 1))
            missing = MISSING
            if missing > 0:
                place = column * height + row
                rows[place].FIELD = rows[place].FIELD + (missing * part) * around[
                    (column + 1) * long + 1 + row
                ]"""

_CORNERS = """total = total + (
                (around[west + row - 1] + around[east + row + 1])
                + (around[west + row + 1] + around[east + row - 1])
            )"""

_EVAPORATE = """@_inner
def _world_evaporate_FIELD(_model, share):
    keep = 1.0 - _world_share(share)
    rows = _patches(_model)
    for place in range(len(rows)):
        rows[place].FIELD = rows[place].FIELD * keep"""


def text(
    calls: list[tuple[str, ...]], patch: Mapping[str, Field], numbers: Mapping[str, str]
) -> str:
    """Return the steps over fields that rules call.

    Args:
        calls: what they call, with fields.
        patch: the fields of a patch.
        numbers: how compiled code finds where the world is.
    """
    own = [call for call in calls if call[0] in CALLS]
    parts = []
    if any(call[0] in NEIGHBOURS for call in own):
        parts.append(_SCRATCH)
    elif any(call[0] == "evaporate" for call in own):
        parts.append(_SHARE)
    for name, field in own:
        if name in AGGREGATES:
            parts.append(aggregate_text(f"_world_{name}_{field}", name, patch[field], None))
        elif name == "evaporate":
            parts.append(_EVAPORATE.replace("FIELD", field))
        else:
            parts.append(_diffuse_text(name, field, numbers))
    return "\n\n\n".join(parts)


def _diffuse_text(name: str, field: str, numbers: Mapping[str, str]) -> str:
    count = NEIGHBOURS[name]
    fills = {
        "WIDTH": numbers["width"],
        "HEIGHT": numbers["height"],
        "WRAPS_X": numbers["wraps_x"],
        "WRAPS_Y": numbers["wraps_y"],
        "COUNT": str(count),
        "CORNERS": _CORNERS if count == 8 else "pass",
        "MISSING": "9 - across * up" if count == 8 else "6 - across - up",
        "CALL": name,
        "FIELD": field,
    }
    made = _DIFFUSE
    for mark, fill in fills.items():
        made = made.replace(mark, fill)
    return made
