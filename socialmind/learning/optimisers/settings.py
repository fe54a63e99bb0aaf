"""Settings of optimisers: numbers with a default, a range and a meaning."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from coglogo_py.border.errors import shown
from coglogo_py.border.numbers import is_number
from socialmind.errors import ModelError


@dataclass(frozen=True)
class Setting:
    """A number that an optimiser is set by.

    Args:
        meaning: what it decides, and where its default comes from.
        default: its value where none is given.
        low, high: its range, both ends included.
        whole: whether it is a whole number.
        automatic: whether 0 is taken too, and leaves the choice to the optimiser.

    >>> Setting("how many genomes", 200, low=2, whole=True).checked("population", 50.0)
    50
    """

    meaning: str
    default: float
    low: float = 0.0
    high: float = math.inf
    whole: bool = False
    automatic: bool = False

    def checked(self, name: str, value: Any) -> float:
        """Return a value in the setting's type.

        Args:
            name: the setting's name, for the error.
            value: the value.

        Raises:
            ModelError: it is no number, or outside the range.
        """
        if is_number(value) and (not self.whole or value == int(value)):
            inside = self.low <= value <= self.high
            if inside or (self.automatic and value == 0):
                return int(value) if self.whole else float(value)
        raise ModelError(f"{name}={shown(value)} of an optimiser", self.expected, self.meaning)

    @property
    def expected(self) -> str:
        """What values are taken, in words."""
        kind = "a whole number" if self.whole else "a number"
        span = (
            f"{self.low:g} or more"
            if math.isinf(self.high)
            else f"from {self.low:g} to {self.high:g}"
        )
        return f"{kind}, {span}{', or 0' if self.automatic else ''}"


def checked(known: Mapping[str, Setting], given: Mapping[str, Any]) -> dict[str, float]:
    """Return all settings: those given, and the defaults of the others.

    Args:
        known: the settings of an optimiser, by name.
        given: values by name.

    Raises:
        ModelError: a name is unknown, or a value is outside its range.

    >>> known = {"share": Setting("the share that breeds", 0.3, high=1.0)}
    >>> checked(known, {}), checked(known, {"share": 1})
    ({'share': 0.3}, {'share': 1.0})
    """
    for name in given:
        if name not in known:
            raise ModelError(f"the setting {name!r} of an optimiser", f"one of {', '.join(known)}")
    return {
        name: setting.checked(name, given.get(name, setting.default))
        for name, setting in known.items()
    }
