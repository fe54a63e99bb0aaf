"""The patches of a running model: as rules and users hold one, and all of them as columns."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from socialmind.agents.attributes import field_property, held_array, unknown
from socialmind.columns import check_fields, column
from socialmind.compiling.layout import row_dtype
from socialmind.errors import SocialmindError, ValueRefusedError
from socialmind.fields import Field, presence, set_default
from socialmind.values import fitted, fitted_column
from socialmind.worlds.torus.geometry import patch_index, patches_in_radius

TAKEN_NAMES = frozenset(("x", "y", "columns", "fields", "high", "low", "row_class", "rows", "size"))
"""What a patch, and the world, keep under these names beside the world's methods."""


class PatchRow:
    """One patch: its fields as attributes, and the coordinates of its centre."""

    __slots__ = ("_place", "_world")

    def __init__(self, world: Any, place: int) -> None:
        self._world = world
        self._place = place

    @property
    def x(self) -> int:
        """The column, low … high."""
        return self._place // self._world.size + self._world.low

    @property
    def y(self) -> int:
        """The row, low … high."""
        return self._place % self._world.size + self._world.low

    def __reduce__(self) -> tuple[Any, ...]:
        return _patch_of, (self._world, self._place)

    def __repr__(self) -> str:
        return f"<patch {self.x} {self.y}>"


class HeldPatch(PatchRow):
    """A patch as users hold it: what is written is checked."""

    __slots__ = ()

    def __init__(self, world: Any, place: int) -> None:
        object.__setattr__(self, "_world", world)
        object.__setattr__(self, "_place", place)

    def __setattr__(self, name: str, value: Any) -> None:
        field = self._world.fields.get(name)
        if field is None:
            raise unknown(name, "patch", type(self), self._world.fields)
        value = fitted(field, value, f"the field {name!r} of the patch {self.x} {self.y}")
        object.__setattr__(self, name, value)

    def __getattr__(self, name: str) -> Any:
        if name.startswith("__") or hasattr(type(self), name):
            return object.__getattribute__(self, name)
        raise unknown(name, "patch", type(self), self._world.fields)


def _patch_of(world: Any, place: int) -> PatchRow:
    patch: PatchRow = world.row_class(world, place)
    return patch


def patch_class(fields: dict[str, Field]) -> type[PatchRow]:
    """Return the class of a world's patches, with their fields as properties."""
    members: dict[str, Any] = {"__slots__": ()}
    for field in fields.values():
        members[field.name] = field_property(field, lambda row: (row._world.columns, row._place))
    return type("Patch", (PatchRow,), members)


def held_patch_class(bare: type[PatchRow], fields: dict[str, Field]) -> type[HeldPatch]:
    """Return the class of a world's patches as users hold them."""
    members: dict[str, Any] = {"__slots__": ()}
    for field in fields.values():
        if field.size is not None:
            members[field.name] = held_array(field, lambda row: (row._world.columns, row._place))
    return type("Patch", (HeldPatch, bare), members)


class PatchForm:
    """What the patches of all worlds of a kind have in common: their record, and their classes.

    Args:
        fields: the fields of a patch.

    Attributes:
        dtype: the record.
        bare: their class as rules hold them.
        held: their class as users do.
    """

    def __init__(self, fields: dict[str, Field]) -> None:
        self.dtype = row_dtype(fields, None)
        self.bare = patch_class(fields)
        self.held = held_patch_class(self.bare, fields)


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
        form: what its patches share with those of other worlds; their own unless given.
    """

    def __init__(self, fields: dict[str, Field], size: int, form: PatchForm | None = None) -> None:
        form = form or PatchForm(fields)
        self.fields = fields
        self.size = size
        self.low = -(size // 2)
        self.high = self.low + size - 1
        self.rows = np.zeros(size * size, form.dtype)
        for field in fields.values():
            set_default(self.rows, field)
        self._bare, self._held = form.bare, form.held
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
