"""A file's lines as values: whole numbers, numbers, truth values, names, colours.

What is not what it should be is noted, and a value in its place returned, so that reading goes on.
"""

from __future__ import annotations

import math
import re
from collections.abc import Collection
from urllib.parse import unquote_plus

from coglogo_py.border.errors import shown
from socialmind.metaciv.description import Hsb, Place
from socialmind.metaciv.findings import Findings, Severity
from socialmind.metaciv.reading.files import Document, Line

LONGEST_NAME = 200
"""Characters."""
INT = (-(2**31), 2**31 - 1)
"""The whole numbers that Java's int holds."""
NUMBER = re.compile(r"[+-]?(\d+\.?\d*|\.\d+)([eE][+-]?\d+)?[dDfF]?", re.ASCII)
WHOLE = re.compile(r"[+-]?\d{1,10}", re.ASCII)


class Record:
    """A document, read field by field.

    Args:
        document: the file.
        findings: where to note what is wrong.
    """

    def __init__(self, document: Document, findings: Findings) -> None:
        self.document = document
        self.findings = findings

    @property
    def name(self) -> str:
        """The name inside, or else the file's, without blanks around it."""
        line = self.document.first("Nom", "Name")
        return (unquote_plus(self.document.stem) if line is None else line.value).strip()

    @property
    def place(self) -> Place:
        """Where its name stands."""
        return self.document.place(self.document.first("Nom", "Name"))

    def check_name(self) -> None:
        """Say what is odd about the name."""
        if self.document.first("Nom", "Name") is None:
            found, expected = "no name", "a line `Nom : …`"
            remedy = f"it was called {shown(self.name)}, as the file"
            self.findings.warn(self.place, found, expected, remedy)
        self.checked_name(self.name, self.place)

    def checked_name(self, name: str, place: Place) -> str:
        """Return a name, and say if it cannot be one."""
        if len(name) > LONGEST_NAME:
            found = f"a name of {len(name)} characters"
            self.findings.error(place, found, f"at most {LONGEST_NAME}")
        elif not name.strip() or not name.isprintable():
            self.findings.error(place, shown(name), "a name of printed characters")
        return name[:LONGEST_NAME]

    def text(self, key: str, default: str = "") -> str:
        """Return the value of a key, to the end of its line, without what cannot be printed."""
        line = self.document.first(key)
        if line is None:
            return default
        return "".join(one if one.isprintable() else " " for one in line.rest)

    def whole(
        self, key: str, default: int | None = None, low: int = INT[0], high: int = INT[1]
    ) -> int:
        """Return a whole number; without a default the key is needed."""
        line = self.document.first(key)
        if line is None:
            if default is None:
                self._miss(key, "a whole number")
            return default or 0
        return self.whole_in(line, line.value, low, high)

    def number(self, key: str, default: float | None = None) -> float:
        """Return a number; without a default the key is needed."""
        line = self.document.first(key)
        if line is None:
            if default is None:
                self._miss(key, "a number")
            return default or 0.0
        return self.number_in(line, line.value)

    def truth(self, key: str) -> bool:
        """Return whether a key has the value true."""
        line = self.document.first(key)
        return line is not None and self.truth_in(line, line.value)

    def truth_in(self, line: Line, text: str) -> bool:
        """Return whether a text is `true`, and say so if it is neither this nor `false`."""
        word = text.strip().lower()
        if word not in ("true", "false"):
            place = self.document.place(line)
            self.findings.warn(place, shown(text), "true or false", "it was read as false")
        return word == "true"

    def colour(self, key: str) -> Hsb:
        """Return a colour, grey where there is none."""
        line = self.document.first(key)
        if line is None:
            return Hsb(0.0, 0.0, 0.5)
        parts = [as_number(one) for one in fields(line.value)]
        numbers = [one for one in parts if one is not None and 0 <= one <= 1]
        if len(parts) != 3 or len(numbers) != 3:
            place, expected = self.document.place(line), "three numbers from 0 to 1"
            self.findings.warn(place, shown(line.value), expected, "the colour was read as grey")
            return Hsb(0.0, 0.0, 0.5)
        return Hsb(*numbers)

    def whole_in(self, line: Line, text: str, low: int = INT[0], high: int = INT[1]) -> int:
        """Return the whole number that a text of a line is."""
        value = as_whole(text)
        if value is None or not low <= value <= high:
            self.findings.error(self.document.place(line), shown(text), bounds(low, high))
            return max(low, 0)
        return value

    def number_in(self, line: Line, text: str) -> float:
        """Return the number that a text of a line is."""
        value = as_number(text)
        if value is None:
            self.findings.error(self.document.place(line), shown(text), "a number")
            return 0.0
        return value

    def known(
        self, line: Line, name: str, names: Collection[str], what: str, instead: str | None = None
    ) -> str | None:
        """Return the declared name that a text means, or None; says so if there is none.

        Args:
            line: where it stands.
            name: the text.
            names: the declared names.
            what: what is meant, as "a plan".
            instead: what is done without; if given, this is a warning.
        """
        found = matching(name, names)
        if found is None:
            place = self.document.place(line)
            severity: Severity = "error" if instead is None else "warning"
            self.findings.unknown(place, name, names, what, severity, instead or "")
        return found

    def parts(self, line: Line, least: int, expected: str) -> list[str] | None:
        """Return the fields of a line, or None if there are too few; says so."""
        found = fields(line.value)
        if len(found) < least:
            self.findings.error(self.document.place(line), shown(line.value), expected)
            return None
        return found

    def _miss(self, key: str, expected: str) -> None:
        self.findings.error(self.document.place(), f"no line `{key} : …`", expected)


