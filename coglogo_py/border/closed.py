"""Classes that take no attributes but their own, so that a misspelt one is an error."""

from __future__ import annotations

from typing import Any

from coglogo_py.border.errors import nearest, shown


class Closed:
    """The base of a class whose instances take the attributes that their `__init__` sets alone.

    Further ones are refused once `_closed` is set; names with a leading underscore are free.
    """

    _closed = False

    def __setattr__(self, name: str, value: Any) -> None:
        if self._closed and not name.startswith("_") and name not in self.__dict__:
            there = getattr(type(self), name, None)
            if not isinstance(there, property):
                known = [one for one in dir(self) if not one.startswith("_")]
                hint = nearest(name, known)
                raise AttributeError(
                    f"a {type(self).__name__} has no attribute {shown(name)} to set"
                    + (f"; {hint}" if hint else "")
                )
        object.__setattr__(self, name, value)
