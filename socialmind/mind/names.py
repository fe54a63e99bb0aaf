"""What names and numbers of modules are held to."""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Collection
from typing import Any

from coglogo_py.border.errors import shown
from coglogo_py.border.numbers import is_number
from socialmind.errors import ModelError, nearest

_NAME = re.compile(r"[^\s:#/\\]([^:#/\\\n\r]*[^\s:#/\\])?")
_UNWRITABLE = ("Cc", "Cs", "Zl", "Zp")
"""Unicode's control characters, halves of surrogate pairs, and separators of lines, which files
cannot hold inside a name."""
_BYTE_ORDER_MARK = "\ufeff"


def check_name(name: Any, what: str, file: str | None, line: int | None) -> None:
    """Refuse a name that files cannot hold.

    Raises:
        ModelError: it is empty, has a colon, a hash, a slash or blanks around it, or a control
            character.
    """
    if isinstance(name, str):
        for character in name:
            if unicodedata.category(character) in _UNWRITABLE or character == _BYTE_ORDER_MARK:
                raise ModelError(
                    f"the character U+{ord(character):04X} in {name!r}, the name of {what}",
                    "a name without control characters",
                    None,
                    file,
                    line,
                )
    if not isinstance(name, str) or not _NAME.fullmatch(name):
        raise ModelError(
            f"{name!r} as the name of {what}",
            "a name without ':', '#', '/' and without blanks around it",
            file=file,
            line=line,
        )


def unknown(what: str, name: str, known: Collection[str]) -> ModelError:
    """Return the error that there is no module of a name, with the one that it resembles."""
    hint = nearest(name, known) if known else f"there is no {what}"
    return ModelError(f"the unknown {what} {name!r}", remedy=hint)


def check_share(value: Any, what: str, file: str | None, line: int | None) -> None:
    """Refuse what is no number in [0, 1].

    Raises:
        ModelError: so it is.
    """
    if not is_number(value) or not 0 <= value <= 1:
        raise ModelError(f"{shown(value)} as {what}", "a number, 0 … 1", file=file, line=line)
