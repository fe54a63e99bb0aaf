"""The patches of a running model: as rules and users hold one, and all of them as columns."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from coglogo_py.border.errors import shown
from socialmind.agents.attributes import field_property, held_array, unknown
from socialmind.columns import check_fields, column
from socialmind.compiling.layout import row_dtype
from socialmind.compiling.lowering import SPACE
from socialmind.errors import ValueRefusedError
from socialmind.fields import Field, presence, set_default
from socialmind.language.aggregates import AGGREGATES, aggregated, field_called
from socialmind.language.arithmetic import brought_back
from socialmind.values import fitted, fitted_column
from socialmind.worlds.grid import geometry, ways
from socialmind.worlds.grid.fields import diffused, share_of
from socialmind.worlds.grid.patches_near import (
    count_around,
    nth_around,
    patch_index,
    patches_in_radius,
)
from socialmind.worlds.grid.rasters import raster

HERE = Path()
TAKEN_NAMES = frozenset(("x", "y", "columns", "fields", "numbers", "row_class", "rows"))
"""What a patch, and the world, keep under these names beside the world's methods."""


class PatchRow:
    """One patch: its fields as attributes, and the coordinates of its centre."""

    __slots__ = ("_place", "_world")

    def __init__(self, world: Any, place: int) -> None:
        self._world = world
        self._place = place

    @property
    def x(self) -> int:
        """The column, low_x … high_x."""
        return self._place // self._world.height + self._world.low_x

    @property
    def y(self) -> int:
        """The row, low_y … high_y."""
        return self._place % self._world.height + self._world.low_y

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


