"""Worlds of patches: their declarations, `Grid` of any shape and `Torus`, the square that wraps."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from coglogo_py.border.errors import shown
from coglogo_py.border.numbers import is_number, is_truth, is_whole
from socialmind.agents.running import Running
from socialmind.errors import ModelError, nearest
from socialmind.fields import class_fields, place_of_field
from socialmind.language.shape import WorldShape
from socialmind.worlds.contract import Ground, Place, World
from socialmind.worlds.grid.extent import OF_TORUS, of_grid
from socialmind.worlds.grid.geometry import COMMANDS
from socialmind.worlds.grid.ground import GridGround
from socialmind.worlds.grid.one_per_patch import OnePerPatch
from socialmind.worlds.grid.patches import TAKEN_NAMES
from socialmind.worlds.grid.shape import GridShape


class Patch:
    """The base of annotated classes that declare the fields of a patch.

    >>> class Land(Patch):
    ...     taken: bool = False
    """


class Grid(World):
    """The declaration of a world of patches, as the attribute `world` of a model.

    Args:
        width: patches across, 1 or more: a number, or the name of a parameter.
        height: patches up, likewise.
        wraps: whether what leaves on one side comes back on the other: True, False for walls, or
            the axis that wraps, "x" or "y".
        patch: the annotated class of its patches, which inherits from `Patch`.
        low: the lowest patch, (x, y); the patch 0 0 is in the world, where agents begin. Unless
            given, it is in the middle, as in NetLogo.
        one_per_patch: whether a patch has room for one agent, of any population.
        maps: what fields of the patches begin with, by name: a CSV file or a picture beside the
            model, or an array; a picture with what black and white are: `("map.png", 0.0, 800.0)`.

    >>> world = Grid(20, 10, wraps="x", low=(0, 0))
    >>> world.sizes
    (20, 10)
    """

    def __init__(
        self,
        width: int | str,
        height: int | str,
        wraps: bool | str = True,
        patch: type = Patch,
        low: tuple[int, int] | None = None,
        one_per_patch: bool = False,
        maps: Mapping[str, Any] | None = None,
    ) -> None:
        self.maps = dict(maps or {})
        self.sizes = (width, height)
        self.wraps = wraps
        self.patch = patch
        self.low = low
        self.one_per_patch = one_per_patch
        self.numbers = of_grid(wraps)

    def __str__(self) -> str:
        """What listings call it."""
        width, height = self.sizes[0], self.sizes[-1]
        borders = f", wraps {self.wraps}" if isinstance(self.wraps, str) else ", walls"
        borders = "" if self.wraps is True else borders
        return f"{type(self).__name__} of {width} × {height} patches{borders}"

    def check(self) -> None:
        """Refuse borders, a corner and patches that are none, and names that are taken.

        Raises:
            ModelError: so it is.
        """
        if not is_truth(self.wraps) and self.wraps not in ("x", "y"):
            raise ModelError(f"wraps={shown(self.wraps)} of the world", "True, False, 'x' or 'y'")
        if not is_truth(self.one_per_patch):
            raise ModelError(f"one_per_patch={shown(self.one_per_patch)}", "True or False")
        low = self.low
        if low is not None and not (
            isinstance(low, tuple) and len(low) == 2 and all(is_whole(one) for one in low)
        ):
            raise ModelError(
                f"low={shown(low)} of the world",
                "the lowest patch, two whole numbers",
                "write low=(0, 0)",
            )
        if not (isinstance(self.patch, type) and issubclass(self.patch, Patch)):
            raise ModelError(
                f"{self.patch!r} as the patches of the world",
                "a class that inherits from socialmind.Patch",
                "write class Land(Patch): …",
            )
        taken = {*TAKEN_NAMES, *COMMANDS, *self.numbers}
        for name in class_fields(self.patch):
            if name in taken or hasattr(OnePerPatch, name):
                raise ModelError(
                    f"a field called {name!r}",
                    "a name that patches and the world do not use",
                    None,
                    *place_of_field(self.patch, name),
                )

        for name, source in self.maps.items():
            if name not in class_fields(self.patch):
                raise ModelError(
                    f"a map of {name!r}, which is no field of the patches",
                    None,
                    nearest(name, class_fields(self.patch)),
                )
            if isinstance(source, tuple) and not (
                len(source) == 3 and all(is_number(one) for one in source[1:])
            ):
                raise ModelError(
                    f"the map {shown(source)} of {name!r}",
                    "a file, and what black and white are",
                    'write ("map.png", 0.0, 1.0)',
                )

    def shape(self, model: Any, place: Place) -> WorldShape:
        """Return what rules know of the world: its patches, its size, and how to move on it."""
        super().shape(model, place)
        alone = tuple(model.populations) if self.one_per_patch else None
        return GridShape(class_fields(self.patch), self.numbers, alone)

    def ground(self, society: Running, *sizes: int) -> Ground:
        """Return the world of a running society, with its patches."""
        width, height = sizes if len(sizes) == 2 else (sizes[0], sizes[0])
        return GridGround(society, width, height, self.low, self.maps)


class Torus(Grid):
    """The declaration of a square torus of patches, as the attribute `world` of a model.

    Args:
        size: patches along a side, 1 or more: a number, or the name of a parameter.
        patch: the annotated class of its patches, which inherits from `Patch`.
        one_per_patch: whether a patch has room for one agent, of any population.
        maps: what fields of the patches begin with, as of a `Grid`.
    """

    def __init__(
        self,
        size: int | str = 33,
        patch: type = Patch,
        one_per_patch: bool = False,
        maps: Mapping[str, Any] | None = None,
    ) -> None:
        super().__init__(size, size, True, patch, None, one_per_patch, maps)
        self.size = size
        self.sizes = (size,)
        self.numbers = OF_TORUS
