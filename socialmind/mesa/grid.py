"""The patches of a society as a grid of Mesa, with the patches' fields as property layers."""

from __future__ import annotations

from collections.abc import Mapping
from random import Random
from typing import Any

import numpy as np
from mesa import discrete_space
from numpy.typing import NDArray

from socialmind.errors import ModelError, SocialmindError
from socialmind.society.table import Table
from socialmind.worlds.grid.patches import PatchWorld

MAX_CELLS = 1_000_000
"""Mesa makes an object of each cell, of about 2 kB with its eight connections."""

_MESA_LAYER: Any = getattr(discrete_space, "PropertyLayer", None)

if _MESA_LAYER is not None:
    # Up to Mesa 3 a property layer is an object around an array; from Mesa 4 on it is the array.

    class PatchLayer(_MESA_LAYER):
        """A layer that reads and writes a field of the patches themselves.

        Args:
            name: the field.
            world: the patches of the society.
        """

        def __init__(self, name: str, world: PatchWorld) -> None:
            self.world = world
            self.name = name
            self.dimensions = (world.width, world.height)

        def _read(self) -> Any:
            return self.world.layer(self.name)

        def _write(self, values: Any) -> None:
            self._read()[...] = values

        # Mesa 3.3 keeps the array under the first name, Mesa 3.5 under the second.
        _mesa_data = property(_read, _write)
        _data = property(_read, _write)


class SocietyGrid(discrete_space.OrthogonalMooreGrid):
    """Mesa's grid of cells over a society's patches.

    Cells are counted from 0: the cell (i, j) is the patch (low_x + i, low_y + j). Layers are views
    of the patches themselves, so writing to them writes to the society. Fields that may be None and
    arrays have no layer. Mesa knows no world that wraps along one axis: its cells end there.

    Args:
        world: the patches of the society.
        random: the random numbers of the Mesa model.

    Raises:
        SocialmindError: the world has more than a million patches.
        ModelError: a field of the patches has a name that Mesa's cells use.
    """

    def __init__(self, world: PatchWorld, random: Random) -> None:
        width, height = world.width, world.height
        if width * height > MAX_CELLS:
            raise SocialmindError(
                f"a world of {width} × {height} patches; Mesa's grid holds at most {MAX_CELLS:,} "
                "cells; draw model.society.world with matplotlib instead"
            )
        torus = bool(world.wraps_x and world.wraps_y)  # Mesa has no cylinders
        super().__init__((width, height), torus=torus, random=random)
        self.world = world
        self._by_patch = list(self._cells.values())
        self._seen: dict[str, tuple[NDArray[Any], NDArray[Any]]] = {}
        self._rows: Any = None
        self._fields = [
            name for name, one in world.fields.items() if one.size is None and not one.optional
        ]
        for name in self._fields:
            if hasattr(self.cell_klass, name):
                raise ModelError(
                    f"a field {name!r} of the patches, which Mesa's cells use",
                    "another name",
                    "rename it to use Mesa's grid",
                )
        self.see_patches()

    def see_patches(self) -> None:
        """Look at the arrays that hold the patches; restoring a checkpoint replaces them."""
        if self._rows is self.world.rows:
            return
        for name in self._fields:
            if self._rows is not None:
                self.remove_property_layer(name)
            if _MESA_LAYER is None:
                self.add_property_layer(name, self.world.layer(name))
            else:
                self.add_property_layer(PatchLayer(name, self.world))
        self._rows = self.world.rows

    def cell_at(self, x: float, y: float) -> Any:
        """Return the cell around a point of the society."""
        return self._by_patch[int(self._patches(np.array([x]), np.array([y]))[0])]

    def place(self, table: Table, agents: Mapping[int, Any]) -> None:
        """Put the agents of a population into the cells on which they stand.

        Args:
            table: the population.
            agents: its agents by identity, in order of birth.
        """
        identities = table.id
        patches = self._patches(table.x, table.y)
        before = self._seen.get(table.shape.name)
        if before is None or not np.array_equal(before[0], identities):
            moved = list(range(len(identities)))
        else:
            moved = np.flatnonzero(before[1] != patches).tolist()
        for place in moved:
            agents[int(identities[place])].move_into(self._by_patch[patches[place]])
        self._seen[table.shape.name] = identities, patches

    def _patches(self, x: NDArray[Any], y: NDArray[Any]) -> NDArray[np.int64]:
        if not (np.isfinite(x).all() and np.isfinite(y).all()):
            raise SocialmindError("an agent at a place that is not finite has no cell in the grid")
        world = self.world
        column = (np.floor(x + 0.5).astype(np.int64) - world.low_x) % world.width
        row = (np.floor(y + 0.5).astype(np.int64) - world.low_y) % world.height
        patches: NDArray[np.int64] = column * world.height + row
        return patches
