"""Colourings: what a page can colour agents and patches by, as a number or a word for each."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from socialmind.errors import SocialmindError, nearest, place_of
from socialmind.looks import Looks
from socialmind.model import Model

PATCHES = "patches"
LOOKS = "looks"
"""What agents or patches are coloured by where the model says how they look."""
NOTHING = 255
"""The place of who has none of the words, or no number."""
LAST = 254
"""The last place along a scale."""


@dataclass(frozen=True)
class Coloured:
    """A value for each of many.

    Attributes:
        values: u1, places among the words, `NOTHING` for none; or f4, NaN for none.
        words: what can be; none where values are numbers.
        colours: of the words, or along the scale, as ``#rrggbb``; the usual ones unless given.
        ends: values at the ends of the scale, where they are given.
    """

    values: NDArray[Any]
    words: Sequence[str] = ()
    colours: Sequence[str] = ()
    ends: tuple[float | None, float | None] = (None, None)

    @property
    def range(self) -> tuple[float, float]:
        """The values at the ends of the scale of numbers."""
        known = self.values[np.isfinite(self.values)]
        least, most = (float(known.min()), float(known.max())) if len(known) else (0.0, 1.0)
        low, high = self.ends
        return least if low is None else low, most if high is None else high

    def places(self, low: float, high: float) -> NDArray[np.uint8]:
        """Return where each number stands along a scale, from 0 to `LAST`, or `NOTHING`.

        Where all numbers are one they stand at the beginning of a model's own scale, and in the
        middle of the usual one.
        """
        if high > low:
            along = (self.values - np.float32(low)) * np.float32(LAST / (high - low))
        else:
            along = np.full(len(self.values), 0 if self.colours else LAST / 2, np.float32)
        known = np.isfinite(self.values)
        rounded = np.clip(np.where(known, along, 0) + 0.5, 0, LAST + 0.5).astype(np.uint8)
        rounded[~known] = NOTHING
        return rounded


def colourings(society: Model, population: str) -> list[str]:
    """Return what the agents of a population can be coloured by.

    "looks" is as the model says, where it does; "one" is one colour for all; "plan"; for a group
    "role GROUP"; "cogniton NAME" and "field NAME".
    """
    own = [LOOKS] if _has_colour(society, population) else []
    return [*own, *_usual(society, population)]


def _usual(society: Model, population: str) -> list[str]:
    table = society.tables[population]
    found = ["one"]
    if table.society is not None:
        names = table.society.names
        found += ["plan", *(f"role {group}" for group in names.groups)]
        found += [f"cogniton {one.name}" for one in table.society.scheme.cognitons]
    return found + [f"field {name}" for name in _shown(table.shape.fields)]


def of_agents(society: Model, population: str, colouring: str) -> Coloured:
    """Return a value for each of the living, in order of birth.

    Args:
        society: as it is.
        population: of it.
        colouring: one of `colourings`.

    Raises:
        SocialmindError: it is none.
    """
    table = society.tables[population]
    looks = looks_of(society).get(population) if colouring == LOOKS else None
    if looks is not None and looks.colour is not None:
        return _as_said(looks, population, len(table))
    if colouring not in (known := _usual(society, population)):
        raise SocialmindError(
            f"{population!r} coloured by {colouring!r}; {nearest(colouring, known)}"
        )
    what, _, name = colouring.partition(" ")
    if what == "one":
        return Coloured(np.zeros(len(table), np.uint8), (population,))
    if what == "plan":
        plans = table.columns["_plan"][table.slots]
        return Coloured(_places(plans), society.schemes[population].plans)
    if what == "cogniton":
        return Coloured(table.cogniton(name).astype(np.float32))
    if what == "role":
        return _roles(table, name)
    return _field(table.shape.fields[name], table.columns, table.slots, table)


def of_patches(society: Model, name: str) -> Coloured:
    """Return a value for each patch, column by column from the south-west.

    Args:
        society: in a world of patches.
        name: a field of the patches.
    """
    world = society.ground.world
    looks = looks_of(society).get(PATCHES) if name == LOOKS else None
    if looks is not None and looks.colour is not None:
        return _as_said(looks, PATCHES, len(world.rows))
    if name not in (known := _shown(world.fields)):
        raise SocialmindError(f"patches coloured by {name!r}; {nearest(name, known)}")
    return _field(world.fields[name], world.columns, slice(None), None)


def patch_fields(society: Model) -> list[str]:
    """Return what patches can be coloured by: "looks", where the model says how, and fields."""
    fields = _shown(getattr(getattr(society.ground, "world", None), "fields", {}))
    return [LOOKS, *fields] if _has_colour(society, PATCHES) else fields


def looks_of(society: Model) -> dict[str, Looks]:
    """Return how a model says that it looks.

    Raises:
        SocialmindError: its method failed, or names what there is not.
    """
    kind = type(society)
    if kind.looks is Model.looks:
        return {}
    try:
        found = society.looks()
    except Exception as error:  # the modeller's
        raise SocialmindError(f"{place_of(error)}: looks() of {kind.name}: {error}") from error
    known = [*society.populations, PATCHES]
    for name, one in found.items():
        if name not in known:
            raise SocialmindError(f"looks() of {kind.name}: {name!r}; {nearest(name, known)}")
        if not isinstance(one, Looks):
            raise SocialmindError(
                f"looks() of {kind.name}: {name!r} has {one!r}; expected Looks(…)"
            )
    return found


def _has_colour(society: Model, name: str) -> bool:
    found = looks_of(society).get(name)
    return found is not None and found.colour is not None


def _as_said(looks: Looks, name: str, count: int) -> Coloured:
    if isinstance(looks.colour, str):
        return Coloured(np.zeros(count, np.uint8), (name,), looks.palette)
    values = looks.values(name, count)
    if looks.is_scale:
        return Coloured(values, (), looks.palette, (looks.low, looks.high))
    return Coloured(_places(values), looks.words, looks.palette)


def _shown(fields: Mapping[str, Any]) -> list[str]:
    placing = ("x", "y", "heading", "angle")
    return [n for n, one in fields.items() if one.size is None and n not in placing]


def _field(field: Any, columns: Mapping[str, Any], slots: Any, table: Any) -> Coloured:
    from socialmind.fields import presence

    values = columns[field.name][slots]
    there = columns[presence(field.name)][slots] if field.optional else None
    if field.choices or field.kind is bool:
        places = _places(values.astype(np.int64))
        words = field.choices or ("no", "yes")
        if there is not None:
            places[~there] = NOTHING
        return Coloured(places, words)
    numbers = values.astype(np.float32)
    if there is not None:
        numbers[~there] = np.nan
    return Coloured(numbers)


def _roles(table: Any, group: str) -> Coloured:
    names, minds = table.society.names, table.society.minds
    slots, place = table.columns["_mind"][table.slots], names.groups[group]
    roles = names.roles[group]
    words = tuple(roles)
    position = {at: number for number, at in enumerate(roles.values())}
    held = np.where(minds.group_slot[slots, place] >= 0, minds.role[slots, place], -1)
    return Coloured(
        np.array([position.get(one, NOTHING) for one in held.tolist()], np.uint8), words
    )


def _places(values: NDArray[Any]) -> NDArray[np.uint8]:
    return np.where((values >= 0) & (values < NOTHING), values, NOTHING).astype(np.uint8)
