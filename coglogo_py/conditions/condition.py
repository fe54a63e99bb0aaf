"""A condition as a scheme writes it: a field of the agent compared with a number."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from dataclasses import field as declared

from coglogo_py.border.errors import SchemeError, shown

OPERATORS = ("<", "<=", ">", ">=", "==", "!=")
"""What a condition may ask; their places are their codes in `heeding`."""

_WRITTEN = re.compile(r"\s*([^\W\d]\w*)\s*(<=|>=|==|!=|<|>)\s*(\S+)\s*")
_NUMBER = re.compile(r"[+-]?([0-9]+\.?[0-9]*|\.[0-9]+)([eE][+-]?[0-9]+)?")
_NAME = re.compile(r"[^\W\d]\w*")


@dataclass(frozen=True)
class Condition:
    """A field of the agent compared with a number, or with a parameter of the model.

    Args:
        field: the field's name.
        operator: one of `OPERATORS`.
        bound: the number, or the name of the parameter.
        line: where it stands in the scheme's file, if in one.

    >>> Condition.parsed("energy < 5", "active_while of cogniton 'Hunger'")
    Condition(field='energy', operator='<', bound=5.0)
    """

    field: str
    operator: str
    bound: float | str
    line: int | None = declared(default=None, compare=False, repr=False)

    def __str__(self) -> str:
        bound = str(self.bound).removesuffix(".0")
        return f"{self.field} {self.operator} {bound}"

    @classmethod
    def parsed(cls, text: object, where: str, line: int | None = None) -> Condition:
        """Return the condition that a text writes.

        Args:
            text: what was written.
            where: how to call it in the error.
            line: where it stands in a file.

        Raises:
            SchemeError: the text is no such comparison.
        """
        if isinstance(text, Condition):
            return text
        found = _WRITTEN.fullmatch(text) if isinstance(text, str) else None
        if found is not None:
            name, operator, bound = found.groups()
            if _NUMBER.fullmatch(bound) and abs(float(bound)) < float("inf"):
                return cls(name, operator, float(bound), line)
            if _NAME.fullmatch(bound):
                return cls(name, operator, bound, line)
        raise SchemeError(
            f"{shown(text)} as {where}",
            "a field of the agent, one of < <= > >= == !=, and a number or a parameter",
            "write energy < 5 or energy < hunger_limit",
        )


Conditions = tuple[Condition, ...]


def conditions_in(written: object, where: str) -> Conditions:
    """Return the conditions that one text, or several, write; all of them must hold."""
    if not isinstance(written, Iterable) or isinstance(written, str | Mapping):
        written = (written,)
    return tuple(Condition.parsed(one, where) for one in written)