class PatchWorld:
    """The patches of a running model.

    It is what `model.world` gives: its size, a patch, the patches around an agent, and each field
    of the patches as a NumPy array of shape (width, height), column by column from the south-west,
    which is a copy. Assigning to the field writes it:

        model.world.width, model.world.low_x, model.world.high_x
        model.world.patch(3, -2).taken
        model.world.taken[x - model.world.low_x, y - model.world.low_y]
        model.world.taken = False
        model.world.sum("food"), also mean, min, max: as rules compute them, patch by patch

    Where agents may stand, and how they move, rules and users call alike: `geometry` has it.

    Args:
        fields: the fields of a patch.
        numbers: where it is, by the names under which rules read it; see `extent`.
        form: what its patches share with those of other worlds; their own unless given.
    """

    width: int
    height: int
    low_x: int
    low_y: int

    def __init__(
        self,
        fields: dict[str, Field],
        numbers: Mapping[str, int],
        form: PatchForm | None = None,
    ) -> None:
        form = form or PatchForm(fields)
        self.fields = fields
        self.numbers = dict(numbers)
        for name, value in numbers.items():
            object.__setattr__(self, name, value)
        self._space = tuple(self.numbers[name] for name in SPACE)
        self.rows = np.zeros(self.width * self.height, form.dtype)
        for field in fields.values():
            set_default(self.rows, field)
        self._bare, self._held = form.bare, form.held
        self.row_class: type[PatchRow] = self._held
        self._see_columns()

    def _see_columns(self) -> None:
        names = self.rows.dtype.names or ()
        self.columns = {name: self.rows[name] for name in names}

    def __reduce__(self) -> tuple[Any, ...]:
        return _world_of, (type(self), self.fields, self.numbers, self.snapshot())

    def __getattr__(self, name: str) -> Any:
        """Return a field of all patches: a copy, and read-only."""
        fields = self.__dict__.get("fields", {})
        if name.startswith("_"):
            raise AttributeError(f"no attribute {name!r}")
        if name in AGGREGATES and name not in fields:
            return partial(self._aggregated, name)
        if name not in fields:
            raise unknown(name, "world", type(self), fields)
        values = self.layer(name).copy()
        if fields[name].optional:
            values = values.astype(object)
            values[~self.layer(presence(name))] = None
        return column(values, f"society.world.{name}")

    def __setattr__(self, name: str, value: Any) -> None:
        """Set a field of all patches: one value for all, or an array (width, height)."""
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
            fields: by name, one value for all, or an array (width, height), column by column from
                the south-west, as the field itself is given.

        Raises:
            UnknownNameError: there is no such field.
            ValueRefusedError: an array of another shape, or a value that the field cannot hold.
        """
        check_fields(fields, self.fields, "the world")
        checked = {}
        sides = self.width, self.height
        for name, values in fields.items():
            shape = np.shape(values)
            if len(shape) >= 2 and shape[:2] == sides:
                values = np.asarray(values).reshape((len(self.rows), *shape[2:]))
            elif len(shape) > (self.fields[name].size is not None):
                raise ValueRefusedError(
                    f"the field {name!r} of the world: found the shape {shape}; expected "
                    f"{sides}, or one value for all"
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

    def load(
        self,
        field: str,
        source: Any,
        low: float | None = None,
        high: float | None = None,
        folder: Path = HERE,
    ) -> None:
        """Set a field of all patches from a map.

        Args:
            field: its name.
            source: a CSV file of numbers or a picture, of which the top is north, each with a
                value for each patch; or an array, (width, height), by column from the south-west.
            low: what black is in a picture; 0 unless given.
            high: what white is; 1 unless given.
            folder: where files lie, unless their path is absolute; the working folder.

        Raises:
            UnknownNameError: there is no such field.
            SocialmindError: the file cannot be read, is of another size, or holds what the field
                cannot; nothing was written.
        """
        check_fields([field], self.fields, "the world")
        sides = self.width, self.height
        self.set(**{field: raster(source, self.fields[field], *sides, low, high, folder)})

    def layer(self, name: str) -> NDArray[Any]:
        """Return a column of the patches themselves, (width, height), not checked when written."""
        found = self.columns[name]
        return found.reshape((self.width, self.height, *found.shape[1:]))

    def hand_out(self, bare: bool) -> None:
        """Give out patches as rules hold them, or, as else, as users do."""
        self.row_class = self._bare if bare else self._held

    def patch(self, x: float, y: float) -> PatchRow:
        """Return the patch around a point."""
        return self.row_class(self, self.place_of(x, y))

    def place_of(self, x: float, y: float) -> int:
        """Return the place of the patch around a point among all patches."""
        return int(patch_index(x, y, *self._space))

    def in_radius(self, agent: Any, radius: float) -> Iterator[PatchRow]:
        """Yield the patches whose centre is at most a radius from an agent or a patch."""
        return self.around(agent.x, agent.y, radius)

    def around(self, x: float, y: float, radius: float) -> Iterator[PatchRow]:
        """Yield the patches whose centre is at most a radius from a point."""
        for place in patches_in_radius(x, y, radius, *self._space):
            yield self.row_class(self, place)

    def neighbours(self, who: Any, steps: int = 1) -> list[PatchRow]:
        """Return the patches around that of an agent, or around a patch, column by column.

        Args:
            who: an agent or a patch, whose own patch is not among them.
            steps: at most so many king's moves away, 0 or more.
        """
        return self._around(who, steps, 0)

    def neighbours4(self, who: Any) -> list[PatchRow]:
        """Return the patches that share a side with that of an agent, or with a patch."""
        return self._around(who, 1, 1)

    def _around(self, who: Any, steps: int, four: int) -> list[PatchRow]:
        place = float(who.x), float(who.y), steps, four, *self._space
        count = count_around(*place)
        return [self.row_class(self, nth_around(one, *place)) for one in range(count)]

    @property
    def patches(self) -> Iterator[PatchRow]:
        """Yield all patches, column by column."""
        for place in range(len(self.rows)):
            yield self.row_class(self, place)

    # Steps over fields ----------------------------------------------------------------------------

    def diffuse(self, field: str, share: float) -> None:
        """Let each patch give a share of a field to its 8 neighbours, as NetLogo does.

        Args:
            field: the name of a field of numbers with fractions.
            share: 0 … 1; each neighbour gets an eighth, what is for none stays.

        Raises:
            UnknownNameError: there is no such field.
            ValueError: the share lies beyond 0 … 1.
        """
        self._spread(field, share, 8)

    def diffuse4(self, field: str, share: float) -> None:
        """Let each patch give a share of a field to its 4 neighbours; see `diffuse`."""
        self._spread(field, share, 4)

    def _spread(self, field: str, share: float, count: int) -> None:
        layer = self.layer(field_called(field, self.fields, "patches", (float,)).name)
        wraps = self.numbers["wraps_x"], self.numbers["wraps_y"]
        layer[...] = diffused(layer, share_of(share), count, *wraps)

    def evaporate(self, field: str, share: float) -> None:
        """Take a share of a field from each patch.

        Args:
            field: the name of a field of numbers with fractions.
            share: 0 … 1.

        Raises:
            UnknownNameError: there is no such field.
            ValueError: the share lies beyond 0 … 1.
        """
        layer = self.layer(field_called(field, self.fields, "patches", (float,)).name)
        layer[...] = layer * (1.0 - share_of(share))

    def way(
        self,
        field: str,
        x: float,
        y: float,
        to_x: float,
        to_y: float,
        sight: int,
        beyond: float,
    ) -> float:
        """Return the heading of the first step of a cheapest way over the eight neighbours.

        Args:
            field: the name of the field that says what it costs to enter a patch; infinite where
                nobody can.
            x: from where.
            y: from where.
            to_x: to where.
            to_y: to where.
            sight: how many steps far the costs are known; 0 or less for all patches.
            beyond: what a step costs beyond, above 0.

        Returns:
            0, 45, … 315 degrees; −1 where there is no way, or no need for any.
        """
        costs = self.columns[field_called(field, self.fields, "patches", (float,)).name]
        return float(ways.way(costs, x, y, to_x, to_y, sight, beyond, *self._space))

    def _aggregated(self, what: str, field: str) -> Any:
        found = field_called(field, self.fields, "patches", (float, int, bool))
        return aggregated(what, self.columns[found.name].tolist(), found, "a world without patches")

    # Moving ---------------------------------------------------------------------------------------

    distance = geometry.distance
    offset = geometry.offset
    towards = geometry.towards
    face = geometry.face
    right = geometry.right
    left = geometry.left
    is_on = geometry.is_on
    is_inside = geometry.is_inside
    can_move = geometry.can_move
    forward = geometry.forward
    walk_to = geometry.walk_to

    def move_to(self, agent: Any, x: float, y: float) -> None:
        """Put an agent at a point, brought back into the world where that wraps.

        Raises:
            ValueRefusedError: the point lies outside the world; nothing was done.
        """
        whose = f"agent {agent.id} of {agent._table.shape.name!r}"
        new_x, new_y = self.kept("x", x, whose), self.kept("y", y, whose)
        agent.x = new_x
        agent.y = new_y

    def kept(self, axis: str, value: float, whose: str) -> float:
        """Return a coordinate as agents keep it.

        Args:
            axis: "x" or "y".
            value: the coordinate.
            whose: for an error.

        Raises:
            ValueRefusedError: it lies beyond a wall.
        """
        if axis == "x":
            low, size, wraps = self.low_x, self.width, self.numbers["wraps_x"]
        else:
            low, size, wraps = self.low_y, self.height, self.numbers["wraps_y"]
        if wraps:
            return float(brought_back(value, low, size))
        if not geometry.between(value, low, size):
            raise ValueRefusedError(
                f"{axis} of {whose}: found {shown(value)}, which lies outside the world; expected "
                f"{low - 0.5} up to below {low + size - 0.5}; ask world.is_inside(x, y) before"
            )
        return float(value)

    # State ----------------------------------------------------------------------------------------

    def snapshot(self) -> dict[str, NDArray[Any]]:
        """Return copies of the arrays that a checkpoint keeps."""
        return {"rows": self.rows.copy()}

    def misfit(self, state: Mapping[str, Any]) -> str | None:
        """Say what is wrong with arrays that are offered as a state, or None."""
        for name, own in self.snapshot().items():
            if name not in state:
                return f"world.{name} holds nothing"
            found = np.asarray(state[name])
            if found.dtype != own.dtype:
                return f"world.{name} holds other fields than the model has"
            if found.shape != own.shape:
                return f"world.{name} holds the shape {found.shape}"
        return None

    def restore(self, state: Mapping[str, NDArray[Any]]) -> None:
        """Take the patches of a checkpoint, which the ground has checked."""
        self.rows = np.array(state["rows"])
        self._see_columns()


def _world_of(
    kind: type[PatchWorld],
    fields: dict[str, Field],
    numbers: Mapping[str, int],
    state: Mapping[str, NDArray[Any]],
) -> PatchWorld:
    world = kind(fields, numbers)
    world.restore(state)
    return world
