"""The patches of a running society."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from coglogo_py.border.errors import shown
from coglogo_py.border.memory import check_memory
from socialmind.agents.running import Running
from socialmind.compiling.lowering import PLACES, SPACE
from socialmind.errors import RuleError, SocialmindError, ValueRefusedError
from socialmind.worlds.contract import Extent, Functions, Ground
from socialmind.worlds.grid.extent import values_of
from socialmind.worlds.grid.fields import SCRATCH, scratch_size
from socialmind.worlds.grid.one_per_patch import INSTEAD, NOWHERE, OnePerPatch
from socialmind.worlds.grid.patches import PatchWorld


class GridGround(Ground):
    """The patches of a running society, which `society.world` gives.

    Args:
        society: the society.
        width: patches across.
        height: patches up.
        low: the lowest patch; None for the middle.
        maps: what fields of the patches begin with, by name: a file beside the model, a parameter
            that is a choice among files, or an array; for a picture with what black and white are.

    Raises:
        SocialmindError: a map cannot be read or does not fit; more patches than there is memory
            for, or none around the point 0 0.
    """

    layered = True

    def __init__(
        self,
        society: Running,
        width: int,
        height: int,
        low: tuple[int, int] | None,
        maps: Mapping[str, Any],
    ) -> None:
        super().__init__(society)
        shape: Any = society.shape.world
        what = f"{shown(width)} × {shown(height)} patches of {society.name}"
        row = shape.form.dtype.itemsize + (24 if shape.alone is not None else 0)
        check_memory(width * height * row, what, SocialmindError)
        numbers = values_of(shape.numbers, width, height, low)
        if not all(numbers[f"low_{a}"] <= 0 <= numbers[f"high_{a}"] for a in PLACES):
            raise SocialmindError(
                f"low={low} of a world of {width} × {height} patches: the patch 0 0, where agents "
                "begin, lies outside; expected one that is inside"
            )
        kind = PatchWorld if shape.alone is None else OnePerPatch
        self.world: Any = kind(shape.patch, numbers, shape.form)
        self._load(maps)
        self.alone = shape.alone is not None
        self._restored = False
        self._scratch: NDArray[Any] | None = None
        if SCRATCH[0] in society.program.world_columns:
            self._scratch = np.zeros(scratch_size(width, height))

    def _load(self, maps: Mapping[str, Any]) -> None:
        """Set the fields that begin with a map."""
        kind: Any = type(self.society)
        for field, source in maps.items():
            source, *ends = source if isinstance(source, tuple) else (source,)
            if isinstance(source, str) and source in kind.parameters:
                source = getattr(self.society, source)
            folder = kind.folder() if isinstance(source, str | Path) else Path()
            self.world.load(field, source, *ends, folder=folder)

    def settle_in(self) -> None:
        """Let a world in which patches have room for one know the agents."""
        if self.alone:
            self.world.settle_in(self.society.tables)

    def build(self) -> None:
        """Look whether all agents stand somewhere, where the setup must have placed them."""
        if self.alone and not self._restored:
            self._check_placed("in the setup")
        self._restored = False

    def arrays(self) -> Mapping[str, NDArray[Any]]:
        """Return the rows of the patches, and who stands on them."""
        arrays = {"patches": self.world.rows}
        if self._scratch is not None:
            arrays[SCRATCH[0]] = self._scratch
        return arrays | self.world.holding() if self.alone else arrays

    def connect(self, context: Any) -> None:
        """Write where the world is."""
        for name, value in self.world.numbers.items():
            if f"world_{name}" in self.society.shape.world.columns:
                context[f"_world_{name}"] = value

    def state(self) -> dict[str, NDArray[Any]]:
        """Return a copy of the patches."""
        return self.world.snapshot()

    def check_state(self, state: Mapping[str, Any], context: Any) -> str | None:
        """Say what is wrong with patches that are offered."""
        return self.world.misfit(state)

    def restore(self, state: Mapping[str, NDArray[Any]]) -> None:
        """Take the patches of a state."""
        self.world.restore(state)
        self._restored = True

    @property
    def entities(self) -> int:
        """How many patches there are."""
        return len(self.world.rows)

    @property
    def extent(self) -> Extent:
        """The patches, from the first one's end to the last one's."""
        numbers = self.world.numbers
        low_x, low_y, width, height, wraps_x, wraps_y = (numbers[name] for name in SPACE)
        ends = low_x - 0.5, low_y - 0.5, float(width), float(height)
        return Extent(*ends, bool(wraps_x), bool(wraps_y), True)

    def keeper(self, population: str, field: str) -> Callable[[float, str], float] | None:
        """Return what keeps a place in the world."""
        if field not in PLACES:
            return None
        return partial(_kept, self, field)

    def hand_out(self, bare: bool) -> None:
        """Give out patches as rules hold them, or as users do."""
        self.world.hand_out(bare)

    def functions(self) -> Functions:
        """Return what interpreted rules call."""
        return {
            "_in_radius": lambda world, x, y, radius: world.around(x, y, radius),
            "_all_patches": lambda world: world.patches,
        }

    # Where a patch has room for one -------------------------------------------------------------

    def put(self, agent: Any, x: float, y: float) -> None:
        """Move an agent."""
        self.world.move_to(agent, x, y)

    def leave(self, table: Any, slot: int) -> None:
        """Let an agent that dies leave its patch."""
        if self.alone:
            self.world.leave(table, slot)

    def run_tick(self, functions: Functions, schedule: Callable[[], None]) -> None:
        """Run the schedule; where patches have room for one, all agents stand somewhere after."""
        if self.alone:
            self.world.list_free()
        schedule()
        if self.alone:
            self._check_placed("in the schedule")

    def _check_placed(self, when: str) -> None:
        nowhere = self.world.standing_nowhere()
        if nowhere is not None:
            population, identity = nowhere
            raise RuleError(NOWHERE, when, self.society.tick, f"agent {identity} of {population!r}")


def _kept(ground: GridGround, axis: str, value: float, whose: str) -> float:
    if ground.alone and ground.world.knows_agents:
        raise ValueRefusedError(f"{axis} of {whose}: {INSTEAD}")
    return float(ground.world.kept(axis, value, whose))
