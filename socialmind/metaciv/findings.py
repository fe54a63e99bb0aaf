"""What was found in a folder of MetaCiv's: errors, warnings and what is not supported."""

from __future__ import annotations

from collections import Counter
from collections.abc import Collection, Iterator
from dataclasses import dataclass, replace
from difflib import get_close_matches
from itertools import islice
from typing import Literal

from coglogo_py.border.errors import LONGEST_VALUE, MOST_COMPARED, PlacedError, shown
from socialmind.metaciv.description import Place

MOST_OF_A_FILE = 100
"""Findings that are listed of one file."""
MOST_HINTS = 500
"""Findings up to which names are compared with those that there are, which takes its time."""
MOST_NAMES = 8
"""Known names that a remedy lists; of more it lists the nearest."""

Severity = Literal["error", "warning", "unsupported"]


@dataclass(frozen=True, slots=True)
class Finding:
    """One thing that was found; printed, it is one line.

    Args:
        severity: an "error" stops the import; a "warning" says how something was read;
            "unsupported" is what the written model does not do.
        place: file and line.
        found: what stands there; a sentence of its own where nothing is expected.
        expected: what should stand there.
        remedy: what to write, or what was read instead.

    >>> print(Finding("error", Place("objets/Corn.metaciv", 3), "'x'", "a number", "write 1"))
    objets/Corn.metaciv:3: found 'x'; expected a number; write 1
    """

    severity: Severity
    place: Place
    found: str
    expected: str | None = None
    remedy: str | None = None

    def __str__(self) -> str:
        return str(PlacedError(self.found, self.expected, self.remedy, *self.place))

    @property
    def told(self) -> str:
        """What it says, without its place."""
        return str(PlacedError(self.found, self.expected, self.remedy))


class Findings:
    """Findings, gathered while a folder is read."""

    def __init__(self) -> None:
        self._found: list[Finding] = []
        self._of_file: Counter[str] = Counter()

    def __iter__(self) -> Iterator[Finding]:
        """Yield them by file and line; of a file `MOST_OF_A_FILE` and how many more there are."""
        yield from sorted(self._found, key=lambda one: one.place)

    @property
    def errors(self) -> int:
        """How many are errors."""
        return sum(one.severity == "error" for one in self._found)

    def add(self, one: Finding) -> None:
        """Note one, unless the file has had its share."""
        count = self._of_file[one.place.file] = self._of_file[one.place.file] + 1
        if count <= MOST_OF_A_FILE:
            self._found.append(one)
        elif count == MOST_OF_A_FILE + 1:
            found = f"more than {MOST_OF_A_FILE} findings in this file; the rest is not listed"
            self._found.append(Finding("error", one.place, found))

    def error(
        self, place: Place, found: str, expected: str | None = None, remedy: str | None = None
    ) -> None:
        """Note what stops the import."""
        self.add(Finding("error", place, found, expected, remedy))

    def warn(
        self, place: Place, found: str, expected: str | None = None, remedy: str | None = None
    ) -> None:
        """Note how something odd was read."""
        self.add(Finding("warning", place, found, expected, remedy))

    def unsupported(self, place: Place, found: str, remedy: str) -> None:
        """Note what the written model does not do."""
        self.add(Finding("unsupported", place, found, None, remedy))

    def unknown(
        self,
        place: Place,
        name: str,
        known: Collection[str],
        what: str,
        severity: Severity = "error",
        instead: str = "",
    ) -> None:
        """Note a name that nothing has, with those that resemble it.

        Args:
            place: where it is named.
            name: the name.
            known: names that there are.
            what: what should have the name, as "a cogniton".
            severity: of the finding.
            instead: what was done instead, if anything.
        """
        compared = self._of_file[place.file] < MOST_OF_A_FILE and len(self._found) < MOST_HINTS
        likely = hint(name, known) if compared else ""
        remedy = "; ".join(one for one in (likely, instead) if one)
        self.add(Finding(severity, place, shown(name), f"the name of {what}", remedy or None))

    def take(self, others: Findings, why_no_errors: str | None = None) -> None:
        """Note all of others, as warnings that say why if they do not matter."""
        for one in others:
            if why_no_errors is not None and one.severity != "warning":
                remedy = "; ".join(text for text in (one.remedy, why_no_errors) if text)
                one = replace(one, severity="warning", remedy=remedy)
            self.add(one)


def hint(name: str, known: Collection[str]) -> str:
    """Return the known names that a wrong one resembles, or what there is.

    >>> hint("A_Mover", ["A_Move", "A_Move_Cardinals_Random", "A_Die"])
    "did you mean 'A_Move'?"
    >>> hint("Curoius", ["Alive"])
    "there is 'Alive'"
    >>> hint("Curoius", [])
    'there is none'
    """
    names = list(islice(known, MOST_COMPARED))
    close = get_close_matches(name, names, n=3) if len(name) <= LONGEST_VALUE else []
    if close:
        return f"did you mean {_listed(close)}?"
    if not names:
        return "there is none"
    if len(names) <= MOST_NAMES:
        return f"there is {', '.join(map(shown, names))}"
    nearest = get_close_matches(name[:LONGEST_VALUE], names, n=3, cutoff=0.0)
    return f"of {len(known)} the nearest are {', '.join(map(shown, nearest))}"


def _listed(names: list[str]) -> str:
    """Return names as one says alternatives."""
    quoted = [shown(one) for one in names]
    return quoted[0] if len(quoted) == 1 else f"{', '.join(quoted[:-1])} or {quoted[-1]}"
