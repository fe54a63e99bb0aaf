"""A plane's arrays: what the compiled kernel finds by address, filled from plain data."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from socialmind.errors import ModelError
from socialmind.worlds.plane.bodies import Disc
from socialmind.worlds.plane.kernel.code import kernel
from socialmind.worlds.plane.kernel.stones import candidates
from socialmind.worlds.plane.layout import (
    BODY,
    EYES,
    KIND,
    LANES,
    OBSTACLE,
    PLANE,
    RAY,
    STONE_COLUMNS,
)

MOST_KINDS = 63
"""Kinds of bodies on a plane: `meets` has a bit for each."""
MOST_CELLS = 256
"""Cells a side of the table of obstacles."""
_BORDERLESS_CELLS = 64
_ENTRIES_PER_CELL = 8


@dataclass(frozen=True, eq=False)
class Bodies:
    """A population of bodies.

    Attributes:
        name: what the `meets` of other kinds call it.
        disc: what its bodies are made of. Two kinds collide if either meets the other.
        rows: (slots,) records; from the column `x` on, they have the columns of `BODY`.
        alive: (slots,) truth values: which of them live.
        offset: bytes from the begin of a record to its column `x`.
    """

    name: str
    disc: Disc
    rows: NDArray[Any]
    alive: NDArray[np.bool_]
    offset: int


@dataclass(frozen=True, eq=False)
class Obstacles:
    """The population of obstacles; as for `Bodies`, with the columns of `OBSTACLE`."""

    rows: NDArray[Any]
    alive: NDArray[np.bool_]
    offset: int


STANDING = "numbers up to a thousand million, and a half-width of 0 (for nothing) or more"
"""What the place, angle and half-width of an obstacle are."""


class Eyes:
    """The range finders of a kind of bodies; any number of planes may share them.

    Args:
        kind: the kind's number.
        rays: (rays,) records `RAY`; a sensor's rays stand next to each other.
        readings: bytes from the column `x` of a body's record to the first of its readings.

    Raises:
        ModelError: there is no ray; a number is not finite; a reach is not above 0; or the rays of
            a sensor reach differently far or do not stand next to each other.
    """

    def __init__(self, kind: int, rays: NDArray[Any], readings: int) -> None:
        rays = np.atleast_1d(np.asarray(rays, RAY))
        for name in ("x", "y", "cos", "sin", "reach"):
            if not np.isfinite(rays[name]).all():
                raise ModelError(f"a ray's {name} that is no number", "finite numbers")
        sensors = list(dict.fromkeys(rays["sensor"].tolist()))
        groups = [np.flatnonzero(rays["sensor"] == sensor) for sensor in sensors]
        if not groups:
            raise ModelError("eyes without a ray", "at least one ray")
        for sensor, group in zip(sensors, groups, strict=True):
            if group[-1] - group[0] != len(group) - 1:
                raise ModelError(
                    f"rays of sensor {sensor} that are apart", "a sensor's rays next to each other"
                )
            reaches = np.unique(rays["reach"][group])
            if len(reaches) != 1 or reaches[0] <= 0:
                raise ModelError(
                    f"reaches {reaches.tolist()} of sensor {sensor}", "one number above 0"
                )
        depth = max(map(len, groups))
        # A sensor with fewer rays has its last one several times.
        order = [group[min(ray, len(group) - 1)] for ray in range(depth) for group in groups]
        order += [order[0]] * (-len(order) % LANES)
        chosen = rays[order]
        self._lanes = _aligned((5, len(order)))
        for row, name in enumerate(("x", "y", "cos", "sin", "reach")):
            self._lanes[row] = chosen[name]
        self._sensors = np.array(sensors, np.int64)
        self._record = np.zeros(1, EYES)
        self._record[0] = (
            kind, self._lanes.ctypes.data, len(order),
            self._sensors.ctypes.data, len(sensors), depth, readings,
        )  # fmt: skip
        self.address = int(self._record.ctypes.data)
        self.kind = kind
        self.lane_count = len(order)
        self.reach = float((np.hypot(rays["x"], rays["y"]) + rays["reach"]).max())
        """How far from the body's centre they see at most."""


