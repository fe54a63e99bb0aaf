"""Civilisations: peoples of one population, each with a place, its founders and their beginnings.

MetaCiv's (thesis, chapter 3). To which one an agent belongs is a field of it, `civilisation`, one
of their names; a hatched agent belongs to its parent's.
"""

from __future__ import annotations

import math
import re
import zlib
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np

from coglogo_py.border.errors import shown
from coglogo_py.border.numbers import is_number, is_whole
from socialmind.errors import ModelError, ValueRefusedError, called_at, nearest
from socialmind.fields import Field
from socialmind.streams import FOUNDING_TAG, FOUNDING_TAGS, Stream
from socialmind.values import fitted

if TYPE_CHECKING:
    from socialmind.society.table import Table

FIELD = "civilisation"
"""The field of an agent that says to which it belongs."""


@dataclass(frozen=True)
class Civilisation:
    """A people of a population.

    Args:
        name: its name.
        agents: how many founders it has: a number, or the name of a parameter.
        place: where they begin, (x, y).
        scattered: how far they stand from the place at most, in x and in y, drawn for each; None
            for the smallest square of patches around it with one for each of them.
        colour: how figures draw it, as "#c04000"; none of its own unless given.
        cognitons: values of cognitons with which they begin, by name; they are active then.
        values: values of fields with which they begin, by name.

    Raises:
        ModelError: a value of a wrong kind, with the file and line of the civilisation.
    """

    name: str
    agents: int | str
    place: tuple[float, float] = (0.0, 0.0)
    scattered: float | None = None
    colour: str | None = None
    cognitons: Mapping[str, float] = field(default_factory=dict)
    values: Mapping[str, Any] = field(default_factory=dict)
    _at: tuple[str | None, int | None] = field(
        default_factory=called_at, init=False, repr=False, compare=False
    )

    def __post_init__(self) -> None:
        if not isinstance(self.name, str) or not self.name:
            raise self.error(f"{shown(self.name)} as the name of a civilisation", "a text")
        if not isinstance(self.agents, str) and not (is_whole(self.agents) and self.agents >= 0):
            expected = "a whole number, 0 or more, or the name of a parameter"
            raise self.error(f"agents={shown(self.agents)} of {self.name!r}", expected)
        pair = isinstance(self.place, tuple | list) and len(self.place) == 2
        if not pair or not all(is_number(one) for one in self.place):
            raise self.error(f"place={shown(self.place)} of {self.name!r}", "two numbers, (x, y)")
        far = self.scattered
        if far is not None and not (is_number(far) and far >= 0):
            raise self.error(f"scattered={shown(far)} of {self.name!r}", "a number, 0 or more")
        colour = self.colour
        if colour is not None and not re.fullmatch("#[0-9a-fA-F]{6}", str(colour)):
            raise self.error(f"colour={shown(colour)} of {self.name!r}", "one as '#c04000'")
        given = (self.cognitons, self.values)
        for what, mapping in zip(("cognitons", "values"), given, strict=True):
            if not isinstance(mapping, Mapping):
                remedy = f"write {what}={{'NAME': 1.0}}"
                raise self.error(
                    f"{what}={shown(mapping)} of {self.name!r}", "values by name", remedy
                )
        for cogniton, value in self.cognitons.items():
            if not is_number(value):
                found = f"{shown(value)} as the cogniton {cogniton!r} of {self.name!r}"
                raise self.error(found, "a finite number")

    def error(self, found: str, expected: str | None, remedy: str | None = None) -> ModelError:
        """Return an error of this civilisation, with its file and line."""
        return ModelError(found, expected, remedy, *self._at)

    def check(self, fields: Mapping[str, Field], minded: bool) -> None:
        """Refuse values that the agents cannot have.

        Args:
            fields: those of an agent.
            minded: whether agents have cogniton minds.
        """
        if self.cognitons and not minded:
            raise self.error(
                f"cognitons of {self.name!r}, whose agents have no minds",
                None,
                "name the population's scheme: mind='scheme.yaml'",
            )
        for name, value in self.values.items():
            what = f"the field {name!r} of {self.name!r}"
            if name not in fields:
                raise self.error(what, "a field of its agents", nearest(name, fields))
            try:
                fitted(fields[name], value, what)
            except ValueRefusedError as error:
                raise self.error(f"a value for {error}", None) from None


def civilisation_field(civilisations: tuple[Civilisation, ...]) -> Field:
    """Return the field that says to which civilisation an agent belongs."""
    return Field(FIELD, int, "i8", 0, choices=tuple(one.name for one in civilisations))


def found(
    table: Table, civilisations: tuple[Civilisation, ...], sizes: list[int], seed: int
) -> None:
    """Let the founders of a population begin: their civilisation, place, values and cognitons.

    Args:
        table: the population, all of whose agents are founders.
        civilisations: in the order in which they found it.
        sizes: how many founders each has.
        seed: the society's.
    """
    stream = Stream(seed)
    tag = FOUNDING_TAG + zlib.crc32(table.shape.name.encode()) % FOUNDING_TAGS
    first = 0
    for number, (one, size) in enumerate(zip(civilisations, sizes, strict=True)):
        slots = np.arange(first, first + size)
        first += size
        table.columns[FIELD][slots] = number
        far = half_square(size) if one.scattered is None else float(one.scattered)
        places = np.zeros((size, 2))
        for row, slot in enumerate(slots.tolist()):
            stream.begin(tag, slot, 0)
            places[row] = [centre + stream.uniform(-far, far) for centre in one.place]
        begun = {name: [value] * size for name, value in one.values.items()}
        table.set_from({"id": slots, "x": places[:, 0], "y": places[:, 1], **begun}, "id")
        minds, society = table.columns["_mind"][slots] if one.cognitons else None, table.society
        if society is not None and minds is not None:
            names = [cogniton.name for cogniton in society.scheme.cognitons]
            for cogniton, value in one.cognitons.items():
                if cogniton in names:  # a scheme in place of the model's may lack it
                    society.minds.values[minds, names.index(cogniton)] = value


def half_square(agents: int) -> float:
    """Return half the side of the smallest square of patches around one with room for so many.

    >>> half_square(1), half_square(9), half_square(10)
    (0.5, 1.5, 2.5)
    """
    return math.ceil((math.sqrt(agents) - 1) / 2) + 0.5 if agents > 0 else 0.5
