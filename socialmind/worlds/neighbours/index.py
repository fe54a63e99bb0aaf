"""The arrays of the index by which compiled rules find agents of a population."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from socialmind.worlds.neighbours.cells import CELLS
from socialmind.worlds.neighbours.eight import EIGHT
from socialmind.worlds.neighbours.entries import ENTRY

ARRAYS: dict[str, Any] = {
    "near_cells": CELLS,
    "near_entries": ENTRY,
    "near_starts": np.int32,
    "near_heads": np.int32,
    "near_spots": np.int32,
    "near_found": np.int64,
    "near_marks": np.int64,
    "near_places": np.float64,
}
"""The arrays of a population that rules look for, as `compiling.layout.SEEKING` names them."""
MORE_CELLS = 64
"""How many more cells there may be than agents: a world has some also where it is empty."""
PATCHES_AN_AGENT = 8
"""How many more times there may be where agents are looked for by patches alone."""


def arrays(room: int, loops: int, patches: bool, few: bool) -> dict[str, NDArray[Any]]:
    """Return the arrays of an index.

    Args:
        room: for so many agents.
        patches: whether they are looked for by patches alone.
        loops: how many loops of the rules go over what they found. No rule calls itself, so no
            more of them are under way at once, each with every agent at most.
        few: whether all are looked at where they are few.
    """
    cells = room * (PATCHES_AN_AGENT if patches else 1) + MORE_CELLS
    sizes = {
        "near_cells": 1,
        "near_entries": 2 * room + EIGHT,  # one that is listed, and one in a list
        "near_starts": 1 if patches else cells + 1,
        "near_heads": cells,
        "near_spots": room,
        "near_found": (loops + 1) * room + EIGHT,
        "near_marks": room // 64 + 1,
        "near_places": 2 * (room + EIGHT) if few else 0,
    }
    made = {name: np.zeros(size, ARRAYS[name]) for name, size in sizes.items()}
    made["near_heads"][:] = -1
    return made
