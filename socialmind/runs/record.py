"""What a JSON record should hold, and the first field that holds something else.

A record is described by nested dictionaries of kinds. Fields that are not described are left alone:
a later version may have written them.
"""

from __future__ import annotations

import json
import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from pathlib import Path, PurePosixPath
from typing import Any

from coglogo_py.border.errors import shown
from coglogo_py.border.numbers import is_number, is_whole
from socialmind.errors import SocialmindError

LONGEST = 2**63 - 1
"""The largest whole number of a table."""


@dataclass(frozen=True)
class Kind:
    """A kind of value: how to call it, and which values are of it."""

    expected: str
    holds: Callable[[Any], bool]


@dataclass(frozen=True)
class Each:
    """A record with any names, each with a value of one kind."""

    kind: Expected


@dataclass(frozen=True)
class Many:
    """A list of values of one kind."""

    kind: Expected


@dataclass(frozen=True)
class Fields:
    """A record with known fields.

    Args:
        needed: those that must be there.
        others: those that may be missing.
    """

    needed: Mapping[str, Expected]
    others: Mapping[str, Expected] = field(default_factory=dict)


Expected = Kind | Each | Many | Fields


def whole(low: int = 0, high: int = LONGEST) -> Kind:
    """A whole number, low … high."""
    bound = f"{low} or more" if high == LONGEST else f"{low} … {high}"
    bound = bound.replace(str(2**64 - 1), "2**64 - 1")
    return Kind(f"a whole number, {bound}", lambda value: is_whole(value) and low <= value <= high)


def one_of(*names: str) -> Kind:
    """One of some texts."""
    return Kind(" or ".join(names), lambda value: isinstance(value, str) and value in names)


def optional(kind: Kind) -> Kind:
    """A value of a kind, or null."""
    return Kind(f"{kind.expected}, or null", lambda value: value is None or kind.holds(value))


ANY = Kind("a value", lambda value: True)
TEXT = Kind("a text", lambda value: isinstance(value, str))
PATH = Kind("a path", lambda value: isinstance(value, str) and "\0" not in value)
TRUTH = Kind("true or false", lambda value: isinstance(value, bool))
NUMBER = Kind("a number, 0 or more", lambda value: is_number(value) and value >= 0)
SHA256 = Kind(
    "a SHA-256 hash of 64 digits",
    lambda value: isinstance(value, str) and re.fullmatch("[0-9a-f]{64}", value) is not None,
)
TEXTS = Each(TEXT)
SEED = whole(0, 2**64 - 1)
ENGINE = one_of("compiled", "pymunk")
SOURCES = Fields({"version": whole(1), "sha256": SHA256, "files": Each(SHA256), "packages": TEXTS})
"""What decided how a model ran: `socialmind.sources.provenance.Sources.record`."""


def model_called(name: Kind) -> Fields:
    """Where a model was found, and what decided how it ran; its name is of a kind."""
    found = {"name": name, "path": optional(PATH), "source_sha256": optional(SHA256)}
    return Fields(found, {"sources": SOURCES})


SETTING = Kind(
    "a number, a truth value or a text",
    lambda value: isinstance(value, bool | str) or is_number(value),
)


def _stays(value: Any) -> bool:
    if not isinstance(value, str) or not value or not value.isprintable() or "\\" in value:
        return False
    path = PurePosixPath(value)
    return not path.is_absolute() and ".." not in path.parts and str(path) == value != "."


NAME_WITHIN = Kind("a name within the folder", _stays)
SHOCK = Fields({"tick": whole(), "function": TEXT, "file": NAME_WITHIN, "sources": SOURCES})
"""A shock that a folder keeps: `socialmind.runs.branching.kept`."""


def read_record(path: Path, what: str) -> dict[str, Any]:
    """Return the content of a JSON file that is a record.

    Args:
        path: the file.
        what: how to call it in the error.

    Raises:
        SocialmindError: the file is none.
    """
    try:
        content = json.loads(path.read_text(encoding="utf-8"))
    except RecursionError:
        raise SocialmindError(f"{path}: not {what} (nested too deep)") from None
    except ValueError as error:
        raise SocialmindError(f"{path}: not {what} ({error})") from error
    if not isinstance(content, dict):
        raise SocialmindError(f"{path}: not {what}: found {shown(content)}")
    return content


def check_record(content: Any, expected: Expected, place: str) -> None:
    """Raise for the first field that is missing or not what it should be.

    Args:
        content: as JSON gives it.
        expected: its description.
        place: the file, for the error.

    Raises:
        SocialmindError: names the field, what was found and what was expected.

    >>> fields = Fields({"seed": whole()}, {})
    >>> check_record({"seed": -1}, fields, "manifest.json")  # doctest: +ELLIPSIS
    Traceback (most recent call last):
    socialmind.errors.SocialmindError: manifest.json: seed: found -1; expected a whole number, ...
    """
    fault = _fault(content, expected, "")
    if fault is not None:
        field, found, wanted = fault
        raise SocialmindError(
            f"{place}: {f'{field}: ' if field else ''}found {found}; expected {wanted}; "
            "take the file from a copy of the folder"
        )


def _fault(value: Any, expected: Expected, field: str) -> tuple[str, str, str] | None:
    """Field, what was found and what was expected at the first fault of a value."""
    if isinstance(expected, Kind):
        return None if expected.holds(value) else (field, shown(value), expected.expected)
    if isinstance(expected, Many):
        if not isinstance(value, list):
            return field, shown(value), "a list"
        inner = [(f"{field}[{n}]", one, expected.kind) for n, one in enumerate(value)]
    else:
        if not isinstance(value, dict):
            return field, shown(value), "a record of fields"
        begin = f"{field}." if field else ""
        if isinstance(expected, Each):
            inner = [(f"{begin}{name}", one, expected.kind) for name, one in value.items()]
        else:
            missing = [name for name in expected.needed if name not in value]
            if missing:
                return f"{begin}{missing[0]}", "nothing", _wanted(expected.needed[missing[0]])
            known = {**expected.needed, **expected.others}
            inner = [(begin + n, value[n], kind) for n, kind in known.items() if n in value]
    return next((found for one in inner if (found := _fault(one[1], one[2], one[0]))), None)


def _wanted(expected: Expected) -> str:
    if isinstance(expected, Kind):
        return expected.expected
    return "a list" if isinstance(expected, Many) else "a record of fields"


def within(folder: Path, name: str) -> Path:
    """Return a file or folder of a folder; links that lead out of it are refused.

    Raises:
        SocialmindError: it lies elsewhere.
    """
    path = folder / name
    try:
        inside = path.resolve().is_relative_to(folder.resolve())
    except (OSError, RuntimeError):  # a link to itself
        inside = False
    if not inside:
        raise SocialmindError(
            f"{path}: a link out of the folder; put the file itself there, or take it from a copy"
        )
    return path
