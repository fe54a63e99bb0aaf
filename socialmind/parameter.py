"""Parameters: the numbers a user may set, with units and ranges."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import Any

from coglogo_py.errors import shown
from socialmind.errors import ModelError, SocialmindError, UnknownNameError


@dataclass
class Parameter:
    """One parameter of a model.

    Attributes:
        default: its value unless a run sets another; its type is the parameter's type.
        unit: the unit of its values.
        low, high: the smallest and largest value, or None for no bound.
        doc: one line on what it means.
        name: its name in the model.
    """

    default: float | int | bool
    unit: str = ""
    low: float | None = None
    high: float | None = None
    doc: str = ""
    name: str = field(default="", compare=False)

    def __set_name__(self, owner: type, name: str) -> None:
        self.name = name

    def check(self) -> None:
        """Refuse a default of another kind or out of range.

        Raises:
            ModelError: so it is.
        """
        if type(self.default) not in (float, int, bool):
            raise ModelError(
                f"{self.default!r} as the default of the parameter {self.name!r}",
                "a number, True or False",
            )
        try:
            self.checked(self.default)
        except SocialmindError as error:
            raise ModelError(f"the default of the {error}") from None

    def __get__(self, model: Any, owner: type) -> Any:
        return self if model is None else model.context[self.name].item()

    def __set__(self, model: Any, value: Any) -> None:
        raise UnknownNameError(
            f"the parameter {self.name!r} stays as it is in a run; give it when the society is "
            f"made, {type(model).__name__}({self.name}={shown(value)}), or declare a variable of "
            "the model"
        )

    @property
    def kind(self) -> type:
        """The type of its values: float, int or bool."""
        return type(self.default)

    @property
    def range(self) -> str:
        """The range of its values, in words."""
        if self.kind is bool:
            return "true or false"
        if self.low is None and self.high is None:
            return "any"
        if self.high is None:
            return f"{self.low:g} or more"
        if self.low is None:
            return f"up to {self.high:g}"
        return f"{self.low:g} … {self.high:g}"

    def checked(self, value: Any) -> float | int | bool:
        """Return a value as the parameter's type.

        Raises:
            SocialmindError: it is of another type, not finite, or out of range.

        >>> Parameter(1.5, low=0, name="price").checked(2)
        2.0
        """
        kind = self.kind
        if kind is bool:
            if not isinstance(value, bool):
                raise self._wrong(value, "true or false")
            return value
        if isinstance(value, bool) or not isinstance(value, int | float):
            raise self._wrong(value, "a whole number" if kind is int else "a number")
        if not math.isfinite(value):
            raise self._wrong(value, "a finite number")
        if kind is int and value != int(value):
            raise self._wrong(value, "a whole number")
        made: float | int = kind(value)
        too_low = self.low is not None and made < self.low
        if too_low or (self.high is not None and made > self.high):
            raise self._wrong(value, f"{self.range}{f' {self.unit}' if self.unit else ''}")
        if kind is int and not -(2**63) <= made < 2**63:
            raise self._wrong(value, "at most 64 bits")
        return made

    def read(self, text: str) -> float | int | bool:
        """Return a value written as text, as on the command line.

        >>> Parameter(25, low=1, name="n_agents").read("30")
        30
        """
        if self.kind is bool:
            words = {"true": True, "yes": True, "on": True, "1": True}
            words |= {"false": False, "no": False, "off": False, "0": False}
            if text.lower() not in words:
                raise self._wrong(text, "true or false")
            return words[text.lower()]
        try:
            number = int(text)
        except ValueError:
            try:
                return self.checked(float(text))
            except ValueError:
                raise self._wrong(
                    text, "a whole number" if self.kind is int else "a number"
                ) from None
        return self.checked(number)

    def _wrong(self, value: Any, expected: str) -> SocialmindError:
        return SocialmindError(f"parameter {self.name}: found {value!r}; expected {expected}")


def parameter(
    default: float | int | bool,
    *,
    unit: str = "",
    low: float | None = None,
    high: float | None = None,
    doc: str = "",
) -> Any:
    """Declare a parameter of a model; see `Parameter`.

    >>> from socialmind import Model
    >>> class Market(Model):
    ...     price: float = parameter(167.0, unit="wheat a tool", low=0.0)
    >>> Market.parameters["price"].default
    167.0
    """
    return Parameter(default, unit, low, high, doc)
