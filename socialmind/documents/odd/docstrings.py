"""What docstrings say of classes and rules."""

from __future__ import annotations

import inspect
import re
from typing import Any

_SECTION = re.compile(
    r"^(Args|Arguments|Attributes|Returns|Yields|Raises|Warns|Example|Examples|Note|Notes):\s*$"
)


def said(thing: Any) -> str:
    """Return a docstring as one paragraph, without its examples and lists of arguments.

    >>> def live(human):
    ...     '''Eat, then
    ...     sleep.
    ...
    ...     Args:
    ...         human: who.
    ...     '''
    >>> said(live)
    'Eat, then sleep.'
    """
    lines: list[str] = []
    for line in (inspect.getdoc(thing) or "").splitlines():
        if _SECTION.match(line) or line.startswith(">>>"):
            break
        lines.append(line.strip())
    return " ".join(" ".join(lines).split())


def own(kind: type) -> str:
    """Return what a class's own docstring says, not that of a base."""
    return said(kind) if kind.__doc__ else ""


def attributes(kind: type) -> dict[str, str]:
    """Return what the docstrings of a class and its bases say of fields, in their `Attributes:`.

    >>> class Market:
    ...     '''A place that trades.
    ...
    ...     Attributes:
    ...         wheat, tools: what is
    ...             in store.
    ...     '''
    >>> attributes(Market)
    {'wheat': 'what is in store', 'tools': 'what is in store'}
    """
    found: dict[str, str] = {}
    for base in reversed(kind.__mro__):
        lines = inspect.cleandoc(base.__doc__ or "").splitlines()
        if "Attributes:" not in lines:
            continue
        names: list[str] = []
        for line in lines[lines.index("Attributes:") + 1 :]:
            if line and not line.startswith(" "):
                break
            match = re.match(r"^ {4}(\w+(?:, \w+)*): (.*)$", line)
            if match:
                names = match[1].split(", ")
                found |= dict.fromkeys(names, match[2])
            elif line.strip():
                found |= {name: f"{found[name]} {line.strip()}" for name in names}
    return {name: text.removesuffix(".") for name, text in found.items()}
