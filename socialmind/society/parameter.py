"""Parameters: what a user may set: numbers with units and ranges, and choices among texts."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from numbers import Real
from typing import TYPE_CHECKING, Any

from coglogo_py.border.errors import nearest, shown
from coglogo_py.border.numbers import is_number, is_truth, is_whole
from socialmind.errors import ModelError, SocialmindError, UnknownNameError

if TYPE_CHECKING:
    from socialmind.fields import Field


@dataclass
class Parameter:
    """One parameter of a model.

    Attributes:
        default: its value unless a run sets another; its type is the parameter's type.
        unit: the unit of its values.
        low, high: the smallest and largest value, or None for no bound.
        doc: one line on what it means.
        choices: the texts among which its value is one; none for a number or a truth value.
        name: its name in the model.
    """

    default: float | int | bool | str
    unit: str = ""
    low: float | None = None
    high: float | None = None
    doc: str = ""
    choices: tuple[str, ...] = ()
    name: str = field(default="", compare=False)

    def __set_name__(self, owner: type, name: str) -> None:
        self.name = name

    def check(self) -> None:
        """Refuse a default of another kind or out of range.

        Raises:
            ModelError: so it is.
        """
        if self.choices:
            self._check_choices()
        for plain, kinds in ((bool, is_truth), (int, is_whole), (float, is_number)):
            if not self.choices and kinds(self.default):
                self.default = plain(self.default)
                break
        else:
            if not self.choices:
                raise ModelError(
                    f"{shown(self.default)} as the default of the parameter {self.name!r}",
                    "a number, True or False, or a text with choices=",
                )
        try:
            self.checked(self.default)
        except SocialmindError as error:
            raise ModelError(f"the default of the {error}") from None

    def _check_choices(self) -> None:
        if isinstance(self.choices, list):
            self.choices = tuple(self.choices)
        several = isinstance(self.choices, tuple) and len(self.choices) > 0
        if not several or not all(isinstance(one, str) and one for one in self.choices):
            raise ModelError(
                f"the choices {shown(self.choices)} of the parameter {self.name!r}",
                "texts",
                f"write parameter({shown(self.default)}, choices=('…', '…'))",
            )
        if len(set(self.choices)) < len(self.choices):
            found = f"the choices {shown(self.choices)} of the parameter {self.name!r}"
            raise ModelError(found, "each text once")
        if self.low is not None or self.high is not None:
            raise ModelError(f"bounds of the parameter {self.name!r}, a choice", "choices alone")

    def __get__(self, model: Any, owner: type) -> Any:
        if model is None:
            return self
        stored = model.context[self.name].item()
        return self.choices[stored] if self.choices else stored

    def stored(self, value: Any) -> float | int | bool:
        """Return a value, checked, as a model keeps it: a choice is its place among the texts."""
        made = self.checked(value)
        return self.choices.index(made) if isinstance(made, str) else made

    @property
    def field(self) -> Field:
        """What rules read of it."""
        from socialmind.fields import Field

        if self.choices:
            place = self.choices.index(str(self.default))
            return Field(self.name, int, "i8", place, choices=self.choices)
        storage = {float: "f8", int: "i8", bool: "?"}[self.kind]
        return Field(self.name, self.kind, storage, self.default)  # type: ignore[arg-type]

    def __set__(self, model: Any, value: Any) -> None:
        raise UnknownNameError(
            f"the parameter {self.name!r} stays as it is in a run; give it when the society is "
            f"made, {type(model).__name__}({self.name}={shown(value)}), or declare a variable of "
            "the model"
        )

    @property
    def kind(self) -> type:
        """The type of its values: float, int, bool or str."""
        return type(self.default)

    @property
    def range(self) -> str:
        """The range of its values, in words."""
        if self.choices:
            return " or ".join(self.choices)
        if self.kind is bool:
            return "true or false"
        if self.low is None and self.high is None:
            return "any"
        if self.high is None:
            return f"{self.low:g} or more"
        if self.low is None:
            return f"up to {self.high:g}"
        return f"{self.low:g} … {self.high:g}"

    def checked(self, value: Any) -> float | int | bool | str:
        """Return a value as the parameter's type.

        Raises:
            SocialmindError: it is of another type, not finite, or out of range.

        >>> Parameter(1.5, low=0, name="price").checked(2)
        2.0
        """
        kind = self.kind
        if self.choices:
            if isinstance(value, str) and value in self.choices:
                return str(value)
            expected = f"one of {', '.join(self.choices)}"
            near = nearest(value, self.choices) if isinstance(value, str) else None
            raise self._wrong(value, f"{expected}; {near}" if near else expected)
        if kind is bool:
            if not is_truth(value):
                raise self._wrong(value, "true or false")
            return bool(value)
        real = isinstance(value, Real) and not is_truth(value)
        if not real:
            raise self._wrong(value, "a whole number" if kind is int else "a number")
        if not is_number(value) and not is_whole(value):
            raise self._wrong(value, "a finite number")
        if kind is float and not is_number(value):
            raise self._wrong(value, "a number that a float can hold")
        if kind is int and value != int(value):
            raise self._wrong(value, "a whole number")
        made: float | int = kind(value)
        too_low = self.low is not None and made < self.low
        if too_low or (self.high is not None and made > self.high):
            raise self._wrong(value, f"{self.range}{f' {self.unit}' if self.unit else ''}")
        if kind is int and not -(2**63) <= made < 2**63:
            raise self._wrong(value, "at most 64 bits")
        return made

    def read(self, text: str) -> float | int | bool | str:
        """Return a value written as text, as on the command line.

        >>> Parameter(25, low=1, name="n_agents").read("30")
        30
        """
        if self.choices:
            return self.checked(text)
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
        return SocialmindError(f"parameter {self.name}: found {shown(value)}; expected {expected}")


def parameter(
    default: float | int | bool | str,
    *,
    unit: str = "",
    low: float | None = None,
    high: float | None = None,
    doc: str = "",
    choices: Sequence[str] = (),
) -> Any:
    """Declare a parameter of a model; see `Parameter`.

    >>> from socialmind import Model
    >>> class Market(Model):
    ...     price: float = parameter(167.0, unit="wheat a tool", low=0.0)
    ...     trade: str = parameter("market", choices=("market", "barter"))
    >>> Market.parameters["price"].default
    167.0
    >>> Market.parameters["trade"].range
    'market or barter'
    """
    given: Any = choices  # checked with the class
    return Parameter(default, unit, low, high, doc, given)
