"""What a fit varies: ranges of parameters and of words of schemes, as points of a unit cube."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from coglogo_py.border.errors import shown
from coglogo_py.border.numbers import is_number
from socialmind.errors import SocialmindError
from socialmind.experiments.sweeps.points.table import refuse_twice
from socialmind.experiments.sweeps.points.varied import WORD, Nameable, Varied

LOG = "log"
NO_NUMBERS = ("at_birth", "conditional")
"""Words of schemes that are truth values."""

Range = Sequence[Any] | None
"""The lowest and the highest value, and "log" for a scale of ratios; None for those declared."""


@dataclass(frozen=True)
class Dimension:
    """One thing that varies.

    Attributes:
        varied: what.
        low: its lowest value.
        high: its highest.
        log: whether equal steps are equal ratios.
    """

    varied: Varied
    low: float
    high: float
    log: bool = False

    @property
    def name(self) -> str:
        """What it is called."""
        return self.varied.name

    def value(self, place: float) -> float | int:
        """Return the value at a place, 0 … 1, of the range.

        A whole number is found in the slice of the range that belongs to it.
        """
        low, high = self._ends()
        found = low + place * (high - low)
        if self.log:
            found = math.exp(found)
        if self.varied.whole:
            return min(max(math.floor(found), int(self.low)), int(self.high))
        return min(max(found, self.low), self.high)

    def place(self, value: float) -> float:
        """Return the place of a value, 0 … 1; of a whole number the middle of its slice."""
        low, high = self._ends()
        if self.varied.whole and self.log:
            return ((math.log(value) + math.log(value + 1)) / 2 - low) / (high - low)
        if self.varied.whole:
            return (value + 0.5 - low) / (high - low)
        return ((math.log(value) if self.log else value) - low) / (high - low)

    def _ends(self) -> tuple[float, float]:
        high = self.high + 1 if self.varied.whole else self.high
        return (math.log(self.low), math.log(high)) if self.log else (self.low, high)


@dataclass(frozen=True)
class Space:
    """All that varies.

    Attributes:
        dimensions: one for each.
    """

    dimensions: tuple[Dimension, ...]

    @property
    def names(self) -> list[str]:
        """What they are called."""
        return [one.name for one in self.dimensions]

    def values(self, place: ArrayLike) -> tuple[float | int, ...]:
        """Return the values at a place of the unit cube."""
        found = np.asarray(place, np.float64).tolist()
        return tuple(one.value(at) for one, at in zip(self.dimensions, found, strict=True))

    def place(self, values: Sequence[float]) -> NDArray[np.float64]:
        """Return the place of values in the unit cube."""
        pairs = zip(self.dimensions, values, strict=True)
        return np.array([one.place(value) for one, value in pairs])

    def record(self) -> list[dict[str, Any]]:
        """Return what a manifest says of it."""
        return [
            {"name": one.name, "low": one.low, "high": one.high, "log": one.log}
            for one in self.dimensions
        ]


def space_of(vary: Mapping[str, Range], there: Nameable) -> Space:
    """Return what varies.

    Args:
        vary: the range of each name.
        there: what can be named.

    Raises:
        SocialmindError: an unknown name, what is no number, a range that cannot be.
    """
    if not vary:
        raise SocialmindError("nothing varies; give --vary NAME=LOW:HIGH, once at least")
    found = tuple(_dimension(there.called(name), given) for name, given in vary.items())
    refuse_twice([one.varied for one in found])
    return Space(found)


def read_vary(texts: Sequence[str]) -> dict[str, Range]:
    """Read `NAME=LOW:HIGH`, `NAME=LOW:HIGH:log`, or `NAME` alone for what is declared.

    Raises:
        SocialmindError: it is none of them, or a name stands twice.

    >>> read_vary(["tool_price=100:250", "food_decay=1e-4:0.01:log"])
    {'tool_price': [100.0, 250.0], 'food_decay': [0.0001, 0.01, 'log']}
    """
    found: dict[str, Range] = {}
    for text in texts:
        name, equals, said = (part.strip() for part in text.partition("="))
        if name in found:
            raise SocialmindError(f"--vary {name}: stands twice; give it once")
        ends: list[Any] = [part.strip() for part in said.split(":")] if equals else []
        if not name or (equals and not 2 <= len(ends) <= 3):
            raise SocialmindError(f"--vary {text}: expected NAME=LOW:HIGH, or NAME=LOW:HIGH:log")
        try:
            found[name] = [*map(float, ends[:2]), *ends[2:]] if equals else None
        except ValueError:
            raise SocialmindError(f"--vary {text}: expected two numbers, {name}=LOW:HIGH") from None
    return found


def _dimension(one: Varied, given: Range) -> Dimension:
    _refuse_what_is_no_number(one)
    if given is None:
        if one.parameter is None or one.parameter.low is None or one.parameter.high is None:
            raise SocialmindError(
                f"{one.name}: no lower and upper border is declared; give --vary "
                f"{one.name}=LOW:HIGH"
            )
        given = one.parameter.low, one.parameter.high
    ends: Any = given if 2 <= len(given) <= 3 else (None, None)
    low, high, *scale = ends
    if not is_number(low) or not is_number(high) or not math.isfinite(high - low):
        raise SocialmindError(f"range of {one.name}: found {shown(given)}; expected two numbers")
    if scale not in ([], [LOG]):
        raise SocialmindError(f"range of {one.name}: found {shown(scale[0])}; expected log")
    if low >= high:
        hint = f"write {high:g}:{low:g}" if low > high else f"use --set {one.name}={low:g}"
        raise SocialmindError(
            f"range of {one.name}: found {low:g}:{high:g}; expected the lower end first; {hint}"
        )
    if scale and low <= 0:
        raise SocialmindError(
            f"range of {one.name}: found {low:g}:{high:g}:log; expected ends above 0 for log"
        )
    for end in (low, high):
        one.checked(int(end) if one.whole and end == int(end) else end)
    return Dimension(one, float(low), float(high), bool(scale))


def _refuse_what_is_no_number(one: Varied) -> None:
    if one.parameter is not None:
        fits = one.parameter.kind in (int, float)
    else:
        word = one.word
        fits = one.kind == WORD and word is not None and word.first not in NO_NUMBERS
        fits = fits and one.name.rpartition("decision_maker.")[2] != "name"
    if not fits:
        raise SocialmindError(
            f"{one.name}: a fit varies numbers, and this is none; fix it by --set, or fit once "
            "for each of its values"
        )
