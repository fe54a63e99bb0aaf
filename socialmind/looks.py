"""How a model says it looks: shapes, sizes and colours of agents, colours of patches."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from socialmind.errors import SocialmindError, nearest

SHAPES = (
    "disc", "arrow", "square", "ring", "triangle", "diamond", "person", "animal", "house", "tree",
)  # fmt: skip
COLOURS: Mapping[str, str] = {
    "blue": "#0072b2",
    "orange": "#d55e00",
    "green": "#009e73",
    "pink": "#cc79a7",
    "sky": "#56b4e9",
    "gold": "#e0a800",
    "purple": "#6e3c8c",
    "red": "#b22b19",
    "brown": "#8a5a2b",
    "earth": "#b99b6b",
    "grass": "#8fbf6a",
    "sand": "#e9dcc0",
    "grey": "#787878",
    "pale": "#d5d9dd",
    "black": "#1d2125",
    "white": "#ffffff",
}
"""Colours by name: the first seven are told apart by the colour-blind."""


@dataclass(frozen=True)
class Looks:
    """How agents of a population, or patches, look in the studio.

    Args:
        shape: one of `SHAPES`; by default an arrow for who has a heading, else a disc.
        colour: one for all; a mapping from words to colours, of which `by` says which each has (0
            for the first; True for the second); or several, a scale along which `by` says where
            each stands. A colour is a name of `COLOURS` or ``#rrggbb``; None leaves them as they
            are.
        by: a value for each of the living in order of birth, or for each patch.
        size: how far each reaches across, in patches; a number, or one for each.
        low: the value of `by` at the beginning of a scale; by default the least.
        high: that at its end; by default the greatest.

    Raises:
        SocialmindError: no such shape or colour, or values are missing.

    >>> Looks("person", {"unhappy": "orange", "content": "blue"}, by=[True, False]).palette
    ('#d55e00', '#0072b2')
    """

    shape: str | None = None
    colour: str | Mapping[str, str] | Sequence[str] | None = None
    by: Any = None
    size: Any = None
    low: float | None = None
    high: float | None = None

    def __post_init__(self) -> None:
        if self.shape is not None and self.shape not in SHAPES:
            raise SocialmindError(f"looks: shape {self.shape!r}; {nearest(self.shape, SHAPES)}")
        if not isinstance(self.colour, str | None) and self.by is None:
            raise SocialmindError(
                f"looks: {len(self.colour)} colours, and nothing says which each has; give by="
            )
        if self.is_scale and len(self.palette) < 2:
            raise SocialmindError("looks: a scale of one colour; give two or more, or a text")
        for one in self.palette:
            if not re.fullmatch("#[0-9a-f]{6}", one):
                raise SocialmindError(f"looks: colour {one!r}; {nearest(one, COLOURS)}, or #rrggbb")

    @property
    def is_scale(self) -> bool:
        """Whether the colours are a scale."""
        return not isinstance(self.colour, str | Mapping | None)

    @property
    def words(self) -> tuple[str, ...]:
        """What the colours mean, where each is a word's."""
        return tuple(self.colour) if isinstance(self.colour, Mapping) else ()

    @property
    def palette(self) -> tuple[str, ...]:
        """The colours as ``#rrggbb``."""
        if self.colour is None:
            return ()
        said = [self.colour] if isinstance(self.colour, str) else self.colour
        colours = said.values() if isinstance(said, Mapping) else said
        return tuple(COLOURS.get(str(one), str(one).lower()) for one in colours)

    def values(self, of: str, count: int) -> np.ndarray[Any, Any]:
        """Return `by` as numbers, one for each.

        Raises:
            SocialmindError: they are no numbers, or not as many.
        """
        return _numbers(f"looks of {of!r}: by", self.by, count)

    def sizes(self, of: str, count: int) -> np.ndarray[Any, Any] | None:
        """Return the sizes, one for each; None for the usual one.

        Raises:
            SocialmindError: they are no numbers, or not as many.
        """
        if self.size is None:
            return None
        if np.ndim(self.size) == 0:
            return np.full(count, self.size, np.float32)
        return _numbers(f"looks of {of!r}: size", self.size, count)


def _numbers(what: str, given: Any, count: int) -> np.ndarray[Any, Any]:
    try:
        found = np.asarray(given).astype(np.float32).reshape(-1)  # patches have two sides
    except (TypeError, ValueError):
        raise SocialmindError(f"{what} holds no numbers") from None
    if found.shape != (count,):
        raise SocialmindError(f"{what} has {found.size} values; expected one for each of {count}")
    return found