def fields(text: str) -> list[str]:
    """Return what stands between commas, without empty fields at the end.

    >>> fields("Corn,3,,"), fields("")
    (['Corn', '3'], [])
    """
    found = text.split(",")
    while found and not found[-1].strip():
        found.pop()
    return found


def as_whole(text: str) -> int | None:
    """Return a whole number that Java's int holds, or None.

    >>> as_whole("-12"), as_whole("2O"), as_whole("3000000000"), as_whole("1_0")
    (-12, None, None, None)
    """
    if not WHOLE.fullmatch(text.strip()):
        return None
    value = int(text)
    return value if INT[0] <= value <= INT[1] else None


def as_number(text: str) -> float | None:
    """Return a finite number, or None.

    >>> as_number("-0.5"), as_number("1e3"), as_number("NaN"), as_number("1e999")
    (-0.5, 1000.0, None, None)
    """
    bare = text.strip()
    if not NUMBER.fullmatch(bare):
        return None
    value = float(bare.rstrip("dDfF"))
    return value if math.isfinite(value) else None


def matching(name: str, names: Collection[str]) -> str | None:
    """Return the declared name that a text means, blanks around it apart, or None."""
    return name.strip() if name.strip() in names else None


def bounds(low: int, high: int) -> str:
    """Return which whole numbers are allowed, in words.

    >>> bounds(*INT), bounds(0, INT[1]), bounds(1, 9)
    ('a whole number', 'a whole number of 0 or more', 'a whole number from 1 to 9')
    """
    if (low, high) == INT:
        return "a whole number"
    return (
        f"a whole number of {low} or more"
        if high == INT[1]
        else (f"a whole number from {low} to {high}")
    )


def unlike(documents: list[Document], what: str, findings: Findings) -> dict[str, Record]:
    """Return the documents by name; of two with the same name the first counts.

    Args:
        documents: sorted by file.
        what: what each is, as "plan".
        findings: where to note the others.
    """
    found: dict[str, Record] = {}
    for document in documents:
        record = Record(document, findings)
        if record.name in found:
            first = found[record.name].document.file
            said = f"a second {what} called {shown(record.name)}"
            findings.warn(record.place, said, remedy=f"{first} counts")
        else:
            record.check_name()
            found[record.name] = record
    return found