class PlaneArrays:
    """The arrays of one world.

    They refer to the arrays of the populations, which must stay where they are; where a population
    has moved to larger ones, `attach` says so.

    Args:
        half_width: of the arena, units; 0 for one without borders.
        dt: seconds a tick.
        cell: side of the table's cells, units, as a wish: it settles how many there are.
        kinds: the populations of bodies.
        obstacles: the population of obstacles, or None.
        eyes: those with which `look` is called for this plane.

    Raises:
        ModelError: a number outside its range, kinds of one name or too many, or a kind that meets
            one that is not there.
    """

    def __init__(
        self,
        half_width: float,
        dt: float,
        cell: float,
        kinds: Sequence[Bodies],
        obstacles: Obstacles | None = None,
        eyes: Sequence[Eyes] = (),
    ) -> None:
        if not 0 <= half_width < math.inf:
            raise ModelError(f"half_width={half_width!r} of a plane", "a number, 0 or more")
        for one in kinds:
            if 0 < half_width <= one.disc.radius:
                raise ModelError(
                    f"a half-width of {half_width:g}, in which {one.name!r} of radius "
                    f"{one.disc.radius:g} find no room",
                    "more than the radius, or 0 for a plane without borders",
                )
        for name, number in (("dt", dt), ("cell", cell)):
            if not 0 < number < math.inf:
                raise ModelError(f"{name}={number!r} of a plane", "a number above 0")
        self.eyes = tuple(eyes)
        """Those that see in it."""
        self._kernel = kernel()
        self._kinds = np.zeros(len(kinds), KIND)
        self._attached: dict[int | None, Any] = {}
        radii = [one.disc.radius for one in kinds]
        self._record = np.zeros(1, PLANE)
        plane = self._record[0]
        plane["half_width"], plane["dt"], plane["cell"] = half_width, dt, -1.0
        plane["reach"] = max([0.0, *radii, *(one.reach for one in self.eyes)])
        plane["kinds"], plane["kind_count"] = self._kinds.ctypes.data, len(kinds)
        wanted = math.ceil(min(2 * half_width / cell, MOST_CELLS)) or _BORDERLESS_CELLS
        self._begin = np.zeros(wanted**2 + 1, np.int32)
        plane["cells"], plane["cell_begin"] = wanted, self._begin.ctypes.data
        self._best = _aligned((max([LANES, *(one.lane_count for one in self.eyes)]),))
        plane["best"] = self._best.ctypes.data
        self.make_room(_ENTRIES_PER_CELL * wanted**2)
        for number, (one, meets) in enumerate(zip(kinds, meetings(kinds), strict=True)):
            disc, record = one.disc, self._kinds[number]
            record["seen"], record["meets"] = disc.seen, meets
            record["mass"], record["moment"] = disc.mass, disc.moment
            for name in ("radius", "linear_damping", "angular_damping", "restitution"):
                record[name] = getattr(disc, name)
            self.attach(number, one.rows, one.alive, one.offset)
        if obstacles is not None:
            self.attach(None, obstacles.rows, obstacles.alive, obstacles.offset)
        else:
            self._make_stones(0)

    @property
    def address(self) -> int:
        """The address of the plane's record, which stays where it is."""
        return int(self._record.ctypes.data)

    def attach(
        self, kind: int | None, rows: NDArray[Any], alive: NDArray[np.bool_], offset: int
    ) -> None:
        """Take the arrays of a kind, or with None those of the obstacles, from now on.

        Obstacles count from the next `build` on.

        Raises:
            ModelError: the arrays are not laid out as the kernel reads them.
        """
        columns = OBSTACLE if kind is None else BODY
        if rows.ndim != 1 or alive.dtype != np.bool_ or alive.shape != rows.shape:
            raise ModelError(
                f"rows {rows.shape} and {alive.dtype.name} {alive.shape} of who lives",
                "one truth value for each row",
            )
        if len(rows) > 1 and not alive.flags.c_contiguous:
            raise ModelError("truth values with gaps between them", "an array of its own")
        held: Mapping[str, Any] = rows.dtype.fields or {}
        for name, (kind_of, place, *_) in (columns.fields or {}).items():
            if name not in held or held[name][0] != kind_of or held[name][1] != offset + place:
                raise ModelError(
                    f"rows without the column {name} {offset + place} bytes from their begin",
                    f"the columns {', '.join(columns.names or ())} next to each other",
                )
        self._attached[kind] = (rows, alive)
        record = self._record[0]
        first = rows.ctypes.data + offset
        if kind is None:
            record["obstacles"], record["obstacle_stride"] = first, rows.strides[0]
            record["obstacle_alive"] = alive.ctypes.data
            self._make_stones(len(rows))
        else:
            one = self._kinds[kind]
            one["rows"], one["stride"], one["capacity"] = first, rows.strides[0], len(rows)
            one["alive"] = alive.ctypes.data
            self._state = np.zeros(max(1, int(self._kinds["capacity"].sum())))
            record["state"] = self._state.ctypes.data

    def build(self) -> None:
        """Work out what stands where, after obstacles were placed.

        Raises:
            ModelError: an obstacle's place, angle or half-width is not finite, or that is below 0.
        """
        found = self._kernel.build.ctypes(self.address, 0, 0)
        if found > 0:
            self.make_room(found)
            found = self._kernel.build.ctypes(self.address, 0, 0)
        if found < 0:
            raise ModelError(f"obstacle {-1 - found} at {self._obstacle(-1 - found)}", STANDING)

    def _obstacle(self, slot: int) -> str:
        """Return the numbers of an obstacle in words."""
        row = self._attached[None][0][slot]
        x, y, angle, half = (float(row[name]) for name in ("x", "y", "angle", "half_width"))
        return f"({x:g}, {y:g}), angle {angle:g}, half-width {half:g}"

    @property
    def stones(self) -> NDArray[np.float64]:
        """The living obstacles as `build` found them, a row of `layout.STONE_COLUMNS` for each."""
        return self._stones[: int(self._record[0]["stone_count"])]

    def stones_near(self, x: float, y: float) -> list[int]:
        """Return which rows of `stones` a body at a place may meet or see, and a few more."""
        plane = self._record.view(np.recarray)[0]
        first, end = candidates(plane, self._begin, x, y)
        listed = self._stones_of_cells if plane.cell > 0 else np.arange(end)
        return [int(stone) for stone in listed[first:end]]

    def make_room(self, entries: int) -> None:
        """Make room for so many entries of the table of cells, which holds from the next `build`.

        Until then there is no table, and the plane works slowly.
        """
        self._stones_of_cells = np.zeros(entries, np.int32)
        plane = self._record[0]
        plane["cell_stones"], plane["cell_room"] = self._stones_of_cells.ctypes.data, entries
        plane["cell"] = -1.0

    def _make_stones(self, capacity: int) -> None:
        self._stones = _aligned((max(1, capacity), STONE_COLUMNS))
        plane = self._record[0]
        plane["stones"], plane["obstacle_capacity"] = self._stones.ctypes.data, capacity
        plane["stone_count"] = 0


