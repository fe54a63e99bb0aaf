"""The torus of a model: its declaration, and its patches in a running model."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from socialmind.columns import check_fields, column
from socialmind.errors import ModelError, SocialmindError, ValueRefusedError
from socialmind.fields import Field, class_fields, place_of_field, presence, set_default
from socialmind.language.layout import row_dtype
from socialmind.rows import PatchRow, held_patch_class, patch_class, unknown
from socialmind.values import fitted_column
from socialmind.worlds.torus import COMMANDS, patch_index, patches_in_radius


class Patch:
    """The base of annotated classes that declare the fields of a patch.

    >>> class Land(Patch):
    ...     taken: bool = False
    """


TAKEN_NAMES = frozenset(("x", "y", "columns", "fields", "high", "low", "row_class", "rows", "size"))
"""What a patch, and the world, keep under these names beside the world's methods."""


class Torus:
    """The declaration of a square torus of patches, as the attribute `world` of a model.

    Args:
        size: patches along a side, 1 or more: a number, or the name of a parameter.
        patch: the annotated class of its patches, which inherits from `Patch`.
    """

    def __init__(self, size: int | str = 33, patch: type = Patch) -> None:
        self.size = size
        self.patch = patch

    def check(self) -> None:
        """Refuse patches of a wrong class, and names that are taken.

        Raises:
            ModelError: so it is.
        """
        if not (isinstance(self.patch, type) and issubclass(self.patch, Patch)):
            raise ModelError(
                f"{self.patch!r} as the patches of the world",
                "a class that inherits from socialmind.Patch",
                "write class Land(Patch): …",
            )
        for name in class_fields(self.patch):
            if name in TAKEN_NAMES or hasattr(Grid, name) or name in COMMANDS:
                raise ModelError(
                    f"a field called {name!r}",
                    "a name that patches and the world do not use",
                    None,
                    *place_of_field(self.patch, name),
                )

    def __get__(self, model: Any, owner: type) -> Any:
        return self if model is None else model.grid

    @property
    def fields(self) -> dict[str, Field]:
        """The fields of its patches."""
        return class_fields(self.patch)


class Grid:
    """The torus of a running model.

    It is what `model.world` gives: its size, a patch, the patches around an agent, and each field
    of the patches as a NumPy array of shape (size, size), column by column from the south-west,
    which is a copy. Assigning to the field writes it:

        model.world.size, model.world.low, model.world.high
        model.world.patch(3, -2).taken
        model.world.taken[x - model.world.low, y - model.world.low]
        model.world.taken = False

    Args:
        fields: the fields of a patch.
        size: patches along a side.
    """

    def __init__(self, fields: dict[str, Field], size: int) -> None:
        self.fields = fields
        self.size = size
        self.low = -(size // 2)
        self.high = self.low + size - 1
        self.rows = np.zeros(size * size, row_dtype(fields, None))
        for field in fields.values():
            set_default(self.rows, field)
        self._bare = patch_class(fields)
        self._held = held_patch_class(self._bare, fields)
        self.row_class: type[PatchRow] = self._held
        self._see_columns()

    def _see_columns(self) -> None:
        names = self.rows.dtype.names or ()
        self.columns = {name: self.rows[name] for name in names}

    def __reduce__(self) -> tuple[Any, ...]:
        return _grid_of, (self.fields, self.size, self.rows)

    def __getattr__(self, name: str) -> NDArray[Any]:
        """Return a field of all patches: a copy, and read-only."""
        fields = self.__dict__.get("fields", {})
        if name.startswith("_"):
            raise AttributeError(f"no attribute {name!r}")
        if name not in fields:
            raise unknown(name, "world", type(self), fields)
        values = self.layer(name).copy()
        if fields[name].optional:
            values = values.astype(object)
            values[~self.layer(presence(name))] = None
        return column(values, f"society.world.{name}")

    def __setattr__(self, name: str, value: Any) -> None:
        """Set a field of all patches: one value for all, or an array (size, size)."""
        fields = self.__dict__.get("fields", {})
        if name in fields:
            self.set(**{name: value})
        elif name.startswith("_") or name in TAKEN_NAMES:
            object.__setattr__(self, name, value)
        else:
            raise unknown(name, "world", type(self), fields)

    def set(self, **fields: Any) -> None:
        """Set fields of all patches.

        Args:
            fields: by name, one value for all, or an array (size, size), column by column from the
                south-west, as the field itself is given.

        Raises:
            UnknownNameError: there is no such field.
            ValueRefusedError: an array of another shape, or a value that the field cannot hold.
        """
        check_fields(fields, self.fields, "the world")
        checked = {}
        for name, values in fields.items():
            shape = np.shape(values)
            if len(shape) >= 2 and shape[:2] == (self.size, self.size):
                values = np.asarray(values).reshape((self.size * self.size, *shape[2:]))
            elif len(shape) > (self.fields[name].size is not None):
                raise ValueRefusedError(
                    f"the field {name!r} of the world: found the shape {shape}; expected "
                    f"{(self.size, self.size)}, or one value for all"
                )
            checked[name] = fitted_column(
                self.fields[name],
                values,
                len(self.rows),
                f"the field {name!r} of the world",
                lambda place: repr(self._held(self, place)),
            )
        for name, (found, there) in checked.items():
            self.columns[name][:] = found
            if self.fields[name].optional:
                self.columns[presence(name)][:] = there

    def layer(self, name: str) -> NDArray[Any]:
        """Return a column of the patches themselves, (size, size), not checked when written."""
        found = self.columns[name]
        return found.reshape((self.size, self.size, *found.shape[1:]))

    def hand_out(self, bare: bool) -> None:
        """Give out patches as rules hold them, or, as else, as users do."""
        self.row_class = self._bare if bare else self._held

    def patch(self, x: float, y: float) -> PatchRow:
        """Return the patch around a point."""
        return self.row_class(self, int(patch_index(x, y, self.low, self.size)))

    def in_radius(self, agent: Any, radius: float) -> Iterator[PatchRow]:
        """Yield the patches whose centre is at most a radius from an agent or a patch."""
        return self.around(agent.x, agent.y, radius)

    def around(self, x: float, y: float, radius: float) -> Iterator[PatchRow]:
        """Yield the patches whose centre is at most a radius from a point."""
        for place in patches_in_radius(x, y, radius, self.low, self.size):
            yield self.row_class(self, place)

    @property
    def patches(self) -> Iterator[PatchRow]:
        """Yield all patches, column by column."""
        for place in range(len(self.rows)):
            yield self.row_class(self, place)

    def restore(self, state: Mapping[str, NDArray[Any]]) -> None:
        """Take the patches of a checkpoint."""
        if state["rows"].dtype != self.rows.dtype or len(state["rows"]) != len(self.rows):
            raise SocialmindError("the checkpoint's patches are not those of the model")
        self.rows = np.array(state["rows"])
        self._see_columns()


def _grid_of(fields: dict[str, Field], size: int, rows: NDArray[Any]) -> Grid:
    grid = Grid(fields, size)
    grid.restore({"rows": rows})
    return grid
