"""Several names that a user gives: a sequence of texts, not a text, which is one of letters."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

from coglogo_py.border.errors import shown
from socialmind.errors import ModelError, called_at


def several(names: Iterable[Any] | str, what: str) -> tuple[Any, ...]:
    """Return names as a tuple.

    Args:
        names: what was given.
        what: how to call it in the error, such as the argument's name.

    Raises:
        ModelError: a text, or nothing that can be gone through, with the line of the call.

    >>> several(["S1", "S2"], "sensors")
    ('S1', 'S2')
    """
    if isinstance(names, str):
        remedy = f"write {what}=[{names!r}]"
        raise ModelError(
            f"the text {shown(names)} as {what}", "several names", remedy, *called_at()
        )
    if not isinstance(names, Iterable):
        raise ModelError(f"{shown(names)} as {what}", "several names", None, *called_at())
    return tuple(names)