def _aligned(shape: tuple[int, ...]) -> NDArray[np.float64]:
    """Return an array of zeros that begins with a cache line, as vector operations like it."""
    size = math.prod(shape)
    whole = np.zeros(size + LANES)
    first = -whole.ctypes.data // whole.itemsize % LANES
    return whole[first : first + size].reshape(shape)


def meetings(kinds: Sequence[Any]) -> list[int]:
    """Return the kinds that each kind collides with, as bits.

    Args:
        kinds: each with the `name` that others know it by and the `disc` that it is made of.

    Raises:
        ModelError: two have one name, there are too many, or one meets what there is not.
    """
    numbers = {one.name: number for number, one in enumerate(kinds)}
    if len(numbers) != len(kinds):
        names = ", ".join(one.name for one in kinds)
        raise ModelError(f"kinds of bodies {names}", "a name for each")
    if len(kinds) > MOST_KINDS:
        raise ModelError(f"{len(kinds)} kinds of bodies", f"at most {MOST_KINDS}")
    meets = [0] * len(kinds)
    for number, one in enumerate(kinds):
        for name in one.disc.meets:
            if name not in numbers:
                raise ModelError(
                    f"bodies {one.name!r} that meet {name!r}",
                    f"a population of bodies: {', '.join(numbers)}",
                )
            meets[number] |= 1 << numbers[name]
            meets[numbers[name]] |= 1 << number
    return meets
