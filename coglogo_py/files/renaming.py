"""Names made such that a form of file can hold them, each still its own."""

from __future__ import annotations

from collections.abc import Callable, Hashable, Iterable, Mapping
from typing import TypeVar

Key = TypeVar("Key", bound=Hashable)


def fitting(names: Iterable[str], fit: Callable[[str], str]) -> dict[str, str]:
    """Return a name that fits for each: itself where it does, and no two the same.

    Args:
        names: in order.
        fit: makes of a name one that the file can hold; leaves one that it can.

    >>> fitting(["a b", "a_b", "c"], lambda name: name.replace(" ", "_"))
    {'a b': 'a_b_2', 'a_b': 'a_b', 'c': 'c'}
    """
    return apart({name: name for name in names}, fit)


def apart(wanted: Mapping[Key, str], fit: Callable[[str], str]) -> dict[Key, str]:
    """Return a name that fits for each thing: the one it wants if it may be had, no two the same.

    >>> apart({1: "a", 2: "a", 3: "b c"}, lambda name: name.replace(" ", "_"))
    {1: 'a', 2: 'a_2', 3: 'b_c'}
    """
    taken: dict[str, Key] = {}
    for key, name in wanted.items():
        if fit(name) == name:
            taken.setdefault(name, key)
    for key, name in wanted.items():
        plain = fit(name)
        found, number = plain, 1
        while taken.setdefault(found, key) != key:
            number += 1
            found = f"{plain}_{number}"
    names = {key: name for name, key in taken.items()}
    return {key: names[key] for key in wanted}


def listed(names: Iterable[str]) -> str:
    """Return names as one lists them.

    >>> listed(["a", "b", "c"])
    "'a', 'b' and 'c'"
    """
    *first, last = map(repr, names)
    return f"{', '.join(first)} and {last}" if first else last


def renamed_in_words(kind: str, names: dict[str, str]) -> list[str]:
    """Return a sentence for each name that became another.

    >>> renamed_in_words("plan", {"a=b": "a_b", "c": "c"})
    ["plan 'a=b' is called 'a_b'"]
    """
    return [f"{kind} {old!r} is called {new!r}" for old, new in names.items() if old != new]
