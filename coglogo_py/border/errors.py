"""What coglogo_py raises when something the user gave it is wrong."""

from __future__ import annotations

import sys
from difflib import get_close_matches
from itertools import islice
from pathlib import Path
from typing import TYPE_CHECKING, Self

from coglogo_py.border.places import place

if TYPE_CHECKING:
    from collections.abc import Iterable


LONGEST_MESSAGE = 1000
"""Characters of an error's message; what a user gave may be a million long."""
LONGEST_VALUE = 80
"""Characters of a value within a message."""


MOST_COMPARED = 2000
"""Known names that a wrong one is compared with."""


class CogLogoError(ValueError):
    """Anything about a scheme or a mind that the user can put right; its message is one line."""

    def __init__(self, message: str = "") -> None:
        super().__init__(one_line(message))


class MindError(CogLogoError):
    """A command to a mind that cannot be carried out; the mind is as it was before."""


class ChoiceError(MindError):
    """A decision maker of the modeller's own gave no position, or no probabilities.

    Args:
        found: what it gave, and what was expected.
        place: file and line of the function.
    """

    def __init__(self, found: str, place: str) -> None:
        self.found, self.place = found, place
        super().__init__(f"{place}: {found}")

    def __reduce__(self) -> tuple[type[ChoiceError], tuple[object, ...]]:
        """Keep the fields when the error crosses a process boundary."""
        return type(self), (self.found, self.place)


class PlacedError(Exception):
    """Something in a user's files is wrong: says where, what, and what to do.

    Args:
        found: what stands there; a sentence of its own where nothing is expected instead.
        expected: what should stand there.
        remedy: what to write or do instead.
        file: the file at fault.
        line: its line, counted from 1.
    """

    def __init__(
        self,
        found: str,
        expected: str | None = None,
        remedy: str | None = None,
        file: str | Path | None = None,
        line: int | None = None,
    ) -> None:
        self.found = found
        self.expected = expected
        self.remedy = remedy
        self.file = None if file is None else str(file)
        self.line = line
        super().__init__(self._message())

    def _message(self) -> str:
        where = place(self.file, self.line)
        parts = [self.found if self.expected is None else f"found {self.found}"]
        if self.expected is not None:
            parts.append(f"expected {self.expected}")
        if self.remedy is not None:
            parts.append(self.remedy)
        message = "; ".join(parts)
        return f"{where}: {message}" if where else message

    def at(self, file: str | Path, line: int | None = None) -> Self:
        """Return the same error, placed in a file."""
        return type(self)(self.found, self.expected, self.remedy, file, line)

    def __reduce__(self) -> tuple[type[Self], tuple[object, ...]]:
        """Keep the fields when the error crosses a process boundary."""
        return type(self), (self.found, self.expected, self.remedy, self.file, self.line)


class SchemeError(PlacedError, CogLogoError):
    """A cognitive scheme, or the file of one, is wrong; arguments as of `PlacedError`.

    >>> print(SchemeError("'maybe'", "true or false", "write true", "herd.cogscheme", 8))
    herd.cogscheme:8: found 'maybe'; expected true or false; write true
    >>> print(SchemeError("the scheme has two groups called 'herd'"))
    the scheme has two groups called 'herd'
    """


def one_line(message: str) -> str:
    r"""Return a message as one line of at most `LONGEST_MESSAGE` characters.

    >>> one_line("bad indent\n  at line 3")
    'bad indent at line 3'
    """
    flat = " ".join(message.split()) if "\n" in message or "\r" in message else message
    return shortened(flat, LONGEST_MESSAGE)


def shortened(text: str, longest: int) -> str:
    """Return a text, its middle left out where it is longer than so many characters."""
    if len(text) <= longest:
        return text
    half = (longest - 3) // 2
    return f"{text[:half]} … {text[-half:]}"


def shown(value: object) -> str:
    r"""Return a value as an error message shows it: in one line, and not at any length.

    >>> shown("a\nb"), shown(10**5000)
    ("'a\\nb'", 'a whole number of more than 4300 digits')
    """
    if isinstance(value, str):
        value = shortened(value, 2 * LONGEST_VALUE)  # the whole repr of a megabyte takes its time
    try:
        text = repr(value)
    except ValueError:  # Python writes no whole numbers of more digits
        return f"a whole number of more than {sys.get_int_max_str_digits()} digits"
    except Exception:
        return f"a {type(value).__name__}"
    return shortened(" ".join(text.split()) if "\n" in text else text, LONGEST_VALUE)


def nearest(name: str, known: Iterable[str]) -> str | None:
    """Return the advice that follows from the known name most like a wrong one.

    >>> nearest("conditionnal", ["influence", "conditional"])
    "did you mean 'conditional'?"
    >>> nearest("colour", []) is None
    True
    """
    if len(name) > LONGEST_VALUE:
        return None
    matches = get_close_matches(name, islice(known, MOST_COMPARED), n=1)
    return f"did you mean {matches[0]!r}?" if matches else None
