"""The torus of a running society."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import partial
from typing import Any

import numpy as np
from numpy.typing import NDArray

from coglogo_py.border.errors import shown
from coglogo_py.border.memory import check_memory
from socialmind.agents.running import Running
from socialmind.compiling.lowering import PLACES
from socialmind.errors import SocialmindError
from socialmind.language.arithmetic import brought_back
from socialmind.worlds.contract import Functions, Ground
from socialmind.worlds.torus.patches import Grid


class TorusGround(Ground):
    """The patches of a running society, which `society.world` gives.

    Args:
        society: the society.
        size: patches along a side.

    Raises:
        SocialmindError: more patches than there is memory for.
    """

    layered = True

    def __init__(self, society: Running, size: int) -> None:
        super().__init__(society)
        shape: Any = society.shape.world
        what = f"{shown(size)} × {shown(size)} patches of {society.name}"
        check_memory(size * size * shape.form.dtype.itemsize, what, SocialmindError)
        self.world: Grid = Grid(shape.patch, size, shape.form)

    def arrays(self) -> Mapping[str, NDArray[Any]]:
        """Return the rows of the patches."""
        return {"patches": self.world.rows}

    def connect(self, context: Any) -> None:
        """Write how large the world is."""
        context["_world_size"] = self.world.size
        context["_world_low"] = self.world.low
        context["_world_high"] = self.world.high

    def state(self) -> dict[str, NDArray[Any]]:
        """Return a copy of the patches."""
        return {"rows": self.world.rows.copy()}

    def check_state(self, state: Mapping[str, Any], context: Any) -> str | None:
        """Say what is wrong with patches that are offered."""
        if "rows" not in state:
            return "world.rows holds nothing"
        found = np.asarray(state["rows"])
        if found.dtype != self.world.rows.dtype:
            return "world.rows holds other fields than the model has"
        if found.shape != self.world.rows.shape:
            return f"world.rows holds the shape {found.shape}"
        return None

    def restore(self, state: Mapping[str, NDArray[Any]]) -> None:
        """Take the patches of a state."""
        self.world.restore(state)

    @property
    def entities(self) -> int:
        """How many patches there are."""
        return len(self.world.rows)

    def keeper(self, population: str, field: str) -> Callable[[float, str], float] | None:
        """Return what brings a place back over the border."""
        if field not in PLACES:
            return None
        return partial(_within, self.world.low, self.world.size)

    def hand_out(self, bare: bool) -> None:
        """Give out patches as rules hold them, or as users do."""
        self.world.hand_out(bare)

    def functions(self) -> Functions:
        """Return what interpreted rules call."""
        return {
            "_in_radius": lambda world, x, y, radius: world.around(x, y, radius),
            "_all_patches": lambda world: world.patches,
        }


def _within(low: int, size: int, value: float, whose: str) -> float:
    return brought_back(value, low, size)
