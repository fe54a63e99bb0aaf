"""What a user may set on a finished society, and what is refused with the line to write."""

from __future__ import annotations

import inspect
from typing import Any

from coglogo_py.border.numbers import whole_number
from socialmind.errors import SocialmindError, UnknownNameError, nearest
from socialmind.society.declaration import SETTINGS
from socialmind.society.parameter import Parameter

REPLACED = ("connected", "watch", "watched")
"""What a society keeps and replaces while it runs."""


def admitted(society: Any, kept: frozenset[str], name: str, value: Any) -> Any:
    """Return what an attribute may be set to, or refuse it.

    A society takes its variables, what its class declares, what `__init__` made, and names with a
    leading underscore, which are the modeller's own.

    Args:
        society: the society.
        kept: the names under which it keeps what is its own.
        name: the attribute.
        value: what it is to be.

    Raises:
        UnknownNameError: it stays, is a method, or there is none.
    """
    kind = type(society)
    there = getattr(kind, name, None)
    if name in REPLACED or isinstance(there, Parameter | property):
        return value  # these speak for themselves
    if name in kind.populations:
        raise UnknownNameError(
            f"the population {name!r} of {kind.name} stays; set fields of its agents: "
            f"society.{name}.FIELD = …"
        )
    if name in kind.networks:
        raise UnknownNameError(
            f"the network {name!r} of {kind.name} stays; set its links: society.{name}.set_from(…)"
        )
    if name == "world":
        raise UnknownNameError(
            f"the world of {kind.name} stays; set fields of its patches: society.world.FIELD = …"
        )
    if name in ("ticks", "score_every"):
        return whole_number(value, name, 0, error=SocialmindError)
    if name in kept or name in SETTINGS:
        raise UnknownNameError(
            f"{name!r} of {kind.name} stays as it was when the society was made; make another"
        )
    if inspect.isroutine(there) and not callable(value):
        raise UnknownNameError(f"{name!r} of {kind.name}, which is a method; call it")
    if there is None and name not in vars(society):
        known = [*kind.variables, *kind.parameters, *kind.populations]
        raise UnknownNameError(
            f"{kind.name} has no variable {name!r}; {nearest(name, known)}; declare it in the "
            f"class ({name}: float = 0.0), set it in __init__, or call it _{name}"
        )
    return value
